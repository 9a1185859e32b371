"""Medals and the mark for all gold: a letter tells them apart as well as the metal."""

from __future__ import annotations

import pygame

from ninja_game.formats.pack.pars import MARGINS
from ninja_game.play.ui.theme import Theme

_METALS = {"bronze": "#b8743a", "silver": "#b4bcc6", "gold": "#e3b021", "author": "#5fb2a5"}
_INK = pygame.Color("#1d1d22")
MEDALS = tuple(reversed(MARGINS))
"""All of them, the easiest first."""


def draw_medal(
    surface: pygame.Surface, theme: Theme, medal: str, x: float, y: float, size: float = 14, *, reached: bool = True
) -> None:
    """A disc with the medal's first letter, its middle at x, y; only its rim where it is not reached."""
    canvas, palette = theme.canvas, theme.palette
    if reached:
        canvas.circle(surface, pygame.Color(_METALS[medal]), (x, y), size / 2)
        canvas.circle(surface, _INK, (x, y), size / 2, 1)
    else:
        canvas.circle(surface, palette.panel_edge, (x, y), size / 2, 1)
    ink = _INK if reached else palette.faint
    letter = size * 0.58
    theme.text(surface, medal[0].upper(), x, y - letter / 2, size=letter, colour=ink, align="centre", bold=True)


def draw_all_gold(surface: pygame.Surface, theme: Theme, x: float, y: float, size: float = 11) -> None:
    """A piece of gold, its middle at x, y."""
    canvas, palette = theme.canvas, theme.palette
    canvas.fill_rect(surface, palette.gold, x - size / 2, y - size / 2, size, size, 2)
    canvas.frame_rect(surface, palette.gold_dark, x - size / 2, y - size / 2, size, size, 1.5, 2)
