"""What the bench does with files: save, open, what was not saved last time, leave."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.part import Commands

if TYPE_CHECKING:
    from ninja_game.play.app import App


class FileCommands:
    """The commands that concern files."""

    def __init__(self, app: App, bench: Bench) -> None:
        self.app = app
        self.bench = bench

    def commands(self) -> Commands:
        """By name."""
        return {"menu": self.leave}

    def offer_recovered(self) -> None:
        """Ask what to do with a run that was being edited when the program died."""

    def leave(self) -> None:
        """Back to where the bench was opened."""
        self.bench.session.close()
        self.app.pop()
