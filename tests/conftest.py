"""What all tests share: no real screen, no sound card, and where the reference data lies if it is there."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def root() -> Path:
    """The project's folder."""
    return ROOT


@pytest.fixture(scope="session")
def reference() -> Path:
    """The folder of the reference data; a test that asks for it skips where that is missing."""
    folder = ROOT.parent / "shared" / "n14"
    if not folder.is_dir():
        pytest.skip("the reference data ../shared/n14 is not here")
    return folder
