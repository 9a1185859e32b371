"""Depth: light along the upper edges of the tiles, shade along the lower ones, and their shadow on what is behind."""

from __future__ import annotations

from typing import NamedTuple

import pygame

from ninja_game.view.sprites.tile_sheet import TileSheet


class Edge(NamedTuple):
    """A strip inside the tiles. ``depth``: logical px, from the upper edge down, below 0 from the lower one up."""

    depth: float
    strength: int


LIT = Edge(20, 13), Edge(8, 20), Edge(2, 120)
SHADED = (Edge(-3, 80),)

SHADOW, SHADOW_AT, SOFT = 76, (3, 5), 5
"""The shadow's strength, where it falls (logical px), and how many times smaller it is made to be soft."""


def add_relief(tiles: pygame.Surface, bright: TileSheet, dark: TileSheet) -> pygame.Surface:
    """Draw the edges on tiles; gives their shadow, for what is behind. The sheets have the same tiles."""
    for sheet, edges in ((bright, LIT), (dark, SHADED)):
        for edge in edges:
            tiles.blit(_strip(sheet, edge), (0, 0), special_flags=pygame.BLEND_PREMULTIPLIED)
    scale, (wide, high) = dark.canvas.scale, tiles.get_size()
    small = pygame.transform.smoothscale(dark.surface, (max(1, wide // SOFT), max(1, high // SOFT)))
    soft = pygame.transform.smoothscale(small, (wide, high))
    shadow = pygame.Surface((wide, high), pygame.SRCALPHA)
    shadow.blit(soft, [round(scale * away) for away in SHADOW_AT], special_flags=pygame.BLEND_PREMULTIPLIED)
    shadow.fill((SHADOW,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    return shadow


def _strip(sheet: TileSheet, edge: Edge) -> pygame.Surface:
    """What is left of the tiles when they are taken away a little lower, or higher."""
    strip = sheet.surface.copy()
    step = round(edge.depth * sheet.canvas.scale) or (1 if edge.depth > 0 else -1)
    strip.blit(sheet.surface, (0, step), special_flags=pygame.BLEND_RGBA_SUB)
    # The tiles go on beyond the edge of the stage.
    strip.fill((0, 0, 0, 0), (0, 0 if step > 0 else strip.height + step, strip.width, abs(step)))
    strip.fill((edge.strength,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    return strip
