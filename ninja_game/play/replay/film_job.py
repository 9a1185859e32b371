"""A film that is made while the replay is watched."""

from __future__ import annotations

from pathlib import Path
from threading import Thread

from ninja_game.files.user_folder import export_path
from ninja_game.formats.recording import Recording
from ninja_game.play.replay.film import Film, write_film
from ninja_game.player.settings import Settings
from ninja_game.runtime import beside


class FilmJob:
    """A film made in the background. ``done`` and then ``result``, a sentence for the player.

    ``folder``: the player's.
    """

    def __init__(self, run: Recording, settings: Settings, folder: Path) -> None:
        self._run = run
        self._settings = settings
        self._folder = folder
        self._count = 1
        self._made = 0
        self._wanted = True
        self.done = False
        self.result = ""
        self._thread: Thread

    def start(self) -> None:
        """Begin."""
        self._thread = beside(self._make, self._fail)

    def cancel(self) -> None:
        """Give up, and wait until it is given up."""
        self._wanted = False
        if self._thread.is_alive():
            self._thread.join(5)

    @property
    def percent(self) -> int:
        """How much of it is made."""
        return min(99, 100 * self._made // self._count)

    def _report(self, made: int) -> bool:
        self._made = made
        return self._wanted

    def _make(self) -> None:
        film = Film(self._run, settings=self._settings)
        self._count = len(film.moments)
        path = export_path(self._folder, self._run.title, ".gif")
        if write_film(film, path, self._report):
            self.result = f"Saved: {path}"
        self.done = True

    def _fail(self, why: str) -> None:
        self.result, self.done = f"No film: {why}", True
