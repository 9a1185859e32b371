"""What all parts of the TAS editor share: the session, the tick under the cursor, the selected ticks, other runs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import ClassVar
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import NinjaGameError, reason
from ninja_game.play.app import App
from ninja_game.play.workspace.part import Part
from ninja_game.tas.contributions import Contributions
from ninja_game.tas.input_track import InputTrack
from ninja_game.tas.session import Session
from ninja_game.tas.timeline import Trajectory
from ninja_game.ui.theme import Theme

Span = tuple[int, int]
"""The first tick, and the first one behind the last."""


@dataclass(frozen=True)
class OtherRun:
    """A run that is shown beside the one under edit.

    ``trajectory``: what its ninja does; ``made``: how, and by whom.
    """

    name: str
    track: InputTrack
    trajectory: Trajectory = field(repr=False)
    made: Contributions = field(default_factory=Contributions)

    @property
    def positions(self) -> NDArray[np.float64]:
        """The ninja after each tick: float64 (ticks, 2), px."""
        return self.trajectory.positions


class TasEditor:
    """What all parts of the TAS editor share.

    ``cursor``: the tick whose row is the present one; the level is shown as it is after that tick.
    ``anchor``: where a selection began; None: only the tick under the cursor is selected. ``others``: runs that were
    opened beside this one; ``chosen``: the number of the one that parts are taken from, where there are any.
    ``preview``: a result of a search that is looked at. ``tab``: the name of the tab that is to be shown.
    ``against``: the run that the lead is told over; None: the chosen other one, else the run as it was opened.
    ``theme``: the look of all parts, in the TAS editor's own logical px, which are not those of other screens.
    ``places``: cursor and anchor when a run was edited or taken over, for undo.
    ``hint``: of what is under the mouse, for the line below.
    """

    def __init__(self, app: App, session: Session) -> None:
        self.app = app
        self.session = session
        self.theme: Theme = app.theme
        self.cursor = 0
        self.anchor: int | None = None
        self.others: list[OtherRun] = []
        self.chosen = 0
        self.ghosts = True
        self.preview: OtherRun | None = None
        self.tab = "Values"
        self.against: InputTrack | None = None
        self.hint = ""
        self._refusal = ""
        self.places: WeakKeyDictionary[InputTrack, tuple[int, int | None]] = WeakKeyDictionary()

    @property
    def track(self) -> InputTrack:
        return self.session.track

    @property
    def beside(self) -> OtherRun | None:
        """The chosen one of the runs beside this one; None without any."""
        return self.others[self.chosen % len(self.others)] if self.others else None

    @property
    def selection(self) -> Span:
        """The selected ticks, at least the one under the cursor."""
        anchor = self.cursor if self.anchor is None else self.anchor
        return min(anchor, self.cursor), max(anchor, self.cursor) + 1

    @property
    def last_tick(self) -> int:
        """The last tick that has a row."""
        return len(self.session.timeline) - 1

    def show_tab(self, name: str) -> None:
        self.tab = name

    def go(self, tick: int, *, select: bool = False) -> None:
        """Put the cursor on a tick; ``select``: what lies between is selected."""
        if not select:
            self.anchor = None
        elif self.anchor is None:
            self.anchor = self.cursor
        self.cursor = min(max(0, tick), self.last_tick)

    def select(self, first: int, last: int) -> None:
        """Select the ticks ``first`` … ``last`` - 1."""
        self.cursor, self.anchor = first, max(first, last - 1)

    def refuse(self, why: str) -> None:
        """Say why something is not done."""
        self._refusal = why
        self.app.notify(why)

    def accept(self) -> None:
        """Something was done: the refusal before is not shown any longer."""
        if self._refusal and self.app.notice == self._refusal:
            self.app.notify("")
        self._refusal = ""

    def attempt(self, edit: Callable[[], object]) -> bool:
        """Do something that may be refused; a notice says why. Whether it was done."""
        try:
            edit()
        except (NinjaGameError, OSError) as error:
            self.refuse(reason(error))
            return False
        self.accept()
        self.cursor = min(self.cursor, self.last_tick)
        if self.anchor is not None:
            self.anchor = min(self.anchor, self.last_tick)
        return True

    def edit(self, make: Callable[[InputTrack], InputTrack], taken: Contributions | None = None) -> bool:
        """Change the run as a function of what it is; a refusal is reported. Whether it was done.

        ``taken``: of those whose keys are taken.
        """
        return self.attempt(lambda: self.session.change(make(self.track), taken=taken))

    def edit_selected(self, make: Callable[[InputTrack], InputTrack], taken: Contributions | None = None) -> bool:
        """Change the selected ticks; undo selects them again. Whether it was done."""
        self.places[self.track] = self.cursor, self.anchor
        return self.edit(make, taken)


class TasPart(Part):
    """A part of the TAS editor. ``slot``: the name of its place in the layout."""

    slot: ClassVar[str] = ""

    def __init__(self, editor: TasEditor) -> None:
        self.editor = editor
