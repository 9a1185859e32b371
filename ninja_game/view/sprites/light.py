"""Light around exits, switches and dangers: soft, still, part of the backdrop."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import pygame

from ninja_game.sim import kinds
from ninja_game.sim.schema.world_fields import World
from ninja_game.ui.theme import Palette


class LightStyle(NamedTuple):
    """A light. ``role``: of the palette; ``reach``: logical px; ``strength``: opacity in its middle, 0…255."""

    role: str
    reach: int
    strength: int


EXIT_OPEN = LightStyle("exit_light", 74, 126)
STYLES = {
    kinds.EXIT: LightStyle("exit_light", 46, 70),
    kinds.SWITCH: LightStyle("exit_light", 52, 150),
    kinds.GOLD: LightStyle("gold_light", 14, 96),
    kinds.MINE: LightStyle("mine", 15, 54),
    kinds.TURRET: LightStyle("turret", 26, 60),
    kinds.LAUNCHER: LightStyle("launcher", 26, 60),
}
"""The lights of objects in their first state, by kind."""


class Light(NamedTuple):
    """A light about a point, px."""

    style: LightStyle
    x: float
    y: float


def light_of(world: World, slot: int) -> Light | None:
    """The light around an object in its present state."""
    o = world.objects[slot]
    style = STYLES.get(o.kind)
    if style is None or (o.kind == kinds.MINE and o.exploded) or (o.kind == kinds.GOLD and o.taken):
        return None
    if o.kind == kinds.SWITCH and world.objects[o.partner].is_open:
        return None
    if o.kind == kinds.EXIT and o.is_open:
        style = EXIT_OPEN
    x, y = (o.base_x, o.base_y) if o.kind == kinds.LAUNCHER else (o.x, o.y)
    return Light(style, x, y)


_GRID = 25  # px of the sheet from which lights of all sizes are made


@lru_cache(maxsize=64)
def light_picture(style: LightStyle, scale: float, palette: Palette) -> pygame.Surface:
    """A light, strongest in its middle. It is shared, so never draw on it."""
    reach = max(1, round(style.reach * scale))
    sheet = _sheet(getattr(palette, style.role)[:3]).copy()
    # Faded as a whole, so that the page scales it smoothly too.
    sheet.fill((255, 255, 255, style.strength), special_flags=pygame.BLEND_RGBA_MULT)
    return pygame.transform.smoothscale(sheet, (2 * reach + 1, 2 * reach + 1))


@lru_cache(maxsize=16)
def _sheet(colour: tuple[int, ...]) -> pygame.Surface:
    """The small sheet in a colour, full strength."""
    sheet = pygame.Surface((_GRID, _GRID), pygame.SRCALPHA)
    sheet.fill((*colour, 0))
    half = _GRID / 2
    for y in range(_GRID):
        for x in range(_GRID):
            distance = ((x + 0.5 - half) ** 2 + (y + 0.5 - half) ** 2) / half**2
            if distance < 1:
                sheet.set_at((x, y), (*colour, round(255 * (1 - distance) ** 2)))
    return sheet
