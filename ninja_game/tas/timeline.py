"""The simulation of a run, tick by tick, kept while its inputs change; and watched formulas over it."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from math import hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import open_worlds, switch_to_compiled
from ninja_game.backend.worlds import TRACED_FLOATS, TRACED_INTS, MemoryName, TraceArrays
from ninja_game.budget import tick_cost
from ninja_game.errors import FormatError
from ninja_game.runs.deaths import death_text, ending_text
from ninja_game.runs.save_states import SaveStates
from ninja_game.runs.trace import OBJECT_RECORD, event_names, ninja_columns, object_rows, switched_doors
from ninja_game.search.formula.language import Formula, FormulaValues, parse_measure, parse_truth
from ninja_game.search.formula.names import FACTS, NAMES, flag_field, id_of, ninja_view, no_object
from ninja_game.sim.digest import differences, state_digest
from ninja_game.sim.inputs import MAX_TICKS, fit_inputs
from ninja_game.sim.kinds import EXIT, KIND_OF
from ninja_game.sim.level import Body, Level, is_box
from ninja_game.sim.rules import EXIT_RADIUS, RADIUS
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_NAMES
from ninja_game.simulation import SaveState, Simulation
from ninja_game.tas.tracks import first_different_index

TICKS_BEHIND_END = 40  # ticks simulated behind the last input, without a key
_GROWTH = 4096  # least growth of the table, rows
_WATCHED_RECORD = np.dtype([*OBJECT_RECORD.descr, ("switched", "u1")])

NINJA_FIELDS = (*TRACED_FLOATS, "state", "in_air")  # the fields of the ninja on which its picture depends


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The ninja after each tick of a run: kept when the run is changed.

    ``columns``: the NINJA_FIELDS after each tick, of one length.
    """

    columns: Mapping[str, NDArray[Any]]

    def __len__(self) -> int:
        return len(self.columns["x"])

    @property
    def positions(self) -> NDArray[np.float64]:
        """The ninja after each tick: float64 (ticks, 2), px."""
        return np.column_stack([self.columns["x"], self.columns["y"]])

    def at(self, tick: int) -> dict[str, Any]:
        """The fields after a tick; behind the last one those of the last. Raises IndexError for an empty one."""
        return {name: column[min(tick, len(column) - 1)].item() for name, column in self.columns.items()}


EMPTY_TRAJECTORY = Trajectory({name: np.zeros(0) for name in NINJA_FIELDS})  # the trajectory of a run without ticks


class Timeline:
    """The world after every tick of a run.

    ``simulated_until``: the number of simulated ticks, the *greenzone*; ``simulate`` adds more.

    Row k of each column is the world after tick k. ``watched``: ids of the objects that are recorded too. Raises
    LevelError for a level that cannot be played.
    """

    def __init__(self, level: Level, inputs: bytes, *, body: Body = "circle", memory: str = "auto") -> None:
        self.level, self.body = level, body
        self._worlds = open_worlds(memory, level, box=is_box(body), at_once=True)
        self.asked_memory = memory
        self.initial = [self._worlds.observe(id_ + 1) for id_ in range(self._worlds.number("id_count"))]
        self.watched: tuple[int, ...] = ()
        self._states: SaveStates[Any] = SaveStates(0, self._worlds.save(), values=tick_cost(level))
        self._columns: dict[str, NDArray[Any]] = {
            **{name: np.zeros(0) for name in TRACED_FLOATS},
            **{name: np.zeros(0, np.int32) for name in TRACED_INTS},
        }
        self._objects = np.zeros((0, 0), _WATCHED_RECORD)
        self._events: dict[int, str] = {}  #: events in words, for ticks that have any
        self.inputs = b""
        self._death = b"", ""
        self.simulated_until = self._ticks_on_plain = 0
        self.set_inputs(inputs)

    @property
    def memory(self) -> MemoryName:
        """The present memory; "auto" may switch to the compiled one."""
        return self._worlds.name

    def __len__(self) -> int:
        """Ticks to simulate: those with inputs, and TICKS_BEHIND_END."""
        return len(self.inputs) + TICKS_BEHIND_END

    @property
    def is_complete(self) -> bool:
        return self.simulated_until >= len(self)

    # --- edits ---

    def set_inputs(self, inputs: bytes) -> int:
        """Set other inputs. Their common beginning stays simulated. Gives the first tick that differs."""
        # Behind the inputs no key is down: a run that grows by such ticks is the same.
        longest = max(len(self.inputs), len(inputs))
        same = first_different_index(fit_inputs(self.inputs, longest), fit_inputs(inputs, longest))
        self.inputs = inputs
        self._forget(min(same, len(self)))
        return same

    def watch(self, ids: Collection[int]) -> None:
        """Record these objects besides the ninja, instead of earlier ones; new ones need a new simulation.

        Raises ArgumentError for an unknown object.
        """
        for id_ in ids:
            self.at_start(id_)
        tracked = tuple(sorted(set(ids)))
        if tracked != self.watched:
            self.watched = tracked
            self._objects = np.zeros((len(self._objects), len(tracked)), _WATCHED_RECORD)
            self._forget(0)

    def _forget(self, tick: int) -> None:
        """Drop all simulated ticks from this one on."""
        self._states.forget_after(tick)
        self.simulated_until = min(self.simulated_until, tick)
        self._events = {at: names for at, names in self._events.items() if at < self.simulated_until}

    def simulate(self, ticks: int) -> bool:
        """Simulate up to a number of ticks more; whether all are simulated now."""
        self._reserve(len(self))
        stop = min(len(self), self.simulated_until + ticks)
        self._choose_memory(stop - self.simulated_until)
        if stop > self.simulated_until:
            self._run(stop)
        return self.is_complete

    def _choose_memory(self, ticks: int) -> None:
        """Before a number of ticks: switch to the compiled memory, once it is worth it and its kernels are ready."""
        self._ticks_on_plain += ticks
        worlds = switch_to_compiled(self._worlds, self.asked_memory, self._ticks_on_plain)
        if worlds is not self._worlds:
            self._worlds = worlds
            worlds.load([0], [0])
            self._states = SaveStates(0, worlds.save(), values=tick_cost(self.level))

    def ensure(self, tick: int) -> None:
        """Simulate all ticks up to this one."""
        if self.simulated_until <= min(tick, len(self) - 1):
            self.simulate(tick + 1 - self.simulated_until)

    def _run(self, stop: int) -> None:
        """Simulate from the nearest save-state up to tick ``stop``, and record those ticks; keep save-states."""
        first, state = self._states.nearest(self.simulated_until)
        self._worlds.restore(state)
        end = first
        slots = [id_ + 1 for id_ in self.watched]
        records = []
        while end < stop:
            start, end = end, min(stop, end - end % self._states.spacing + self._states.spacing)
            inputs = fit_inputs(self.inputs[start:end], end - start)
            records.append(self._worlds.trace(inputs, slots, events=True))
            if self._states.wants(end):
                self._states.keep(end, self._worlds.save())
        record = TraceArrays(*map(np.concatenate, zip(*records, strict=True)))
        for name, values in ninja_columns(record).items():
            self._columns[name][first:stop] = values
        if self.watched:
            watched = self._objects[first:stop]
            objects = object_rows(record, len(self.watched))
            for name in ("x", "y", "s"):
                watched[name] = objects[name]
            watched["switched"] = switched_doors(record, len(self.watched))
        self._events |= {first + at: names for at, names in enumerate(event_names(record)) if names}
        self.simulated_until = stop

    def _reserve(self, rows: int) -> None:
        if len(self._objects) >= rows:
            return
        more = max(rows - len(self._objects), _GROWTH)
        for name, column in self._columns.items():
            self._columns[name] = np.concatenate([column, np.zeros(more, column.dtype)])
        self._objects = np.concatenate([self._objects, np.zeros((more, len(self.watched)), _WATCHED_RECORD)])

    # --- reading ---

    def column(self, name: str) -> NDArray[Any]:
        """A field of TRACED_FLOATS (px, px/tick) or TRACED_INTS after each simulated tick: (simulated_until,)."""
        return self._columns[name][: self.simulated_until]

    def object_column(self, id_: float, name: str) -> FormulaValues:
        """x, y (px), s (status) or switched (0, 1) of an object: (simulated_until,).

        Raises ArgumentError for an unknown one, _UnwatchedError for one that is not recorded yet.
        """
        self.at_start(id_)
        if id_ not in self.watched:
            raise _UnwatchedError(int(id_))
        column: FormulaValues = self._objects[: self.simulated_until, self.watched.index(int(id_))][name].astype(float)
        return column

    def events(self, tick: int) -> str:
        """The names of the events of a simulated tick, with spaces between; of others ''."""
        return self._events.get(tick, "")

    @property
    def event_ticks(self) -> list[tuple[int, str]]:
        return [*self._events.items()]

    @property
    def objects(self) -> list[tuple[int, int, float, float]]:
        """Id, kind, x and y (px, at the start) of every object that can be watched."""
        seen = enumerate(self.initial)
        return [(id_, kind, x, y) for id_, (kind, x, y, _) in seen if KIND_OF[kind].traced]

    def at_start(self, id_: float) -> tuple[int, float, float, int]:
        """Kind, x, y (px) and status of an object at the start. Raises ArgumentError for an unknown one."""
        if not 0 <= id_ < len(self.initial) or id_ != int(id_) or not KIND_OF[self.initial[int(id_)][0]].traced:
            raise no_object(id_)
        return self.initial[int(id_)]

    @property
    def exits(self) -> list[tuple[float, float]]:
        return [(x, y) for kind, x, y, _ in self.initial if kind == EXIT]

    @property
    def positions(self) -> NDArray[np.float64]:
        """The ninja after each simulated tick: float64 (simulated_until, 2), px."""
        return np.column_stack([self.column("x"), self.column("y")])

    def trajectory(self) -> Trajectory:
        """The trajectory of the simulated ticks."""
        return Trajectory({name: self.column(name).copy() for name in NINJA_FIELDS})

    @property
    def end(self) -> tuple[int, str]:
        """The first tick of exit contact or death among those simulated, and which; (-1, "running") without one."""
        outcomes = self.column("outcome")
        ended = np.flatnonzero(outcomes)
        return (int(ended[0]), OUTCOME_NAMES[int(outcomes[ended[0]])]) if len(ended) else (-1, OUTCOME_NAMES[0])

    def ending(self) -> str:
        """The end in words, for a death with the killer; "" without one."""
        end, outcome = self.end
        return ending_text(outcome, end, self.death()) if end >= 0 else ""

    def unended_text(self) -> str:
        """A sentence about a run without an end: that it goes on, and which exits' switches it has not touched."""
        world = self.world(self.simulated_until - 1)
        exits = (obj for obj in world.objects[1 : world.slots_used] if obj.kind == EXIT)
        shut = ", ".join(str(obj.id) for obj in exits if not getattr(obj, KIND_OF[EXIT].used))
        return f"it goes on, the switch of exit {shut} untouched" if shut else "it goes on"

    def death(self) -> str:
        """The ninja's killer, in words; "" without a death in the simulated ticks."""
        end, outcome = self.end
        if outcome != OUTCOME_NAMES[OUTCOME_DEAD]:
            return ""
        inputs = fit_inputs(self.inputs[: end + 1], end + 1)
        if self._death[0] != inputs:
            start, state = self._states.nearest(end)
            self._worlds.restore(state)
            self._worlds.run(inputs[start:])
            self._death = inputs, death_text(self._worlds.events(), self._worlds.ninja(), self._worlds.objects())
        return self._death[1]

    def save_state(self, tick: int) -> SaveState:
        """The nearest kept moment at or before the one after this many ticks, for ``Simulation.restore``."""
        at, state = self._states.nearest(min(tick, self.simulated_until, MAX_TICKS))
        return SaveState(self.level, self.body, self.memory, fit_inputs(self.inputs[:at], at), state)

    def world(self, tick: int) -> World:
        """The world after a simulated tick."""
        run = Simulation(self.level, body=self.body, memory=self.memory)
        run.restore(self.save_state(tick + 1))
        for keys in fit_inputs(self.inputs, tick + 1)[run.tick : tick + 1]:
            run.step_keys(keys)
        return run.world


NAMED_APART = 3  # objects that `difference_text` names at most


def difference_text(ours: World, theirs: World) -> str:
    """The differences of two worlds that decide later ticks, in words."""
    if state_digest(ours) == state_digest(theirs):
        return "in the same state: what follows plays as before"
    (x, y, vx, vy), (x2, y2, vx2, vy2) = (
        (n.x, n.y, n.x - n.prev_x, n.y - n.prev_y) for n in (ours.ninja, theirs.ninja)
    )
    gap = f"{hypot(x2 - x, y2 - y):.2f} px away, {hypot(vx2 - vx, vy2 - vy):.2f} px/tick other"
    fields = [name.partition(": ")[::2] for name, _, _ in differences(ours, theirs)]
    read = (name for name, field in fields if name not in ("ninja", "world") and field not in ("", "move_ticks"))
    other = [*dict.fromkeys(re.sub(r"object (\d+) \((.*)\)", r"\2 \1", name) for name in read)]
    text = f"not in the same state: {gap}"
    if other:
        text += f"; other: {', '.join(other[:NAMED_APART])}"
    if len(other) > NAMED_APART:
        text += f" and {len(other) - NAMED_APART} more"
    return text


WATCHABLE = {**NAMES, "status": 1, "exit_distance": 0}
"""The names in a watched formula: those of a search, an object's status, the distance to the nearest exit's disc."""


class _UnwatchedError(Exception):
    """An object that the timeline does not record yet."""

    def __init__(self, id_: int) -> None:
        super().__init__(id_)
        self.id = id_


@dataclass(frozen=True)
class Watch:
    """A watched formula. ``text``: as typed."""

    text: str
    formula: Formula

    def values(self, timeline: Timeline) -> FormulaValues:
        """Its value after each simulated tick, float64 (simulated_until,); truth is 1 or 0, no value is NaN.

        Objects that are not recorded yet are recorded from now on. Raises ArgumentError for an unknown one.
        """
        while True:
            try:
                with np.errstate(all="ignore"):
                    series = np.asarray(self.formula.value(timeline_view(timeline)), np.float64)
                return np.broadcast_to(series, (timeline.simulated_until,))
            except _UnwatchedError as error:
                valid = timeline.simulated_until
                timeline.watch([*timeline.watched, error.id])
                timeline.ensure(valid - 1)


def parse_watch(text: str) -> Watch:
    """A number or a truth to watch, in the language of goals. Raises FormulaError."""
    try:
        return Watch(text, parse_measure(text, WATCHABLE, FACTS))
    except FormatError as error:
        try:
            return Watch(text, parse_truth(text, WATCHABLE, FACTS))
        except FormatError:
            raise error from None


def exit_distance(timeline: Timeline, span: slice = slice(None)) -> FormulaValues:
    """Distance of the ninja to the disc of the nearest exit after each tick, px; 0 or less: it touches it.

    ``span``: of these ticks only.
    """
    x, y = timeline.column("x")[span], timeline.column("y")[span]
    distances = [np.hypot(x - exit_x, y - exit_y) for exit_x, exit_y in timeline.exits] or [np.full(len(x), np.inf)]
    nearest: FormulaValues = np.min(distances, axis=0) - (EXIT_RADIUS + RADIUS)
    return nearest


def timeline_view(timeline: Timeline) -> dict[str, Callable[..., NDArray[np.float64]]]:
    """The values of a formula's names after each simulated tick of a timeline."""
    column = timeline.column

    def of(name: str) -> FormulaValues:
        if name == "tick":
            return np.arange(0.0, timeline.simulated_until)
        values: FormulaValues = column(name[1]) - column(f"prev_{name[1]}") if name in {"vx", "vy"} else column(name)
        return values

    def of_object(name: str) -> Callable[..., FormulaValues]:
        return lambda number: timeline.object_column(id_of(number), name)

    return ninja_view(of) | {
        "object_x": of_object("x"),
        "object_y": of_object("y"),
        "status": of_object("s"),
        "taken": lambda number: _flag(timeline, id_of(number), "taken"),
        "opened": lambda number: _flag(timeline, id_of(number), "opened"),
        "exit_distance": lambda: exit_distance(timeline),
    }


def _flag(timeline: Timeline, id_: float, what: str) -> FormulaValues:
    """Whether an object is collected or opened: its status differs from that at the start."""
    kind, _, _, status = timeline.at_start(id_)
    if flag_field(what, kind, id_) == "switched":
        return timeline.object_column(id_, "switched")
    return np.where(timeline.object_column(id_, "s") != status, 1.0, 0.0)
