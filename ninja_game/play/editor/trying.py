"""A level under edit, played: nothing of it is saved, and one press leads back."""

from __future__ import annotations

from collections.abc import Callable

from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.sayings import Saying, read_sayings
from ninja_game.play.app import App
from ninja_game.play.level.screen import LevelScreen
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry
from ninja_game.player.playthrough import LevelContext, Navigation, PacedRun
from ninja_game.sim.level import Level
from ninja_game.ui.audio.music import SILENCE

Left = Callable[[bytes], object]
"""Called with the inputs of the last try when the test is left."""


class TryContext(LevelContext):
    """A level that is only tried out: with practice tools and without a clock; nothing counts."""

    def ghosts(self) -> list[PacedRun]:
        """None: nobody has a best on a level that is being made."""
        return []

    def sayings(self) -> tuple[Saying, ...]:
        """All of them, however often the level was passed."""
        return read_sayings(self.entry.named.says)

    def passed(self, attempt: Attempt) -> list[str]:
        return ["It can be passed"]

    def died(self, attempt: Attempt) -> None:
        """Nothing is counted."""

    def gave_up(self, attempt: Attempt) -> None:
        """Nothing is counted."""

    def advance(self) -> Navigation:
        return Navigation.BACK


class TryScreen(LevelScreen):
    """Plays a level; the back key leaves at once, whatever is going on. Raises LevelError for one without a ninja."""

    music = SILENCE

    def __init__(self, app: App, name: str, level: Level, left: Left, *, says: str = "") -> None:
        title = f"{name} ({app.controls.name('back')}: back to the editor)"
        named = NamedLevel(title, "", "", level, "", says=says)
        super().__init__(app, TryContext(app.player, Entry(named, "yours"), practice_mode=True))
        self._left = left
        self._last = b""

    def retry(self, *, ignored: int = 0) -> None:
        """The try before is remembered."""
        self._last = bytes(self.attempt.inputs) or self._last
        super().retry(ignored=ignored)

    def leave(self) -> None:
        """Tell the editor of the last try."""
        super().leave()
        self._left(bytes(self.attempt.inputs) or self._last)

    def _dispatch_action(self, pressed: tuple[str, ...]) -> None:
        if "back" in pressed or "quit" in pressed:
            self.app.pop()
        else:
            super()._dispatch_action(pressed)
