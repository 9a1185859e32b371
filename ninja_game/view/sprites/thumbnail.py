"""Small pictures of levels for lists."""

from __future__ import annotations

import pygame

from ninja_game.errors import LevelError
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.level import Level
from ninja_game.sim.loader import tile_map
from ninja_game.sim.schema.world_fields import World
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.theme import Palette
from ninja_game.view.ninja.figure import STAND, ninja_sprite
from ninja_game.view.sprites.backdrop import Backdrop
from ninja_game.view.sprites.drawing import DrawTarget, shared_book
from ninja_game.view.sprites.moving_sprites import draw_moving
from ninja_game.view.sprites.object_animation import ObjectAnimation


def open_exit(world: World) -> None:
    """Open the first exit of a world that is only drawn."""
    for exit_ in [obj for obj in world.objects[1:] if obj.kind == EXIT][:1]:
        exit_.is_open = True


def thumbnail(level: Level, palette: Palette, width: int, *, opened: bool = False) -> pygame.Surface:
    """The level at its start, ``width`` px wide; only the tiles if it cannot be played.

    ``opened``: with its first exit open.
    """
    canvas = Canvas((width, max(1, round(width * HEIGHT / WIDTH))))
    book = shared_book(canvas.scale, palette.base)
    try:
        run = Simulation(level)
    except LevelError:
        backdrop = Backdrop(canvas, palette, book, tile_map(level))
        backdrop.ground.blit(backdrop.tiles, (0, 0), special_flags=pygame.BLEND_PREMULTIPLIED)
        return backdrop.ground
    if opened:
        open_exit(run.world)
    animation = ObjectAnimation(run.world)
    backdrop = Backdrop(canvas, palette, book, run.tiles)
    backdrop.reset(run.world, animation)
    target = DrawTarget(canvas, palette, book)
    target.begin(backdrop.picture)
    draw_moving(target, run.world, animation, 1.0)
    n = run.world.ninja
    target.picture(ninja_sprite(canvas.scale, palette, STAND, 1, (0.0, 0.0), colour=palette.ninja), n.x, n.y)
    backdrop.cover(backdrop.picture, backdrop.picture.get_rect(), (0, 0))
    return backdrop.picture
