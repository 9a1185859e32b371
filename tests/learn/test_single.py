"""The single environment: Gymnasium's own checks, episodes, save-states, pictures, and the errors for wrong use."""

import warnings
from collections.abc import Iterator
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ClosedEnvironmentError, InvalidAction, ResetNeeded, UnsupportedMode
from gymnasium.utils.env_checker import check_env

from ninja_game import load_level, record_replay
from ninja_game.errors import ArgumentError
from ninja_game.files.bundled import bundled_levels
from ninja_game.learn import ENVIRONMENTS
from ninja_game.learn.observations.observation import PARTS
from ninja_game.learn.observations.surroundings import LocalTiles
from ninja_game.learn.rewards import REWARD_TERMS
from ninja_game.learn.single import NinjaEnv
from ninja_game.sim.events import EVENT_NAMES
from tests.support.slow import the_rest_is_slow

EXIT_NEAR = "0" * 713 + "|5^100,566!0^130,566!11^260,564,230,564"
RIGHT, RIGHT_JUMP = 2, 5


@pytest.fixture
def env() -> Iterator[NinjaEnv]:
    made = NinjaEnv(EXIT_NEAR, memory="plain")
    yield made
    made.close()


def made(name: str, **settings: Any) -> NinjaEnv:
    env = gymnasium.make(f"ninja_game.learn:{name}", memory="plain", **settings).unwrapped
    assert isinstance(env, NinjaEnv)
    return env


def checked(env: NinjaEnv) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env)


@pytest.mark.parametrize("name", the_rest_is_slow([*ENVIRONMENTS], 1))
@pytest.mark.filterwarnings("ignore:.*out of date:DeprecationWarning")
def test_gymnasium_finds_nothing_wrong_with_any_id(name: str) -> None:
    checked(made(name))


@pytest.mark.parametrize("actions", ["discrete", "buttons"])
@pytest.mark.parametrize("part", PARTS)
def test_gymnasium_finds_nothing_wrong_with_any_space(part: str, actions: str) -> None:
    checked(made("Ninja-v0", observation=part, actions=actions))


def test_gymnasium_finds_nothing_wrong_with_tiles_as_flags() -> None:
    checked(made("Ninja-v0", observation=LocalTiles(size=3, form="one-hot")))


@pytest.mark.slow
@pytest.mark.parametrize("normalised", [False, True])
def test_gymnasium_finds_nothing_wrong_with_all_parts_together(normalised: bool) -> None:
    parts = [part(normalised=normalised) for part in PARTS.values()]
    checked(made("Ninja-v0", observation=parts))
    checked(made("Ninja-v0", observation=parts, flat=True))


def test_gymnasium_finds_nothing_wrong_with_all_rewards_together() -> None:
    checked(made("Ninja-v0", reward=[*REWARD_TERMS]))


def test_an_episode_ends_at_the_exit_and_pays_for_it(env: NinjaEnv) -> None:
    _, info = env.reset(seed=0)
    assert info == {"outcome": "running", "ticks": 0, "gold": 0, "events": [], "level": "level"}
    seen, rewards = [], []
    ended = False
    while not ended:
        _, reward, ended, truncated, info = env.step(RIGHT)
        seen += info["events"]
        rewards.append(reward)
        assert not truncated
    assert (info["outcome"], info["gold"]) == ("exit", 1)
    assert seen == ["gold-taken", "exit-opened", "won"]
    assert rewards == [0.0] * (len(rewards) - 1) + [1.0]
    assert set(seen) <= set(EVENT_NAMES)


def test_time_over_is_truncation() -> None:
    env = NinjaEnv(EXIT_NEAR, time_limit=10, memory="plain")
    env.reset()
    ends = [env.step(1)[2:4] for _ in range(3)]
    assert ends == [(False, False), (False, False), (False, True)]
    with pytest.raises(ResetNeeded, match="the episode is over"):
        env.step(1)


@pytest.mark.parametrize("actions", ["discrete", "buttons"])
def test_the_inputs_of_an_episode_are_a_run_that_anybody_can_verify(actions: str) -> None:
    env = NinjaEnv(EXIT_NEAR, actions=actions, memory="plain", frame_skip=3)
    env.reset(seed=5)
    env.action_space.seed(5)
    over = False
    while not over:
        *_, terminated, truncated, info = env.step(env.action_space.sample())
        over = terminated or truncated
    replay = record_replay(env.level, env.inputs)
    assert len(env.inputs) == info["ticks"]
    assert (replay.outcome, replay.gold) == (info["outcome"], info["gold"])


def test_a_saved_moment_comes_back_with_all_that_follows(env: NinjaEnv) -> None:
    env.reset(seed=0)
    for _ in range(5):
        env.step(RIGHT_JUMP)
    saved = env.save()
    inputs = env.inputs

    def following() -> list[Any]:
        return [env.step(action) for action in (RIGHT, RIGHT, RIGHT_JUMP, 0)]

    first = following()
    while env.step(RIGHT)[2] is False:
        pass
    observation, info = env.restore(saved)
    assert env.inputs == inputs
    assert info["ticks"] == 20
    assert np.array_equal(observation, first[0][0]) is False
    for before, now in zip(first, following(), strict=True):
        assert np.array_equal(before[0], now[0])
        assert before[1:] == now[1:]


def test_a_moment_of_another_level_does_not_fit(env: NinjaEnv) -> None:
    env.reset()
    saved = env.save()
    other = NinjaEnv("00-0-first-steps", memory="plain")
    other.reset()
    with pytest.raises(ArgumentError, match="do not fit"):
        other.restore(saved)


def test_the_seed_chooses_the_levels_of_all_episodes() -> None:
    env, other = (NinjaEnv("test", memory="plain") for _ in range(2))
    names = [env.reset(seed=3)[1]["level"], *(env.reset()[1]["level"] for _ in range(9))]
    assert names == [other.reset(seed=3)[1]["level"], *(other.reset()[1]["level"] for _ in range(9))]
    assert len(set(names)) > 3
    assert [env.reset(seed=seed)[1]["level"] for seed in range(5)] != names[:5]


def test_without_a_seed_environments_differ() -> None:
    firsts = {NinjaEnv("test", memory="plain").reset()[1]["level"] for _ in range(6)}
    assert len(firsts) > 1


def test_options_choose_a_level_for_one_episode_or_other_levels_from_now_on() -> None:
    env = NinjaEnv(["00-0-first-steps", "00-1-mind-the-gap"], memory="plain")
    assert env.reset(options={"level": "00-1-mind-the-gap"})[1]["level"] == "00-1-mind-the-gap"
    assert env.reset(options={"level": 0})[1]["level"] == "00-0-first-steps"
    assert env.reset(options={"level": load_level(bundled_levels()[2])})[1]["level"] == "level"
    assert env.level == load_level(bundled_levels()[2])
    assert env.reset()[1]["level"] == "level"
    for wrong in ({"level": "nowhere"}, {"level": 7}, {"lvl": 0}):
        with pytest.raises(ArgumentError, match="expected"):
            env.reset(options=wrong)


def test_both_memories_show_the_same() -> None:
    pytest.importorskip("numba")
    plain, fast = (NinjaEnv("00-0-first-steps", memory=memory) for memory in ("plain", "compiled"))
    plain.reset(seed=1)
    fast.reset(seed=1)
    plain.action_space.seed(1)
    for _ in range(60):
        action = plain.action_space.sample()
        one, other = plain.step(action), fast.step(action)
        assert np.array_equal(one[0], other[0])
        assert one[1:] == other[1:]


@pytest.mark.parametrize(
    "wrong", [6, -1, 1.5, True, "right", None, [1], [1, [1]], np.array([1, 0, 1]), np.array(float("nan"))], ids=repr
)
def test_what_is_not_an_action_is_refused_and_changes_nothing(env: NinjaEnv, wrong: Any) -> None:
    env.reset()
    with pytest.raises(InvalidAction, match="expected"):
        env.step(wrong)
    assert env.inputs == b""
    assert env.step(RIGHT)[4]["ticks"] == 4


@pytest.mark.parametrize("wrong", [1, [1, 0], [0, 0, 2], [0.5, 0, 0]], ids=repr)
def test_what_is_not_an_action_of_buttons_is_refused(wrong: Any) -> None:
    env = NinjaEnv(EXIT_NEAR, actions="buttons", memory="plain")
    env.reset()
    with pytest.raises(InvalidAction, match="expected"):
        env.step(wrong)


def test_nothing_works_before_the_first_reset(env: NinjaEnv) -> None:
    for use in (lambda: env.step(1), env.render, env.save):
        with pytest.raises(ResetNeeded, match="call reset"):
            use()


def test_nothing_works_after_close_but_close(env: NinjaEnv) -> None:
    env.reset()
    saved = env.save()
    env.close()
    env.close()
    for use in (env.reset, lambda: env.step(1), env.render, env.save, lambda: env.restore(saved)):
        with pytest.raises(ClosedEnvironmentError, match="closed"):
            use()


def test_wrong_settings_are_refused_in_words() -> None:
    with pytest.raises(UnsupportedMode, match="rgb_array"):
        NinjaEnv(render_mode="film")
    wrong: tuple[dict[str, Any], ...] = (
        {"level": "nowhere"}, {"level": 3}, {"render_size": (0, 0)}, {"render_size": 400}, {"reward": 3},
        {"actions": "keys"}, {"observation": "smell"}, {"frame_skip": 0}, {"time_limit": 0},
        {"body": "ball"}, {"memory": "cloud"},
    )  # fmt: skip
    for settings in wrong:
        with pytest.raises(ArgumentError, match=r"expected|there is no level"):
            NinjaEnv(**settings)


def test_rgb_arrays_are_the_games_own_picture() -> None:
    env = made("Ninja-v0", render_mode="rgb_array", render_size=(264, 200))
    env.reset()
    first = env.render()
    assert (first.shape, first.dtype) == ((200, 264, 3), np.uint8)
    for _ in range(10):
        env.step(RIGHT_JUMP)
    saved, then = env.save(), env.render()
    assert not np.array_equal(first, then)
    env.step(RIGHT)
    env.restore(saved)
    assert np.array_equal(env.render(), then)
    env.reset()
    assert np.array_equal(env.render(), first)
    assert env.metadata["render_fps"] == 10


def test_text_shows_what_is_there_now() -> None:
    env = NinjaEnv(EXIT_NEAR, memory="plain", render_mode="ansi")
    env.reset()
    start = env.render().rpartition("\n")[0]
    assert [start.count(char) for char in "@oXx"] == [1, 1, 1, 1]
    while not env.step(RIGHT)[2]:
        pass
    end, _, line = env.render().rpartition("\n")
    assert [end.count(char) for char in "@oXx"] == [1, 0, 1, 0]
    assert line.endswith("exit, 1 gold")


def test_rendering_without_a_mode_warns(env: NinjaEnv) -> None:
    env.reset()
    with pytest.warns(UserWarning, match="render mode"):
        assert env.render() is None


def test_a_window_follows_its_size_and_stays_away_once_it_is_closed() -> None:
    import pygame

    env = NinjaEnv(EXIT_NEAR, memory="plain", render_mode="human", render_size=(132, 100))
    env.reset()
    assert pygame.display.get_window_size() == (132, 100)
    pygame.event.post(pygame.event.Event(pygame.VIDEORESIZE, size=(264, 200)))
    env.step(RIGHT)
    assert env.render() is None
    assert env._picture is not None
    assert env._picture._context.canvas.window == (264, 200)
    pygame.event.post(pygame.event.Event(pygame.QUIT))
    env.step(RIGHT)
    assert not pygame.display.get_init()
    assert env.step(RIGHT)[4]["ticks"] == 12
    env.close()
