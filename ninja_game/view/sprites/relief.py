"""Depth: light that fades below the upper edges of the tiles, shade along the lower ones, their shadow behind them."""

from __future__ import annotations

import pygame

from ninja_game.ui.scenery import painted
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.tile_sheet import TileSheet

EDGES = (("bright", 2, 0, 120), ("outline", -3, 0, 80), ("bright", 9, 12, 62))
"""What is left of the tiles in a colour when they are taken away: so much lower, or higher, and so soft, logical px;
how strong it is."""

SHADOW, SHADOW_AT = 76, (4, 6)
"""The shadow's strength, and where it falls, logical px."""


def add_relief(sheet: TileSheet, palette: Palette) -> pygame.Surface:
    """Draw the edges of a level's tiles on their sheet; what is behind, in their shadow."""
    inks = {role: sheet.in_colour(getattr(palette, role)) for role in ("bright", "outline")}
    size = sheet.surface.size
    small = painted(palette).copy()
    # It is soft, since it is painted on the small sheet of the scenery.
    shadow = pygame.transform.smoothscale(inks["outline"], small.get_size())
    shadow.fill((SHADOW,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    share = sheet.canvas.scale * small.width / size[0]
    small.blit(shadow, [round(share * away) for away in SHADOW_AT], special_flags=pygame.BLEND_PREMULTIPLIED)
    for role, depth, soft, strength in EDGES:
        edge = taken = inks[role]
        step = round(depth * sheet.canvas.scale) or (1 if depth > 0 else -1)
        if soft:
            # Made small and large again.
            few = [max(1, round(length / soft / sheet.canvas.scale)) for length in size]
            for each in ([2 * number for number in few], few, size):
                taken = pygame.transform.smoothscale(taken, each)
        else:
            edge = taken.copy()
        edge.blit(taken, (0, step), special_flags=pygame.BLEND_RGBA_SUB)
        # The tiles go on beyond the edge of the stage.
        edge.fill((0, 0, 0, 0), (0, 0 if step > 0 else size[1] + step, size[0], abs(step)))
        edge.fill((strength,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
        sheet.surface.blit(edge, (0, 0), special_flags=pygame.BLEND_PREMULTIPLIED)
    return pygame.transform.smoothscale(small, size)
