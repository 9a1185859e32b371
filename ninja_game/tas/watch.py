"""Values of a run that its maker watches, tick by tick: formulas over a timeline."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import ArgumentError, FormatError
from ninja_game.search.formula.language import Formula, Values, parse_number, parse_truth
from ninja_game.search.formula.names import FACTS, FLAGS, NAMES, id_of
from ninja_game.sim.kinds import DOOR, KIND_NAMES
from ninja_game.sim.rules import EXIT_RADIUS, RADIUS
from ninja_game.sim.states import OUTCOME_DEAD, OUTCOME_EXIT
from ninja_game.tas.timeline import Timeline

WATCHABLE = {**NAMES, "status": 1, "exit_distance": 0}
"""The names in a watched formula: those of a search, an object's status, how far it is to the nearest exit's disc."""


class _UnwatchedError(Exception):
    """An object that the timeline does not record yet."""

    def __init__(self, id_: int) -> None:
        super().__init__(id_)
        self.id = id_


@dataclass(frozen=True)
class Watch:
    """A watched formula. ``text``: as its maker wrote it."""

    text: str
    formula: Formula

    def values(self, timeline: Timeline) -> Values:
        """Its value after each simulated tick, float64 (simulated_until,); a truth is 1 or 0, what has no value is NaN.

        Objects that are not recorded yet are recorded from now on. Raises ArgumentError for an unknown one.
        """
        while True:
            try:
                with np.errstate(all="ignore"):
                    found = np.asarray(self.formula.value(timeline_view(timeline)), np.float64)
                return np.broadcast_to(found, (timeline.simulated_until,))
            except _UnwatchedError as error:
                valid = timeline.simulated_until
                timeline.watch([*timeline.watched, error.id])
                timeline.ensure(valid - 1)


def parse_watch(text: str) -> Watch:
    """A number or a truth to be watched, in the language of goals. Raises FormulaError."""
    try:
        return Watch(text, parse_number(text, WATCHABLE, FACTS))
    except FormatError as error:
        try:
            return Watch(text, parse_truth(text, WATCHABLE, FACTS))
        except FormatError:
            raise error from None


def exit_distance(timeline: Timeline, span: slice = slice(None)) -> Values:
    """How far the ninja is from the disc of the nearest exit after each tick, px; 0 or less: it touches it.

    ``span``: of these ticks only.
    """
    x, y = timeline.column("x")[span], timeline.column("y")[span]
    far = [np.hypot(x - exit_x, y - exit_y) for exit_x, exit_y in timeline.exits] or [np.full(len(x), np.inf)]
    nearest: Values = np.min(far, axis=0) - (EXIT_RADIUS + RADIUS)
    return nearest


def timeline_view(timeline: Timeline) -> dict[str, Callable[..., NDArray[np.float64]]]:
    """What the names of a formula mean after each simulated tick of a timeline."""
    column = timeline.column

    def velocity(axis: str) -> Values:
        moved: Values = column(axis) - column(f"prev_{axis}")
        return moved

    def of_object(name: str) -> Callable[..., Values]:
        return lambda number: _object_column(timeline, id_of(number), name)

    return {
        "x": lambda: column("x"), "y": lambda: column("y"), "vx": lambda: velocity("x"), "vy": lambda: velocity("y"),
        "speed": lambda: np.hypot(velocity("x"), velocity("y")),
        "tick": lambda: np.arange(0.0, timeline.simulated_until), "gold": lambda: column("gold"),
        "state": lambda: column("state"), "jump_timer": lambda: column("jump_timer"),
        "dead": lambda: column("outcome") == OUTCOME_DEAD, "won": lambda: column("outcome") == OUTCOME_EXIT,
        "in_air": lambda: column("in_air"), "near_wall": lambda: column("near_wall"),
        "distance": lambda x, y: np.hypot(column("x") - x, column("y") - y),
        "object_x": of_object("x"), "object_y": of_object("y"), "status": of_object("s"),
        "taken": lambda number: _flag(timeline, id_of(number), "taken"),
        "opened": lambda number: _flag(timeline, id_of(number), "opened"),
        "exit_distance": lambda: exit_distance(timeline),
    }  # fmt: skip


def _object_column(timeline: Timeline, id_: float, name: str) -> Values:
    timeline.at_start(id_)
    if id_ not in timeline.watched:
        raise _UnwatchedError(int(id_))
    return timeline.object_column(int(id_), name).astype(np.float64)


def _flag(timeline: Timeline, id_: float, what: str) -> Values:
    """Whether an object is taken, or opened: its status is not the one that it has at the start."""
    kind, _, _, status = timeline.at_start(id_)
    if kind not in FLAGS[what]:
        kinds = " and ".join(KIND_NAMES[each] for each in FLAGS[what])
        raise ArgumentError(f"object {id_:g} is of kind {KIND_NAMES[kind]}; '{what}' is for {kinds}")
    if kind == DOOR:
        return _object_column(timeline, id_, "switched")
    return np.where(_object_column(timeline, id_, "s") != status, 1.0, 0.0)
