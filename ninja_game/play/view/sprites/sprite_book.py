"""Every sprite by its key, made when it is first needed and kept."""

from __future__ import annotations

from collections import OrderedDict

from ninja_game.play.ui.palette import Palette
from ninja_game.play.view.sprites.drawing import Extent, SpriteKey
from ninja_game.play.view.sprites.sketch import Sketch, Sprite
from ninja_game.play.view.sprites.tile_sheet import TilePictures

_KEPT = 3000


class SpriteBook:
    """The sprites at one scale in one palette. ``tiles``: the pictures of tiles, for a sheet of them."""

    def __init__(self, scale: float, palette: Palette) -> None:
        self.scale = scale
        self.palette = palette
        self.tiles: TilePictures = {}
        self._kept: OrderedDict[SpriteKey, Sprite] = OrderedDict()

    def sprite(self, key: SpriteKey) -> Sprite:
        """The sprite of a key."""
        found = self._kept.get(key)
        if found is None:
            drawing = key.drawing
            extent = drawing.extent if key.turn == 0 else _turned(drawing.extent)
            sketch = Sketch(self.scale, extent, turn=key.turn)
            drawing.paint(sketch, self.palette, *key.parameters)
            found = sketch.finish(key.alpha / 8)
            self._kept[key] = found
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        return found


def _turned(extent: Extent) -> Extent:
    """Room for a drawing turned by any angle."""
    reach = max((x * x + y * y) ** 0.5 for x in extent[::2] for y in extent[1::2])
    return -reach, -reach, reach, reach
