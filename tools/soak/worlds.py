"""Run crowded levels for very many ticks on all cores: no odd state, and the same as on the plain memory.

    python3 tools/dev.py tool soak.worlds [--ticks 1000000000] [--seed 1]

Links, counts and places are looked at every so often, and one world of each batch is run on the plain memory too. Exit
code 0: nothing found; 1: something was, printed with the seed that makes it. Hostile levels, on kernels that refuse
indices out of range, are tried by `EXAMPLES=100000 NEW_EXAMPLES=1 python3 tools/dev.py test tests/sim/test_door.py`.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from ninja_game.batch.batch import Batch
from ninja_game.sim.kinds import GOLD, LAUNCH_PAD
from ninja_game.sim.memory.schema import MAX_EVENTS
from ninja_game.simulation import BODIES, Simulation
from tests.support.crowded import crowded_level

LEVELS, WORLDS, TICKS, LOOKS = 32, 1024, 1200, 8
"""Of one batch: its levels, worlds, ticks, and how often its worlds are looked at."""


def odd_states(ticks: int, seed: int) -> Iterator[str]:
    """Reports of batches whose worlds are not as they must be."""
    done = 0
    while done < ticks:
        for problem in _batch_problems(seed):
            yield f"batch {seed}: {problem}"
        done += WORLDS * TICKS
        seed += 1


def _batch_problems(seed: int) -> Iterator[str]:
    rng = np.random.default_rng(seed)
    levels = [crowded_level(seed * LEVELS + number) for number in range(LEVELS)]
    body = BODIES[seed % len(BODIES)]
    batch = Batch(levels, WORLDS, body=body, memory="compiled")
    spans = rng.integers(0, 8, (TICKS // 6, WORLDS), dtype=np.uint8)
    keys = np.repeat(spans, 6, axis=0)
    watched = int(rng.integers(WORLDS))
    plain = Simulation(levels[watched % LEVELS], body=body, memory="plain")
    before = batch.outcomes.copy(), batch.gold.copy(), batch.used.copy()
    held = 0
    for look in range(1, LOOKS + 1):
        part = keys[(look - 1) * TICKS // LOOKS : look * TICKS // LOOKS]
        batch.run(part, press=True)
        outcomes, gold, used = before
        if not ((batch.outcomes == outcomes) | (outcomes == 0)).all():
            yield "an outcome changed after it was reported"
        if (batch.gold < gold).any() or (batch.used != used).any() or (batch.ticks != look * TICKS // LOOKS).any():
            yield "gold, slots or ticks are counted wrong"
        before = batch.outcomes.copy(), batch.gold.copy(), used
        yield from _state_problems(batch)
        if look <= 2:  # the plain memory is slow
            for pressed in part[:, watched].tolist():
                jump = pressed >> 2 & 1
                plain.step_keys(pressed | 8 * (jump & ~held))
                held = jump
            if plain.digest() != batch.digest(watched):
                yield f"world {watched} differs between the memories after {plain.tick} ticks"


def _state_problems(batch: Batch) -> Iterator[str]:
    """What is wrong with the worlds as they are now."""
    records, objects, used = batch.records, batch.objects, batch.used[:, np.newaxis]
    numbers = np.arange(objects.shape[1])
    inside = (numbers > 0) & (numbers < used)
    pads = [any(record.kind == LAUNCH_PAD for record in level.objects) for level in batch.levels]
    calm = ~np.array(pads)[batch.levels_now]
    golds = [sum(record.kind == GOLD for record in level.objects) for level in batch.levels]
    places = batch.positions
    if not np.isfinite(places).all() or not np.isfinite(batch.velocities()).all():
        yield "a ninja's place is not a number"
    if (calm & ((places < 24.0) | (places > (768.0, 576.0))).any(axis=1)).any():
        yield "a ninja left the room without a launch pad"
    if ((batch.outcomes < 0) | (batch.outcomes > 2)).any() or (batch.gold > np.array(golds)[batch.levels_now]).any():
        yield "an outcome or the gold is out of range"
    if ((records["event_count"] < 0) | (records["event_count"] > MAX_EVENTS)).any():
        yield "events are out of range"
    for name in ("next", "prev", "newer", "older", "ring_next", "ring_prev"):
        links = objects[name]
        if (inside & ((links < 0) | (links >= used))).any():
            yield f"a link ({name}) leads out of the world"
    yield from _grid_problems(records["heads"], objects, inside & (objects["in_grid"] == 1) & (objects["cell"] > 0))


def _grid_problems(heads: NDArray[np.int16], objects: NDArray[np.void], there: NDArray[np.bool_]) -> Iterator[str]:
    """What is wrong with the lists of the cells: each filed object is linked, from both sides, in its cell."""
    worlds, slots = np.nonzero(there)
    filed = objects[worlds, slots]
    if (filed["cell"] >= heads.shape[1]).any():
        yield "an object is filed in a cell outside the grid"
        return
    followed = np.where(filed["next"] > 0, objects["prev"][worlds, filed["next"]], slots)
    leading = np.where(
        filed["prev"] > 0, objects["next"][worlds, filed["prev"]], heads[worlds, filed["cell"]].astype(np.int32)
    )
    if (followed != slots).any() or (leading != slots).any():
        yield "a cell's list is broken"


def main() -> int:
    """Print what is found, twenty findings at most."""
    parser = argparse.ArgumentParser(description="Run crowded levels for very many ticks.")
    parser.add_argument("--ticks", type=int, default=10_000_000, help="of all worlds together (default 10 million)")
    parser.add_argument("--seed", type=int, default=1, help="of the first batch (default 1)")
    options = parser.parse_args()
    found = 0
    for report in islice(odd_states(options.ticks, options.seed), 20):
        print(report, flush=True)
        found += 1
    print(f"{options.ticks} ticks, {found} wrong")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
