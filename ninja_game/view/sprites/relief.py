"""Depth: light along the upper edges of the tiles, shade along the lower ones, and their shadow on what is behind."""

from __future__ import annotations

import pygame

from ninja_game.sim.collision.tiles import EMPTY, FULL, SHAPE
from ninja_game.sim.memory.schema import TileMap
from ninja_game.sim.rules import GRID_COLUMNS, GRID_ROWS, STRIDE
from ninja_game.ui.scenery import painted
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.tile_sheet import TileKey, TileSheet

EDGES = (("bright", 20, 13), ("bright", 8, 20), ("bright", 2, 120), ("outline", -3, 80))
"""Strips inside the tiles: colour; depth from the upper edge down, or from the lower one up, logical px; strength."""

SHADOW, SHADOW_AT = 76, (4, 6)
"""The shadow's strength, and where it falls, logical px."""

SOLID = 1
"""The tile that fills its cell."""


def add_relief(sheet: TileSheet, level: TileMap, palette: Palette) -> None:
    """Draw the edges of a level's tiles on their sheet."""
    edges: dict[tuple[TileKey, ...], pygame.Surface] = {}
    for row in range(GRID_ROWS):
        for column in range(GRID_COLUMNS):
            # The tiles go on beyond the edge of the stage.
            own, above, below = (
                level.tiles[(y + 1) * STRIDE + column + 1] if 0 <= y < GRID_ROWS else SOLID
                for y in (row, row - 1, row + 1)
            )
            if SHAPE[own] == EMPTY or SHAPE[own] == SHAPE[above] == SHAPE[below] == FULL:
                continue
            key = sheet.key(column, row, own), sheet.key(column, row - 1, above), sheet.key(column, row + 1, below)
            if key not in edges:
                edges[key] = _edges(sheet, palette, *key)
            sheet.surface.blit(edges[key], sheet.cell(column, row), special_flags=pygame.BLEND_PREMULTIPLIED)


def _edges(sheet: TileSheet, palette: Palette, own: TileKey, above: TileKey, below: TileKey) -> pygame.Surface:
    """Those of one cell: what is left of its tile when it is taken away a little lower, or higher."""
    edges = pygame.Surface(own[1:3], pygame.SRCALPHA)
    for role, depth, strength in EDGES:
        colour: pygame.Color = getattr(palette, role)
        tile, beside = sheet.picture(own, colour), sheet.picture(above if depth > 0 else below, colour)
        step = round(depth * sheet.canvas.scale) or (1 if depth > 0 else -1)
        strip = tile.copy()
        strip.blit(tile, (0, step), special_flags=pygame.BLEND_RGBA_SUB)
        strip.blit(
            beside, (0, step + (tile.height if depth < 0 else -beside.height)), special_flags=pygame.BLEND_RGBA_SUB
        )
        strip.fill((strength,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
        edges.blit(strip, (0, 0), special_flags=pygame.BLEND_PREMULTIPLIED)
    return edges


def ground_in_shadow(sheet: TileSheet, palette: Palette) -> pygame.Surface:
    """What is behind tiles, with their shadow, as dark as they are on their sheet; soft, since all is made small."""
    small = painted(palette).copy()
    shadow = pygame.transform.smoothscale(sheet.surface, small.get_size())
    shadow.fill((SHADOW,) * 4, special_flags=pygame.BLEND_RGBA_MULT)
    share = sheet.canvas.scale * small.width / sheet.surface.width
    small.blit(shadow, [round(share * away) for away in SHADOW_AT], special_flags=pygame.BLEND_PREMULTIPLIED)
    return pygame.transform.smoothscale(small, sheet.surface.size)
