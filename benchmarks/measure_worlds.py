"""Cost of the game's own worlds: against threads, number of worlds, objects in the level; of its rays; memory."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from statistics import median
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from benchmarks import game_kernels
from benchmarks.charts import Chart, seconds_per
from benchmarks.game_kernels import count_ticks
from ninja_game.backend.compiled import load_worlds
from ninja_game.backend.layout import used_bytes
from ninja_game.backend.memories import compiled
from ninja_game.batch.batch import Batch
from ninja_game.formats.recording import Recording
from ninja_game.runtime import cores
from ninja_game.sim.kinds import GOLD, MINE, NINJA
from ninja_game.sim.level import TILES, Level, ObjectSpec
from ninja_game.simulation import Simulation

WORLDS = 1024
RESIDENT = 64
PLACES = 8
PASSES = 3
TICKS = 64
NUMBERS = (10, 30, 100, 300, 1000, 3000, 10_000)


def crowd(recordings: Sequence[Recording], count: int, threads: int) -> tuple[Batch, NDArray[np.uint8]]:
    """Worlds that play the recordings, and the inputs of their first ticks."""
    chosen = [recordings[number % len(recordings)] for number in range(count)]
    batch = Batch([recording.level for recording in recordings], count, memory="compiled", threads=threads)
    inputs = np.frombuffer(b"".join(recording.replay.playback(TICKS) for recording in chosen), np.uint8)
    return batch, np.ascontiguousarray(inputs.reshape(count, TICKS).T)


def batch_speed(recordings: Sequence[Recording], count: int, threads: int, *, alone: bool = False) -> float:
    """Ticks a second of a batch, ``run`` for many ticks a call or (``alone``) ``step`` by step; best of several."""
    batch, inputs = crowd(recordings, count, threads)
    start = batch.save()
    best = float("inf")
    for _ in range(15 if count <= WORLDS else 5):
        batch.restore(start)
        begin = perf_counter()
        if alone:
            for row in inputs:
                batch.step(row)
        else:
            batch.run(inputs)
        best = min(best, perf_counter() - begin)
    return count * TICKS / best


def threads(recordings: Sequence[Recording]) -> Chart:
    """Speed against threads, with 1,024 worlds."""
    chart = Chart("speed-against-threads", f"{WORLDS:,} worlds, {cores()} cores", "threads", "million ticks/s", "")
    for number in (1, 2, 3, 4) if cores() < 4 else (1, 2, 4, 8, 16):
        chart.add(f"{TICKS} ticks a call", number, batch_speed(recordings, WORLDS, number) / 1e6)
        chart.add("one tick a call", number, batch_speed(recordings, WORLDS, number, alone=True) / 1e6)
    return chart


def worlds(recordings: Sequence[Recording]) -> Chart:
    """Speed against the number of worlds."""
    chart = Chart("speed-against-worlds", "Batches of worlds", "worlds", "million ticks/s", "x")
    for count in (1, 4, 16, 64, 256, 1024, 4096):
        for number in sorted({1, cores()}):
            ways = {f"{TICKS} ticks a call": False, "one tick a call": True}
            for words, alone in ways.items():
                speed = batch_speed(recordings, count, number, alone=alone)
                chart.add(f"{number} threads, {words}", count, speed / 1e6)
    return chart


def scattered(count: int) -> Level:
    """A level with the ninja on a platform in its middle, a thing in each of the eight cells around, all else far away.

    So the density around the ninja is the same however many objects there are; they are half mines, half gold.
    """
    centre = 16, 12
    cells = [(i, j) for i in range(1, 32) for j in range(1, 24) if max(abs(i - centre[0]), abs(j - centre[1])) > 2]
    near = [(centre[0] + i, centre[1] + j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
    places = [*near, *(cells[number * 7 % len(cells)] for number in range(count - len(near)))]
    records = [ObjectSpec(NINJA, (centre[0] * 24.0 + 12.0, centre[1] * 24.0 + 12.0))]
    for number, (column, row) in enumerate(places[:count]):
        records.append(ObjectSpec(MINE if number % 2 else GOLD, (column * 24.0 + 12.0, row * 24.0 + 12.0)))
    tiles = [0] * TILES
    for column in range(centre[0] - 1, centre[0] + 2):
        tiles[(column - 1) * 23 + centre[1]] = 1
    return Level(tuple(tiles), tuple(records))


def objects() -> Chart:
    """The ninja's query in the game's own grid against the objects in the level."""
    chart = Chart("ninja-query-against-objects", "The ninja's object query", "objects in the level", "ns a query")
    ways = {"nine cells": (game_kernels.query_nine_cells, 1000), "every object": (game_kernels.query_every_thing, 10)}
    # Some addresses suit the processor's caches better than others, and a shared processor is slower for seconds at a
    # time: the best of several places in memory and of several passes.
    worlds = {
        count: [load_worlds(compiled, [scattered(count)], box=False)[1] for _ in range(PLACES)] for count in NUMBERS
    }
    best: dict[tuple[int, str], float] = {}
    for number in range(PLACES * PASSES):
        for count in NUMBERS:
            for series, (name, rounds) in ways.items():
                call = partial(compiled(name), worlds[count][number % PLACES], rounds)
                seconds = seconds_per(call, rounds=1) / rounds
                best[count, series] = min(seconds, best.get((count, series), seconds))
    for (count, series), seconds in best.items():
        chart.add(series, count, seconds * 1e9)
    return chart


def whole_ticks() -> Chart:
    """A whole tick against the objects in the level, that rest as gold and mines do; the cost of a save-state."""
    chart = Chart("tick-against-objects", "A tick and a save-state", "objects in the level", "ns")
    call = compiled(count_ticks)
    keys = np.zeros(400, np.uint8)
    for count in NUMBERS:
        maps, world = load_worlds(compiled, [scattered(count)], box=False)
        chart.add("tick", count, seconds_per(partial(call, maps, world, 0, keys)) / len(keys) * 1e9)
        run = Simulation(scattered(count), memory="compiled")
        state = run.save()
        chart.add("save", count, seconds_per(run.save) * 1e9)
        chart.add("restore", count, seconds_per(partial(run.restore, state)) * 1e9)
    return chart


def rays() -> Chart:
    """A ray against its length: along its cells, and through all cells of the box around it."""
    chart = Chart("ray-against-length", "A ray at 35 degrees that ends at a wall", "cells crossed", "ns a ray")
    dx, dy = 0.8191520442889918, 0.573576436351046
    for wall in (3, 4, 6, 8, 12, 16, 22, 30):
        tiles = tuple(1 if number // 23 + 1 >= wall else 0 for number in range(TILES))
        maps, world = load_worlds(compiled, [Level(tiles, (ObjectSpec(NINJA, (36.0, 36.0)),))], box=False)
        x, y = 36.5, 37.0
        length = (wall * 24.0 - x) / dx + 1.0
        crossed = int((x + dx * length) / 24) - 1 + int((y + dy * length) / 24) - 1
        same = [
            compiled(game_kernels.cast_along_cells)(maps, world, x, y, dx, dy, 1),
            compiled(game_kernels.cast_through_box)(maps, world, x, y, dx, dy, length, 1),
        ]
        assert abs(same[0] - same[1]) < 1e-6, f"the rays disagree: {same}"
        ray = maps, world, x, y, dx, dy
        along = partial(compiled(game_kernels.cast_along_cells), *ray, 100)
        chart.add("along its cells", crossed, seconds_per(along) * 1e7)
        chart.add(
            "through its box", crossed,
            seconds_per(partial(compiled(game_kernels.cast_through_box), *ray, length, 100)) * 1e7,
        )  # fmt: skip
    return chart


def resident_bytes() -> int:
    """Memory of this process that is in use, bytes; 0 where the system does not say."""
    status = Path("/proc/self/statm")
    return int(status.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") if status.exists() else 0


def memory() -> Chart:
    """Memory of a world against the objects in its level: what it uses, and what each of a batch makes resident."""
    chart = Chart("memory-against-objects", "Memory of a world", "objects in the level", "KiB")
    for count in NUMBERS:
        level = scattered(count)
        chart.add("used", count, used_bytes(count + 2) / 1024)
        grown = []
        for _ in range(3):
            before = resident_bytes()
            batch = Batch(level, RESIDENT, memory="compiled", threads=1)
            batch.run(np.zeros((40, RESIDENT), np.uint8))
            grown.append((resident_bytes() - before) / RESIDENT / 1024)
            del batch
        chart.add(f"resident, of {RESIDENT}", count, max(median(grown), 0.01))
    return chart
