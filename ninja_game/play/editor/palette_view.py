"""The palette: pictures of all tiles and all types of objects; a click chooses one to draw with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from math import dist
from typing import NamedTuple

import pygame

from ninja_game.editor.motion import TILE_IDS
from ninja_game.editor.palette import (
    EMPTY,
    FAMILIES,
    FULL,
    OBJECT_TYPE_NAMES,
    OBJECT_TYPES,
    QUARTERS,
    TILE_KEYS,
    ObjectType,
    object_type_of,
    tile_name,
    with_switch,
)
from ninja_game.editor.specs import BODY_PART, points, properties, word
from ninja_game.editor.tools import EditorTools
from ninja_game.errors import LevelError
from ninja_game.sim import kinds
from ninja_game.sim.grid import Cell, Point, cell_of
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec, well_formed
from ninja_game.sim.rules import CELL
from ninja_game.sim.states import TRAP
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.input.keys import key_label_of
from ninja_game.ui.theme import PALETTES, Area, Palette, Theme, contains_point, mixed
from ninja_game.ui.widgets import Widget
from ninja_game.view.ninja.figure import FIGURE_REACH, STAND, paint_figure
from ninja_game.view.sprites import static_sprites
from ninja_game.view.sprites.drawing import DrawTarget, SpriteBook, SpriteKey, drawn_within, is_near
from ninja_game.view.sprites.moving_sprites import draw_moving
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.sketch import Sketch
from ninja_game.view.sprites.static_sprites import PlacedSprite, door_place, static_sprites_of
from ninja_game.view.sprites.tile_sheet import tile_picture

_NINJA = ObjectSpec(kinds.NINJA, (36.0, 36.0))
_TOGETHER = 1000  # objects that one world is built with: its memory holds a few thousand
_KEPT = 4000

_HIDDEN = 4  # opacity in eighths of a door that a player cannot see yet


@drawn_within(FIGURE_REACH)
def _standing(s: Sketch, p: Palette) -> None:
    paint_figure(s, p, STAND, 1, (0.0, 0.0), colour=p.ninja)


class ObjectSprites(NamedTuple):
    """The sprites of an object, the px that they cover (an empty rectangle if there are none), and its cells."""

    sprites: list[PlacedSprite]
    rect: pygame.Rect
    cells: list[Cell]

    def draw(self, target: DrawTarget, *, alpha: int = 8) -> None:
        for key, x, y in self.sprites:
            target.sprite(key if alpha == 8 else key.faded(min(alpha, key.alpha)), x, y)


def _model(spec: ObjectSpec) -> ObjectSpec:
    """An object with the same sprites at a fixed place; a switch is far from its door."""
    kind, values = spec.kind, spec.values
    if not well_formed(spec):
        return spec
    if kind == kinds.EXIT:
        return spec._replace(values=(300.0, 300.0, 100.0, 100.0))
    if kind == kinds.DOOR:
        column, row = values[4] + values[7], values[5] + values[8]
        nowhere = not (0 <= column <= COLUMNS + 1 and 0 <= row <= ROWS + 1) or column == row == 0
        if not (word(spec, "side") and column.is_integer() and row.is_integer()):
            return spec
        return spec._replace(values=(100.0, 100.0, *values[2:4], *([-50.0 if nowhere else 12.0] * 2), *values[6:]))
    return spec._replace(values=(300.0, 306.0 if kind == kinds.FLOOR_GUARD else 300.0, *values[2:]))


class _Noted(DrawTarget):
    def __init__(self, canvas: Canvas, palette: Palette, book: SpriteBook) -> None:
        super().__init__(canvas, palette, book)
        self.sprites: list[PlacedSprite] = []

    def sprite(self, key: SpriteKey, x: float, y: float) -> None:
        self.sprites.append((key, x, y))


class ObjectPictures:
    """The sprites of objects, to be drawn at the scale and in the palette of ``target``.

    Cached for each model: the part to which a sprite belongs, the sprite, and its offset.
    """

    def __init__(self, target: DrawTarget) -> None:
        self.target = target
        self._kept: dict[ObjectSpec, list[tuple[int, SpriteKey, float, float]]] = {}

    def sprites_of(self, specs: Iterable[ObjectSpec]) -> dict[ObjectSpec, ObjectSprites]:
        """The sprites of each object. Objects with the same sprites at every place are simulated once."""
        models = {spec: _model(spec) for spec in specs}
        if len(self._kept) > _KEPT:
            self._kept.clear()
        unknown = [model for model in dict.fromkeys(models.values()) if model not in self._kept]
        self._kept |= {
            model: [(BODY_PART, _standing(), 0.0, 0.0)] if model.kind == kinds.NINJA else [] for model in unknown
        }
        drawn = [model for model in unknown if well_formed(model) and model.kind != kinds.NINJA]
        for start in range(0, len(drawn), _TOGETHER):
            self._learn(drawn[start : start + _TOGETHER])
        return {spec: self._look(spec, model) for spec, model in models.items()}

    def _look(self, spec: ObjectSpec, model: ObjectSpec) -> ObjectSprites:
        places = points(spec)
        if spec.kind == kinds.FLOOR_GUARD and places:
            # It sinks to the floor of its cell.
            x, y = places[BODY_PART]
            places = {BODY_PART: (x, CELL * cell_of(x, y)[1] + 18.0)}
        sprites = [(key, places[at][0] + x, places[at][1] + y) for at, key, x, y in self._kept[model] if at in places]
        canvas, book = self.target.canvas, self.target.book
        rects = []
        cells = [cell_of(*place) for place in places.values()]
        for key, x, y in sprites:
            if is_near(x, y):
                sprite, (px, py) = book.sprite(key), canvas.point(x, y)
                rects.append(sprite.surface.get_rect(topleft=(px - sprite.ax, py - sprite.ay)))
        return ObjectSprites(sprites, rects[0].unionall(rects[1:]) if rects else pygame.Rect(0, 0, 0, 0), cells)

    def _learn(self, specs: list[ObjectSpec]) -> None:
        try:
            world = Simulation(Level(objects=(_NINJA, *specs))).world
        except LevelError:
            return
        animation = ObjectAnimation(world)
        moving, target = set(animation.moving_slots), self.target
        recorder = _Noted(target.canvas, target.palette, target.book)
        for number, spec in enumerate(specs):
            slot = number + 2
            o = world.objects[slot]
            recorder.sprites = static_sprites_of(world, slot, animation, 1.0)
            if spec.kind == kinds.EXIT:
                recorder.sprites += static_sprites_of(world, o.partner, animation, 1.0)
            elif spec.kind == kinds.DOOR and o.mechanism == TRAP and (place := door_place(o)):
                recorder.sprite(static_sprites.door(TRAP, 0).turned(place[2]).faded(_HIDDEN), place[0], place[1])
            elif slot in moving:
                animation.moving_slots = [slot]
                draw_moving(recorder, world, animation, 1.0)
            places = points(spec)
            for key, x, y in recorder.sprites if places else ():
                part = min(places, key=lambda part: dist(places[part], (x, y)))
                self._kept[spec].append((part, key, x - places[part][0], y - places[part][1]))


TILE, OBJECT, KEY = 16.0, 28.0, 8.0
"""Sides of the squares of tiles and objects, and the height of the key below an object, px."""
_BLOCK, BLOCK_ROW = 42.5, 35.0  # distance between two families of tiles, across and down, px
_OBJECTS = 104.0  # distance from the top to the objects, px
OBJECTS_PER_ROW = 6

TILE_ORDER = (EMPTY, FULL, *(tile for family in FAMILIES for tile in family.tiles))

CHANGES: dict[str, dict[str, str | int]] = {
    "direction": {"w": "up", "a": "left", "s": "down", "d": "right"},
    "side": {"w": "top", "a": "left", "s": "bottom", "d": "right"},
    "movement": {"q": -1, "e": 1},
    "seeker": {"n": 1},
}
"""The letters that change each property of the drawn or selected objects: to a word, or by a number of words."""

PaletteEntry = int | ObjectType  # a tile or a type of objects

_FAMILY_OF_KEY = {family.key: family for family in FAMILIES}
_ENTRY_OF_KEY: dict[str, PaletteEntry] = {
    **{key: tile for tile, key in TILE_KEYS.items()},
    **{f"shift+{object_type.key}": object_type for object_type in OBJECT_TYPES},
}


def live_changes(tools: EditorTools) -> dict[str, dict[str, str | int]]:
    """The members of CHANGES whose letters act now."""
    names = [name for spec in tools.selected.subjects for name in properties(spec)] if tools.about_objects else []
    return {name: CHANGES[name] for name in dict.fromkeys(names) if name in CHANGES}


def entry_of_key(tools: EditorTools, key: str) -> PaletteEntry | None:
    """What a key takes, whatever is in hand: a digit a tile, Shift and a letter an object.

    With tiles a letter of QUARTERS takes that quarter of the family in hand.
    """
    tile = tools.brush.tile
    family = next((item for item in FAMILIES if tile in item.tiles), FAMILIES[0])
    if key in _FAMILY_OF_KEY:
        return _FAMILY_OF_KEY[key].tiles[family.tiles.index(tile) if tile in family.tiles else 0]
    if key in list(QUARTERS) and not tools.about_objects:
        return family.tiles[QUARTERS.index(key)]
    return _ENTRY_OF_KEY.get(key)


class PaletteView(Widget):
    """The tiles, and the objects below them. ``hovered``: the entry under the mouse."""

    def __init__(self, area: Area, tools: EditorTools) -> None:
        super().__init__(area)
        self.tools = tools
        self.hovered: PaletteEntry | None = None

    def places(self) -> list[tuple[PaletteEntry, Area]]:
        """Every entry with its square; the four tiles of a family lie like their keys Q W A S."""
        x, y, _, _ = self.area
        areas: list[tuple[PaletteEntry, Area]] = []
        for number, tile in enumerate((EMPTY, FULL)):
            areas.append((tile, (x + 104 + number * (TILE + 14), y + 1, TILE, TILE)))
        for number, family in enumerate(FAMILIES):
            row, column = divmod(number, 4)
            left, top = x + 11 + column * _BLOCK, y + 21 + row * BLOCK_ROW
            for k, tile in enumerate(family.tiles):
                areas.append((tile, (left + k % 2 * TILE, top + k // 2 * TILE, TILE, TILE)))
        for number, object_type in enumerate(OBJECT_TYPES):
            row, column = divmod(number, OBJECTS_PER_ROW)
            top = y + _OBJECTS + row * (OBJECT + KEY)
            areas.append((object_type, (x + column * (OBJECT + 0.6), top, OBJECT, OBJECT)))
        return areas

    @property
    def _in_hand(self) -> PaletteEntry:
        if not self.tools.brush.draws_objects:
            return self.tools.brush.tile
        return OBJECT_TYPES[OBJECT_TYPE_NAMES.index(object_type_of(self.tools.brush.spec))]

    @property
    def label(self) -> str:
        """The name of the entry under the mouse, or else of the chosen one; of objects with the key."""
        what = self._in_hand if self.hovered is None else self.hovered
        if isinstance(what, ObjectType):
            return f"{what.name.capitalize()} (Shift+{key_label_of(what.key)})"
        name = tile_name(what)
        return f"{name[0].upper()}{name[1:]}"

    def _at(self, x: float, y: float) -> PaletteEntry | None:
        return next((entry for entry, area in self.places() if contains_point(area, x, y)), None)

    def contains(self, x: float, y: float) -> bool:
        """Whether there is an entry at a point; the mouse between two entries means nothing here."""
        return self._at(x, y) is not None

    def click(self, x: float, y: float) -> bool:
        entry = self._at(x, y)
        if entry is not None:
            self.take(entry)
        return True

    def take(self, entry: PaletteEntry) -> None:
        self.tools.pick_up(entry.spec if isinstance(entry, ObjectType) else entry)

    def hover(self, x: float, y: float) -> None:
        self.hovered = self._at(x, y)

    def step(self, by: int) -> None:
        """The entry before or after the chosen one; while something is drawn only the bend of a line changes."""
        tools = self.tools
        if tools.bend(by):
            return
        entries: Sequence[PaletteEntry] = OBJECT_TYPES if tools.brush.draws_objects else TILE_ORDER
        place = entries.index(self._in_hand) if self._in_hand in entries else 0
        self.take(entries[(place + by) % len(entries)])

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        canvas, palette = theme.canvas, theme.palette
        x, y, w, _ = self.area
        objects = self.tools.brush.draws_objects
        for text, top, height, lit in (("Tiles", y, 89, not objects), ("Objects: Shift+letter", y + 89, 126, objects)):
            if lit:
                lit_area = x - 3, top - 2, w + 5, height
                canvas.fill_rect(surface, mixed(palette.panel, palette.accent, 0.2), *lit_area, 3)
                canvas.frame_rect(surface, palette.accent, *lit_area, 1, 3)
            theme.text(surface, text, x + 1, top + 2, size=10, bold=lit)
        for number, family in enumerate(FAMILIES):
            row, column = divmod(number, 4)
            at = x + 3 + column * _BLOCK, y + 32 + row * BLOCK_ROW
            self._draw_key(surface, theme, family.key, at)
        for entry, area in self.places():
            canvas.fill_rect(surface, palette.background, *area)
            at = canvas.point(area[0], area[1])
            surface.blit(self._icon(theme, entry, area), at, special_flags=pygame.BLEND_PREMULTIPLIED)
            if isinstance(entry, ObjectType):
                below = area[0] + OBJECT / 2 - 2.5, area[1] + OBJECT
                self._draw_key(surface, theme, entry.key, below)
            elif entry in TILE_KEYS:
                self._draw_key(surface, theme, TILE_KEYS[entry], (area[0] - 9, area[1] + 4))
                canvas.frame_rect(surface, palette.panel_edge, *area)
            if entry == self._in_hand:
                canvas.frame_rect(surface, palette.accent, *area, 2)

    def _draw_key(self, surface: pygame.Surface, theme: Theme, key: str, at: Point) -> None:
        theme.text(surface, key_label_of(key), *at, size=8, height=KEY, bold=True)

    def _icon(self, theme: Theme, entry: PaletteEntry, area: Area) -> pygame.Surface:
        size = theme.canvas.rect(*area).size
        if not isinstance(entry, ObjectType):
            return tile_icon(entry, size, theme.palette.base.name)
        # The chosen entry with its present properties.
        in_hand = self.tools.brush.draws_objects and object_type_of(self.tools.brush.spec) == entry.name
        return object_icon(
            self.tools.brush.spec if in_hand else entry.spec, size, theme.canvas.scale, theme.palette.base.name
        )


@lru_cache(maxsize=200)
def tile_icon(tile: int, size: tuple[int, int], palette: str, alpha: int = 255) -> pygame.Surface:
    """A tile as large as ``size``; empty for a tile without shape. ``palette``: its name."""
    picture = tile_picture(tile, size, tuple(PALETTES[palette].tile)).copy() if tile in TILE_IDS else None
    picture = picture or pygame.Surface(size, pygame.SRCALPHA)
    picture.fill((alpha,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    return picture


@lru_cache(maxsize=200)
def object_icon(spec: ObjectSpec, size: tuple[int, int], scale: float, palette: str) -> pygame.Surface:
    """An object in the middle of a small picture; a door or an exit without its switch."""
    canvas = Canvas((round(WIDTH * scale), round(HEIGHT * scale)))
    far = with_switch(spec, 700.0, 500.0, "half")
    x, y = points(far)[BODY_PART]
    px, py = canvas.point(x, y)
    canvas.origin = size[0] // 2 - px, size[1] // 2 - py
    target = DrawTarget(canvas, PALETTES[palette], SpriteBook(canvas.scale, PALETTES[palette]))
    icon = pygame.Surface(size, pygame.SRCALPHA)
    target.begin(icon)
    ObjectPictures(target).sprites_of([far])[far].draw(target)
    return icon
