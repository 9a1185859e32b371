"""A figure's picture, and a film of its demonstration."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.play.lab.figures.catalogue import FIGURES
from ninja_game.play.lab.sheet import FIGURE, Sheet
from ninja_game.play.replay.film import write_gif
from ninja_game.play.ui.canvas import HEIGHT, WIDTH
from ninja_game.play.view.render_context import OffscreenContext
from ninja_game.play.window import save_picture

FILM_TICKS = 240
PICTURE_TICK = 100
"""Where in its demonstration a figure is photographed."""


def figure_pictures(name: str, *, scale: float = 1.0, ticks: int = FILM_TICKS) -> Iterator[pygame.Surface]:
    """The figure after each tick of its demonstration, without anything around it."""
    pygame.font.init()
    context = OffscreenContext((round(WIDTH * scale), round(HEIGHT * scale)))
    surface = pygame.Surface(context.canvas.window)
    figure = FIGURES[name]()
    for tick in range(ticks):
        figure.demonstrate(tick)
        figure.tick()
        sheet = Sheet(surface, context.theme, figure.view)
        figure.draw(sheet)
        sheet.close()
        yield surface.subsurface(context.canvas.rect(*FIGURE))


def export_figure(name: str, path: Path, *, scale: float = 1.0) -> None:
    """Write a figure as PNG, or its demonstration as GIF. Raises NinjaGameError for another suffix, OSError."""
    if path.suffix == ".png":
        *_, last = figure_pictures(name, scale=scale, ticks=PICTURE_TICK)
        save_picture(last, path)
    elif path.suffix == ".gif":
        pictures = figure_pictures(name, scale=scale)
        context = OffscreenContext((round(WIDTH * scale), round(HEIGHT * scale)))
        palette, size = context.theme.palette, context.canvas.rect(*FIGURE).size
        write_gif(pictures, FILM_TICKS, path, size, 1.0, palette)
    else:
        raise NinjaGameError(f"{path}: a figure is written as .png or .gif")
