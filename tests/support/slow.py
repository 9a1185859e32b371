"""Tests that take long and rarely fail: only `python3 tools/dev.py test --all` runs them."""

from collections.abc import Iterable, Mapping
from itertools import count
from typing import Any

import pytest

from tests.support.memories import COMPILED

COMPILED_OR_SLOW = (pytest.param("plain", id="plain", marks=pytest.mark.slow), COMPILED)
"""Both memories where compiled runs say nearly as much; golden runs are on both every time."""


def the_rest_is_slow(values: Mapping[str, Any] | Iterable[Any], quick: int) -> list[Any]:
    """Parameters of which only the first few are run every time."""
    named = values.items() if isinstance(values, Mapping) else ((None, value) for value in values)
    marks = ([] if number < quick else [pytest.mark.slow] for number in count())
    return [pytest.param(value, id=name, marks=mark) for (name, value), mark in zip(named, marks, strict=False)]
