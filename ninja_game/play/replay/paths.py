"""A picture of runs: their paths over the level, and below it speed over time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pygame
from numpy.typing import NDArray

from ninja_game.sim.level import Level
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.theme import Palette, Theme, run_colour
from ninja_game.view.sprites.thumbnail import thumbnail

Path = tuple[str, NDArray[np.float64]]  # a run's name and its positions, float64 (ticks, 2), px

PLOT_HEIGHT = 150  # height of the plot of speeds, logical px

_LEFT, _TOP, _BOTTOM = 40.0, 26.0, 22.0  # margins of the plot, logical px


def paths_picture(level: Level, paths: Sequence[Path], palette: Palette, width: int) -> pygame.Surface:
    """The level with the paths, and the speeds (px/tick over seconds) below; ``width``: px of the picture."""
    above = thumbnail(level, palette, width)
    theme = Theme(palette, Canvas((width, round(width * HEIGHT / WIDTH))))
    for number, (_, positions) in reversed([*enumerate(paths)]):  # the first on top
        draw_path(above, theme.canvas, positions, run_colour(number))
    picture = pygame.Surface((width, above.get_height() + theme.canvas.px(PLOT_HEIGHT)))
    picture.fill(palette.background)
    picture.blit(above, (0, 0))
    below = picture.subsurface((0, above.get_height(), width, theme.canvas.px(PLOT_HEIGHT)))
    _draw_speeds(below, theme, paths)
    return picture


def draw_path(
    surface: pygame.Surface, canvas: Canvas, positions: NDArray[np.float64], colour: pygame.Color, width: float = 1.5
) -> pygame.Rect:
    """Draw a path, ``width`` logical px wide, over a picture of its level; the px that it covers."""
    if len(positions) < 2:
        return pygame.Rect(0, 0, 0, 0)
    x, y = (positions * canvas.scale + canvas.origin).T.tolist()
    points = list(zip(x, y, strict=True))
    thick = max(1, canvas.px(width))
    return pygame.draw.lines(surface, colour, False, points, thick).inflate(2 * thick, 2 * thick)


def _draw_speeds(surface: pygame.Surface, theme: Theme, paths: Sequence[Path]) -> None:
    canvas, faint = theme.canvas, theme.palette.faint
    speeds = [np.hypot(*np.diff(positions, axis=0).T) for _, positions in paths]
    seconds = max(1.0, *(len(positions) / TICKS_PER_SECOND for _, positions in paths))
    fastest = max(1.0, *(float(speed.max(initial=0)) for speed in speeds))
    floor, right = PLOT_HEIGHT - _BOTTOM, WIDTH - 14.0

    def at(second: float, speed: float) -> tuple[float, float]:
        x = _LEFT + (right - _LEFT) * second / seconds
        return canvas.exact(x, floor - (floor - _TOP) * speed / fastest)

    for speed in (0.0, fastest / 2, fastest):
        pygame.draw.line(surface, faint, at(0, speed), at(seconds, speed))
        theme.text(surface, f"{speed:.1f}", _LEFT - 5, at(0, speed)[1] / canvas.scale - 5, align="right", colour=faint)
    step = max(1, round(seconds / 10))
    for second in range(0, int(seconds) + 1, step):
        theme.text(surface, f"{second} s", at(second, 0)[0] / canvas.scale, floor + 6, align="centre", colour=faint)
    theme.text(surface, "px/tick", 6, 5, colour=faint)
    x = _LEFT + 20
    for number, (name, _) in enumerate(paths):
        colour = run_colour(number)
        points = [at((tick + 1) / TICKS_PER_SECOND, speed) for tick, speed in enumerate(speeds[number].tolist())]
        if len(points) > 1:
            pygame.draw.lines(surface, colour, False, points, max(1, canvas.px(1)))
        x = theme.text(surface, name, x, 5, colour=colour, bold=True, width=150).right / canvas.scale + 16
