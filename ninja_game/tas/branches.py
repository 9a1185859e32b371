"""Branches: takes of one run that its maker keeps, as a tree of what was made from what."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from ninja_game.formats.replay.input_runs import Marker
from ninja_game.sim.inputs import check_inputs
from ninja_game.tas.take import Take


@dataclass(frozen=True)
class Branch:
    """A take that is kept. ``parent``: the branch from which it was made, by number; None for the first ones.

    ``end``: the tick of the exit contact or death (-1: none), ``outcome`` which of them, ``gold`` the pieces then.
    """

    name: str
    take: Take
    parent: int | None = None
    end: int = -1
    outcome: str = "running"
    gold: int = 0


class Branches:
    """The branches of a run, in the order in which they were kept. ``current``: the one from which the take comes."""

    def __init__(self) -> None:
        self.all: list[Branch] = []
        self.current: int | None = None

    def __len__(self) -> int:
        return len(self.all)

    def keep(self, branch: Branch) -> int:
        """Keep a take as a child of the current branch, and go on from it; its number."""
        self.all.append(replace(branch, parent=self.current))
        self.current = len(self.all) - 1
        return self.current

    def rename(self, number: int, name: str) -> None:
        """Give a branch another name."""
        self.all[number] = replace(self.all[number], name=name)

    def drop(self, number: int) -> None:
        """Forget a branch; what was made from it hangs on its parent."""
        parent = self.all[number].parent

        def moved(other: int | None) -> int | None:
            other = parent if other == number else other
            return other if other is None or other < number else other - 1

        self.current = moved(self.current)
        self.all = [replace(each, parent=moved(each.parent)) for at, each in enumerate(self.all) if at != number]

    def in_tree(self) -> Iterator[tuple[int, int]]:
        """The branches as a tree is read, children under their parent: number and depth."""

        def under(parent: int | None, depth: int) -> Iterator[tuple[int, int]]:
            for number, branch in enumerate(self.all):
                if branch.parent == parent:
                    yield number, depth
                    yield from under(number, depth + 1)

        return under(None, 0)

    def as_json(self) -> dict[str, Any]:
        """All of it as JSON can say it."""
        return {"branches": [branch_as_json(branch) for branch in self.all], "current": self.current}


def branches_of_json(kept: dict[str, Any]) -> Branches:
    """What ``as_json`` gave. Raises ValueError, KeyError, TypeError or DemoError for anything else."""
    found = Branches()
    for number, each in enumerate(kept["branches"]):
        branch = branch_of_json(each)
        if branch.parent is not None and not 0 <= branch.parent < number:
            raise ValueError("a branch that hangs on a later one")
        found.all.append(branch)
    current = kept["current"]
    if current is not None and not 0 <= int(current) < len(found.all):
        raise ValueError("no such branch")
    found.current = current
    return found


def branch_as_json(branch: Branch) -> dict[str, Any]:
    """A branch as JSON can say it."""
    return {
        "name": branch.name, "parent": branch.parent, "end": branch.end, "outcome": branch.outcome,
        "gold": branch.gold, **take_as_json(branch.take),
    }  # fmt: skip


def branch_of_json(kept: dict[str, Any]) -> Branch:
    """What ``branch_as_json`` gave. Raises ValueError, KeyError, TypeError or DemoError for anything else."""
    parent = kept["parent"]
    end, gold = int(kept["end"]), int(kept["gold"])
    return Branch(
        str(kept["name"]), take_of_json(kept), None if parent is None else int(parent), end, str(kept["outcome"]), gold
    )


def take_as_json(take: Take) -> dict[str, Any]:
    """A take as JSON can say it: its inputs a hexadecimal digit a tick."""
    return {"inputs": "".join(f"{keys:x}" for keys in take.inputs), "markers": [list(each) for each in take.markers]}


def take_of_json(kept: dict[str, Any]) -> Take:
    """What ``take_as_json`` gave. Raises ValueError, KeyError, TypeError or DemoError for anything else."""
    inputs = bytes(int(digit, 16) for digit in kept["inputs"])
    check_inputs(inputs)
    return Take(inputs, tuple(Marker(int(tick), str(name)) for tick, name in kept["markers"]))
