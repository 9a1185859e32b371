"""Input tracks, the runs under edit; and branches: saved tracks, in a tree by the track that each came from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ninja_game.errors import ArgumentError
from ninja_game.formats.replay.input_text import not_a_marker
from ninja_game.formats.replay.notations import Marker, is_marker_name
from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN, MAX_TICKS, check_inputs, with_press_bit
from ninja_game.sim.states import OUTCOME_NAMES
from ninja_game.tas.contributions import NONE, Contributions


@dataclass(frozen=True)
class InputTrack:
    """The inputs of a run under edit, which never change: an edit gives another track.

    ``inputs``: one byte per tick, the sum of its ``Input`` flags; in ticks beyond them no key is down. A jump triggers
    when the key goes down. Other jumps in a recording (``Input.JUMP_PRESSED`` without the key, or a key that goes down
    without it) stay in all ticks that are not edited. ``made``: the contributions to the keys since the run was opened;
    a session sets it for each track.
    """

    inputs: bytes
    markers: tuple[Marker, ...] = ()
    made: Contributions = field(default=NONE, compare=False)

    def __len__(self) -> int:
        return len(self.inputs)

    def keys_at(self, tick: int) -> int:
        """The keys that are down in a tick, a sum of left, right and jump."""
        return self.inputs[tick] & KEYS_DOWN if 0 <= tick < len(self.inputs) else 0

    def replaced(self, first: int, last: int, keys: Sequence[int]) -> InputTrack:
        """Other keys instead of the ticks ``first`` … ``last`` - 1; later ticks move if they are more or fewer.

        All edits are this one. If the run ends before ``first``, ticks without a key fill the gap. Markers of dropped
        ticks go; those behind move. Raises ArgumentError for impossible ticks.
        """
        if not 0 <= first <= last:
            raise ArgumentError(f"ticks {first} to {last} are not a span")
        if first + len(keys) + max(0, len(self.inputs) - last) > MAX_TICKS:
            raise ArgumentError(f"a run has at most {MAX_TICKS} ticks")
        before = self.inputs[:first].ljust(first, b"\0")
        held = before[-1] & JUMP_HELD if before else 0
        made = bytearray()
        for key in keys:
            made.append(with_press_bit(key, held))
            held = key & JUMP_HELD
        after = bytearray(self.inputs[last:])
        if after:
            after[0] = self._joined(last, held)
        return InputTrack(before + bytes(made) + bytes(after), self._markers_after(first, last, len(made)))

    def up_to(self, ticks: int) -> InputTrack:
        """The first ticks, with their markers and the marker of the tick after them."""
        return InputTrack(self.inputs[:ticks], tuple(marker for marker in self.markers if marker.tick <= ticks))

    def _joined(self, tick: int, held: int) -> int:
        """The tick behind an edit: it triggers as the keys say, unless it did otherwise before."""
        keys, held_before = self.inputs[tick], self.inputs[tick - 1] & JUMP_HELD if tick else 0
        return with_press_bit(keys, held) if keys == with_press_bit(keys, held_before) else keys

    def _markers_after(self, first: int, last: int, count: int) -> tuple[Marker, ...]:
        """The markers when ``count`` ticks replace the ticks ``first`` … ``last`` - 1."""
        kept = []
        for tick, name in self.markers:
            if tick >= last:
                kept.append(Marker(tick + count - (last - first), name))
            elif tick < first + count:
                kept.append(Marker(tick, name))
        return tuple(kept)

    def with_key(self, first: int, last: int, key: int, *, down: bool) -> InputTrack:
        """A key down, or up, in the ticks ``first`` … ``last`` - 1. The run grows if it ends before them."""
        if last > MAX_TICKS:
            raise ArgumentError(f"a run has at most {MAX_TICKS} ticks")
        keys = [self.keys_at(tick) | key if down else self.keys_at(tick) & ~key for tick in range(first, last)]
        return self.replaced(first, last, keys)

    def named(self, tick: int, name: str) -> InputTrack:
        """This track with a tick named or commented ('': unnamed). It grows if it ends before the tick.

        Raises ReplayError for a name that replay texts cannot hold, ArgumentError for an impossible tick.
        """
        name = marker_name(name)
        if name and not is_marker_name(name):
            raise not_a_marker(name)
        if not 0 <= tick <= MAX_TICKS:
            raise ArgumentError(f"a run has at most {MAX_TICKS} ticks")
        others = [marker for marker in self.markers if marker.tick != tick and marker.name != name]
        if not name:
            return InputTrack(self.inputs, tuple(others))
        return InputTrack(self.inputs.ljust(tick, b"\0"), tuple(sorted([*others, Marker(tick, name)])))

    def first_difference(self, other: InputTrack) -> int:
        """The first tick whose input differs; the length of the shorter one if none does."""
        return first_different_index(self.inputs, other.inputs)


def marker_name(text: str) -> str:
    """A text as the name of a tick, without quotes, since replay texts write names in quotes."""
    return text.strip().replace('"', "'")


def first_different_index(ours: bytes, theirs: bytes) -> int:
    """The first index at which bytes differ; the length of the shorter ones if none does."""
    shared = min(len(ours), len(theirs))
    unequal = np.frombuffer(ours, np.uint8, shared) != np.frombuffer(theirs, np.uint8, shared)
    return int(np.argmax(unequal)) if unequal.any() else shared


@dataclass(frozen=True)
class Branch:
    """A kept input track. ``parent``: the number of the branch that it was made from; None for the first ones.

    ``end``: the tick of the exit contact or death (-1: none), ``outcome`` which of them, ``gold`` the pieces then.
    """

    name: str
    track: InputTrack
    parent: int | None = None
    end: int = -1
    outcome: str = "running"
    gold: int = 0

    def is_as_good_as(self, other: Branch) -> bool:
        """Whether it reaches the exit no later than another one, with no less gold."""
        return self.outcome == "exit" and self.end <= other.end and self.gold >= other.gold


class Branches:
    """The branches of a run, in the order of their making. ``current``: the one that the track comes from.

    ``watched``: the watched formulas of the run, saved with them; empty: the default ones.
    """

    def __init__(self) -> None:
        self.all: list[Branch] = []
        self.current: int | None = None
        self.watched: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.all)

    def keep(self, branch: Branch) -> int:
        """Keep an input track as a child of the current branch, and continue from it; its number."""
        self.all.append(replace(branch, parent=self.current))
        self.current = len(self.all) - 1
        return self.current

    def rename(self, number: int, name: str) -> None:
        """Give a branch another name. Raises ArgumentError for an unknown one."""
        self.all[self.checked(number)] = replace(self.all[number], name=name)

    def checkout(self, number: int) -> InputTrack:
        """Make a branch the current one; its input track. Raises ArgumentError for an unknown one."""
        self.current = self.checked(number)
        return self.all[number].track

    def drop(self, number: int) -> None:
        """Delete a branch; its children move to its parent. Raises ArgumentError for an unknown one."""
        parent = self.all[self.checked(number)].parent

        def moved(other: int | None) -> int | None:
            other = parent if other == number else other
            return other if other is None or other < number else other - 1

        self.current = moved(self.current)
        self.all = [replace(branch, parent=moved(branch.parent)) for at, branch in enumerate(self.all) if at != number]

    def checked(self, number: int) -> int:
        """The number of a branch. Raises ArgumentError for an unknown one."""
        if not 0 <= number < len(self.all):
            raise ArgumentError(f"there is no branch {number}")
        return number

    def in_tree(self) -> Iterator[tuple[int, int]]:
        """The branches in tree order, children under their parent: number and depth."""
        children: dict[int | None, list[int]] = {}
        for number, branch in enumerate(self.all):
            children.setdefault(branch.parent, []).append(number)
        waiting = [(number, 0) for number in reversed(children.get(None, []))]
        while waiting:
            number, depth = waiting.pop()
            yield number, depth
            waiting += [(child, depth + 1) for child in reversed(children.get(number, []))]

    def as_json(self) -> dict[str, Any]:
        data = {"branches": [branch_as_json(branch) for branch in self.all], "current": self.current}
        return {**data, "watched": list(self.watched)}

    def do(self, change: dict[str, Any]) -> None:
        """Do a change given in a journal's words: one of those below, or all branches. Raises DAMAGED."""
        if "branches" in change:
            whole = branches_of_json(change)
            self.all, self.current, self.watched = whole.all, whole.current, whole.watched
        elif "keep" in change:
            self.keep(branch_of_json(change["keep"]))
        elif "watch" in change:
            self.watched = tuple(map(str, change["watch"]))
        elif "rename" in change:
            self.rename(int(change["rename"]), str(change["name"]))
        elif "checkout" in change:
            self.checkout(int(change["checkout"]))
        else:
            self.drop(int(change["drop"]))


def branches_of_json(kept: dict[str, Any]) -> Branches:
    """The inverse of ``as_json``. Raises one of DAMAGED for anything else."""
    branches = Branches()
    for number, entry in enumerate(kept["branches"]):
        branch = branch_of_json(entry)
        if branch.parent is not None and not 0 <= branch.parent < number:
            raise ValueError("a branch whose parent comes later")
        branches.all.append(branch)
    if kept["current"] is not None:
        branches.checkout(int(kept["current"]))
    branches.watched = tuple(map(str, kept.get("watched", ())))
    return branches


def branch_as_json(branch: Branch) -> dict[str, Any]:
    return {
        "name": branch.name, "parent": branch.parent, "end": branch.end, "outcome": branch.outcome,
        "gold": branch.gold, **track_as_json(branch.track),
    }  # fmt: skip


def branch_of_json(kept: dict[str, Any]) -> Branch:
    """The inverse of ``branch_as_json``. Raises one of DAMAGED for anything else."""
    parent = kept["parent"]
    outcome = str(kept["outcome"])
    if outcome not in OUTCOME_NAMES:
        raise ValueError(f"the outcome {outcome[:40]!r}")
    parent = None if parent is None else int(parent)
    return Branch(str(kept["name"]), track_of_json(kept), parent, int(kept["end"]), outcome, int(kept["gold"]))


def track_as_json(track: InputTrack) -> dict[str, Any]:
    """An input track as JSON: its inputs a hexadecimal digit per tick."""
    data = {"inputs": track.inputs.hex()[1::2], "markers": [list(marker) for marker in track.markers]}
    return data | {"made": track.made.as_json()}


def track_of_json(kept: dict[str, Any]) -> InputTrack:
    """The inverse of ``track_as_json``. Raises one of DAMAGED for anything else."""
    made = Contributions.of_json(kept["made"]) if "made" in kept else NONE
    return replace(checked_track(inputs_of_json(kept["inputs"]), markers_of_json(kept["markers"])), made=made)


def inputs_of_json(digits: str) -> bytes:
    """Inputs, a hexadecimal digit a tick. Raises one of DAMAGED for anything else."""
    return bytes.fromhex("0" + "0".join(digits)) if digits else b""


def markers_of_json(kept: list[Any]) -> tuple[Marker, ...]:
    """Names of ticks. Raises one of DAMAGED for anything else."""
    return tuple(Marker(int(tick), str(name)) for tick, name in kept)


def checked_track(inputs: bytes, markers: tuple[Marker, ...]) -> InputTrack:
    """An input track that a replay text can hold. Raises ValueError or DemoError for another."""
    check_inputs(inputs)
    names = {name for tick, name in markers if 0 <= tick <= len(inputs) and is_marker_name(name)}
    if len(names) < len(markers):
        raise ValueError("markers at impossible ticks")
    return InputTrack(inputs, markers)
