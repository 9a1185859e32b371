"""The table of drawings by name; each module of drawings fills it when it is imported."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

Extent = tuple[float, float, float, float]
"""How far a drawing reaches left, up, right and down from its point, logical px."""


class Drawing(NamedTuple):
    """A registered drawing: ``paint(sketch, palette, *parameters)`` within ``extent``."""

    extent: Extent
    paint: Callable[..., None]


DRAWINGS: dict[str, Drawing] = {}


def drawing(name: str, *extent: float) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Register a function as the drawing of a name. One number as ``extent`` is a reach to all sides."""
    reach = extent[0]
    box = (-reach, -reach, reach, reach) if len(extent) == 1 else (extent[0], extent[1], extent[2], extent[3])

    def register(paint: Callable[..., None]) -> Callable[..., None]:
        DRAWINGS[name] = Drawing(box, paint)
        return paint

    return register
