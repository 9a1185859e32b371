"""A drawing: a function over a sketch, with its extent; called with its parameters it gives the key of a sprite."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Concatenate, Generic, NamedTuple, ParamSpec

from ninja_game.play.ui.palette import Palette
from ninja_game.play.view.sprites.sketch import Sketch

Extent = tuple[float, float, float, float]
"""How far a drawing reaches left, up, right and down from its point, logical px."""

P = ParamSpec("P")


class SpriteKey(NamedTuple):
    """What tells one sprite from another. ``turn``: degrees clockwise; ``alpha``: 0 to 8 eighths.

    The parameters are whole numbers or words: few enough to keep every sprite.
    """

    drawing: Drawing[Any]
    parameters: tuple[Any, ...]
    turn: int = 0
    alpha: int = 8

    def turned(self, degrees: int) -> SpriteKey:
        """The same, turned clockwise."""
        return self._replace(turn=degrees)

    def faded(self, alpha: int) -> SpriteKey:
        """The same, ``alpha`` eighths as solid."""
        return self._replace(alpha=alpha)


@dataclass(frozen=True, eq=False)
class Drawing(Generic[P]):
    """``paint(sketch, palette, *parameters)`` draws within ``extent``."""

    extent: Extent
    paint: Callable[Concatenate[Sketch, Palette, P], None]

    def __call__(self, *parameters: P.args, **_named: P.kwargs) -> SpriteKey:
        """The key of this drawing with these parameters."""
        return SpriteKey(self, parameters)


def drawing(*extent: float) -> Callable[[Callable[Concatenate[Sketch, Palette, P], None]], Drawing[P]]:
    """Make a drawing of a function. One number as ``extent`` is a reach to all sides."""
    reach = extent[0]
    box = (-reach, -reach, reach, reach) if len(extent) == 1 else (extent[0], extent[1], extent[2], extent[3])
    return lambda paint: Drawing(box, paint)
