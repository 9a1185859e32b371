"""How objects of a level look at rest: the game's own drawings, asked for from a small world with these objects."""

from __future__ import annotations

from collections.abc import Iterable
from math import dist
from typing import NamedTuple

import pygame

from ninja_game.editor.draft import Cell, cell_of
from ninja_game.editor.specs import BODY, points, word
from ninja_game.errors import LevelError
from ninja_game.sim import kinds
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec, well_formed
from ninja_game.sim.states import TRAP
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import Palette
from ninja_game.view.ninja.figure import REACH, STAND, paint_figure
from ninja_game.view.sprites import static_sprites
from ninja_game.view.sprites.drawing import DrawTarget, SpriteBook, SpriteKey, drawing, is_near
from ninja_game.view.sprites.moving_sprites import draw_moving
from ninja_game.view.sprites.object_animation import ObjectAnimation
from ninja_game.view.sprites.sketch import Sketch
from ninja_game.view.sprites.static_sprites import PlacedSprite, door_place, static_sprites_of

_NINJA = ObjectSpec(kinds.NINJA, (36.0, 36.0))
_TOGETHER = 1000
"""Objects that are asked for at once: a world holds a few thousand."""
_KEPT = 4000

_HIDDEN = 4
"""Eighths as solid as others are the doors that a player cannot see yet."""


@drawing(REACH)
def _standing(s: Sketch, p: Palette) -> None:
    paint_figure(s, p, STAND, 1, (0.0, 0.0), colour=p.ninja)


class ObjectSprites(NamedTuple):
    """The sprites of an object, the px that they cover (an empty rectangle for what is not drawn), and its cells."""

    sprites: list[PlacedSprite]
    rect: pygame.Rect
    cells: list[Cell]

    def draw(self, target: DrawTarget, *, alpha: int = 8) -> None:
        for key, x, y in self.sprites:
            target.sprite(key if alpha == 8 else key.faded(min(alpha, key.alpha)), x, y)


def _model(spec: ObjectSpec) -> ObjectSpec:
    """The object that looks the same, in the place in which it is asked for; a switch is far from its door."""
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
    """The sprites of objects, for drawing at the scale and in the palette of ``target``.

    What is kept of each model: to which of its parts a sprite belongs, the sprite, and its place from there.
    """

    def __init__(self, target: DrawTarget) -> None:
        self.target = target
        self._kept: dict[ObjectSpec, list[tuple[int, SpriteKey, float, float]]] = {}

    def sprites_of(self, specs: Iterable[ObjectSpec]) -> dict[ObjectSpec, ObjectSprites]:
        """The sprites of each. What looks alike everywhere is asked for once, in one place."""
        models = {spec: _model(spec) for spec in specs}
        if len(self._kept) > _KEPT:
            self._kept.clear()
        asked = [model for model in dict.fromkeys(models.values()) if model not in self._kept]
        self._kept |= {model: [(BODY, _standing(), 0.0, 0.0)] if model.kind == kinds.NINJA else [] for model in asked}
        drawn = [model for model in asked if well_formed(model) and model.kind != kinds.NINJA]
        for start in range(0, len(drawn), _TOGETHER):
            self._learn(drawn[start : start + _TOGETHER])
        return {spec: self._look(spec, model) for spec, model in models.items()}

    def _look(self, spec: ObjectSpec, model: ObjectSpec) -> ObjectSprites:
        places = points(spec)
        if spec.kind == kinds.FLOOR_GUARD and places:
            # It sinks to the floor of its cell.
            x, y = places[BODY]
            places = {BODY: (x, 24.0 * cell_of(x, y)[1] + 18.0)}
        sprites = [
            (key, places[part][0] + x, places[part][1] + y) for part, key, x, y in self._kept[model] if part in places
        ]
        canvas, book = self.target.canvas, self.target.book
        rects, cells = [], [cell_of(*place) for place in places.values()]
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
        noted = _Noted(target.canvas, target.palette, target.book)
        for number, spec in enumerate(specs):
            slot = number + 2
            o = world.objects[slot]
            noted.sprites = static_sprites_of(world, slot, animation, 1.0)
            if spec.kind == kinds.EXIT:
                noted.sprites += static_sprites_of(world, o.partner, animation, 1.0)
            elif spec.kind == kinds.DOOR and o.mechanism == TRAP and (place := door_place(o)):
                noted.sprite(static_sprites.door(TRAP, 0).turned(place[2]).faded(_HIDDEN), place[0], place[1])
            elif slot in moving:
                animation.moving_slots = [slot]
                draw_moving(noted, world, animation, 1.0)
            places = points(spec)
            for key, x, y in noted.sprites if places else ():
                part = min(places, key=lambda part: dist(places[part], (x, y)))
                self._kept[spec].append((part, key, x - places[part][0], y - places[part][1]))
