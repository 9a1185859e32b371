"""Depth: light that fades below the upper edges of the tiles, shade along the lower ones, their shadow behind them."""

from __future__ import annotations

import pygame

from ninja_game.ui.scenery import GRAINS, grain, scenery_sheet
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.tile_sheet import TileSheet

_EDGES = (("bright", 2, 0, 120), ("outline", -3, 0, 80), ("bright", 8, 30, 88))
"""Copies of the tiles in a colour, minus the tiles moved down or up and blurred by so much, logical px; their opacity.
The last one also lights rock near its other edges, so that the inside of a mass is darker.
"""

GRAIN = {"bright": 13, "outline": 18}
"""Difference between the rock's marks and its ink, of 255 per channel: too small to look like an object."""

SHADOW = 76  # opacity, of 255
SHADOW_AT = (4, 6)  # offset of the shadow, logical px


def add_relief(sheet: TileSheet, palette: Palette) -> pygame.Surface:
    """Draw the edges of a level's tiles on their sheet, and their shadow on the sheet behind."""
    inks = {role: sheet.in_colour(getattr(palette, role)) for role in ("bright", "outline")}
    size = sheet.surface.size
    small = scenery_sheet(palette).copy()
    # It is soft because it is painted on the small sheet of the scenery.
    shadow = pygame.transform.smoothscale(inks["outline"], small.get_size())
    if palette.scenery in GRAINS:
        _add_grain(sheet, palette, inks)
    shadow.fill((SHADOW,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    share = sheet.canvas.scale * small.width / size[0]
    small.blit(shadow, [round(share * away) for away in SHADOW_AT], special_flags=pygame.BLEND_PREMULTIPLIED)
    for role, depth, soft, strength in _EDGES:
        edge = taken = inks[role]
        step = round(depth * sheet.canvas.scale) or (1 if depth > 0 else -1)
        if soft:
            # Blurred by scaling down and up again.
            few = [max(1, round(length / soft / sheet.canvas.scale)) for length in size]
            for numbers in ([2 * number for number in few], few, size):
                taken = pygame.transform.smoothscale(taken, numbers)
        else:
            edge = taken.copy()
        edge.blit(taken, (0, step), special_flags=pygame.BLEND_RGBA_SUB)
        # The tiles continue beyond the edge of the stage.
        edge.fill((0, 0, 0, 0), (0, 0 if step > 0 else size[1] + step, size[0], abs(step)))
        edge.fill((strength,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
        sheet.surface.blit(edge, (0, 0), special_flags=pygame.BLEND_PREMULTIPLIED)
    return pygame.transform.smoothscale(small, size)


def _add_grain(sheet: TileSheet, palette: Palette, inks: dict[str, pygame.Surface]) -> None:
    """Mark the rock: darker if it is dark on a light scenery, else lighter, so that it contrasts with the scenery."""
    role = "bright" if sum(palette.text[:3]) > sum(palette.background[:3]) else "outline"
    away = max(abs(ink - rock) for ink, rock in zip(getattr(palette, role)[:3], palette.tile[:3], strict=True))
    pattern = grain(palette, role)
    marks = pygame.transform.smoothscale(inks[role], pattern.get_size())
    marks.blit(pattern, (0, 0), special_flags=pygame.BLEND_RGBA_SUB)
    marks.fill((round(255 * GRAIN[role] / away),) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    marks = pygame.transform.smoothscale(marks, sheet.surface.size)
    sheet.surface.blit(marks, (0, 0), special_flags=pygame.BLEND_PREMULTIPLIED)
