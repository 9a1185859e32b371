"""Untrusted levels: whatever a level holds, it is played or refused with a message, on both memories alike."""

import math
import os
from functools import cache

import pytest
from hypothesis import given, settings, strategies as st

from ninja_game import parse_level, run_level, trace_level
from ninja_game.backend.compiled import CompiledWorlds
from ninja_game.backend.compiler import Compiler
from ninja_game.backend.memories import compiled_available
from ninja_game.backend.numba_import import import_numba
from ninja_game.errors import LevelError
from ninja_game.sim.kinds import GOLD, NINJA
from ninja_game.sim.level import TILES, Level, ObjectSpec
from ninja_game.simulation import Simulation
from tests.support.memories import BOTH

NINJA_SPEC = ObjectSpec(NINJA, (100.0, 300.0))
GOLD_SPEC = ObjectSpec(GOLD, (100.0, 300.0))


@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize("kind", [13, 99, 10**17, -1, -2, -3, -99])
def test_a_record_of_a_kind_that_does_not_exist_creates_nothing(kind: int, memory: str) -> None:
    run = Simulation(Level(objects=(ObjectSpec(kind, (1.0, 2.0)), NINJA_SPEC, GOLD_SPEC)), memory=memory)
    run.step(right=True)
    assert [(o.id, o.kind) for o in run.objects] == [(1, "gold")]


@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize("kind", ["99", "999999999999999999"])
def test_an_odd_type_number_in_a_level_file_harms_nobody(kind: str, memory: str) -> None:
    try:
        level = parse_level("0" * 713 + f"|5^100,300!{kind}^1,2")
    except LevelError:
        return
    assert run_level(level, bytes(9), memory=memory).outcome == "running"


@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize(
    "level, message",
    [
        ("levels/00-0-first-steps.txt", "this is not a level"),
        (Level(tiles=(0,) * 12, objects=(NINJA_SPEC,)), "713 whole numbers"),
        (Level(tiles=(0.5,) * TILES, objects=(NINJA_SPEC,)), "713 whole numbers"),  # type: ignore[arg-type]
        (Level(objects=(NINJA_SPEC, ObjectSpec(0, ("x", 2.0)))), "object 1 of the level is not an ObjectSpec"),  # type: ignore[arg-type]
        (Level(objects=(NINJA_SPEC, ObjectSpec(0, (10**400, 2.0)))), "object 1 of the level is not an ObjectSpec"),
        (Level(objects=(ObjectSpec(0.5, (1.0, 2.0)), NINJA_SPEC)), "object 0 of the level is not an ObjectSpec"),  # type: ignore[arg-type]
        (Level(objects=(ObjectSpec("0", (1.0, 2.0)), NINJA_SPEC)), "object 0 of the level is not an ObjectSpec"),  # type: ignore[arg-type]
        (Level(objects=(GOLD_SPEC,)), "it has no ninja"),
        (Level(objects=(NINJA_SPEC,) * 13_000), "too many objects"),
    ],
)
def test_what_is_not_a_level_is_refused(level: Level, message: str, memory: str) -> None:
    with pytest.raises(LevelError, match=message):
        Simulation(level, memory=memory)
    for run in (run_level, trace_level):
        for choice in (memory, "auto"):
            with pytest.raises(LevelError, match=message):
                run(level, bytes(9), memory=choice)


@cache
def checked() -> Compiler:
    """One compiler of kernels that refuse indices out of range, for all examples."""
    return Compiler(import_numba(), checked=True)


numbers = st.one_of(st.floats(), st.integers(-3, 40).map(float), st.sampled_from([math.nan, math.inf, 1e300, 792.0]))
specs = st.builds(ObjectSpec, st.integers(-2, 15), st.lists(numbers, max_size=10).map(tuple))
tiles = st.lists(st.integers(-5, 50), min_size=TILES, max_size=TILES).map(tuple)


@pytest.mark.slow
@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@settings(max_examples=int(os.environ.get("EXAMPLES", "200")))
@given(tiles, st.lists(specs, max_size=12), st.binary(min_size=40, max_size=40), st.booleans())
def test_no_hostile_level_leads_out_of_bounds(
    ids: tuple[int, ...], records: list[ObjectSpec], keys: bytes, box: bool
) -> None:
    world = CompiledWorlds(checked(), [Level(ids, (NINJA_SPEC, *records))], box=box)
    world.run(bytes(key & 15 for key in keys))
