"""Demonstrations: the observations, actions and rewards that recordings give in an environment.

>>> from ninja_game import load_replays
>>> episode = demonstration(load_replays("levels/certificates/00-0-first-steps.exit.replay.txt")[0])
>>> episode.observations.shape, episode.actions.shape, episode.rewards.sum().item(), episode.outcome
((237, 30), (236,), 1.0, 'exit')
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Unpack

import gymnasium
import numpy as np
from numpy.typing import NDArray

from ninja_game.budget import DATASET_MIB
from ninja_game.errors import ArgumentError, BudgetError, MissingExtraError, NinjaGameError
from ninja_game.files.writing import write_atomically
from ninja_game.formats.n14.level_string import level_digest, write_level_string
from ninja_game.formats.recording import Recording
from ninja_game.learn.actions import BUTTON_KEYS, DISCRETE_KEYS
from ninja_game.learn.observations.observation import Observed
from ninja_game.learn.single import NinjaEnv
from ninja_game.learn.worlds import TaskSettings
from ninja_game.runs.run import run_level
from ninja_game.runtime import install_hint
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, KEYS_DOWN
from ninja_game.sim.level import Body, Level
from ninja_game.sim.rules import LIFETIME

_BOTH = KEY_LEFT + KEY_RIGHT
_ACTION_OF_KEYS = np.array(
    [DISCRETE_KEYS.tolist().index(keys & JUMP_HELD if keys & _BOTH == _BOTH else keys) for keys in range(KEYS_DOWN + 1)]
)
"""The discrete action for each sum of keys; left and right together count as none (ninja.md §3)."""


class UnplayableRecordingError(NinjaGameError):
    """A recording that no agent could have made in an environment; the message says why."""


@dataclass(frozen=True, eq=False)
class Demonstration:
    """A recording of T ticks as T steps of an environment with frame skip 1.

    ``observations``: (T + 1, …), from the first reset to the last step, or a dict of such arrays. ``actions``: (T,)
    int64, for buttons (T, 3) int8. ``rewards``: (T,) float64. ``terminations``, ``truncations``: (T,) bool; a recording
    that ends before the exit or death ends truncated. ``name``, ``level``, ``body``: those of the recording.
    """

    name: str
    level: Level
    body: Body
    observations: Observed
    actions: NDArray[Any]
    rewards: NDArray[np.float64]
    terminations: NDArray[np.bool_]
    truncations: NDArray[np.bool_]
    outcome: str
    gold: int


def demonstration(
    recording: Recording,
    *,
    actions: str = "discrete",
    time_limit: int | None = None,
    most_bytes: int = DATASET_MIB * 2**20,
    **settings: Unpack[TaskSettings],
) -> Demonstration:
    """Play a recording in a ``NinjaEnv`` with its level and body.

    ``time_limit``: ticks (``TimeLeft`` shows them); None: those of the recording. ``settings``: of ``NinjaEnv``.

    An environment presses jump when the jump key goes down; recordings of N can also press it again while it is down.
    Raises UnplayableRecordingError if that changes the run, BudgetError for more than ``most_bytes`` of observations.
    """
    keys = recording.inputs
    limit = time_limit or len(keys)
    env = NinjaEnv(recording.level, body=recording.body, frame_skip=1, time_limit=limit, actions=actions, **settings)
    down = np.frombuffer(keys, np.uint8) & KEYS_DOWN
    buttons = ((down[:, np.newaxis] & BUTTON_KEYS) > 0).astype(np.int8)
    played = buttons if actions == "buttons" else _ACTION_OF_KEYS[down]
    seen = [env.reset()[0]]
    size = observation_size(seen[0])
    rewards: list[float] = []
    info: dict[str, Any] = {}
    terminated = False
    for action in played:
        observation, reward, terminated, truncated, info = env.step(action)
        seen.append(observation)
        if size * len(seen) > most_bytes:
            found = f"{len(keys):,} ticks of {size:,} bytes each"
            raise BudgetError("too many observations", recording.file, found=found, hint="--megabytes raises the limit")
        rewards.append(reward)
        if terminated or truncated:
            break
    ticks = len(rewards)
    if env.inputs != keys[:ticks]:
        runs = [run_level(recording.level, inputs, body=recording.body) for inputs in (keys, env.inputs)]
        if runs[0] != runs[1]:
            what = "it presses jump again while the key is down"
            raise UnplayableRecordingError(f"{recording.file}: {recording.name}: {what}")
    terminations, truncations = np.zeros((2, ticks), np.bool_)
    terminations[-1], truncations[-1] = terminated, not terminated
    observations = _stacked(seen)
    return Demonstration(
        recording.name, recording.level, recording.body, observations, played[:ticks], np.array(rewards), terminations,
        truncations, info["outcome"], info["gold"],
    )  # fmt: skip


def observation_size(observations: Observed) -> int:
    return sum(part.nbytes for part in (observations.values() if isinstance(observations, dict) else [observations]))


def _stacked(seen: Sequence[Any]) -> Observed:
    if isinstance(seen[0], dict):
        return {name: np.stack([observation[name] for observation in seen]) for name in seen[0]}
    return np.stack(seen)


def arrays(episodes: Sequence[Demonstration]) -> dict[str, NDArray[Any]]:
    """Join episodes, N steps in all, into arrays with the names that Minari uses.

    ``observations`` (N, …) before and ``next_observations`` after each step (for several parts: "observations/NAME"),
    ``actions``, ``rewards``, ``terminations``, ``truncations`` (N,), ``episode_ids`` (N,): the episode of each step,
    ``names`` (episodes,). Raises ArgumentError without episodes.
    """
    if not episodes:
        raise ArgumentError("there are no demonstrations to write")
    columns: dict[str, NDArray[Any]] = {}
    for name, first, last in (("observations", None, -1), ("next_observations", 1, None)):
        parts = [episode.observations for episode in episodes]
        for key in parts[0] if isinstance(parts[0], dict) else [""]:
            rows = [part[key] if isinstance(part, dict) else part for part in parts]
            columns[f"{name}/{key}" if key else name] = np.concatenate([row[first:last] for row in rows])
    for name in ("actions", "rewards", "terminations", "truncations"):
        columns[name] = np.concatenate([getattr(episode, name) for episode in episodes])
    columns["episode_ids"] = np.repeat(np.arange(len(episodes)), [len(episode.rewards) for episode in episodes])
    columns["names"] = np.array([episode.name for episode in episodes])
    return columns


def write_npz(path: Path, episodes: Sequence[Demonstration]) -> None:
    """Write ``arrays`` of episodes as a NumPy file. Raises ArgumentError without episodes, FileError, OSError."""
    named: dict[str, Any] = {**arrays(episodes)}
    write_atomically(path, lambda file: np.savez_compressed(file, **named))


def require_minari() -> None:
    if find_spec("minari") is None or find_spec("h5py") is None:
        raise MissingExtraError(f"data sets of Minari need it; {install_hint('minari')}")


def write_minari(dataset: str, episodes: Sequence[Demonstration], **settings: Any) -> Any:
    """Write episodes as the data set ``dataset`` of Minari ("name-v0"), in Minari's own place; gives the data set.

    ``settings``: those of the demonstrations, as words and numbers. The environment that the set recovers has the
    levels of all episodes. The metadata of an episode have the ``options`` of its reset, ``level_digest``,
    ``frame_skip`` and the ``name`` of the recording.

    Raises MissingExtraError without Minari; ArgumentError without episodes, for episodes of different bodies, or for a
    name that Minari refuses.
    """
    require_minari()
    import minari
    from minari.data_collector import EpisodeBuffer

    bodies = {episode.body for episode in episodes}
    if len(bodies) != 1:
        raise ArgumentError(f"{len(episodes)} demonstrations of {len(bodies)} bodies; expected some of one body")
    digests = [level_digest(episode.level) for episode in episodes]
    levels = dict(zip(digests, (write_level_string(episode.level, exact=True) for episode in episodes), strict=True))
    buffers = [
        EpisodeBuffer(
            id=number,
            observations=episode.observations,
            actions=episode.actions,
            rewards=episode.rewards.tolist(),
            terminations=episode.terminations.tolist(),
            truncations=episode.truncations.tolist(),
            options={"level": list(levels).index(digests[number])},
        )
        for number, episode in enumerate(episodes)
    ]
    longest = max(LIFETIME, *(len(episode.rewards) for episode in episodes))
    own = {"level": list(levels.values()), "body": bodies.pop(), "frame_skip": 1, "time_limit": longest}
    env = gymnasium.make("ninja_game.learn:Ninja-v0", **{**own, **settings})
    try:
        with env, warnings.catch_warnings():
            # Minari warns about a missing address of the author, link and scores, which recordings do not have.
            warnings.simplefilter("ignore", UserWarning)
            written = minari.create_dataset_from_buffers(
                dataset,
                buffers,
                env=env,
                jpeg_encoding=False,
                data_format="hdf5",
                algorithm_name="recordings",
                description="Recordings of ninja-game, one step a tick",
            )
            written.storage.update_episode_metadata(
                [
                    {"level_digest": digest, "frame_skip": 1, "name": episode.name}
                    for digest, episode in zip(digests, episodes, strict=True)
                ]
            )
            return written
    except ValueError as error:
        raise ArgumentError(f"{dataset}: {error}") from None
