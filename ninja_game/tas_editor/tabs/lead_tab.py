"""The lead of the run over another one: a branch, its earlier state, or another opened run."""

from __future__ import annotations

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import counted
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.notations import Marker
from ninja_game.runs.compare import NEAR_DISTANCE, LeadTable, lead_table
from ninja_game.runtime import NewestJob
from ninja_game.tas.tracks import InputTrack
from ninja_game.tas_editor.editor import TasEditor
from ninja_game.tas_editor.tabs.tab import SMALL, UNPLACED, Rows, Tab
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Choice

PAUSE_MS = 300  # ms without an edit before a run is compared

_COLUMNS = (256, 200, 144, 58)  # places of ticks, lead and its change, px from the right of a row
_HEADS = ("Tick here", "Tick there", "Ahead + or behind -", "Since above")

Pair = tuple[InputTrack, InputTrack]
_Job = tuple[Pair, Recording, Recording, tuple[Marker, ...]]


def compared_pair(job: _Job) -> tuple[Pair, LeadTable | str]:
    """The table, or a sentence why there is none."""
    pair, ours, theirs, markers = job
    try:
        return pair, lead_table(ours, theirs, markers)
    except NinjaGameError as error:
        return pair, str(error)


class LeadTab(Tab):
    """A table of the run's lead over another run, in ticks; compared in the background after each edit."""

    name = "Lead"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self._opened = editor.track
        self._requested: Pair | None = None
        self._unchanged_ms = 0
        self.job: NewestJob[_Job, tuple[Pair, LeadTable | str]] = NewestJob(compared_pair)
        self.choice = Choice(
            UNPLACED, "", self._options(), self._theirs, self._put, hint="The run that this one is compared to"
        )
        self.list = Rows(self._draw_row, self._go, keeps=False, hint="A click puts the cursor there")
        self.widgets = [self.choice, self.list]

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        self.choice.area = x + 56, y + 4, w - 60, 18
        self.list.area = x + 4, y + 53, w - 8, h - 55

    def _options(self) -> list[tuple[str, object]]:
        session, options = self.editor.session, [("the run as it was opened", self._opened)]
        if len(session.saved):
            options.append(("the run as it was saved", session.saved))
        options += [(f"branch: {branch.name}", branch.track) for branch in session.branches.all]
        options += [(other.name, other.track) for other in self.editor.others]
        names: dict[InputTrack, str] = {}
        for name, track in options:
            names.setdefault(track, name)
        return [(name, track) for track, name in names.items()]

    def _theirs(self) -> InputTrack:
        """The chosen run; by default the other one, or this one as it was opened."""
        editor = self.editor
        if editor.against is not None:
            return editor.against
        return editor.beside.track if editor.beside else self._opened

    def _put(self, track: object) -> None:
        self.editor.against = track if isinstance(track, InputTrack) else None

    @property
    def _pair(self) -> Pair:
        return self.editor.track, self._theirs()

    def update(self, real_ms: int) -> None:
        if self.editor.tab != self.name and not self.editor.others:
            return
        self.choice.options = self._options()
        if self._theirs() not in {track for _, track in self.choice.options}:
            self.editor.against = None
        pair = self._pair
        if pair != self._requested:
            self._requested, self._unchanged_ms = pair, 0
        elif self._unchanged_ms < PAUSE_MS:
            self._unchanged_ms += real_ms
            if self._unchanged_ms >= PAUSE_MS:
                session = self.editor.session
                ours, theirs = session.recording(pair[0], "this run"), session.recording(pair[1], "the other run")
                self.job.ask((pair, ours, theirs, pair[0].markers))
        table = self.table
        self.list.fill(table.rows if table else ())
        self.editor.leads = table.leads if table and self.editor.others and self.is_current else {}

    @property
    def table(self) -> LeadTable | None:
        result = self.job.result
        return result[1] if result is not None and isinstance(result[1], LeadTable) else None

    @property
    def is_current(self) -> bool:
        return self.job.result is not None and self.job.result[0] == self._pair

    def _go(self, index: int) -> None:
        if self.table is not None:
            self.editor.go(self.table.rows[index].tick)

    @property
    def summary(self) -> str:
        if not self.is_current or self.job.result is None:
            return self.job.problem or "comparing ..."
        table = self.job.result[1]
        if isinstance(table, str):
            return table
        keys, place = table.comparison.first_keys, table.comparison.first_place
        if keys is None:
            return "the same keys"
        parts = [
            f"other keys from tick {keys} on",
            f"elsewhere from tick {place} on" if place is not None else "the same way",
        ]
        last = next((row for row in reversed(table.rows) if row.at), None)
        if last is not None:
            parts.append(f"{lead_text(last.ahead)} at {last.name}")
        if table.apart:
            parts.append(f"{counted(table.apart, 'second')} not listed: over {NEAR_DISTANCE:.0f} px apart")
        return "; ".join(parts)

    def render_key(self) -> tuple[object, ...]:
        rows = self.table and self.table.rows
        return self.choice.options, self._theirs(), self.summary, rows, self.editor.cursor, self.list.over

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        x, y, w, _ = self.area
        theme.text(surface, "Against", x + 6, y + 8, size=11)
        theme.text(surface, self.summary, x + 6, y + 26, size=SMALL, width=w - 16)
        self.list.draw_heads(surface, theme, "Place", _HEADS, _COLUMNS)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, _: bool) -> None:
        if self.table is None or index >= len(self.table.rows):
            return
        row, palette = self.table.rows[index], theme.palette
        x, right, y = area[0], area[0] + area[2], area[1] + 3
        current = self.is_current
        colour = palette.text if row.at and current else palette.faint
        theme.text(
            surface, row.name, x + 8, y, size=SMALL, colour=colour, bold=bool(row.at), width=area[2] - _COLUMNS[0] - 14
        )
        for at, tick in zip(_COLUMNS, (row.tick, row.other), strict=False):
            theme.text(surface, str(tick), right - at, y, size=SMALL, colour=colour)
        since = row.ahead - (self.table.rows[index - 1].ahead if index else 0)
        for at, ticks in zip(_COLUMNS[2:], (row.ahead, since), strict=True):
            if current and ticks:
                colour = palette.good if ticks > 0 else palette.bad
            theme.text(surface, f"{ticks:+d}" if ticks else "0", right - at, y, size=SMALL, bold=True, colour=colour)
            colour = palette.faint


def lead_text(ahead: int) -> str:
    """A lead as text.

    >>> lead_text(1), lead_text(-12), lead_text(0)
    ('1 tick ahead', '12 ticks behind', 'as early')
    """
    text = f"{counted(abs(ahead), 'tick')} {'ahead' if ahead > 0 else 'behind'}"
    return text if ahead else "as early"
