"""Marks beside what warns by a sound: rocket, laser and chaingun, chase, turret; each has a shape of its own."""

from __future__ import annotations

from ninja_game.sim.memory.schema import World
from ninja_game.ui.audio.table import warning_of
from ninja_game.ui.canvas import HEIGHT, WIDTH, Point
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.drawing import DrawTarget, drawing
from ninja_game.view.sprites.sketch import Sketch

ABOVE = 24.0
"""How far over its source a mark stands, px."""
_BORDER = 14.0

_SHAPES: dict[str, list[Point]] = {
    "rocket": [(0, -6), (5, 5), (0, 2), (-5, 5)],
    "weapon": [(1, -6), (-5, 1), (-1, 1), (-1, 6), (5, -1), (1, -1)],
    "chase": [(-1.6, -6), (1.6, -6), (0.8, 2), (-0.8, 2)],
    "turret": [(0, -6), (6, 0), (0, 6), (-6, 0)],
}


@drawing(10)
def cue(s: Sketch, p: Palette, warning: str) -> None:
    """A disc with the shape of a warning."""
    s.disc(p.outline, 0, 0, 9)
    s.disc(p.bright, 0, 0, 7.8)
    s.polygon(p.mine, _SHAPES[warning])
    if warning == "chase":
        s.disc(p.mine, 0, 4.6, 1.4)
    elif warning == "turret":
        s.disc(p.bright, 0, 0, 2.4)


def draw_sound_cues(target: DrawTarget, world: World) -> None:
    """The marks of a world, above their sources and never out of the stage."""
    for o in world.objects[1 : world.id_count + 1]:
        warning = warning_of(o)
        if warning:
            x = min(WIDTH - _BORDER, max(_BORDER, o.x))
            y = min(HEIGHT - _BORDER, max(_BORDER, o.y - ABOVE))
            target.sprite(cue(warning), x, y)
