"""The grids of benchmarks/: every touching pair exactly once, every query the same by any grid."""

from typing import Any

import numpy as np
from hypothesis import given, strategies as st

from benchmarks.arena import RADIUS, brute_pairs, brute_queries, five_cell_pairs, loose_build, loose_move, loose_queries
from benchmarks.normal_grid import normal_build, normal_move, normal_queries

COLUMNS = 4

coordinates = st.one_of(
    st.floats(RADIUS, COLUMNS - RADIUS, allow_nan=False),
    st.integers(1, COLUMNS - 1).map(float),  # on the lines between cells
)
places = st.lists(st.tuples(coordinates, coordinates), min_size=0, max_size=24)


def arrays(points: list[tuple[float, float]]) -> tuple[Any, Any]:
    """x and y by slot; slot 0 is nobody."""
    table = np.array([(0.0, 0.0), *points])
    return table[:, 0].copy(), table[:, 1].copy()


def loose(x: Any, y: Any) -> tuple[Any, Any, Any, Any]:
    """Heads, next and previous links, cells."""
    heads = np.zeros((COLUMNS + 2) ** 2, np.int64)
    nexts, prevs, cells = (np.zeros(len(x), np.int64) for _ in range(3))
    loose_build(COLUMNS, x, y, heads, nexts, prevs, cells)
    return heads, nexts, prevs, cells


def pairs(found: Any, count: int) -> list[tuple[int, int]]:
    """Pairs in a canonical order."""
    return sorted((min(pair), max(pair)) for pair in found[:count].tolist())


@given(places)
def test_five_cells_find_every_touching_pair_exactly_once(points: list[tuple[float, float]]) -> None:
    x, y = arrays(points)
    heads, nexts, _, cells = loose(x, y)
    found, expected = np.zeros((2, 400, 2), np.int64)
    count = five_cell_pairs(COLUMNS, x, y, heads, nexts, cells, found)
    assert count == brute_pairs(x, y, expected)
    assert pairs(found, count) == pairs(expected, count)


@given(places, places, st.integers(0, 2**32 - 1))
def test_all_grids_answer_alike_also_after_moves(
    points: list[tuple[float, float]], questions: list[tuple[float, float]], seed: int
) -> None:
    x, y = arrays(points)
    qx, qy = (side[1:] for side in arrays(questions))
    heads, nexts, prevs, cells = loose(x, y)
    entries = np.zeros((COLUMNS + 2) ** 2, np.int64)
    links: list[Any] = [np.zeros(4 * len(x), np.int64) for _ in range(2)]
    bounds: list[Any] = [np.zeros(len(x), np.int64) for _ in range(2)]
    stamps = np.zeros(len(x), np.int64)
    normal_build(COLUMNS, x, y, entries, links[0], links[1], bounds[0], bounds[1])
    dx, dy = np.random.default_rng(seed).uniform(-0.5, 0.5, (2, len(x)))
    dx, dy = np.clip(x + dx, RADIUS, COLUMNS - RADIUS) - x, np.clip(y + dy, RADIUS, COLUMNS - RADIUS) - y
    for rounds in (0, 1):
        copies: list[Any] = [x.copy(), y.copy()]
        loose_move(COLUMNS, x, y, dx, dy, heads, nexts, prevs, cells, rounds)
        normal_move(COLUMNS, copies[0], copies[1], dx, dy, entries, links[0], links[1], bounds[0], bounds[1], rounds)
        expected = brute_queries(x, y, qx, qy)
        assert loose_queries(COLUMNS, x, y, heads, nexts, qx, qy) == expected
        assert normal_queries(COLUMNS, x, y, entries, links[0], stamps, qx, qy) == expected
