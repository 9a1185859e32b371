"""How objects of a level look at rest: the game's own drawings, asked for from a small world with these objects."""

from __future__ import annotations

from collections.abc import Iterable

import pygame

from ninja_game.errors import LevelError
from ninja_game.play.ui.canvas import Canvas
from ninja_game.play.ui.palette import Palette
from ninja_game.play.view.ninja.figure import ninja_sprite
from ninja_game.play.view.ninja.pose import STAND
from ninja_game.play.view.sprites import static_sprites
from ninja_game.play.view.sprites.draw_moving import draw_moving
from ninja_game.play.view.sprites.draw_target import DrawTarget, is_near
from ninja_game.play.view.sprites.drawing import SpriteKey
from ninja_game.play.view.sprites.object_animation import ObjectAnimation
from ninja_game.play.view.sprites.sketch import Sprite
from ninja_game.play.view.sprites.sprite_book import SpriteBook
from ninja_game.play.view.sprites.static_sprite_state import PlacedSprite, door_place, static_sprites_of
from ninja_game.sim import kinds
from ninja_game.sim.level import Level, ObjectSpec, makes_object, well_formed
from ninja_game.sim.states import TRAP
from ninja_game.simulation import Simulation

_NINJA = ObjectSpec(kinds.NINJA, (36.0, 36.0))
_TOGETHER = 1000
"""Objects that are asked for at once: a world holds a few thousand."""

_HIDDEN = 4
"""Eighths as solid as others are the doors that a player cannot see yet."""


_TIED = {kinds.DOOR, kinds.EXIT, kinds.FLOOR_GUARD}
"""Kinds that look otherwise in another place: on a side of a cell, with a switch, on the floor."""


def _model(record: ObjectSpec) -> ObjectSpec:
    """The same object in the place in which it is asked for."""
    if record.kind in _TIED:
        return record
    return record._replace(values=(300.0, 300.0, *record.values[2:]))


class _Noted(DrawTarget):
    """Takes down which sprites would be drawn."""

    def __init__(self, canvas: Canvas, palette: Palette, book: SpriteBook) -> None:
        super().__init__(canvas, palette, book)
        self.sprites: list[PlacedSprite] = []

    def sprite(self, key: SpriteKey, x: float, y: float) -> None:
        """Note it."""
        self.sprites.append((key, x, y))


class ObjectPictures:
    """The sprites of every record, found out once and kept. All drawings have the size and palette of ``target``."""

    def __init__(self, target: DrawTarget) -> None:
        self.target = target
        self._kept: dict[ObjectSpec, list[PlacedSprite]] = {}
        self._rects: dict[ObjectSpec, pygame.Rect] = {}
        self._ninja: Sprite | None = None

    def learn(self, records: Iterable[ObjectSpec]) -> None:
        """Find out about those that are not known yet. What looks alike everywhere is asked for once, in one place."""
        new = [record for record in dict.fromkeys(records) if record not in self._kept]
        drawn = [record for record in new if well_formed(record) and record.kind != kinds.NINJA]
        models = {record: _model(record) for record in drawn}
        asked = [model for model in dict.fromkeys(models.values()) if model not in self._kept]
        for start in range(0, len(asked), _TOGETHER):
            self._learn(asked[start : start + _TOGETHER])
        for record in new:
            model = models.get(record, record)
            dx, dy = (
                (a - b for a, b in zip(record.values[:2], model.values[:2], strict=True)) if model != record else (0, 0)
            )
            self._kept[record] = [(key, x + dx, y + dy) for key, x, y in self._kept.get(model, [])]

    def _learn(self, records: list[ObjectSpec]) -> None:
        try:
            world = Simulation(Level(objects=(_NINJA, *records))).world
        except LevelError:
            return
        animation = ObjectAnimation(world)
        statics = {slot: static_sprites_of(world, slot, animation, 1.0) for slot in animation.static_slots}
        moving, target = animation.moving_slots, self.target
        noted = _Noted(target.canvas, target.palette, target.book)
        for number, record in enumerate(records):
            slot = number + 2
            sprites = list(statics.get(slot, ()))
            o = world.objects[slot]
            if record.kind == kinds.EXIT:
                sprites += next((statics[k] for k in statics if world.objects[k].partner == slot and k != slot), [])
            elif record.kind == kinds.DOOR and o.mechanism == TRAP and (place := door_place(o)):
                bar = static_sprites.door(TRAP, 0).turned(place[2]).faded(_HIDDEN)
                sprites.append((bar, place[0], place[1]))
            elif slot in moving:
                animation.moving_slots, noted.sprites = [slot], []
                draw_moving(noted, world, animation, 1.0)
                sprites += noted.sprites
            self._kept[record] = sprites

    def draw(self, target: DrawTarget, record: ObjectSpec, *, alpha: int = 8) -> None:
        """Draw an object in its place; ``alpha``: eighths as solid."""
        if record.kind == kinds.NINJA and makes_object(record) and len(record.values) == 2:
            target.picture(self._figure(alpha), *record.values)
        for key, x, y in self._kept.get(record, ()):
            target.sprite(key if alpha == 8 else key.faded(min(alpha, key.alpha)), x, y)

    def _figure(self, alpha: int) -> Sprite:
        target = self.target
        if self._ninja is None:
            self._ninja = ninja_sprite(
                target.canvas.scale, target.palette, STAND, 1, (0.0, 0.0), colour=target.palette.ninja
            )
        if alpha == 8:
            return self._ninja
        faded = self._ninja.surface.copy()
        faded.fill((32 * alpha,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
        return self._ninja._replace(surface=faded)

    def rect(self, record: ObjectSpec) -> pygame.Rect:
        """The px that an object covers; an empty rectangle for what is not drawn."""
        if record not in self._rects:
            self._rects[record] = self._covered(record)
        return self._rects[record]

    def _covered(self, record: ObjectSpec) -> pygame.Rect:
        canvas, book = self.target.canvas, self.target.book
        found = pygame.Rect(0, 0, 0, 0)
        placed = [(book.sprite(key), x, y) for key, x, y in self._kept.get(record, ())]
        if record.kind == kinds.NINJA and len(record.values) == 2:
            placed.append((self._figure(8), *record.values))
        for sprite, x, y in placed:
            if is_near(x, y):
                px, py = canvas.point(x, y)
                box = sprite.surface.get_rect(topleft=(px - sprite.ax, py - sprite.ay))
                found = found.union(box) if found.width else box
        return found
