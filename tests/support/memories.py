"""Which memories a test runs on: the compiled one only where Numba is."""

import pytest

from ninja_game.backend.memories import compiled_available

PLAIN = pytest.param("plain", id="plain")
COMPILED = pytest.param(
    "compiled", id="compiled", marks=pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
)
BOTH = (PLAIN, COMPILED)
