"""The runs of a board, counted and rejected ones, with the reason of the rejection."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from ninja_game.board.collect import RunFolder
from ninja_game.board.players import folded
from ninja_game.formats.replay.provenance import names_of_text, parse_provenance
from ninja_game.formats.replay.text import Replay
from ninja_game.levels.episodes import Entry
from ninja_game.runs.run import run_level

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

RunKey = tuple[str, int]  # a run's file, as a path in the folder, and its record there

Dates = Callable[[RunKey, str], str]
"""Gives the moment at which the board first had a run, by its key and way: UTC, 2026-01-31T12:00:00Z; "" if unknown."""

RunRows = dict[tuple[str, Any], dict[str, Any]]

PLAYED = "played"
ASSISTED = "assisted"
"""The two ladders; a run of unknown making is on the first one, unless the board's rules say otherwise."""

REJECTED = "rejected"
DISOWNED = "disowned"
DECISIONS = (REJECTED, DISOWNED, PLAYED, ASSISTED)
"""The decisions of a board's keeper on a run: it does not count, it is not by its player, its ladder."""

REJECTED_KINDS = {
    "moderated": ("by the keeper", "Rejected by the keeper", "Rejected by the keeper"),
    "practice": ("of practice", "Practice runs", "Practice run"),
    "copy": ("copied", "Copies of runs", "Copy"),
    "refused": ("refused", "Runs that do not count", "Does not count"),
    "unreadable": ("unreadable", "Files that are not runs", "Not a run"),
}
"""Reasons why a run does not count: in a line of a report, and on a page, of several and of one."""

UNKNOWN_PLAYER = "unknown ("  # begins the name of a player that no run names; the file follows
OWN = "own"  # kind of a level of an episode whose run the same player has sent before


@dataclass(frozen=True, kw_only=True)
class Judged:
    """The result of a recording, as plain values that can be cached; undescribed fields are those of Verdict."""

    record: int
    kind: str  #: "" for a run that counts, else one of REJECTED_KINDS
    why: str = ""  #: the reason if it does not count
    author: str = ""
    level: str = ""  #: digest of its level
    tick: int = -1  #: tick of the exit contact
    gold: int = 0
    score: int = 0  #: ticks
    way: str = ""  #: digest of the ninja's positions; also of a run that counts once the keeper calls it assisted
    presses: int = 0  #: presses of all keys
    jumps: int = 0  #: presses of the jump key
    made: str = ""
    assisted: bool | None = None
    co_authors: str = ""
    episode: str = ""
    mark: str = ""  #: a remark about keys that no keyboard can press, "" without such keys


class Decision(NamedTuple):
    """The keeper's decision on a run."""

    level: str  #: digest
    way: str
    file: str
    player: str
    what: str  #: one of DECISIONS
    reason: str
    added: str  #: the date of the decision

    @property
    def key(self) -> tuple[str, str, str]:
        """The run of the decision: its level, way and folded player."""
        return self.level, self.way, folded(self.player)


class Ledger(NamedTuple):
    """The memory of a board: the facts of its last ranking, and the keeper's decisions."""

    runs: RunRows  #: runs that counted, by file and record
    rejected: RunRows  #: runs that did not count, by file and record
    withdrawn: RunRows  #: runs that counted once and are gone now, or do not count any more, by level and way
    decisions: dict[tuple[str, str, str], Decision]  #: decisions by their ``key``

    def decision(self, run: Run) -> Decision | None:
        """The keeper's decision on a run, if there is one."""
        return self.decisions.get((run.level, run.way, folded(run.player)))

    @property
    def owners(self) -> RunRows:
        """The first run of every way through a level, by level and way; ``near`` and ``confirmed`` as in a Run.

        Runs that the keeper has disowned are left out: their real player may still send them.
        """
        rows = self.withdrawn | {(row["level"], row["way"]): row for row in self.runs.values()}
        disowned = {decision.key for decision in self.decisions.values() if decision.what == DISOWNED}
        return {way: row for way, row in rows.items() if (*way, folded(row["player"])) not in disowned}


NO_LEDGER = Ledger({}, {}, {}, {})


@dataclass(frozen=True, kw_only=True)
class Run(Judged):
    """A run that counts, with the simulation's results."""

    file: str  #: path in the folder
    player: str
    entry: Entry = field(repr=False)
    added: str  #: the moment when the board first had it: UTC, or ""
    digest: str = field(repr=False)  #: digest of its file
    folder: RunFolder = field(repr=False, compare=False)
    marks: tuple[str, ...] = ()  #: remarks for readers
    near: str = ""  #: the run that it nearly copies, a sentence
    near_to: RunKey | None = None  #: key of that run, if the runs were compared now
    untrusted: str = ""  #: a sentence, if its player's other runs are from another folder
    confirmed: bool = False  #: whether the keeper confirmed it: not a copy, and by its player
    again: bool = False  #: it was withdrawn, and is the first of its moment
    taken: str = ""  #: the moment when this board first had it, if ``added`` is the date of an older board
    derived: bool = False  #: near to a run of one of its ``origins``

    @cached_property
    def key(self) -> RunKey:
        return self.file, self.record

    @property
    def waits(self) -> str:
        """Why it leads no table until the keeper confirms it; "" for a run that does not wait."""
        return "; ".join(filter(None, (self.near, self.untrusted)))

    @property
    def sender(self) -> str:
        """The folder that it was sent in; "" if it lies in none."""
        return self.file.rpartition("/")[0].partition("/")[0]

    @property
    def remark(self) -> str:
        """Its marks as a text."""
        return "; ".join(self.marks)

    def marked(self, mark: str) -> Run:
        """The run with one more mark, before its others; itself for ""."""
        return replace(self, marks=(mark, *self.marks)) if mark else self

    @property
    def now_confirmed(self) -> Run:
        """The run as the keeper confirms it; the remark on a near copy says so."""
        return replace(self.marked("confirmed by the keeper" if self.near else ""), near="", confirmed=True)

    @property
    def order(self) -> tuple[str, bool, bool, RunKey]:
        """The run's place in time: the earliest run owns its inputs. Levels of episodes come after single runs."""
        return self.added, not self.again, bool(self.episode), self.key

    @property
    def day(self) -> str:
        """The date of ``added``."""
        return self.added.partition("T")[0]

    @property
    def moment(self) -> str:
        """The date of ``added`` with the time of day, if that is known."""
        time = self.added[11:16]
        return self.day if time in ("", "00:00") else f"{self.day} {time} UTC"

    @property
    def moved_in(self) -> str:
        """The moment at which this board first had the run."""
        return self.taken or self.added

    @property
    def ladder(self) -> str:
        """The ladder that ranks it."""
        return ASSISTED if self.assisted else PLAYED

    @property
    def origins(self) -> set[str]:
        """The players, folded, whose runs an assisted one is made of, as it says; none for any other run."""
        names = (parse_provenance(self.made).begun_by, *names_of_text(self.co_authors)) if self.assisted else ()
        return {folded(name) for name in names if name}

    @cached_property
    def medal(self) -> str:
        """Its medal, "" for none."""
        return self.entry.pars.medal(self.tick) if self.entry.pars else ""

    @property
    def inputs(self) -> bytes:
        """Its inputs, read again. Raises FileError if the file has changed since."""
        return self.folder.inputs(self.file, self.record, self.digest, self.tick + 1)

    @property
    def positions(self) -> NDArray[np.float64]:
        """The ninja after each tick: float64 (ticks, 2), px."""
        return run_level(self.entry.named.level, self.inputs).positions

    def rejected(self, kind: str, why: str, first: RunKey | None = None) -> RejectedRun:
        """The run as one that does not count."""
        return RejectedRun(*self.key, kind, why, self.player, self.entry.title, self.way, self.added, first)

    def decided_by(self, decision: Decision | None) -> Run | RejectedRun:
        """The run after a decision on it, if there is one."""
        if decision is None:
            return self
        reason = f": {decision.reason}" if decision.reason else ""
        source = f"by the keeper on {decision.added[:10]}{reason}"
        if decision.what == DISOWNED:
            return replace(self, player="").rejected("moderated", f"not by {self.player}: rejected {source}")
        if decision.what == REJECTED:
            return self.rejected("moderated", f"rejected {source}")
        marks = *self.marks, f"moved to {decision.what} {source}"
        return replace(self, kind="", assisted=decision.what == ASSISTED, marks=marks)

    @property
    def replay(self) -> Replay:
        """Its ``inputs``, with the results of the simulation."""
        named = self.entry.named
        return Replay(
            self.inputs, self.tick, "exit", self.gold, name=self.entry.title, author=self.player,
            level_name=self.entry.title, level_author=named.author, level=named.level, made=parse_provenance(self.made),
            co_authors=names_of_text(self.co_authors),
        )  # fmt: skip


@dataclass(frozen=True)
class RejectedRun:
    """A run, or a file, that does not count."""

    file: str
    record: int
    kind: str  #: one of REJECTED_KINDS, or OWN
    why: str
    player: str = ""
    level: str = ""  #: title of its level
    way: str = ""  #: as ``Run.way``, if it was simulated to its end
    added: str = ""  #: as ``Run.added``, if it was simulated to its end
    first: RunKey | None = None  #: the run that it copies


@dataclass(frozen=True)
class ValidatedRuns:
    """All runs of a folder."""

    runs: tuple[Run, ...]  #: runs that count, in the order in which they were added
    rejected: tuple[RejectedRun, ...]  #: runs that do not count, by file
    again: tuple[RejectedRun, ...] = ()  #: of kind OWN: episode levels with an earlier run by the player
    alike: Mapping[str, str] = field(default_factory=dict)  #: the earlier player with a similar name, by player
    #: Runs of whole episodes, by the episode's key; a run for each of its levels
    episodes: Mapping[str, list[list[Run]]] = field(default_factory=dict)
