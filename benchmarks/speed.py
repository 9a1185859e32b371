"""How fast the world is here: ticks, loading, save-states, compilation. Medians of several rounds."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from hashlib import sha256
from statistics import median
from typing import Any

import numpy as np

from benchmarks.game_kernels import count_ticks
from ninja_game.backend.memories import compiled, compiled_available
from ninja_game.backend.plain import load_plain
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.runs.trace import trace_digests, trace_recording
from ninja_game.sim.level import Level
from ninja_game.sim.world import step
from ninja_game.simulation import Simulation

ROUNDS = 5
ROUND_SECONDS = 0.2  # a round is repeated until it has taken so long: short ones measure the clock

COMPILED_COSTS = ("load_compiled_us", "save_us", "restore_us", "state_bytes")

FIRST_TICK = """
import time
start = time.perf_counter()
from ninja_game import Simulation, parse_level
Simulation(parse_level("0" * 713 + "|5^100,566"), memory="{memory}").step()
print(time.perf_counter() - start)
"""


def run_benchmark(recordings: Sequence[Recording], *, compile_time: bool = True) -> dict[str, Any]:
    """Every figure by name. What needs Numba is None where it is missing.

    ``*_ticks_per_s``: one thread, loading not counted. ``*_us``: microseconds for the level of median size, whose
    objects are ``objects``; ``load_us`` is of the plain memory, ``save_us`` and ``restore_us`` of the compiled one.
    ``start_*_s``: from a new process's first import to its first tick. ``compile_s``: that with nothing compiled.
    """
    level = sorted((recording.level for recording in recordings), key=_objects)[len(recordings) // 2]
    numba = compiled_available()
    return {
        "python": platform.python_version(),
        "machine": f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores",
        "recordings": len(recordings),
        "corpus": corpus_digest(recordings),
        "signature": signature(recordings),
        "plain_ticks_per_s": plain_speed(recordings),
        "compiled_ticks_per_s": compiled_speed(recordings) if numba else None,
        "objects": _objects(level),
        **_plain_costs(level),
        **(_compiled_costs(level) if numba else dict.fromkeys(COMPILED_COSTS)),
        "start_plain_s": _first_tick("plain"),
        "start_compiled_s": min(_first_tick("compiled") for _ in range(2)) if numba else None,
        "compile_s": _compile_time() if numba and compile_time else None,
    }


def _objects(level: Level) -> int:
    return len(level.objects)


def corpus_digest(recordings: Sequence[Recording]) -> str:
    """Sha256 (hex) of all levels, bodies and inputs."""
    parts = (f"{level_digest(recording.level)} {recording.body} {recording.inputs.hex()}\n" for recording in recordings)
    return sha256("".join(parts).encode()).hexdigest()


def signature(recordings: Sequence[Recording]) -> str:
    """Sha256 (hex) of everything that all runs show in every tick, objects and all: any change of any bit shows."""
    return sha256("".join(trace_digests(trace_recording(run)).run_sha256 for run in recordings).encode()).hexdigest()


def plain_speed(recordings: Sequence[Recording]) -> float:
    """Ticks a second on the plain memory, one thread."""

    def race(recording: Recording) -> tuple[int, float]:
        tiles, world = load_plain(recording.level, recording.body == "box")
        inputs = recording.inputs
        start = time.perf_counter()
        for keys in inputs:
            step(tiles, world, keys)
            if world.outcome:
                break
        return world.tick, time.perf_counter() - start

    return _speed(race, recordings)


def compiled_speed(recordings: Sequence[Recording]) -> float:
    """Ticks a second on the compiled memory, one thread. Compilation is not counted."""
    from ninja_game.backend.compiled import load_worlds

    def race(recording: Recording) -> tuple[int, float]:
        maps, worlds = load_worlds(compiled, [recording.level], box=recording.body == "box")
        inputs = np.frombuffer(recording.inputs, np.uint8)
        start = time.perf_counter()
        ticks = kernel(maps, worlds, 0, inputs)
        return ticks, time.perf_counter() - start

    kernel = compiled(count_ticks)
    race(recordings[0])
    return _speed(race, recordings)


def _speed(race: Callable[[Recording], tuple[int, float]], recordings: Sequence[Recording]) -> float:
    """Ticks a second over all recordings: the median of the rounds."""
    rates = []
    for _ in range(ROUNDS):
        ticks, seconds = 0, 0.0
        while seconds < ROUND_SECONDS:
            for recording in recordings:
                more, took = race(recording)
                ticks += more
                seconds += took
        rates.append(ticks / seconds)
    return round(median(rates))


def _plain_costs(level: Level) -> dict[str, float]:
    """What it costs to load a level, and to save and restore a plain world in it."""
    load, save, restore, _ = _costs(level, "plain")
    return {"load_us": load, "save_plain_us": save, "restore_plain_us": restore}


def _compiled_costs(level: Level) -> dict[str, float]:
    """The same for a compiled world, and how large its state is."""
    return dict(zip(COMPILED_COSTS, _costs(level, "compiled"), strict=True))


def _costs(level: Level, memory: str) -> tuple[float, float, float, int]:
    world = Simulation(level, memory=memory)
    state = world.save()
    load = _microseconds(lambda: Simulation(level, memory=memory))
    size = state.data.nbytes if memory == "compiled" else 0
    return load, _microseconds(world.save), _microseconds(lambda: world.restore(state)), size


def _microseconds(function: Callable[[], object]) -> float:
    """Time of one call: the median of the rounds."""
    calls, seconds = 1, 0.0
    while seconds < ROUND_SECONDS / 10:
        calls *= 4
        seconds = _seconds(function, calls)
    return round(median(_seconds(function, calls) for _ in range(ROUNDS)) / calls * 1e6, 3)


def _seconds(function: Callable[[], object], calls: int) -> float:
    start = time.perf_counter()
    for _ in range(calls):
        function()
    return time.perf_counter() - start


def _first_tick(memory: str, **environment: str) -> float:
    """Seconds to the first tick of a new process, from its first import on."""
    code = [sys.executable, "-P", "-c", FIRST_TICK.format(memory=memory)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), **environment}
    return round(float(subprocess.check_output(code, env=environment, text=True)), 3)


def _compile_time() -> float:
    """Seconds to the first tick of a process that finds nothing compiled."""
    with tempfile.TemporaryDirectory() as folder:
        return _first_tick("compiled", NUMBA_CACHE_DIR=folder)
