"""The drawn tiles are the tiles of the world, and nothing shines through between them."""

from typing import NamedTuple

import pygame
import pytest

from ninja_game.sim.collision.rays import solid_at
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import PALETTES
from ninja_game.view.sprites.backdrop import Backdrop
from ninja_game.view.sprites.drawing import SpriteBook
from ninja_game.view.sprites.tile_sheet import tile_picture

CLASSIC = PALETTES["classic"]


class OneTile(NamedTuple):
    tiles: list[int]


@pytest.mark.parametrize("tile", range(34))
def test_a_shape_covers_what_is_solid(tile: int) -> None:
    size = 48
    picture = tile_picture(tile, (size, size), tuple(CLASSIC.tile))
    run = Simulation(Level((tile, *[0] * 712), (ObjectSpec(5, (400.0, 300.0)),)))
    for row in range(size):
        for column in range(size):
            x, y = 24 + (column + 0.5) / 2, 24 + (row + 0.5) / 2
            near = [
                solid_at(run.tiles, x + dx, y + dy)
                for dx in (-0.7, 0, 0.7)
                for dy in (-0.7, 0, 0.7)
                if 24 <= x + dx < 48 and 24 <= y + dy < 48
            ]
            if len(set(near)) == 1:
                assert (picture.get_at((column, row)).a > 127) == near[0], (tile, column, row)


@pytest.mark.parametrize("size", [(792, 600), (1000, 700), (1584, 1200), (613, 477)])
def test_no_seams_between_full_tiles(size: tuple[int, int]) -> None:
    canvas = Canvas(size)
    run = Simulation(Level((1,) * 713, (ObjectSpec(5, (400.0, 300.0)),)))
    backdrop = Backdrop(canvas, CLASSIC, SpriteBook(canvas.scale, CLASSIC), run.tiles)
    mask = pygame.mask.from_surface(backdrop.tiles, 254)
    assert mask.count() == canvas.size[0] * canvas.size[1]


def test_slopes_meet_their_neighbours_without_seams() -> None:
    """Along the border between a slope and the full tile under it no px is less than full."""
    for size in ((792, 600), (1000, 760)):
        canvas = Canvas(size)
        columns = [[0] * 23 for _ in range(31)]
        for column in range(31):
            columns[column][10], columns[column][11] = (18, 22)[column % 2] if column % 3 else 2, 1
        tiles = tuple(tile for column in columns for tile in column)
        run = Simulation(Level(tiles, (ObjectSpec(5, (400.0, 100.0)),)))
        backdrop = Backdrop(canvas, CLASSIC, SpriteBook(canvas.scale, CLASSIC), run.tiles)
        _, border = canvas.point(0, 24 * 12)
        left, right = canvas.point(24, 0)[0], canvas.point(768, 0)[0]
        for x in range(left, right):
            assert backdrop.tiles.get_at((x, border)).a == 255
            assert backdrop.tiles.get_at((x, border + 1)).a == 255


@pytest.mark.parametrize("size", [(653, 481), (1000, 760)])
def test_slope_over_many_cells_is_one_straight_line(size: tuple[int, int]) -> None:
    """However the cells' px are rounded: no step of a 45 degree slope is off its line by a px."""
    canvas = Canvas(size)
    columns = [[0] * 23 for _ in range(31)]
    for k in range(20):
        columns[k][k + 1] = 2
        columns[k][k + 2 :] = [1] * (21 - k)
    tiles = tuple(tile for column in columns for tile in column)
    run = Simulation(Level(tiles, (ObjectSpec(5, (700.0, 100.0)),)))
    backdrop = Backdrop(canvas, CLASSIC, SpriteBook(canvas.scale, CLASSIC), run.tiles)
    off = []
    for x in range(round(25 * canvas.scale), round(500 * canvas.scale)):
        column = [backdrop.tiles.get_at((x, y)).a / 255 for y in range(round(26 * canvas.scale), canvas.size[1])]
        top = next(y for y, alpha in enumerate(column) if alpha > 0.5) + round(26 * canvas.scale)
        off.append(top - (x + 24 * canvas.scale))
    assert max(off) - min(off) < 1.3


def test_full_tile_is_its_colour_everywhere() -> None:
    """Sheets are filled with it."""
    picture = tile_picture(1, (37, 36), tuple(CLASSIC.tile))
    assert {tuple(picture.get_at((x, y))) for x in range(37) for y in range(36)} == {tuple(CLASSIC.tile)}
