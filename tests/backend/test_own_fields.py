"""Whatever reads worlds reads of each object the fields of its kind only: searches, learning, generator and traces."""

import pytest

from ninja_game import Batch, Simulation
from ninja_game.backend.memories import compiled_available
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.runs.trace import trace_level
from ninja_game.sim.kinds import DOOR, EXIT
from tests.support.crowded import crowded_inputs, crowded_level
from tests.support.memories import BOTH
from tests.support.own_fields import seen

pytestmark = pytest.mark.usefixtures("own_fields")
both_memories = pytest.mark.parametrize("memory", BOTH)
needs_numba = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")

LOCKED = parse_level_string(
    ("0" * 10 + "1" * 12 + "0") * 10 + "0" * 23 * 21 + "|5^60,566!11^290,566,270,566!9^150,566,0,0,10,23,1,0,0!0^90,566"
)
"""A low corridor, closed by a locked door whose switch lies in it, and gold."""


@both_memories
def test_a_foreign_field_is_an_error_to_read_and_to_write(memory: str) -> None:
    """As ``is_open`` of a door: its bytes are those of ``switched``, and its plain value is always 0."""
    batch = Batch(LOCKED, 1, memory=memory)
    batch.step([0])
    w = batch._worlds.worlds[0] if memory == "plain" else seen(batch._worlds.worlds)[0]
    door, exit_ = (next(o for o in map(w.objects.__getitem__, range(1, 6)) if o.kind == kind) for kind in (DOOR, EXIT))
    assert (door.switched, exit_.is_open) == (0, 0)
    with pytest.raises(AttributeError, match=r"is_open of an object of kind 9 \(door\)"):
        _ = door.is_open
    with pytest.raises(AttributeError, match=r"switched of an object of kind 11 \(exit\)"):
        exit_.switched = 1


@both_memories
@pytest.mark.parametrize("seed", [3, 8, 15])
def test_runs_and_traces(seed: int, memory: str) -> None:
    level, inputs = crowded_level(seed), crowded_inputs(seed, 120)
    checked = trace_level(level, inputs, memory=memory, events=True)
    run = Simulation(level, memory=memory)
    for keys in inputs[:20]:
        run.step_keys(keys)
    state, digest = run.save(), run.digest()
    run.step_keys(0)
    run.restore(state)
    assert (run.digest(), [seen.kind for seen in run.objects]) == (digest, list(checked.kinds))


@both_memories
def test_observations_rewards_and_the_distance_to_the_goal(memory: str) -> None:
    from ninja_game.learn.observations.observation import PARTS
    from ninja_game.learn.rewards import DistanceShaping
    from ninja_game.learn.vector import NinjaVectorEnv

    parts = [name for name in PARTS if name != "pixels"]
    levels = [LOCKED, crowded_level(3), crowded_level(8)]
    envs = NinjaVectorEnv(3, levels, observation=parts, reward=DistanceShaping(), memory=memory, threads=1)
    envs.reset(seed=3)
    for number in range(30):
        envs.step([2, 2, number % 6])


@pytest.mark.slow
@needs_numba
def test_the_solver_finds_what_it_finds_anyway(monkeypatch: pytest.MonkeyPatch) -> None:
    from ninja_game.search import solve as solving
    from ninja_game.search.task import Task

    monkeypatch.setattr(solving, "compile_solver", lambda: None)
    run = solving.solve(Task(LOCKED, gold=-1, work=9_000))
    assert run is not None
    assert run.gold == 1


@needs_numba
def test_searches_along_a_run() -> None:
    from ninja_game.search.certificate import verified_run
    from ninja_game.search.heuristics import Heuristics
    from ninja_game.search.nodes import Resolution, open_start
    from ninja_game.search.spans import SpanSearches, SpanSettings

    start = open_start(LOCKED, box=False)
    searches = SpanSearches(start, Heuristics(start.maps, start.worlds), gold=0)
    searches.follow(verified_run(LOCKED, bytes([2] * 20 + [0] * 10 + [2] * 120)).inputs)
    assert searches.run.masks[-1] == 3, "a door and an exit are open at the end"
    settings = SpanSettings(Resolution(cell=4.0, speed=0.35, macro=3, jitter=5), 8.0, 64.0, 0.9, 2.0)
    searches.search(10, 60, settings, seed=1, ticks=3_000, spend=lambda _: True)
    assert searches._search.ticks >= 3_000


def test_doors_of_a_checked_level_are_doors() -> None:
    from ninja_game.levels.lint import level_findings

    assert isinstance(level_findings(LOCKED), list)
