"""Cost of object queries, pairs, moves and bullets against numbers, at a constant density: one object a cell."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import tempfile
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import arena, normal_grid
from benchmarks.charts import Chart, seconds_per
from ninja_game.backend.memories import compiled

NUMBERS = (10, 30, 100, 300, 1000, 3000, 10_000)
QUERIES = 16_384  # so many that the processor cannot learn their branches by heart, as it does with a few hundred


def walk(random: np.random.Generator, low: float, high: float) -> Any:
    """One coordinate of queries that move as a ninja does: steps of at most a fifth of a cell, within bounds."""
    path = np.cumsum(random.uniform(-0.2, 0.2, QUERIES)) % (2 * (high - low))
    return low + np.minimum(path, 2 * (high - low) - path)


class Arena:
    """``count`` objects in an arena as large as keeps one object a cell, filed in both grids; queries well inside."""

    def __init__(self, count: int, seed: int = 1) -> None:
        random = np.random.default_rng(seed)
        self.columns = max(2, round(count**0.5))
        low, high = arena.RADIUS + 0.1, self.columns - arena.RADIUS - 0.1
        self.x, self.y = random.uniform(low, high, (2, count + 1))
        self.qx, self.qy = (walk(random, 1.0, self.columns - 1.0) for _ in range(2))
        self.jump_x, self.jump_y = random.uniform(1.0, self.columns - 1.0, (2, QUERIES))
        self.dx, self.dy = random.uniform(-0.1, 0.1, (2, count + 1))
        self.heads, self.entries = np.zeros((2, (self.columns + 2) ** 2), np.int64)
        self.nexts, self.prevs, self.cells, self.low, self.high, self.stamps = np.zeros((6, count + 1), np.int64)
        self.entry_nexts, self.entry_prevs = np.zeros((2, 4 * (count + 1)), np.int64)
        self.found = np.zeros((0, 2), np.int64)
        compiled(arena.loose_build)(self.columns, self.x, self.y, self.heads, self.nexts, self.prevs, self.cells)
        box = self.entries, self.entry_nexts, self.entry_prevs, self.low, self.high
        compiled(normal_grid.normal_build)(self.columns, self.x, self.y, *box)
        loose = self.columns, self.x, self.y, self.heads, self.nexts
        motion = self.columns, self.x, self.y, self.dx, self.dy
        self.calls: dict[str, Any] = {
            "loose": partial(compiled(arena.loose_queries), *loose, self.qx, self.qy),
            "jumps": partial(compiled(arena.loose_queries), *loose, self.jump_x, self.jump_y),
            "normal": partial(
                compiled(normal_grid.normal_queries), self.columns, self.x, self.y, self.entries, self.entry_nexts,
                self.stamps, self.qx, self.qy,
            ),
            "brute": partial(compiled(arena.brute_queries), self.x, self.y, self.qx, self.qy),
            "five": partial(compiled(arena.five_cell_pairs), *loose, self.cells, self.found),
            "n^2": partial(compiled(arena.brute_pairs), self.x, self.y, self.found),
            "move loose": partial(
                compiled(arena.loose_move), *motion, self.heads, self.nexts, self.prevs, self.cells, 2
            ),
            "move normal": partial(compiled(normal_grid.normal_move), *motion, *box, 2),
        }  # fmt: skip
        half = count // 2 + 1
        for name, filed in (("filed", 1), ("reading", 0)):
            self.calls[name] = partial(
                compiled(arena.bullets), *loose, self.prevs, self.cells, self.dx * 10, self.dy * 10, half, filed, 2
            )
        assert self.calls["loose"]() == self.calls["normal"]() == self.calls["brute"](), "the grids disagree"
        assert self.calls["five"]() == self.calls["n^2"](), "the grids disagree on pairs"


def queries() -> Chart:
    """One query against the number of objects, and in C where there is a compiler."""
    chart = Chart("query-against-objects", "One object query, one object a cell", "objects", "ns a query")
    library = c_library()
    for count in NUMBERS:
        here = Arena(count)
        names = {
            "loose": "nine cells",
            "normal": "normal grid",
            "brute": "every object",
            "jumps": "nine cells, anywhere",
        }
        for call, series in names.items():
            chart.add(series, count, seconds_per(here.calls[call]) / QUERIES * 1e9)
        if library:
            chart.add("nine cells, C", count, seconds_per(c_queries(library, here)) / QUERIES * 1e9)
            chart.add("every object, C", count, seconds_per(c_brute(library, here)) / QUERIES * 1e9)
    return chart


def pairs() -> Chart:
    """All touching pairs against the number of objects."""
    chart = Chart("pairs-against-objects", "All touching pairs, one object a cell", "objects", "us")
    library = c_library()
    for count in NUMBERS:
        here = Arena(count)
        chart.add("five cells", count, seconds_per(here.calls["five"]) * 1e6)
        chart.add("n^2", count, seconds_per(here.calls["n^2"]) * 1e6)
        if library:
            chart.add("five cells, C", count, seconds_per(c_pairs(library, here)) * 1e6)
    return chart


def moves() -> Chart:
    """Filing again after a move by up to a tenth of a cell, and bullets that are in the grid or only read it."""
    chart = Chart("moves-against-objects", "Moving one object, one object a cell", "objects", "ns an object", "x")
    for count in NUMBERS[2:]:
        here = Arena(count)
        for call, series in (("move loose", "loose grid"), ("move normal", "normal grid")):
            chart.add(series, count, seconds_per(here.calls[call]) / (2 * count) * 1e9)
        for call, series in (("filed", "bullet in the grid"), ("reading", "bullet that reads")):
            flying = Arena(count) if call == "reading" else here
            chart.add(series, count, seconds_per(flying.calls[call]) / (2 * (count - count // 2)) * 1e9)
    return chart


# --- the same in C ---


def c_library() -> Any:
    """grids.c, compiled by the system's C compiler; None where there is none."""
    compiler = shutil.which("cc")
    if not compiler:
        return None
    folder = Path(tempfile.mkdtemp())
    source = Path(__file__).with_name("grids.c")
    # For this very machine and without contracted or reordered arithmetic, as Numba's code is.
    options = ["-O3", "-march=native", "-ffp-contract=off", "-shared", "-fPIC"]
    subprocess.run([compiler, *options, "-o", str(folder / "grids.so"), str(source)], check=True)
    library = ctypes.CDLL(str(folder / "grids.so"))
    shutil.rmtree(folder)
    for name in ("loose_queries", "five_cell_pairs", "brute_queries"):
        getattr(library, name).restype = ctypes.c_int64
    return library


def _pointers(*arrays: Any) -> list[ctypes.c_void_p]:
    return [ctypes.c_void_p(array.ctypes.data) for array in arrays]


def c_queries(library: Any, here: Arena) -> Any:
    """The nine-cell queries in C, checked against ours."""
    words = (
        ctypes.c_int64(here.columns), *_pointers(here.x, here.y, here.heads, here.nexts, here.qx, here.qy),
        ctypes.c_int64(QUERIES),
    )  # fmt: skip
    assert library.loose_queries(*words) == here.calls["loose"](), "C disagrees"
    return partial(library.loose_queries, *words)


def c_brute(library: Any, here: Arena) -> Any:
    """The queries without a grid in C, checked against ours."""
    words = (
        *_pointers(here.x, here.y), ctypes.c_int64(len(here.x)), *_pointers(here.qx, here.qy), ctypes.c_int64(QUERIES),
    )  # fmt: skip
    assert library.brute_queries(*words) == here.calls["brute"](), "C disagrees"
    return partial(library.brute_queries, *words)


def c_pairs(library: Any, here: Arena) -> Any:
    """The pairs by five cells in C, checked against ours."""
    words = (
        ctypes.c_int64(here.columns), *_pointers(here.x, here.y, here.heads, here.nexts, here.cells),
        ctypes.c_int64(len(here.x)),
    )  # fmt: skip
    assert library.five_cell_pairs(*words) == here.calls["five"](), "C disagrees"
    return partial(library.five_cell_pairs, *words)
