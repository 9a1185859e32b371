"""Make a run look played: as few key changes as will do, at the price of a few ticks at most."""

from __future__ import annotations

from itertools import groupby

from ninja_game.runs.run import run_level
from ninja_game.sim.inputs import KEYS_DOWN, press_jumps
from ninja_game.sim.level import Level
from ninja_game.simulation import Body

Row = tuple[int, int]
"""Keys that are down, and for how many ticks."""


def rows_of(inputs: bytes) -> list[Row]:
    """Inputs as rows of equal keys; triggers follow from them."""
    return [(keys, len(list(ticks))) for keys, ticks in groupby(keys & KEYS_DOWN for keys in inputs)]


def playback(rows: list[Row]) -> bytes:
    """Rows of keys as inputs, with triggers where the jump key goes down."""
    return press_jumps([keys for keys, ticks in rows for _ in range(ticks)])


def smoothed(level: Level, inputs: bytes, *, body: Body = "circle", gold: int = 0, price: int = 0) -> bytes:
    """A run to the exit with fewer key changes, at most ``price`` ticks longer than ``inputs``.

    Short rows of keys are given to their neighbours, the shortest first, as long as the run still reaches the exit.
    """
    limit = len(inputs) + price
    rows = rows_of(inputs)
    longest = 1
    while longest <= 24:
        merged = _without_one(rows, longest, level, body, gold, limit)
        if merged is None:
            longest += 1
        else:
            rows = merged
    run = run_level(level, playback(rows).ljust(limit, b"\0"), body=body)
    return playback(rows).ljust(limit, b"\0")[: run.ticks]


def _without_one(rows: list[Row], longest: int, level: Level, body: Body, gold: int, limit: int) -> list[Row] | None:
    """The rows with one of at most ``longest`` ticks merged into a neighbour; None if no such run passes."""
    for index, (_, ticks) in enumerate(rows):
        if ticks > longest:
            continue
        for neighbour in (index - 1, index + 1):
            if not 0 <= neighbour < len(rows):
                continue
            keys = rows[neighbour][0]
            changed = rows_of(playback([*rows[:index], (keys, ticks), *rows[index + 1 :]]))
            run = run_level(level, playback(changed).ljust(limit, b"\0")[:limit], body=body)
            if run.outcome == "exit" and run.gold >= gold:
                return rows_of(playback(changed)[: run.ticks])
    return None
