"""The palette: all tiles and all types of objects as they look; a click takes one in hand."""

from __future__ import annotations

from functools import lru_cache

import pygame

from ninja_game.editor.brush import (
    EMPTY,
    FAMILIES,
    FULL,
    OBJECT_TYPE_NAMES,
    OBJECT_TYPES,
    ObjectType,
    object_type_of,
    tile_key,
    tile_name,
    with_switch,
)
from ninja_game.editor.motion import TILE_IDS
from ninja_game.editor.specs import BODY, points
from ninja_game.editor.tools import EditorTools
from ninja_game.play.editor.object_pictures import ObjectPictures
from ninja_game.sim.level import ObjectSpec
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.input.keys import key_label_of
from ninja_game.ui.theme import PALETTES, Area, Theme, inside
from ninja_game.ui.widgets import Widget
from ninja_game.view.sprites.drawing import DrawTarget, SpriteBook
from ninja_game.view.sprites.tile_sheet import tile_picture

TILE, OBJECT, KEY = 16.0, 28.0, 8.0
"""Sides of the squares, and the height of the key below an object, px."""
BLOCK, BLOCK_ROW = 42.5, 35.0
"""From one family of tiles to the next, px."""
_OBJECTS = 104.0
"""From the top to the objects, px."""
OBJECTS_PER_ROW = 6

TILE_ORDER = (EMPTY, FULL, *(tile for family in FAMILIES for tile in family.tiles))

_TILE_KEYS = {family.key for family in FAMILIES}
"""Keys that choose tiles, where tiles are drawn; the other ones choose objects there too."""


class PaletteView(Widget):
    """Tiles above, objects below. ``hovered``: what the mouse is over."""

    def __init__(self, area: Area, tools: EditorTools) -> None:
        super().__init__(area)
        self.tools = tools
        self.hovered: int | ObjectType | None = None

    def places(self) -> list[tuple[int | ObjectType, Area]]:
        """Every entry with its square; the four tiles of a family stand as their keys Q W A S do."""
        x, y, _, _ = self.area
        found: list[tuple[int | ObjectType, Area]] = []
        for number, tile in enumerate((EMPTY, FULL)):
            found.append((tile, (x + 34 + number * (TILE + 3), y + 1, TILE, TILE)))
        for number, family in enumerate(FAMILIES):
            row, column = divmod(number, 4)
            left, top = x + 11 + column * BLOCK, y + 21 + row * BLOCK_ROW
            for k, tile in enumerate(family.tiles):
                found.append((tile, (left + k % 2 * TILE, top + k // 2 * TILE, TILE, TILE)))
        for number, object_type in enumerate(OBJECT_TYPES):
            row, column = divmod(number, OBJECTS_PER_ROW)
            top = y + _OBJECTS + row * (OBJECT + KEY)
            found.append((object_type, (x + column * (OBJECT + 0.6), top, OBJECT, OBJECT)))
        return found

    @property
    def _in_hand(self) -> int | ObjectType:
        tools = self.tools
        return OBJECT_TYPES[OBJECT_TYPE_NAMES.index(object_type_of(tools.spec))] if tools.objects else tools.tile

    @property
    def said(self) -> str:
        """What is under the mouse, or else in hand, and its keys."""
        return _said(self._in_hand if self.hovered is None else self.hovered)

    def _at(self, x: float, y: float) -> int | ObjectType | None:
        return next((what for what, area in self.places() if inside(area, x, y)), None)

    def contains(self, x: float, y: float) -> bool:
        """Whether an entry is there: what lies between them is others'."""
        return self._at(x, y) is not None

    def click(self, x: float, y: float) -> bool:
        what = self._at(x, y)
        if what is not None:
            self.tools.pick_up(what.spec if isinstance(what, ObjectType) else what)
        return True

    def hover(self, x: float, y: float) -> str:
        """The mouse is there: what it is over, and how to take it by keys."""
        self.hovered = self._at(x, y)
        if self.hovered is None:
            return ""
        return f"{_said(self.hovered)} among the {'objects' if isinstance(self.hovered, ObjectType) else 'tiles'}"

    def step(self, by: int) -> None:
        """The entry before or after the one in hand; while something is drawn only a line bends."""
        tools = self.tools
        if tools.bend(by):
            return
        if tools.objects:
            names = [object_type.name for object_type in OBJECT_TYPES]
            tools.pick_up(OBJECT_TYPES[(names.index(object_type_of(tools.spec)) + by) % len(OBJECT_TYPES)].spec)
        else:
            place = TILE_ORDER.index(tools.tile) if tools.tile in TILE_ORDER else 0
            tools.pick_up(TILE_ORDER[(place + by) % len(TILE_ORDER)])

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        canvas, palette = theme.canvas, theme.palette
        x, y, _, _ = self.area
        tools = self.tools
        for text, top, lit in (("Tiles", y + 4, not tools.objects), ("Objects", y + 91, tools.objects)):
            colour = palette.accent if lit else palette.text
            theme.text(surface, text, x + 1, top, size=10, colour=colour, bold=lit)
        for number, family in enumerate(FAMILIES):
            row, column = divmod(number, 4)
            at = x + 3 + column * BLOCK, y + 32 + row * BLOCK_ROW
            if not tools.objects:
                theme.text(surface, family.key, *at, size=8)
        for what, area in self.places():
            canvas.fill_rect(surface, palette.background, *area)
            at = canvas.point(area[0], area[1])
            surface.blit(self._icon(theme, what, area), at, special_flags=pygame.BLEND_PREMULTIPLIED)
            if isinstance(what, ObjectType) and (tools.objects or what.key not in _TILE_KEYS):
                middle, top = area[0] + OBJECT / 2, area[1] + OBJECT
                theme.text(surface, key_label_of(what.key), middle, top, size=7.5, align="centre", height=KEY)
            if what in (EMPTY, FULL):
                canvas.frame_rect(surface, palette.panel_edge, *area)
            if what == self._in_hand:
                canvas.frame_rect(surface, palette.accent, *area, 2)

    def _icon(self, theme: Theme, what: int | ObjectType, area: Area) -> pygame.Surface:
        size = theme.canvas.rect(*area).size
        if not isinstance(what, ObjectType):
            return tile_icon(what, size, theme.palette.base.name)
        # The one in hand as it is drawn now.
        in_hand = self.tools.objects and object_type_of(self.tools.spec) == what.name
        return object_icon(self.tools.spec if in_hand else what.spec, size, theme.canvas.scale, theme.palette.base.name)


def _said(what: int | ObjectType) -> str:
    if isinstance(what, ObjectType):
        return f"{what.name.capitalize()}: {key_label_of(what.key)}"
    name = tile_name(what)
    return f"{name[0].upper()}{name[1:]}: {tile_key(what)}"


@lru_cache(maxsize=200)
def tile_icon(tile: int, size: tuple[int, int], palette: str, alpha: int = 255) -> pygame.Surface:
    """A tile as large as ``size``; nothing for what has no shape. ``palette``: its name."""
    picture = tile_picture(tile, size, tuple(PALETTES[palette].tile)).copy() if tile in TILE_IDS else None
    picture = picture or pygame.Surface(size, pygame.SRCALPHA)
    picture.fill((alpha,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    return picture


@lru_cache(maxsize=200)
def object_icon(spec: ObjectSpec, size: tuple[int, int], scale: float, palette: str) -> pygame.Surface:
    """An object in the middle of a small picture; of a door or an exit without its switch."""
    canvas = Canvas((round(792 * scale), round(600 * scale)))
    far = with_switch(spec, 700.0, 500.0, "half")
    x, y = points(far)[BODY]
    px, py = canvas.point(x, y)
    canvas.origin = size[0] // 2 - px, size[1] // 2 - py
    target = DrawTarget(canvas, PALETTES[palette], SpriteBook(canvas.scale, PALETTES[palette]))
    icon = pygame.Surface(size, pygame.SRCALPHA)
    target.begin(icon)
    ObjectPictures(target).sprites_of([far])[far].draw(target)
    return icon
