"""A play of the level under edit."""

from __future__ import annotations

from ninja_game.formats.messages import LevelMessage, parse_messages
from ninja_game.formats.named_level import NamedLevel
from ninja_game.levels.episodes import YOURS, Entry
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.level.screen import LevelScreen
from ninja_game.player.attempt import Attempt
from ninja_game.player.playthrough import Navigation, PacedRun, Playthrough
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import Level
from ninja_game.ui.audio.music import SILENCE


class DraftPlaythrough(Playthrough):
    """A playtest of the level under edit: with practice tools, without a clock; nothing counts."""

    next_label = "back to the editor"

    def __init__(self, session: EditorSession, entry: Entry, *, lead: bytes, deaths: int) -> None:
        super().__init__(session.app.player, entry, practice_mode=True)
        self._session, self.lead, self.deaths = session, lead, deaths

    def _show(self, attempt: Attempt, *, over: bool) -> None:
        self._session.add_playtest(self.level, bytes(attempt.inputs), over=over)

    def beginning(self) -> tuple[Level, bytes]:
        """The start of the level under edit, wherever this begins: its texts lie where they will lie in play."""
        level, inputs = self._session.draft.level, self._session.certifying_inputs
        return (level if any(spec.kind == NINJA for spec in level.objects) else self.level), inputs

    def ghosts(self) -> list[PacedRun]:
        """None: a level under edit has no best run."""
        return []

    def messages(self) -> tuple[LevelMessage, ...]:
        """All messages, however often the level was passed."""
        return parse_messages(self.entry.named.says)

    def passed(self, attempt: Attempt) -> list[str]:
        self._show(attempt, over=True)
        certifies = not self.lead and self._session.passed(self.level, attempt)
        return ["It can be passed: this run certifies it" if certifies else "It can be passed"]

    def died(self, attempt: Attempt) -> None:
        self._show(attempt, over=True)

    def gave_up(self, attempt: Attempt) -> None:
        self.left(attempt, over=True)

    def left(self, attempt: Attempt, *, over: bool = False) -> None:
        """Report to the editor a playtest that was left before its end."""
        if attempt.outcome == "running":
            self._show(attempt, over=over)

    def advance(self) -> Navigation:
        return Navigation.BACK


class PlaytestScreen(LevelScreen):
    """Plays a level under edit; the back key leaves at once. Raises LevelError without a ninja.

    ``says``: the messages; ``there``: the level in its pack, whose colours it has; ``lead``: inputs played at once
    before the player's; ``deaths``: those before, for messages.
    """

    music = SILENCE

    def __init__(
        self,
        session: EditorSession,
        level: Level,
        *,
        says: str = "",
        there: Entry | None = None,
        lead: bytes = b"",
        deaths: int = 0,
    ) -> None:
        app = session.app
        title = f"{session.name} ({app.controls.name('back')}: back to the editor)"
        named = NamedLevel(title, "", "", level, "", says=says)
        entry = Entry(named, YOURS, there.episode if there else "")
        self._draft_playthrough = DraftPlaythrough(session, entry, lead=lead, deaths=deaths)
        super().__init__(app, self._draft_playthrough)

    def leave(self) -> None:
        super().leave()
        self._draft_playthrough.left(self.attempt)

    def _dispatch_action(self, pressed: tuple[str, ...]) -> None:
        if "back" in pressed or "quit" in pressed:
            self.app.pop()
        else:
            super()._dispatch_action(pressed)
