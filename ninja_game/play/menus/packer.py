"""Makes packs ready to share, whatever screen is on top meanwhile."""

from __future__ import annotations

import os
from pathlib import Path
from time import monotonic

from ninja_game.editor.packs import Obstacles, ReadyPack, make_ready
from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.writing import write_atomically
from ninja_game.play.app import App, Aside, Screen
from ninja_game.play.clipboard import copy_link
from ninja_game.runtime import NewestJob
from ninja_game.sim.level import Level

SECONDS, LONGER = 20.0, 300.0
"""For each search of a run; for one that found none before."""

HALF_SECONDS = 30.0
"""After so long half of a bar is full where nobody knows how long something takes, then half of the rest."""


class Packer(Aside):
    """``path``: the pack that is, or was, made ready; ``text``: how that stands or ended, ``share``: of its step.

    ``saved``: the zip that came of it. ``desk``: the screen at which a link is waited for.
    """

    def __init__(self, app: App) -> None:
        self.app = app
        self.path = Path()
        self.saved: Path | None = None
        self._seconds = SECONDS
        self.desk: Screen | None = None
        self.obstacles: Obstacles = {}
        self.busy = self._stopped = False
        self.text, self.share = "", 0.0
        self._step: tuple[str, float | None, float] = "", None, 0.0
        self._job: NewestJob[Path, ReadyPack] = NewestJob(self._make_ready)

    def start(self, path: Path, seconds: float = SECONDS) -> None:
        self.path, self.busy, self._stopped = path, True, False
        self.saved, self._seconds = None, seconds
        self._say("Beginning", 0.0)
        self._job.ask(path)

    def search_longer(self, path: Path, missing: tuple[Level, str]) -> None:
        """Make the pack ready with another search of a run that was looked for in vain."""
        self.obstacles.pop(missing, None)
        self.start(path, LONGER)

    def end(self) -> None:
        """Stop; what was found is on the disk already."""
        self._stopped = True

    def _say(self, text: str, share: float | None) -> None:
        if self._stopped:
            raise NinjaGameError("Stopped; what was found is kept")
        self._step = text, share, monotonic()

    def _make_ready(self, path: Path) -> ReadyPack:
        jobs = max(1, (os.cpu_count() or 2) - 1)
        return make_ready(path, seconds=self._seconds, jobs=jobs, say=self._say, obstacles=self.obstacles)

    def update(self) -> None:
        if not self.busy:
            return
        text, share, began = self._step
        seconds = monotonic() - began
        self.text = "Stopping" if self._stopped else text if share is not None else f"{text}: {seconds:.0f} s"
        self.share = 1 - 0.5 ** (seconds / HALF_SECONDS) if share is None else share
        if self._job.idle:
            self.busy, self.text = False, self._job.problem
            if self._job.result and not self.text:
                self.text = self._share(self._job.result)

    def _share(self, ready: ReadyPack) -> str:
        """Write the zip, and put the link into the clipboard of who waits for it; all that is to be said."""
        app, name, waited_for = self.app, ready.pack.name, self.app.top is self.desk
        self.saved = app.write_export(name, ".zip", lambda path: write_atomically(path, ready.zipped))
        said = [app.notice]
        if ready.link and waited_for:
            copy_link(app, lambda: ready.link, title=name)
            said.append("the link is in the clipboard")
        app.notify("; ".join(said) if waited_for else f"{shown_text(name)} is ready to share", here=waited_for)
        if codes := dict.fromkeys(each.code.replace("-", " ") for each in ready.findings):
            said[0] += f", with {counted(len(ready.findings), 'open problem')} ({', '.join(codes)})"
        return "; ".join([*said, *ready.notes])


def packer_of(app: App) -> Packer:
    """The program's only one."""
    for each in app.aside:
        if isinstance(each, Packer):
            return each
    app.aside.append(packer := Packer(app))
    return packer
