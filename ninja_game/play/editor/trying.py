"""A level under edit, played: nothing of it is saved, and one press leads back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.sayings import Saying, read_sayings
from ninja_game.play.app import App
from ninja_game.play.level.screen import LevelScreen
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import LevelContext, Navigation, PacedRun
from ninja_game.sim.level import Level
from ninja_game.ui.audio.music import SILENCE


class Tried(Protocol):
    def __call__(self, inputs: bytes, *, over: bool) -> object:
        """Called with the inputs of a try when it is left, or is ``over``."""


class TryContext(LevelContext):
    """A level that is only tried out: with practice tools and without a clock; nothing counts."""

    onward = "back to the editor"

    def __init__(self, data: PlayerData, entry: Entry, tried: Tried, certifies: Callable[[Attempt], bool]) -> None:
        super().__init__(data, entry, practice_mode=True)
        self._tried, self._certifies = tried, certifies

    def ghosts(self) -> list[PacedRun]:
        """None: nobody has a best on a level that is being made."""
        return []

    def sayings(self) -> tuple[Saying, ...]:
        """All of them, however often the level was passed."""
        return read_sayings(self.entry.named.says)

    def passed(self, attempt: Attempt) -> list[str]:
        self._tried(bytes(attempt.inputs), over=True)
        return ["It can be passed" + ": this run certifies it" * self._certifies(attempt)]

    def died(self, attempt: Attempt) -> None:
        self._tried(bytes(attempt.inputs), over=True)

    def gave_up(self, attempt: Attempt) -> None:
        self.left(attempt, over=True)

    def left(self, attempt: Attempt, *, over: bool = False) -> None:
        """Tell of a try that has not ended by itself."""
        if attempt.outcome == "running":
            self._tried(bytes(attempt.inputs), over=over)

    def advance(self) -> Navigation:
        return Navigation.BACK


class TryScreen(LevelScreen):
    """Plays a level; the back key leaves at once, whatever is going on. Raises LevelError for one without a ninja."""

    music = SILENCE

    def __init__(
        self, app: App, name: str, level: Level, tried: Tried, certifies: Callable[[Attempt], bool], *, says: str = ""
    ) -> None:
        title = f"{name} ({app.controls.name('back')}: back to the editor)"
        named = NamedLevel(title, "", "", level, "", says=says)
        self._trying = TryContext(app.player, Entry(named, "yours"), tried, certifies)
        super().__init__(app, self._trying)

    def leave(self) -> None:
        """Tell the editor of the last try."""
        super().leave()
        self._trying.left(self.attempt)

    def _dispatch_action(self, pressed: tuple[str, ...]) -> None:
        if "back" in pressed or "quit" in pressed:
            self.app.pop()
        else:
            super()._dispatch_action(pressed)
