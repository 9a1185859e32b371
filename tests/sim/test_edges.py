"""The edge rule, exhaustively, against a literal reading of world.md §3; cells, lookup, missing neighbours."""

import math
from pathlib import Path

import pytest

from ninja_game.backend.plain import load_plain
from ninja_game.sim.collision.tiles import (
    COLUMN,
    EDGE_OF_FACES,
    EXISTS,
    NEIGHBOUR_OFFSET,
    ODD_HALF_ID,
    ROW,
    SHAPE,
    UNDEFINED_ID,
)
from ninja_game.sim.grid import cell_at, cell_index
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.rules import INTERESTING, OFF, SOLID, STRIDE

FACES = {  # up, down, left, right, as world.md lists them
    **{tile: "pFFp" for first in (2, 6, 10, 18, 26) for tile in (first,)},
    **{tile: "pFpF" for first in (2, 6, 10, 18, 26) for tile in (first + 1,)},
    **{tile: "FppF" for first in (2, 6, 10, 18, 26) for tile in (first + 2,)},
    **{tile: "FpFp" for first in (2, 6, 10, 18, 26) for tile in (first + 3,)},
    14: "pFpp",
    15: "pFpp",
    16: "Fppp",
    17: "Fppp",
    22: "ppFp",
    25: "ppFp",
    23: "pppF",
    24: "pppF",
    30: "pFpp",
    31: "pppF",
    32: "Fppp",
    33: "ppFp",
    0: "----",
    1: "FFFF",
    ODD_HALF_ID: "pppp",
    UNDEFINED_ID: "pppp",
}
PLACE_OF_SIDE = {0: 3, 1: 1, 2: 2, 3: 0}  # right, down, left, up among U D L R
STATE = {"off": OFF, "interesting": INTERESTING, "solid": SOLID}


def literal_state(own: str, neighbour: str) -> str:
    """The table of world.md §3, column by column."""
    if neighbour == "-":
        return "off"
    if neighbour == "p":
        return "interesting"
    return "off" if own == "F" else "solid"


@pytest.mark.parametrize("page", ["rules/world", "how-it-works", "learn/05-edges"])
def test_every_page_has_the_same_table_of_edges(page: str) -> None:
    text = (Path(__file__).parents[2] / "docs" / f"{page}.md").read_text("utf-8")
    heads = "|".join(f" neighbour's face {face} " for face in ("none", "partial", "full"))
    table = text.partition(f"| own face |{heads}|\n|---|---|---|---|\n")[2].partition("\n\n")[0]
    rows = [[cell.split()[0] for cell in row.strip("|").split("|")] for row in table.splitlines()]
    assert [own for own, *_ in rows] == ["none", "partial", "full"]
    assert [STATE[word] for _, *states in rows for word in states] == EDGE_OF_FACES


@pytest.mark.parametrize("own", range(len(SHAPE)))
def test_every_pair_of_tiles_has_the_edge_of_the_table(own: int) -> None:
    for side in range(4):
        for neighbour in range(len(SHAPE)):
            tiles = [0] * 713
            centre = (15, 11)
            beside = (centre[0] + (1, 0, -1, 0)[side], centre[1] + (0, 1, 0, -1)[side])
            for (column, row), tile in ((centre, own), (beside, neighbour)):
                tiles[(column - 1) * 23 + row - 1] = -1 if tile == UNDEFINED_ID else tile
            _, w = load_plain(Level(tuple(tiles), (ObjectSpec(NINJA, (30.0, 30.0)),)), box=False)
            place = PLACE_OF_SIDE[side]
            expected = literal_state(FACES[own][place], FACES[neighbour][PLACE_OF_SIDE[side ^ 2]])
            assert w.edges[4 * cell_index(*centre) + side] == STATE[expected], (own, neighbour, side)


def test_an_empty_cell_is_solid_towards_the_border() -> None:
    _, w = load_plain(Level(objects=(ObjectSpec(NINJA, (30.0, 30.0)),)), box=False)
    for column in range(1, 32):
        assert w.edges[4 * cell_index(column, 1) + 3] == SOLID
        assert w.edges[4 * cell_index(column, 23) + 1] == SOLID


def test_the_border_is_interesting_towards_what_is_missing() -> None:
    _, w = load_plain(Level(objects=(ObjectSpec(NINJA, (30.0, 30.0)),)), box=False)
    assert w.edges[4 * cell_index(0, 12) + 2] == INTERESTING
    assert w.edges[4 * cell_index(32, 12) + 0] == INTERESTING


@pytest.mark.parametrize(
    "x, y, cell",
    [
        (0.0, 0.0, (0, 0)),
        (-0.0, 0.0, (0, 0)),
        (24.0, 48.0, (1, 2)),
        (math.nextafter(24.0, 0.0), 0.0, (0, 0)),
        (math.nextafter(792.0, 0.0), math.nextafter(600.0, 0.0), (32, 24)),
    ],
)
def test_a_point_on_a_line_belongs_right_of_and_below_it(x: float, y: float, cell: tuple[int, int]) -> None:
    assert cell_at(x, y) == cell_index(*cell)


@pytest.mark.parametrize(
    "x, y", [(792.0, 10.0), (10.0, 600.0), (-1e-300, 10.0), (math.nan, 10.0), (10.0, math.nan), (math.inf, 1.0)]
)
def test_outside_the_grid_is_no_cell(x: float, y: float) -> None:
    assert cell_at(x, y) == 0


@pytest.mark.parametrize("column, row", [(-1, 0), (33, 0), (0, 25), (1.5, 2), (math.nan, 2), (3, math.inf)])
def test_a_cell_must_exist_to_have_an_index(column: float, row: float) -> None:
    assert cell_index(column, row) == 0


def test_no_step_from_a_cell_leaves_the_array_and_the_ring_is_missing() -> None:
    for cell in range(len(EXISTS)):
        if EXISTS[cell]:
            for step in NEIGHBOUR_OFFSET:
                neighbour = cell + step
                inside = 0 <= COLUMN[cell] + (step if abs(step) == 1 else 0) <= 32
                inside = inside and 0 <= ROW[cell] + (step // STRIDE if abs(step) > 1 else 0) <= 24
                assert bool(EXISTS[neighbour]) == inside
