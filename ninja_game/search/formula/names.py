"""The meaning of the names in a formula: the ninja, the run and single objects, in all worlds of a batch."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.backend.memories import open_worlds
from ninja_game.batch.batch import Batch
from ninja_game.errors import ArgumentError
from ninja_game.search.formula.language import FAR, FormulaValues
from ninja_game.search.heuristics import FARTHEST, DistanceField, Heuristics, open_masks, points_at
from ninja_game.sim.kinds import DOOR, EXIT, GOLD, KIND_NAMES, KIND_OF, LAUNCHER, MINE, TURRET
from ninja_game.sim.level import Level
from ninja_game.sim.states import LAUNCHER_FLIGHT, OUTCOME_DEAD, OUTCOME_EXIT

NAMES = {
    "x": 0, "y": 0, "vx": 0, "vy": 0, "speed": 0, "tick": 0, "gold": 0, "state": 0, "jump_timer": 0,
    "dead": 0, "won": 0, "in_air": 0, "near_wall": 0,
    "distance": 2, "object_x": 1, "object_y": 1, "taken": 1, "opened": 1,
}  # fmt: skip
"""The names, and the number of their arguments in brackets; docs/speedruns.md explains them."""

SPAN_NAMES = {**NAMES, "difference": 1}  # the names in a span search, which can compare with the run
FACTS = ("dead", "won", "in_air", "near_wall", "taken", "opened")  # the names that are true or false


def ninja_view(of: Callable[[str], FormulaValues]) -> dict[str, Callable[..., FormulaValues]]:
    """Functions for the names of the ninja and the run. ``of``: gives fields and "outcome", as float64."""
    plain = ("x", "y", "vx", "vy", "tick", "gold", "state", "jump_timer", "in_air", "near_wall")
    return {
        **{name: partial(of, name) for name in plain},
        "speed": lambda: np.hypot(of("vx"), of("vy")),
        "dead": lambda: (of("outcome") == OUTCOME_DEAD).astype(float),
        "won": lambda: (of("outcome") == OUTCOME_EXIT).astype(float),
        "distance": lambda x, y: np.hypot(of("x") - x, of("y") - y),
    }


def view_of(batch: Batch) -> dict[str, Callable[..., NDArray[np.float64]]]:
    """Functions for all names; they read the worlds at the time of the call.

    They raise ArgumentError for an unknown object.
    """
    ninja = batch.records["ninja"]
    place, before = batch.positions, batch.previous

    def of(name: str) -> FormulaValues:
        value: FormulaValues = values[name]().astype(float, copy=False)
        return value

    def flag(what: str) -> Callable[..., Any]:
        def value(number: Any) -> Any:
            record = _object(batch, number)
            return (record[flag_field(what, int(record["kind"][0]), float(number))] != 0).astype(float)

        return value

    values: dict[str, Callable[[], Any]] = {
        "x": lambda: place[:, 0], "y": lambda: place[:, 1],
        "vx": lambda: place[:, 0] - before[:, 0], "vy": lambda: place[:, 1] - before[:, 1],
        "tick": lambda: batch.ticks - 1, "gold": lambda: batch.gold, "state": lambda: batch.states,
        "outcome": lambda: batch.outcomes, "jump_timer": lambda: ninja["jump_timer"],
        "in_air": lambda: ninja["in_air"], "near_wall": lambda: ninja["near_wall"],
    }  # fmt: skip
    return ninja_view(of) | {
        "object_x": lambda number: _place(batch, number, "x"),
        "object_y": lambda number: _place(batch, number, "y"),
        "taken": flag("taken"),
        "opened": flag("opened"),
    }


def distance_views(level: Level, batch: Batch) -> dict[str, Callable[..., Any]]:
    """Margins of facts that are still false: the distance to what makes them true, by the solver's fields."""
    distances = Distances(level, batch)

    def far(number: Any) -> Any:
        return distances.to_object(_object(batch, number))

    return {"won" + FAR: distances.to_exit, "taken" + FAR: far, "opened" + FAR: far}


def difference_from(level: Level, inputs: bytes, batch: Batch) -> Callable[[Any], NDArray[np.float64]]:
    """Make a function of a tick that gives the distance between worlds and the state of a run of that level after it.

    0: ``state_digest`` is the same; otherwise 1 plus the differences of the ninjas' places (px) and velocities
    (px/tick). It raises ArgumentError for a tick outside the run.
    """

    @cache
    def moment(tick: float) -> tuple[Batch, str]:
        if tick != int(tick) or not 0 <= tick < len(inputs):
            raise ArgumentError(f"difference({tick:g}): the run has ticks 0 to {len(inputs) - 1}")
        single = Batch(level, 1, body=batch.body, memory=batch.memory)
        single.run(np.frombuffer(inputs[: int(tick) + 1], np.uint8)[:, np.newaxis], stop=True)
        return single, single.state_digests()[0]

    def difference(number: Any) -> NDArray[np.float64]:
        single, digest = moment(plain_number(number, "the tick in 'difference'"))
        velocity = batch.velocities() - single.velocities()
        away: NDArray[np.float64] = 1.0 + np.hypot(*(batch.positions - single.positions).T) + np.hypot(*velocity.T)
        near = np.flatnonzero(away == 1.0)
        near = near[(batch.places[near] == single.places).all((1, 2))]
        away[near] = [found_digest != digest for found_digest in batch.state_digests(near)]
        return away

    return difference


def id_of(number: Any) -> float:
    """The id in the brackets of a formula. Raises ArgumentError if it differs between worlds."""
    return plain_number(number, "the id of an object")


def plain_number(number: Any, what: str) -> float:
    """A number in the brackets of a formula. Raises ArgumentError if it differs between worlds."""
    if np.ndim(number):
        raise ArgumentError(f"{what} is a plain number, such as 3")
    return float(number)


def no_object(id_: float) -> ArgumentError:
    return ArgumentError(f"there is no object {id_:g}; ids are those that `ninja-game splits` shows")


def _object(batch: Batch, number: Any) -> Any:
    id_ = id_of(number)
    if not 0 <= id_ < int(batch.records["id_count"][0]) or id_ != int(id_):
        raise no_object(id_)
    return batch.objects[:, int(id_) + 1]


def _place(batch: Batch, number: Any, axis: str) -> Any:
    """The place of an object in all worlds, px, as traces show it (``place_of``)."""
    record = _object(batch, number)
    kind = int(record["kind"][0])
    if kind == TURRET:
        return record[f"aim_{axis}"]
    if kind == LAUNCHER:
        return np.where(record["routine"] == LAUNCHER_FLIGHT, record[axis], record[f"base_{axis}"])
    return record[axis]


FLAGS = {
    "taken": {kind: KIND_OF[kind].used for kind in (GOLD, MINE)},
    "opened": {kind: KIND_OF[kind].used for kind in (EXIT, DOOR)},
}
"""The field that holds a fact, by kind of object."""


def flag_field(what: str, kind: int, id_: float) -> str:
    """The field of an object that the name ``what`` reads. Raises ArgumentError if its kind has none."""
    if kind not in FLAGS[what]:
        kinds = " and ".join(KIND_NAMES[known] for known in FLAGS[what])
        raise ArgumentError(f"object {id_:g} is of kind {KIND_NAMES[kind]}; '{what}' is for {kinds}")
    return FLAGS[what][kind]


_SPEED = 4.0
"""px per tick of a field: it makes margins comparable to distances in formulas (6 px to the next point: 1.5 ticks)."""
UNREACHABLE = -1.0 - _SPEED * FARTHEST  # the margin if no way leads to what makes a fact true
Target = Callable[[int, float, float], DistanceField]  # the field of a target in a switch state, for a ninja at (x, y)


class Distances:
    """Distances of worlds from a fact that is still false, such as ``won``, by the distance fields of the solver.

    A level's fields, by target and switch state, are made when a world of the batch first needs them.
    """

    def __init__(self, level: Level, batch: Batch) -> None:
        self._level, self._batch = level, batch
        self._fields: dict[tuple[object, int], DistanceField] = {}

    @cached_property
    def _heuristics(self) -> Heuristics:
        alone = open_worlds(self._batch.memory, self._level, box=False)
        return Heuristics(alone.maps, alone.records)

    def to_exit(self) -> FormulaValues:
        """Minus the distance to the exit, by way of its switch, in px roughly."""
        return self._margins("exit", self._heuristics.field)

    def to_object(self, record: Any) -> FormulaValues:
        """Minus the distance to an object, or to the switch of an exit, in px roughly."""
        target = self._batch.objects[:, int(record["partner"][0])] if int(record["kind"][0]) == EXIT else record
        place = float(target["x"][0]), float(target["y"][0])
        return self._margins(place, lambda state, x, y: self._heuristics.field_to(place, state, x, y))

    def _margins(self, key: object, target: Target) -> FormulaValues:
        batch = self._batch
        places, states = batch.positions, open_masks(batch.objects, self._heuristics.slots)
        points = points_at(places)
        margins = np.empty(batch.count)
        for state in np.unique(states).tolist():
            here = states == state
            if (key, state) not in self._fields:
                x, y = places[np.argmax(here)].tolist()
                self._fields[key, state] = np.minimum(target(state, x, y), np.float32(FARTHEST))
            margins[here] = -1.0 - _SPEED * self._fields[key, state][points[here]]
        return margins
