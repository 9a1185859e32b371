"""The TAS editor in the window: its parts, and a run in them."""

from __future__ import annotations

import gc
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ninja_game.formats.recording import Recording
from ninja_game.play.app import App
from ninja_game.play.input.bindings import InputEvent
from ninja_game.play.tas.commands import RunCommands
from ninja_game.play.tas.controls import TABLE
from ninja_game.play.tas.editor import TasEditor, TasPart
from ninja_game.play.tas.head import Foot, Head
from ninja_game.play.tas.layout import Splitters
from ninja_game.play.tas.level.part import LevelPart
from ninja_game.play.tas.roll.part import Roll
from ninja_game.play.tas.tabs.branches_tab import BranchesTab
from ninja_game.play.tas.tabs.lead_tab import LeadTab
from ninja_game.play.tas.tabs.search_tab import SearchTab
from ninja_game.play.tas.tabs.tab import Tab, TabStrip
from ninja_game.play.tas.tabs.values_tab import ValuesTab
from ninja_game.play.ui.theme import Theme
from ninja_game.play.workspace.part import Commands
from ninja_game.play.workspace.screen import WorkspaceScreen
from ninja_game.tas.session import Session

if TYPE_CHECKING:
    from ninja_game.tas.files import OpenedRun
    from ninja_game.tas.journal import RecoveredRun


class TasScreen(WorkspaceScreen):
    """A run is edited here. ``editor``: what is seen and selected; ``session``: the run.

    ``others``: other runs of its level; ``found``: what was not saved of the run last time. Raises LevelError for a run
    on a level that cannot be played, ReplayError for another run that is of another level or has another body,
    FileError for what another window continues with.
    """

    table = TABLE

    def __init__(
        self, app: App, opened: OpenedRun, others: Sequence[Recording] = (), found: RecoveredRun | None = None
    ) -> None:
        super().__init__(app)
        self.session = Session(opened, app.player.folder)
        if found is not None:
            self.session.recover(found)
        self.editor = TasEditor(app, self.session)
        values = ValuesTab(self.editor)
        self.tabs: list[Tab] = [values, BranchesTab(self.editor), LeadTab(self.editor), SearchTab(self.editor)]
        self.level, self.roll = LevelPart(self.editor, values.ask), Roll(self.editor)
        self.strip = TabStrip(self.editor, self.tabs)
        self.head, self.foot_line = Head(self.editor), Foot(self.editor)
        self.files = RunCommands(app, self.editor, self.run, self._recover)
        self.level.others.open(others)
        placed = [self.head, self.level, self.roll, self.foot_line, self.strip, *self.tabs]
        self.splitters = Splitters(self.editor, placed)
        self._entered = found is not None

    @property
    def tab(self) -> Tab:
        return self.strip.shown

    @property
    def parts(self) -> Sequence[TasPart]:
        return [self.head, self.level, self.roll, self.tab, self.strip, self.foot_line, self.splitters]

    @property
    def theme(self) -> Theme:
        """The TAS editor's own: a larger window has room for more, where other screens are larger."""
        if self.splitters.fit():
            self.redraw, self.notice_area = True, self.splitters.layout.notices
        return self.editor.theme

    def commands(self) -> Commands:
        own = dict(self.files.commands())
        for part in (*self.parts, *self.tabs):
            own.update(part.commands())
        return own

    def run(self, name: str) -> None:
        self.commands()[name]()

    def hint(self, text: str) -> None:
        self.editor.hint = text

    def _recover(self, found: RecoveredRun) -> None:
        self.app.replace(TasScreen(self.app, found.opened, found=found))

    def enter(self) -> None:
        """The first time, ask about what was not saved."""
        self.editor.theme = self.theme  # all parts are in their places before the first of them looks around
        super().enter()
        # All that there is now (compiled code has much) is left out when memory is cleared up: that took 80 ms.
        gc.freeze()
        if not self._entered:
            self._entered = True
            self.files.offer_recovered()

    def leave(self) -> None:
        """Covered or closed: what is going on ends."""
        super().leave()
        gc.unfreeze()
        self.level.stop()
        self.session.end()
        if self not in self.app.stack:
            for tab in self.tabs:
                tab.close()
            self.session.close(keep=True)  # what is not saved is offered again

    def meaning(self, event: InputEvent) -> str:
        """The command that an event means, which is another one while the run is taken over; '' for none."""
        return self.level.meaning(event)

    def capture(self, event: InputEvent) -> bool:
        """Keys of the game go to the ninja that was taken over."""
        if self.level.capture(event):
            self.held.follow(event.raw)
            return True
        return super().capture(event)

    def update(self, real_ms: int) -> None:
        """Simulate what is not simulated yet; parts go on."""
        super().update(real_ms)
        if not self.level.take_over.on:
            self.session.timeline.simulate(self.session.ticks_per_frame)
        for part in (self.level, self.roll, *self.tabs):
            part.update(real_ms)
        self.follow_parts()
