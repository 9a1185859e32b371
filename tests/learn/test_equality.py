"""One environment is as many: single and vector, plain and compiled, with any number of threads, to the last byte."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from ninja_game.backend.memories import compiled_available
from ninja_game.learn import NinjaEnv, NinjaVectorEnv
from ninja_game.learn.observations.observation import PARTS
from ninja_game.learn.rewards import REWARD_TERMS
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.level import Level
from ninja_game.sim.states import OUTCOME_NAMES
from tests.support.learning import playable_levels

WORLDS = 3
FAST = "compiled" if compiled_available() else "plain"
EVERYTHING: dict[str, Any] = {
    "repeat": 0.25,
    "longest_wait": 3,
    "observation": [*PARTS],
    "reward": [*REWARD_TERMS],
    "time_limit": 50,
}
actions_of_all = st.lists(st.tuples(*[st.integers(0, 5)] * WORLDS), min_size=1, max_size=25)


class Singles:
    """Single environments, of which one that has ended starts again in the next step, as the vector's worlds do."""

    def __init__(self, levels: list[Level], seed: int, **more: Any) -> None:
        self.envs = [NinjaEnv(levels, memory="plain", **EVERYTHING, **more) for _ in range(WORLDS)]
        self.shown = [env.reset(seed=seed + number) for number, env in enumerate(self.envs)]
        self.ended = [False] * WORLDS

    def step(self, actions: tuple[int, ...]) -> list[Any]:
        answers = []
        for number, (env, action) in enumerate(zip(self.envs, actions, strict=True)):
            if self.ended[number]:
                seen, info = env.reset()
                answer = seen, 0.0, False, False, info
            else:
                answer = env.step(action)
            self.ended[number] = answer[2] or answer[3]
            answers.append(answer)
        return answers


def same_world(single: tuple[Any, ...], vector: tuple[Any, ...], number: int) -> bool:
    """Whether an answer is that of a world of the vector."""
    seen, reward, terminated, truncated, info = single
    infos = {name: values.tolist()[number] for name, values in vector[4].items() if name[0] != "_"}
    stated = {
        "outcome": OUTCOME_NAMES[infos["outcome"]],
        "ticks": infos["ticks"],
        "gold": infos["gold"],
        "events": [name for bit, name in enumerate(EVENT_NAMES) if infos["events"] >> bit & 1],
        "level": infos["level"],
    }
    return (
        all(seen[name].tobytes() == vector[0][name][number].tobytes() for name in PARTS)
        and np.float64(reward).tobytes() == vector[1][number].tobytes()
        and (terminated, truncated, info) == (vector[2][number], vector[3][number], stated)
    )


@pytest.mark.slow
@settings(max_examples=8)
@given(
    levels=st.lists(playable_levels, min_size=1, max_size=3),
    actions=actions_of_all,
    seed=st.integers(0, 2**64),
    frame_skip=st.integers(1, 6),
)
def test_single_plain_environments_are_the_compiled_vector(
    levels: list[Level], actions: list[tuple[int, ...]], seed: int, frame_skip: int
) -> None:
    seed %= 2**64 - WORLDS
    singles = Singles(levels, seed, frame_skip=frame_skip)
    vector = NinjaVectorEnv(WORLDS, levels, memory=FAST, frame_skip=frame_skip, **EVERYTHING)
    shown: Any = vector.reset(seed=seed)
    for seen, _ in singles.shown:
        assert seen in vector.single_observation_space
    assert [info["level"] for _, info in singles.shown] == shown[1]["level"].tolist()
    for chosen in actions:
        answer = vector.step(np.array(chosen))
        for number, single in enumerate(singles.step(chosen)):
            assert same_world(single, answer, number)


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@settings(max_examples=4)
@given(levels=st.lists(playable_levels, min_size=1, max_size=3), seed=st.integers(0, 1000))
def test_the_number_of_threads_changes_no_byte(levels: list[Level], seed: int) -> None:
    """With 130 worlds, so that the threads have something to share out."""
    count = 130
    vectors = [NinjaVectorEnv(count, levels, threads=threads, **EVERYTHING) for threads in (1, 2, 4)]
    rng = np.random.default_rng(seed)
    bytes_of = {index: [flat(*vector.reset(seed=seed))] for index, vector in enumerate(vectors)}
    for _ in range(12):
        actions = rng.integers(6, size=count)
        for index, vector in enumerate(vectors):
            bytes_of[index].append(flat(*vector.step(actions)))
    assert bytes_of[0] == bytes_of[1] == bytes_of[2]


def flat(*answer: Any) -> bytes:
    """All bytes of an answer."""
    parts = [value for each in answer for value in (each.values() if isinstance(each, dict) else [each])]
    return b"".join(repr(part.tolist()).encode() if part.dtype == object else part.tobytes() for part in parts)
