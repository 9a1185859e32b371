"""Worlds as environments: n episodes side by side, from one to thousands. Both Gymnasium classes use this.

>>> import numpy as np
>>> from ninja_game import Input, parse_level
>>> level = parse_level("0" * 713 + "|5^100,566!11^160,564,130,564")
>>> worlds = EnvWorlds(level, 2)
>>> for _ in range(6):
...     ticks = worlds.step(np.array([Input.RIGHT, Input.LEFT], np.uint8))
>>> worlds.ticks.tolist(), worlds.terminated.tolist(), worlds.rewards.tolist()
([24, 24], [True, False], [1.0, 0.0])
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, TypedDict

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import open_worlds
from ninja_game.backend.plain import save_plain
from ninja_game.batch.batch import Indices, Keys, WorldChoice, numbers_of
from ninja_game.batch.thread_pool import thread_count, thread_pool, whole_number
from ninja_game.errors import ArgumentError
from ninja_game.learn.goal_distance import GoalDistance
from ninja_game.learn.levels.origins import Origin, level_source
from ninja_game.learn.levels.source import ChosenLevels, LevelSequences
from ninja_game.learn.observations.observation import Observation, PartLike
from ninja_game.learn.observations.part import PartContext
from ninja_game.learn.protocol import CHANCES, draw_starts, next_random
from ninja_game.learn.rewards import DistanceShaping, RewardLike, Shaping, event_rewards, terms_of
from ninja_game.sim.digest import world_digest
from ninja_game.sim.events import EXIT_OPENED, GOLD_TAKEN, MINE_EXPLODED
from ninja_game.sim.inputs import with_press_bit
from ninja_game.sim.level import Body, is_box
from ninja_game.sim.rules import LIFETIME
from ninja_game.sim.schema.declare import kernel
from ninja_game.sim.schema.world_fields import MAX_EVENTS, TileMap, World
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_EXIT
from ninja_game.sim.world import step
from ninja_game.simulation import SaveState, Simulation

_FACT_ROWS = 8
OUTCOME_ROW, TICKS_ROW, GOLD_ROW, EVENTS_ROW, ENDED_ROW, PLAYED_ROW, WAIT_ROW, RANDOM_ROW = range(_FACT_ROWS)
"""Rows of ``facts``, a column per world: keys of its last tick in PLAYED_ROW, remaining steps without keys in WAIT_ROW,
state of the generator that decides whether keys are repeated (`protocol.py`) in RANDOM_ROW."""
_TERMINATED, _TRUNCATED = 1, 2  # how an episode has ended; 0: it has not
_CHANGES = (1 << GOLD_TAKEN) | (1 << MINE_EXPLODED) | (1 << EXIT_OPENED)
"""Events that change the looks of objects that never move."""


class StepSettings(NamedTuple):
    """The settings of a step: ticks, a number of CHANCES, and the reward of each event."""

    frame_skip: int  #: ticks of a step
    time_limit: int  #: ticks of an episode
    repeat: int  #: of CHANCES: that a world repeats the keys of the previous step
    exit_reward: float  #: for reaching the exit
    death_reward: float  #: for dying, 0 or less
    gold_reward: float  #: for each piece
    tick_reward: float  #: for each tick, 0 or less


@kernel
def advance_worlds(
    maps: Sequence[TileMap], level_of: Indices, worlds: Sequence[World], indices: Indices, first: int, last: int,
    keys: Keys, settings: Sequence[StepSettings], rewards: NDArray[np.float64], facts: NDArray[np.int64],
    changed: NDArray[np.bool_], terminated: NDArray[np.bool_], truncated: NDArray[np.bool_],
) -> int:  # fmt: skip
    """Run worlds ``indices[first:last]`` for one step with their ``keys``; gives the number of ticks run.

    A world stops at its first exit contact or death, and at the time limit. As on a keyboard, jump is pressed in a tick
    in which it is held and was not held before. A waiting world gets no keys. ``settings`` has one row, since kernels
    take arrays. ``rewards`` (worlds) gets the sums. ``facts`` (OUTCOME_ROW to RANDOM_ROW x worlds): EVENTS_ROW has
    those of all ticks, as bits. ``changed`` (worlds): set if one of _CHANGES happened, and if the list of events was
    full. ``terminated``, ``truncated`` (worlds): the parts of ENDED_ROW.
    """
    total = 0
    frame_skip, time_limit, repeat = settings[0].frame_skip, settings[0].time_limit, settings[0].repeat
    for k in range(first, last):
        index = indices[k]
        tiles = maps[level_of[index]]
        w = worlds[index]
        down = int(keys[index])
        if repeat:
            facts[RANDOM_ROW, index] = next_random(int(facts[RANDOM_ROW, index]))
            if facts[RANDOM_ROW, index] < repeat:
                down = int(facts[PLAYED_ROW, index])
        if facts[WAIT_ROW, index]:
            facts[WAIT_ROW, index] -= 1
            down = 0
        facts[PLAYED_ROW, index] = down
        tick = w.tick
        gold = w.gold
        event_bits = 0
        crowded = False
        for _ in range(frame_skip):
            step(tiles, w, with_press_bit(down, w.ninja.jump_held))
            for event in range(w.event_count):
                event_bits |= 1 << w.events[event].kind
            if w.event_count >= MAX_EVENTS:
                crowded = True
            if w.outcome or w.tick >= time_limit:
                break
        ticks = w.tick - tick
        reward = settings[0].gold_reward * (w.gold - gold) + settings[0].tick_reward * ticks
        if w.outcome == OUTCOME_EXIT:
            reward += settings[0].exit_reward
        elif w.outcome == OUTCOME_DEAD:
            reward += settings[0].death_reward
        rewards[index] = reward
        facts[OUTCOME_ROW, index] = w.outcome
        facts[TICKS_ROW, index] = w.tick
        facts[GOLD_ROW, index] = w.gold
        facts[EVENTS_ROW, index] = event_bits
        facts[ENDED_ROW, index] = _TERMINATED if w.outcome else _TRUNCATED if w.tick >= time_limit else 0
        terminated[index] = w.outcome != 0
        truncated[index] = w.outcome == 0 and w.tick >= time_limit
        changed[index] = crowded or (event_bits & _CHANGES) != 0
        total += ticks
    return total


NO_LEVEL = -1
CHUNK_WORLDS = 512
"""Worlds that are run and then observed before the next ones: their memory fits into the processor's cache."""


@dataclass(frozen=True, eq=False)
class EnvState:
    """Saved worlds of an ``EnvWorlds``, for one with equal levels, body, memory and time limit."""

    levels: Indices
    states: Any = field(repr=False)  #: the save-states
    starts: NDArray[np.float64] = field(repr=False)  #: ticks to the exit at the start of each episode
    facts: NDArray[np.int64] = field(repr=False)  #: the rows of ``EnvWorlds.facts``, a column per world
    owner: tuple[Any, ...] = field(repr=False)


class TaskSettings(TypedDict, total=False):
    """Arguments of ``EnvWorlds``: observations, rewards, and the memory."""

    observation: PartLike | Sequence[PartLike]
    flat: bool
    reward: RewardLike | Sequence[RewardLike] | None
    goal_distance: bool
    memory: str


class EnvSettings(TaskSettings, total=False):
    """Arguments of ``EnvWorlds`` that both Gymnasium classes take."""

    frame_skip: int
    time_limit: int
    repeat: float
    longest_wait: int
    body: Body


def refuse_unknown(settings: Mapping[str, object], *own: str) -> None:
    """Raise ArgumentError for a name that is not an argument of an environment; ``own``: its additional arguments."""
    for name in settings.keys() - EnvSettings.__optional_keys__:
        known = ", ".join(sorted({*own, *EnvSettings.__optional_keys__}))
        raise ArgumentError(f"an environment has no argument {name!r}; expected one of {known}")


def checked_options(options: object, *known: str) -> dict[str, Any]:
    """Check the options of a reset. Raises ArgumentError for unknown ones."""
    if options is not None and (not isinstance(options, dict) or options.keys() - {*known}):
        raise ArgumentError(f"options are {options!r:.60}; expected a dict of {', '.join(known)}, or none")
    return dict(options or {})


class EnvWorlds:
    """``count`` worlds as episodes, one after the other.

    ``level``: the origin of the levels, as for ``level_source``. Each world has its own seed; the level of its e-th
    episode depends only on that seed and on e (and on what the source has learned, if it learns). ``observation``,
    ``flat``: as for ``Observation``. ``reward``: a term or several (`rewards.py`). ``frame_skip``: ticks of a step.
    ``time_limit``: ticks after which an episode is truncated. ``repeat``: chance that a step repeats the keys of the
    previous step; ``longest_wait``: most steps without keys at the start of an episode (`protocol.py`); their number
    depends on the world's seed and the episode. ``goal_distance``: make ``goal`` (``GoalDistance``: the distance of
    each world from the exit) even if no reward and no part needs it. ``body``, ``memory``, ``threads``: as for a
    ``Batch``; neither memory nor threads change a result.

    Every call overwrites the arrays below; copy what must last. n is the number of worlds.

    ============  ====================  =======================================================================
    observations  (n, …), or a dict     what the parts of the observation say
    rewards       (n,) float64          what the last step earned
    terminated    (n,) bool             whether the exit or death has been
    truncated     (n,) bool             whether the time is over without either
    outcomes      (n,) int64            0 running, 1 exit, 2 dead
    ticks, gold   (n,) int64            ticks of the episode; pieces collected
    events        (n,) int64            bit k: event k (`sim/events.py`) happened in the last step
    played        (n,) int64            the keys of the last step
    levels_now    (n,) intp             which of ``levels`` each world plays
    ============  ====================  =======================================================================

    Raises what ``Batch`` raises, and ArgumentError for numbers that cannot be.
    """

    def __init__(
        self,
        level: Origin,
        count: int,
        *,
        observation: PartLike | Sequence[PartLike] = "state",
        flat: bool = False,
        reward: RewardLike | Sequence[RewardLike] | None = None,
        frame_skip: int = 4,
        time_limit: int = LIFETIME,
        repeat: float = 0.0,
        longest_wait: int = 0,
        goal_distance: bool = False,
        body: Body = "circle",
        memory: str = "auto",
        threads: int | None = None,
    ) -> None:
        for name, number in (("worlds", count), ("frame_skip", frame_skip), ("time_limit", time_limit)):
            whole_number(name, number)
        whole_number("longest_wait", longest_wait, 0)
        if not isinstance(repeat, int | float) or not 0.0 <= repeat < 1.0:
            raise ArgumentError(f"repeat is {repeat!r:.60}; expected a chance, 0 or more and below 1")
        self.source = level_source(level)
        self.levels = self.source.levels
        self.count, self.body, self.frame_skip, self.time_limit = count, body, frame_skip, time_limit
        self._unbounded = self.source.largest is not None
        loaded = self.levels if self.source.largest is None else [self.source.largest] * count
        self._worlds = open_worlds(memory, loaded, count, box=is_box(body))
        self.memory, self.threads = self._worlds.name, thread_count(threads)
        self._changed = np.ones(count, np.bool_)
        fresh = self._worlds.initial_levels(range(len(loaded)))
        max_objects = self._worlds.slots if self._unbounded else 0
        context = PartContext(
            self._worlds, fresh, self._changed, time_limit, self.memory == "compiled", max_objects=max_objects
        )
        self.observation = Observation(observation, flat=flat)
        self.terms = terms = terms_of(reward)
        shaping = [term for term in terms if isinstance(term, DistanceShaping)]
        self._guided = any(part.needs_goal for part in self.observation.parts)
        needs_goal = goal_distance or self._guided or shaping
        if needs_goal and self._unbounded:
            raise ArgumentError("the solver's field is not made for levels without end; take others, such as 'packed'")
        self.goal = GoalDistance(self.levels, context) if needs_goal else None
        self._shaping = Shaping(shaping, self.goal) if self.goal and shaping else None
        self.observations = self.observation.buffers(count)
        self._context = replace(context, goal=self.goal)
        self._writers = self.observation.writers(self.observations, self._context)
        self._advance = self._worlds.kernel(advance_worlds)
        self._everyone: Indices = np.arange(count, dtype=np.intp)
        self._levels = LevelSequences(self.source, count)
        level_of: Indices = np.asarray(self._worlds.level_of)
        self.levels_now: Indices = np.full(count, NO_LEVEL) if self._unbounded else level_of
        self.rewards = np.zeros(count)
        self._facts = np.zeros((_FACT_ROWS, count), np.int64)
        self.outcomes, self.ticks, self.gold, self.events, self._ended, self.played = self._facts[:WAIT_ROW]
        self._longest_wait = longest_wait
        self.terminated, self.truncated = np.zeros((2, count), np.bool_)
        settings = StepSettings(frame_skip, time_limit, int(repeat * CHANCES), **event_rewards(terms))
        self._first_arguments = (self._worlds.maps, level_of, self._worlds.worlds)
        results = self.rewards, self._facts, self._changed, self.terminated, self.truncated
        self._last_arguments = (context.records([settings], StepSettings), *results)
        self._settings: dict[str, Any] = {
            "level": self.source, "count": count, "observation": self.observation.parts, "flat": flat, "reward": terms,
            "frame_skip": frame_skip, "time_limit": time_limit, "repeat": repeat,
            "longest_wait": longest_wait, "goal_distance": goal_distance, "body": body, "memory": self.memory,
            "threads": threads,
        }  # fmt: skip
        self.reset()

    __copy__ = deepcopy

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuilt, (self._settings,), (self.save(), self._levels, self._facts, self.rewards)

    def __setstate__(self, state: tuple[EnvState, LevelSequences, NDArray[np.int64], NDArray[np.float64]]) -> None:
        saved, self._levels, facts, rewards = state
        self.restore(saved)
        self._facts[:], self.rewards[:] = facts, rewards

    # --- time ---

    def step(self, keys: Keys, restart: Indices | None = None) -> int:
        """Run one step of every world with its keys, uint8 (n,): sums of ``Input``; gives the number of ticks run.

        With ``repeat`` or ``longest_wait`` a world may get other keys: ``played``.

        ``restart``: worlds that do not step but begin a new episode instead, without a reward.
        """
        indices = self._everyone
        if restart is not None and restart.size:
            steps = np.ones(self.count, np.bool_)
            steps[restart] = False
            indices = np.flatnonzero(steps)
            self._restart(restart)

        def work(first: int, last: int) -> int:
            ticks = 0
            for start in range(first, last, CHUNK_WORLDS):
                end = min(start + CHUNK_WORLDS, last)
                ticks += self._advance(*self._first_arguments, indices, start, end, keys, *self._last_arguments)
                if self.goal:
                    self.goal.measure(self.levels_now, indices, start, end)
                self._write(indices, start, end)
            return ticks

        ticks = thread_pool(self.threads).share(work, len(indices), self.frame_skip)
        if self.goal:
            moved = self.goal.settle(self.levels_now)
            if self._guided:
                self._observe(moved)
        if self._shaping:
            self._shaping.add(self.rewards, indices, self.terminated)
        ended = self.ended()
        if ended.size:
            self.source.report(self.levels_now[ended], self.outcomes[ended] == OUTCOME_EXIT)
        return ticks

    def _write(self, indices: Indices, first: int, last: int) -> int:
        for write, arguments in self._writers:
            write(*self._first_arguments, indices, first, last, *arguments)
        return 0

    def _observe(self, indices: Indices) -> None:
        thread_pool(self.threads).share(lambda first, last: self._write(indices, first, last), len(indices))

    def ended(self) -> Indices:
        """Indices of the worlds whose episode is over, (k,) intp."""
        ended: Indices = self._ended.nonzero()[0]
        return ended

    # --- single worlds ---

    def reset(
        self, worlds: WorldChoice = None, *, seeds: Sequence[int] | None = None, levels: ChosenLevels | None = None
    ) -> None:
        """Begin new episodes. ``seeds``: new seeds of these worlds. ``levels``: to be played; by default drawn."""
        numbers = numbers_of(worlds, self.count, "worlds")
        if seeds is not None:
            self._levels.seed(numbers, seeds)
        self._restart(numbers, levels)

    def _restart(self, numbers: Indices, levels: ChosenLevels | None = None) -> None:
        chosen, drawn = self._levels.next(numbers, levels)
        if self._unbounded:
            self._enter(numbers, chosen)
        else:
            self._worlds.load(numbers.tolist(), chosen.tolist())
        self._facts[:, numbers] = 0
        self.terminated[numbers] = self.truncated[numbers] = False
        self._facts[WAIT_ROW:, numbers] = draw_starts(drawn, self._longest_wait)
        self._look(numbers, None)

    def _enter(self, numbers: Indices, chosen: Indices) -> None:
        """Start worlds in levels of a source without limit; each world has a place for its present level."""
        levels = [self.levels[number] for number in chosen.tolist()]
        self._worlds.put_levels(numbers, levels)
        for index, fresh in zip(numbers.tolist(), self._worlds.initial_levels(numbers.tolist()), strict=True):
            self._context.fresh[index] = fresh
            for write in self._context.writers:
                write(index)
        self.levels_now[numbers] = chosen

    def _look(self, numbers: Indices, starts: NDArray[np.float64] | None) -> None:
        """Measure worlds again after a restart or restore, without reward. ``starts``: ticks at starts, None: now."""
        self.rewards[numbers], self._changed[numbers] = 0.0, True
        if self.goal:
            self.goal.begin(self.levels_now, numbers)
            self.goal.start[numbers] = self.goal.ticks[numbers] if starts is None else starts
        if self._shaping:
            self._shaping.begin(numbers)
        self._observe(numbers)

    def save(self, worlds: WorldChoice = None) -> EnvState:
        """Save the states of worlds and of their episodes, for ``restore``."""
        numbers = numbers_of(worlds, self.count, "worlds")
        starts = self.goal.start[numbers] if self.goal else np.zeros(len(numbers))
        saved = self._worlds.save_many(numbers), starts, self._facts[:, numbers]
        return EnvState(self.levels_now[numbers], *saved, self._owner())

    def restore(self, state: EnvState, worlds: WorldChoice = None) -> None:
        """Put as many saved states into worlds, the same or others. Raises ArgumentError if they do not fit.

        The worlds show the saved observation, no reward and no events. The random repetition of keys does not go back.
        """
        numbers = numbers_of(worlds, self.count, "worlds")
        if state.owner != self._owner() or len(state.levels) != len(numbers):
            raise ArgumentError(f"{len(state.levels)} saved worlds do not fit {len(numbers)} of these")
        if self._unbounded:
            self._enter(numbers, state.levels)
        self._worlds.restore_many(state.states, numbers, numbers if self._unbounded else state.levels)
        self._facts[:RANDOM_ROW, numbers] = state.facts[:RANDOM_ROW]
        self.events[numbers] = 0
        self.terminated[:], self.truncated[:] = self._ended == _TERMINATED, self._ended == _TRUNCATED
        self._look(numbers, state.starts)

    def simulation(self, index: int) -> Simulation:
        """Copy a world, without its past, to a run on the plain memory, to look at it or to go on."""
        run = Simulation(self.levels[self.levels_now[index]], body=self.body)
        run.restore(SaveState(run.level, run.body, run.memory, b"", save_plain(self.world(index))))
        return run

    def world(self, index: int) -> World:
        """Copy one world to plain objects, to read its fields."""
        return self._worlds.world(index)

    def digest(self, index: int) -> str:
        """Sha256 (hex) of one world in canonical form, as ``Simulation.digest``."""
        return world_digest(self.world(index))

    def _owner(self) -> tuple[Any, ...]:
        return self.levels, self.body, self.memory, self.time_limit, self.goal is not None


def _rebuilt(settings: dict[str, Any]) -> EnvWorlds:
    """Rebuild worlds. A function, so that a copy also has copies of the settings: a source of levels may learn."""
    return EnvWorlds(**settings)
