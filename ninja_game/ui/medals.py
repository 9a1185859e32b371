"""Medals, and the mark for all gold."""

from __future__ import annotations

from math import pi, sin

import pygame

from ninja_game.formats.pack import pars
from ninja_game.ui.theme import Theme, mixed

_METALS = {"bronze": "#b8743a", "silver": "#b4bcc6", "gold": "#e3b021", "author": "#5fb2a5"}
_INK = pygame.Color("#1d1d22")
_LARGE = 30.0  # size from which a medal shows its relief, px
MEDALS_FROM_BRONZE = tuple(reversed(pars.MEDALS))


def draw_medal(
    surface: pygame.Surface,
    theme: Theme,
    medal: str,
    x: float,
    y: float,
    size: float = 14,
    *,
    reached: bool = True,
    shine: float = 1.0,
) -> None:
    """A disc with the medal's first letter, centred at x, y; only its rim if it is not reached.

    A large one has relief and hangs from a ribbon, all within ``size``; ``shine``: progress of the light over it.
    """
    canvas, palette = theme.canvas, theme.palette
    large = reached and size >= _LARGE
    metal = pygame.Color(_METALS[medal])
    bright = mixed(metal, palette.spark, 0.6)
    radius = size * 0.4 if large else size / 2
    if large:
        y += size * 0.1
        for side in (-1, 1):
            corners = ((0.02, -0.3), (0.26, -0.6), (0.42, -0.5), (0.18, -0.18))
            canvas.polygon(surface, palette.band, [(x + side * dx * size, y + dy * size) for dx, dy in corners])
    if reached:
        canvas.circle(surface, mixed(metal, _INK, 0.35) if large else metal, (x, y), radius)
        canvas.circle(surface, _INK, (x, y), radius, 1)
    else:
        canvas.circle(surface, palette.panel_edge, (x, y), radius, 1)
    if large:
        canvas.circle(surface, bright, (x - size * 0.012, y - size * 0.012), radius * 0.86)
        canvas.circle(surface, metal, (x + size * 0.012, y + size * 0.012), radius * 0.8)
        if 0 < shine < 1:
            across = radius * 0.7 * (2 * shine - 1)
            half = (radius * radius * 0.56 - across * across) ** 0.5 * 0.7
            middle = x + across * 0.7, y + across * 0.7
            ends = (middle[0] - half, middle[1] + half), (middle[0] + half, middle[1] - half)
            canvas.line(surface, bright, *ends, size * 0.09)
    letter = radius * 1.16
    top = y - letter / 2
    ink = _INK if reached else palette.faint
    theme.text(surface, medal[0].upper(), x, top, size=letter, colour=ink, align="centre", bold=True, height=size)


def draw_stamp(
    surface: pygame.Surface, theme: Theme, medal: str, x: float, y: float, size: float, stamp: float, shine: float
) -> None:
    """A medal being stamped, ``stamp`` 0…1: it shrinks to its size, and light moves over it."""
    if stamp > STAMP_SEEN:
        draw_medal(surface, theme, medal, x, y, size * stamp * (1 + 0.6 * sin(pi * stamp)), shine=shine)


STAMP_SEEN = 0.2  # ``stamp`` of the first visible picture


def draw_all_gold(surface: pygame.Surface, theme: Theme, x: float, y: float, size: float = 11) -> None:
    """A piece of gold, centred at x, y."""
    canvas, palette = theme.canvas, theme.palette
    canvas.fill_rect(surface, palette.gold, x - size / 2, y - size / 2, size, size, 2)
    canvas.frame_rect(surface, palette.gold_dark, x - size / 2, y - size / 2, size, size, 1.5, 2)
