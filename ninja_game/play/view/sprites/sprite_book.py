"""Every drawing by its key, made when it is first needed and kept."""

from __future__ import annotations

from collections import OrderedDict
from typing import Any

from ninja_game.play.ui.palette import Palette
from ninja_game.play.view.effects import particle_shapes
from ninja_game.play.view.sprites import moving_sprites as movers
from ninja_game.play.view.sprites import static_sprites as fixtures
from ninja_game.play.view.sprites.registry import DRAWINGS, Extent
from ninja_game.play.view.sprites.sketch import Sketch, Sprite

Key = tuple[Any, ...]
"""Name of a drawing and its parameters, which are whole numbers or words: few enough to keep every picture."""

_KEPT = 3000

_SOURCES = (fixtures, movers, particle_shapes)
"""Imported for the drawings that they register."""


class SpriteBook:
    """The drawings at one scale in one palette.

    A key is (name, turn in degrees, alpha in 1/8, further parameters…).
    """

    def __init__(self, scale: float, palette: Palette) -> None:
        self.scale = scale
        self.palette = palette
        self._kept: OrderedDict[Key, Sprite] = OrderedDict()

    def sprite(self, key: Key) -> Sprite:
        """The drawing of a key. Raises KeyError for an unknown name."""
        found = self._kept.get(key)
        if found is None:
            name, turn, alpha, *parameters = key
            entry = DRAWINGS[name]
            extent = entry.extent if turn == 0 else _turned(entry.extent)
            sketch = Sketch(self.scale, extent, turn=turn)
            entry.paint(sketch, self.palette, *parameters)
            found = sketch.finish(alpha / 8)
            self._kept[key] = found
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        return found


def _turned(extent: Extent) -> Extent:
    """Room for a drawing turned by any angle."""
    reach = max((x * x + y * y) ** 0.5 for x in extent[::2] for y in extent[1::2])
    return -reach, -reach, reach, reach
