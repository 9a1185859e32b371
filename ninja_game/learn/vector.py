"""Many worlds, up to thousands, as one vector environment of Gymnasium.

>>> envs = NinjaVectorEnv(3, level="00-0-first-steps")
>>> observations, infos = envs.reset(seed=7)
>>> observations, rewards, terminations, truncations, infos = envs.step([2, 2, 5])
>>> observations.shape, infos["ticks"].tolist()
((3, 30), [4, 4, 4])
>>> envs.close()
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from typing import Any, Unpack

import numpy as np
from gymnasium.error import ClosedEnvironmentError, ResetNeeded, UnsupportedMode
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from ninja_game.errors import ArgumentError
from ninja_game.learn.actions import Actions
from ninja_game.learn.levels.origins import DEFAULT_LEVEL, Origin
from ninja_game.learn.levels.source import checked_seed
from ninja_game.learn.observations.observation import Observed
from ninja_game.learn.rendering import EpisodePicture, checked_size
from ninja_game.learn.worlds import EnvSettings, EnvWorlds, checked_options, refuse_unknown
from ninja_game.sim.rules import TICKS_PER_SECOND

Infos = dict[str, Any]


class NinjaVectorEnv(VectorEnv[Observed, Any, NDArray[Any]]):
    """``num_envs`` worlds that step together in compiled code.

    ``level``, ``observation``, ``flat``, ``reward``, ``frame_skip``, ``time_limit``, ``repeat``, ``longest_wait``,
    ``body``, ``memory``, ``threads``: as for ``EnvWorlds``. ``actions``: "discrete" or "buttons". ``autoreset_mode``:
    "NextStep" (a world that has ended ignores its next action and begins a new episode instead), "SameStep" (it begins
    at once; ``infos["final_obs"]`` and ``["final_info"]`` have the old end) or "Disabled" (the caller resets it, by
    ``options={"reset_mask": …}``). ``copy``: observations are new arrays; else they share memory that the next call
    overwrites.

    ``reset(seed=s)`` gives world i the seed s + i (modulo 2^64), ``seed=[…]`` gives one seed per world. ``options``:
    ``"reset_mask"``: the worlds to reset; ``"level"``: the name or number of the level to play, or one per world.

    ``infos`` has (num_envs,) arrays: ``outcome`` (0 running, 1 exit, 2 dead), ``ticks`` and ``gold`` of the episode,
    ``events`` of the step (bit k: event k of `sim/events.py`), ``level`` (its name; its number: ``worlds.levels_now``).

    ``render_mode="rgb_array"``: ``render`` gives a picture of each world, (height, width, 3) uint8 by ``render_size``.
    """

    def __init__(
        self,
        num_envs: int = 1,
        level: Origin = DEFAULT_LEVEL,
        *,
        actions: str = "discrete",
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        copy: bool = True,
        threads: int | None = None,
        render_mode: str | None = None,
        render_size: tuple[int, int] = (528, 400),
        **settings: Unpack[EnvSettings],
    ) -> None:
        refuse_unknown(settings, "level", "actions", "autoreset_mode", "copy", "threads", "render_mode", "render_size")
        if render_mode not in {None, "rgb_array"}:
            raise UnsupportedMode(f"render_mode is {render_mode!r}; expected 'rgb_array' or None")
        self.render_mode, self._size = render_mode, checked_size(render_size)
        self._picture: EpisodePicture | None = None
        self.worlds = EnvWorlds(level, num_envs, threads=threads, **settings)
        self._names, self._named = np.full(num_envs, "", dtype=object), np.full(num_envs, -1)
        self.actions = Actions(actions)
        self.num_envs = num_envs
        self.copy = copy
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        fps = TICKS_PER_SECOND / self.worlds.frame_skip
        self.metadata = {"render_modes": ["rgb_array"], "render_fps": fps, "autoreset_mode": self.autoreset_mode}
        self.single_action_space = self.actions.space
        self.single_observation_space = self.worlds.observation.space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._reset_before = False

    def reset(
        self, *, seed: int | Sequence[int] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observed, Infos]:
        """Begin new episodes. Raises ArgumentError for seeds, a mask, levels or other options that do not fit."""
        self._refuse_closed()
        options = checked_options(options, "level", "reset_mask")
        mask = options.get("reset_mask")
        chosen = np.arange(self.num_envs) if mask is None else np.flatnonzero(self._checked_mask(mask))
        if seed is None or isinstance(seed, int | np.integer):
            super().reset(seed=None if seed is None else checked_seed(seed))
        seeds = self._seeds(seed)
        self.worlds.reset(
            chosen, seeds=seeds and [seeds[index] for index in chosen.tolist()], levels=options.get("level")
        )
        self._reset_before = True
        reset = np.zeros(self.num_envs, np.bool_)
        reset[chosen] = True
        return self._shown(), self._infos(reset)

    def _seeds(self, seed: int | Sequence[int] | None) -> list[int] | None:
        if seed is None:
            return None if self._reset_before else self.np_random.integers(2**63, size=self.num_envs).tolist()
        if isinstance(seed, int | np.integer):
            return [(int(seed) + index) % 2**64 for index in range(self.num_envs)]
        seeds = list(seed) if isinstance(seed, Sequence | np.ndarray) else []
        if len(seeds) != self.num_envs:
            raise ArgumentError(f"seeds are {seed!r:.60}; expected {self.num_envs}, one for each world")
        return seeds

    def _checked_mask(self, mask: Any) -> NDArray[np.bool_]:
        if not isinstance(mask, np.ndarray) or mask.shape != (self.num_envs,) or mask.dtype != np.bool_:
            raise ArgumentError(f"reset_mask is {mask!r:.60}; expected an array of {self.num_envs} truth values")
        if not (self._reset_before or mask.all()):
            raise ResetNeeded("the first reset is of all worlds; leave reset_mask out")
        return mask

    def step(self, actions: Any) -> tuple[Observed, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], Infos]:
        """Run one step of every world.

        Raises InvalidAction; ResetNeeded before the first reset and, without autoreset, for worlds that have ended.
        """
        self._refuse_closed()
        if not self._reset_before:
            raise ResetNeeded("step before reset; call reset first")
        keys = self.actions.keys(actions, self.num_envs)
        worlds = self.worlds
        ended = worlds.ended()
        if ended.size and self.autoreset_mode is AutoresetMode.DISABLED:
            raise ResetNeeded(f"worlds {ended.tolist()[:5]} … have ended; reset them with options={{'reset_mask': …}}")
        worlds.step(keys, restart=ended)
        rewards, terminated, truncated = worlds.rewards.copy(), worlds.terminated.copy(), worlds.truncated.copy()
        final: Infos = {}
        if self.autoreset_mode is AutoresetMode.SAME_STEP:
            ended = worlds.ended()
            if ended.size:
                final = self._final(ended, terminated | truncated)
                worlds.reset(ended)
        return self._shown(), rewards, terminated, truncated, self._infos() | final

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """A picture of each world in its present state; None without a render mode."""
        self._refuse_closed()
        if self.render_mode is None:
            return None
        if not self._reset_before:
            raise ResetNeeded("no episode has begun; call reset() before render()")
        picture = self._picture = self._picture or EpisodePicture(self._size)
        pictures = []
        for index in range(self.num_envs):
            picture.begin(self.worlds.simulation(index))
            pictures.append(picture.rgb())
        return tuple(pictures)

    def __getstate__(self) -> dict[str, Any]:
        """Copies make their own picture."""
        return vars(self) | {"_picture": None}

    __copy__ = deepcopy

    def _final(self, ended: NDArray[np.intp], mask: NDArray[np.bool_]) -> Infos:
        """The last observations and infos of the worlds that have ended."""
        seen = self.worlds.observations
        last = {name: part[ended] for name, part in seen.items()} if isinstance(seen, dict) else seen[ended]
        final_obs = np.full(self.num_envs, None, dtype=object)
        for row, index in enumerate(ended.tolist()):
            final_obs[index] = {name: part[row] for name, part in last.items()} if isinstance(last, dict) else last[row]
        return {"final_obs": final_obs, "_final_obs": mask, "final_info": self._infos(mask), "_final_info": mask.copy()}

    def _shown(self) -> Observed:
        seen = self.worlds.observations
        if not self.copy:
            return seen
        return {name: part.copy() for name, part in seen.items()} if isinstance(seen, dict) else seen.copy()

    def _infos(self, mask: NDArray[np.bool_] | None = None) -> Infos:
        """Infos of all worlds, or of the worlds in ``mask``, with 0 for the others."""
        worlds = self.worlds
        for index in np.flatnonzero(worlds.levels_now != self._named).tolist():
            self._named[index] = number = worlds.levels_now[index]
            self._names[index] = worlds.source.names[number]
        values = {
            "outcome": worlds.outcomes, "ticks": worlds.ticks, "gold": worlds.gold,
            "events": worlds.events, "level": self._names,
        }  # fmt: skip
        infos: Infos = {}
        mask = np.ones(self.num_envs, np.bool_) if mask is None else mask
        for name, value in values.items():
            infos[name] = np.where(mask, value, None if name == "level" else 0)
            infos[f"_{name}"] = mask.copy()
        return infos

    def _refuse_closed(self) -> None:
        if self.closed:
            raise ClosedEnvironmentError("this environment is closed; make a new one")
