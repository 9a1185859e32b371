"""One world as a Gymnasium environment.

>>> import gymnasium
>>> env = gymnasium.make("ninja_game.learn:Ninja-v0", level="00-0-first-steps")
>>> observation, info = env.reset(seed=0)
>>> observation, reward, terminated, truncated, info = env.step(5)
>>> env.action_space, observation.shape, reward, info["outcome"], info["ticks"]
(Discrete(6), (30,), 0.0, 'running', 4)
>>> env.close()
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any, Unpack

import gymnasium
import numpy as np
from gymnasium.error import ClosedEnvironmentError, ResetNeeded, UnsupportedMode

from ninja_game.learn.actions import Actions
from ninja_game.learn.levels.origins import DEFAULT_LEVEL, Origin
from ninja_game.learn.levels.source import checked_seed
from ninja_game.learn.rendering import EpisodePicture, checked_size, state_text
from ninja_game.learn.worlds import EnvSettings, EnvState, EnvWorlds, checked_options, refuse_unknown
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import JUMP_HELD, with_press_bit
from ninja_game.sim.level import Level
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.sim.states import OUTCOME_NAMES
from ninja_game.simulation import Simulation


@dataclass(frozen=True, eq=False)
class SavedEpisode:
    """A saved state of an episode, from ``NinjaEnv.save``, for environments with equal levels and settings."""

    state: EnvState = field(repr=False)
    inputs: bytes = field(repr=False)
    running: bool


class NinjaEnv(gymnasium.Env[Any, Any]):
    """One world; an episode ends at the exit or by death (terminated), or at the time limit (truncated).

    ``level``, ``observation``, ``flat``, ``reward``, ``frame_skip`` (ticks of a step), ``time_limit`` (ticks),
    ``repeat``, ``longest_wait``, ``body``, ``memory``: as for ``EnvWorlds``. ``actions``: "discrete" or "buttons"
    (``Actions``). ``render_mode``: "human" (a window that shows every tick at the game's speed), "rgb_array" or "ansi"
    (text); ``render_size``: px, width and height.

    ``info``: ``outcome`` ("running", "exit", "dead"), ``ticks`` and ``gold`` of the episode, ``events`` (names, of
    ``EVENT_NAMES``, of the events of the last step), ``level`` (its name).

    Raises ArgumentError for wrong arguments, LevelError for a level that cannot be played, UnsupportedMode for another
    render mode. ``step`` and ``render`` raise ResetNeeded before the first reset, ``step`` also after the episode's
    end; ``step`` raises InvalidAction; all raise ClosedEnvironmentError after ``close``.
    """

    metadata: dict[str, Any] = {"render_modes": ["human", "rgb_array", "ansi"], "render_fps": 10}  # noqa: RUF012

    def __init__(
        self,
        level: Origin = DEFAULT_LEVEL,
        *,
        actions: str = "discrete",
        render_mode: str | None = None,
        render_size: tuple[int, int] = (528, 400),
        **settings: Unpack[EnvSettings],
    ) -> None:
        refuse_unknown(settings, "level", "actions", "render_mode", "render_size")
        if render_mode not in {None, *self.metadata["render_modes"]}:
            raise UnsupportedMode(f"render_mode is {render_mode!r}; expected one of {self.metadata['render_modes']}")
        self.render_mode = render_mode
        self._size = checked_size(render_size)
        self._settings = settings
        self._actions = Actions(actions)
        self.action_space = self._actions.space
        self.worlds = EnvWorlds(level, 1, threads=1, **settings)
        self.observation_space = self.worlds.observation.space
        # Recorders of films read the rate of steps from the environment.
        self.metadata = {**self.metadata, "render_fps": TICKS_PER_SECOND / self.worlds.frame_skip}
        self._picture: EpisodePicture | None = None
        self._inputs = bytearray()
        self._started = self._running = self._closed = False
        self._seed = 0

    # --- episodes ---

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Begin an episode; gives its observation and info.

        ``seed``: begin the sequence of levels of that seed. ``options``: ``{"level": …}``, this episode's level by its
        name or number; or other levels, as for ``level_source``, for this and all later episodes. Raises ArgumentError
        for other options and seeds.
        """
        self._check_open()
        seed = None if seed is None else checked_seed(seed)
        level = checked_options(options, "level").get("level")
        super().reset(seed=seed)
        new_seed = seed is not None or not self._started
        if new_seed:
            self._seed = int(self.np_random.integers(2**63)) if seed is None else seed
        if level is not None and not isinstance(level, int | np.integer) and level not in self.worlds.source.names:
            self.worlds = EnvWorlds(level, 1, threads=1, **self._settings)
            level, new_seed = None, True
        self.worlds.reset(seeds=[self._seed] if new_seed else None, levels=level)
        self._inputs.clear()
        self._started = self._running = True
        if self._picture is not None:
            self._picture.begin(Simulation(self.level, body=self.worlds.body))
        self._show(0)
        return self._observation(), self._info()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Hold the keys of an action for the ticks of a step: observation, reward, terminated, truncated, info."""
        self._check_open()
        if not self._running:
            over = "the episode is over" if self._started else "no episode has begun"
            raise ResetNeeded(f"{over}; call reset() before step()")
        worlds = self.worlds
        worlds.step(self._actions.key(action))
        down, terminated, truncated = worlds.played.item(0), worlds.terminated.item(0), worlds.truncated.item(0)
        held = self._inputs[-1] & JUMP_HELD if self._inputs else 0
        ticks = worlds.ticks.item(0) - len(self._inputs)
        self._inputs += bytes([with_press_bit(down, held)]).ljust(ticks, bytes([down]))
        self._running = not (terminated or truncated)
        self._show(ticks)
        return self._observation(), worlds.rewards.item(0), terminated, truncated, self._info()

    def __getstate__(self) -> dict[str, Any]:
        """Copies make their own picture."""
        return vars(self) | {"_picture": None}

    __copy__ = deepcopy

    def _observation(self) -> Any:
        observed = self.worlds.observations
        if isinstance(observed, dict):
            return {name: array[0].copy() for name, array in observed.items()}
        return observed[0].copy()

    def _info(self) -> dict[str, Any]:
        worlds = self.worlds
        bits = worlds.events.item(0)
        return {
            "outcome": OUTCOME_NAMES[worlds.outcomes.item(0)],
            "ticks": worlds.ticks.item(0),
            "gold": worlds.gold.item(0),
            "events": [name for bit, name in enumerate(EVENT_NAMES) if bits >> bit & 1] if bits else [],
            "level": worlds.source.names[worlds.levels_now[0]],
        }

    @property
    def level(self) -> Level:
        """The present level."""
        level: Level = self.worlds.levels[self.worlds.levels_now[0]]
        return level

    @property
    def inputs(self) -> bytes:
        """The inputs of this episode, one byte per tick, for ``record_replay``."""
        return bytes(self._inputs)

    def save(self) -> SavedEpisode:
        """Save the present state, for ``restore``; the levels of later episodes are not part of it."""
        self._check_started("save")
        return SavedEpisode(self.worlds.save(), self.inputs, self._running)

    def restore(self, saved: SavedEpisode) -> tuple[Any, dict[str, Any]]:
        """Go back to a saved state; gives its observation and info, without events.

        Random numbers do not go back: with ``repeat`` later steps differ. Raises ArgumentError for other settings.
        """
        self._check_started("restore")
        self.worlds.restore(saved.state)
        self._inputs[:] = saved.inputs
        self._running = saved.running
        if self._picture is not None:
            self._picture.begin(Simulation(self.level, body=self.worlds.body))
        self._show(1)
        return self._observation(), self._info()

    # --- pictures ---

    def render(self) -> Any:
        """Show the present state: an array (height, width, 3) uint8, a text, or None if a window shows it already."""
        self._check_started("render")
        if self.render_mode is None:
            gymnasium.logger.warn("render() was called without a render mode: make the environment with render_mode=…")
            return None
        if self.render_mode == "ansi":
            return state_text(self.level, self.worlds.body, self.inputs)
        picture = self._followed(0)
        return None if self.render_mode == "human" else picture.rgb()

    def _show(self, ticks: int) -> None:
        """Show the last ticks in the window, if there is one."""
        if self.render_mode == "human":
            self._followed(ticks)

    def _followed(self, ticks: int) -> EpisodePicture:
        """The picture of the present state; ``ticks``: number of the last ticks that a window shows."""
        if self._picture is None:
            window = self.render_mode == "human"
            self._picture = EpisodePicture(self._size, window=window)
            self._picture.begin(Simulation(self.level, body=self.worlds.body))
        self._picture.follow(self.inputs, ticks)
        return self._picture

    def close(self) -> None:
        """Close the window. A second call does nothing."""
        if self._picture is not None:
            self._picture.close()
        self._closed = True

    def _check_open(self) -> None:
        if self._closed:
            raise ClosedEnvironmentError("the environment is closed; make another one")

    def _check_started(self, what: str) -> None:
        self._check_open()
        if not self._started:
            raise ResetNeeded(f"no episode has begun; call reset() before {what}()")
