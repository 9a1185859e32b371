"""Colours: four channels of 0 to 255, as a tuple."""

from __future__ import annotations

from functools import lru_cache
from operator import itemgetter
from typing import Any


class Color(tuple[int, int, int, int]):
    """``Color("#rrggbb")``, ``Color("#rrggbbaa")``, ``Color(r, g, b, a=255)``, ``Color((r, g, b))``."""

    __slots__ = ()
    r, g, b, a = (property(itemgetter(k)) for k in range(4))

    def __new__(cls, first: Any, *rest: int) -> Color:
        if first.__class__ is cls:
            return first
        return _color(first, *rest) if isinstance(first, str) or rest else _color(*first)

    def lerp(self, other: Color, share: float) -> Color:
        return _of([int(one * (1 - share) + two * share + 0.5) for one, two in zip(self, Color(other), strict=True)])


def _of(channels: Any) -> Color:
    return tuple.__new__(Color, channels)


@lru_cache(maxsize=2048)
def _color(first: str | int, *rest: int) -> Color:
    if isinstance(first, int):
        channels = (first, *rest, 255)[:4] if len(rest) == 2 else (first, *rest)
    else:
        try:
            channels = tuple(bytes.fromhex(first.removeprefix("#")))
        except ValueError:
            channels = ()
        if len(channels) == 3:
            channels += (255,)
    if len(channels) != 4 or not all(0 <= channel <= 255 for channel in channels):
        raise ValueError("invalid color argument")
    return _of(channels)


@lru_cache(maxsize=4096)
def packed(colour: Any) -> int:
    """A colour as one number, for the display list: red in the highest of four bytes."""
    r, g, b, a = Color(colour)
    return r << 24 | g << 16 | b << 8 | a
