"""How far a run is ahead of another one: a table of its splits, its markers and its seconds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.input_runs import Marker
from ninja_game.runs.compare import Comparison, compare_runs, each_second, split_name
from ninja_game.sim.rules import TICKS_PER_SECOND


class LeadRow(NamedTuple):
    """A place that both runs reach, and their ticks there. ``counts``: it is more than a second of the first run."""

    tick: int
    other: int
    name: str
    counts: bool

    @property
    def ahead(self) -> int:
        """Ticks by which the first run is there earlier; negative where it is later."""
        return self.other - self.tick


@dataclass(frozen=True)
class LeadTable:
    """The rows by ticks of the first run, and what the runs have in common.

    ``apart``: full seconds of the first run without a row, where the other one does not come near.
    """

    rows: tuple[LeadRow, ...]
    comparison: Comparison
    apart: int


def lead_table(ours: Recording, theirs: Recording, markers: Sequence[Marker]) -> LeadTable:
    """Compare a run, with its markers, to another one. Raises what ``compare_runs`` does."""
    found = compare_runs(ours, theirs)
    rows = [LeadRow(lead.tick, lead.other, split_name(lead.at), True) for lead in found.splits]
    there = {lead.tick: lead.other for lead in found.places}
    rows += [LeadRow(tick, there[tick], name, True) for tick, name in markers if tick in there]
    rows += [
        LeadRow(lead.tick, lead.other, f"{lead.tick // TICKS_PER_SECOND} s", False)
        for lead in each_second(found.places)
    ]
    seconds = (len(found.positions[0]) - 1) // TICKS_PER_SECOND
    apart = seconds - len(each_second(found.places))
    return LeadTable(tuple(sorted(rows, key=lambda row: row.tick)), found, apart)
