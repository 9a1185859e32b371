"""The core of the environments: the same bytes on both memories, with any number of threads, alone or among many."""

from typing import Any

import numpy as np
import pytest

from ninja_game import Simulation
from ninja_game.backend.memories import compiled, compiled_available
from ninja_game.errors import ArgumentError
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.rewards import DeathPenalty, ExitReward, GoldReward, TimePenalty
from ninja_game.learn.worlds import EnvWorlds, advance_worlds
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from tests.support.learning import LEVELS, random_actions, same
from tests.support.memories import BOTH

REWARD = (ExitReward(1.0), DeathPenalty(0.5), GoldReward(0.1), TimePenalty(0.001))
needs_numba = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")


def history(actions: Any, *, worlds: EnvWorlds, seeds: list[int]) -> list[bytes]:
    """What the worlds show after each step, ended ones beginning again, as bytes."""
    worlds.reset(seeds=seeds)
    shown = []
    for row in actions:
        worlds.step(DISCRETE_KEYS[row], restart=worlds.ended())
        seen = worlds.observations
        parts = list(seen.values()) if isinstance(seen, dict) else [seen]
        arrays = (*parts, worlds.rewards, worlds.terminated, worlds.truncated, worlds.ticks, worlds.gold, worlds.events)
        shown.append(b"".join(array.tobytes() for array in arrays))
    return shown


def make(count: int, **settings: Any) -> EnvWorlds:
    given: dict[str, Any] = {"reward": REWARD, "time_limit": 300}
    return EnvWorlds(LEVELS, count, **given | settings)


@needs_numba
def test_threads_change_nothing() -> None:
    actions, seeds = random_actions(60, 900), list(range(900))
    one, two, four = (history(actions, worlds=make(900, threads=threads), seeds=seeds) for threads in (1, 2, 4))
    assert one == two == four


@needs_numba
def test_plain_and_compiled_show_the_same_bytes() -> None:
    actions, seeds = random_actions(100, 4), [3, 4, 5, 6]
    one, other = (history(actions, worlds=make(4, memory=memory), seeds=seeds) for memory in ("plain", "compiled"))
    assert one == other


@needs_numba
def test_one_world_and_many_share_one_compiled_function() -> None:
    for count in (1, 4):
        history(random_actions(2, count), worlds=make(count), seeds=[3] * count)
    entry: Any = compiled(advance_worlds)
    assert len(entry.signatures) == 1


@pytest.mark.parametrize("memory", BOTH)
def test_a_step_is_what_a_run_does_in_so_many_ticks(memory: str) -> None:
    worlds = EnvWorlds(LEVELS[0], 1, memory=memory, frame_skip=3, reward=REWARD)
    run = Simulation(LEVELS[0])
    for action in random_actions(50, 1, seed=2)[:, 0]:
        keys = int(DISCRETE_KEYS[action])
        gold, events, ticks = run.gold, set(), 0
        while ticks < 3 and run.outcome == "running":
            left, right, jump = (bool(keys & key) for key in (KEY_LEFT, KEY_RIGHT, JUMP_HELD))
            run.step(left=left, right=right, jump=jump)
            ticks += 1
            events |= {EVENT_NAMES.index(event.name) for event in run.events}
        assert worlds.step(np.array([keys], np.uint8)) == ticks
        assert worlds.digest(0) == run.digest()
        assert worlds.events[0] == sum(1 << event for event in events)
        earned = 0.1 * (run.gold - gold) - 0.001 * ticks + {"exit": 1.0, "dead": -0.5, "running": 0.0}[run.outcome]
        assert worlds.rewards[0] == pytest.approx(earned)
        assert worlds.terminated[0] == (run.outcome != "running")
        if worlds.terminated[0]:
            break
    else:
        pytest.fail("the run should end")


@pytest.mark.parametrize("memory", BOTH)
def test_an_episode_is_truncated_at_its_time_limit(memory: str) -> None:
    worlds = EnvWorlds(LEVELS[0], 1, memory=memory, frame_skip=4, time_limit=6)
    none = np.zeros(1, np.uint8)
    assert [(worlds.step(none), bool(worlds.truncated[0])) for _ in range(2)] == [(4, False), (2, True)]
    assert not worlds.terminated[0]


@pytest.mark.parametrize("memory", BOTH)
def test_saved_worlds_go_on_in_other_worlds_as_they_would_have(memory: str) -> None:
    worlds = make(5, memory=memory)
    worlds.reset(levels=[0, 1, 2, 0, 1])
    actions = DISCRETE_KEYS[random_actions(24, 5)]
    for row in actions[:12]:
        worlds.step(row)
    state = worlds.save([1, 2])
    worlds.restore(state, [4, 0])
    assert worlds.levels_now[[4, 0]].tolist() == [1, 2]
    assert not worlds.rewards[[4, 0]].any()
    for row in actions[12:]:
        row[[4, 0]] = row[[1, 2]]
        worlds.step(row)
        for one, other in ((1, 4), (2, 0)):
            assert worlds.digest(one) == worlds.digest(other)
            assert same(worlds.observations[[one]], worlds.observations[[other]])  # type: ignore[index]
    with pytest.raises(ArgumentError):
        worlds.restore(state, [1])
    with pytest.raises(ArgumentError):
        make(5, memory=memory, time_limit=77).restore(state, [1, 2])


@pytest.mark.parametrize("normalised", [True, False])
def test_observations_stay_in_their_space(normalised: bool) -> None:
    from ninja_game.learn.observations.vectors import StateVector

    worlds = make(3, observation=StateVector(normalised=normalised))
    worlds.reset(levels=[0, 1, 2])
    for row in random_actions(200, 3):
        worlds.step(DISCRETE_KEYS[row], restart=worlds.ended())
        assert all(seen in worlds.observation.space for seen in worlds.observations)


@pytest.mark.parametrize("memory", BOTH)
def test_a_restored_world_shows_no_events_of_the_step_before(memory: str) -> None:
    worlds = make(2, memory=memory)
    worlds.reset(levels=[0, 0])
    jump = np.array([KEY_RIGHT | JUMP_HELD] * 2, np.uint8)
    for _ in range(30):
        worlds.step(jump)
        if worlds.events.all():
            break
    assert worlds.events.all()
    worlds.restore(worlds.save([0]), [1])
    assert worlds.events[0]
    assert not worlds.events[1]


def test_a_restored_world_has_ended_as_it_had() -> None:
    worlds = make(3, time_limit=60)
    worlds.reset(levels=[0, 0, 0])
    start = worlds.save([0])
    while worlds.ended().size != 2:
        worlds.step(np.array([KEY_RIGHT, KEY_LEFT, 0], np.uint8), restart=np.array([2]))
    passed_and_late = worlds.save([0, 1])
    worlds.restore(start, [0])
    assert (worlds.terminated.tolist(), worlds.truncated.tolist()) == ([False] * 3, [False, True, False])
    worlds.reset()
    worlds.restore(passed_and_late, [2, 0])
    assert (worlds.terminated.tolist(), worlds.truncated.tolist()) == ([False, False, True], [True, False, False])
    assert worlds.ended().tolist() == [0, 2]
