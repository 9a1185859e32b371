"""What the bench does with files: save, open, what was not saved last time, leave."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from ninja_game.editor.files import OccupiedError
from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import file_stem
from ninja_game.files.user_folder import REPLAYS, free_path
from ninja_game.formats.links.making import replay_link
from ninja_game.play.clipboard import copy_link
from ninja_game.play.editor.panels import STAY, Form, HelpPage, Menu, Row
from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.controls import COMMANDS
from ninja_game.play.tas.part import Commands
from ninja_game.player.saving import keep_replay
from ninja_game.tas.files import SUFFIX, replay_of_take
from ninja_game.tas.journal import Recovered, forget, recovered

if TYPE_CHECKING:
    from ninja_game.play.app import App

HELP = """\
A row of the roll is a tick: click L, R or J to change a key, drag to paint, click the number of a tick to go there. \
The level shows the world after that tick. Enter takes over: play on yourself, Enter again ends it.
Mark some ticks and press F to search for a better way through them; a click on a result puts it into the run."""
"""What one has to know to begin."""


class FileCommands:
    """The commands that concern files. ``run``: does a command of any part by its name."""

    def __init__(self, app: App, bench: Bench, run: Callable[[str], object]) -> None:
        self.app = app
        self.bench = bench
        self.session = bench.session
        self._run = run

    def commands(self) -> Commands:
        """By name."""
        return {"menu": self.menu, "help": self.help, "save": self.save, "save_as": self.save_as}

    def help(self) -> None:
        """All commands on one page."""
        self.app.push(HelpPage(self.app, "The bench", HELP, COMMANDS))

    def menu(self) -> None:
        """The file menu."""
        rows: list[Row] = [
            ("Save", self.save, "Ctrl+S"), ("Save as...", self.save_as, "Ctrl+Shift+S"),
            ("Open another run...", lambda: self._run("open_other"), "Beside this one: Ctrl+O"),
            ("Watch", self.watch, "In the replay viewer, which makes films too"),
            ("Keep as a replay", self.keep, "Among yours"), ("Copy a link", self.copy_link, "Opens the run"),
            ("Help", self.help, "F1"), ("Leave", self.leave, ""),
        ]  # fmt: skip
        self.app.push(Menu(self.app, "Run", rows))

    @property
    def _name(self) -> str:
        return self.session.about.name or "run"

    # --- saving ---

    def save(self) -> None:
        """Write the run into its file, or into a new one among the player's replays."""
        self.save_to(self.session.file.path or free_path(self._folder, file_stem(self._name, "run"), SUFFIX))

    @property
    def _folder(self) -> Path:
        path = self.session.file.path
        return path.parent if path else self.app.player.folder / REPLAYS

    def save_as(self) -> None:
        """Ask for the name of the file, and write the run."""
        path = self.session.file.path
        name = path.name.removesuffix(SUFFIX) if path else file_stem(self._name, "run")

        def take(texts: list[str]) -> None:
            self.save_to(self._folder / f"{file_stem(texts[0], 'run')}{SUFFIX}")

        self.app.push(Form(self.app, "Save as", [("Name of the file", name, 100)], "Save", take))

    def save_to(self, path: Path, *, replacing: bool = False) -> None:
        """Write the run; ask before anything is replaced."""
        try:
            self.session.save(path, replacing=replacing)
        except OccupiedError as error:
            text = str(error)
            rows: list[Row] = [
                ("Save under another name", self.save_as, ""),
                ("Replace it", lambda: self.save_to(path, replacing=True), "What it holds now is lost"), STAY,
            ]  # fmt: skip
            self.app.push(Menu(self.app, text[0].upper() + text[1:], rows))
        except (NinjaGameError, OSError) as error:
            self.app.notify(f"Not saved: {getattr(error, 'strerror', '') or error}")
        else:
            without = " without claims: Ctrl+E takes out what is behind the end" if self.session.has_tail else ""
            self.app.notify(f"Saved{without}: {path}")

    def keep(self) -> None:
        """Put the run among the player's replays."""
        if self.session.has_tail:
            self.app.notify("Keys are pressed behind the end: take them out first, with Ctrl+E")
            return
        about, take = self.session.about, self.session.take
        self.bench.attempt(lambda: self.app.notify(keep_replay(self.app.player, replay_of_take(about, take))))

    def copy_link(self) -> None:
        """The run as a link, in the clipboard."""
        about, take = self.session.about, self.session.take
        copy_link(self.app, lambda: replay_link([replay_of_take(about, take)]), title=self._name)

    def watch(self) -> None:
        """The run in the replay viewer."""
        from ninja_game.play.replay.screen import ReplayScreen

        self.app.push(ReplayScreen(self.app, [self.session.recording()], editable=False))

    # --- what was not saved ---

    def offer_recovered(self, open_found: Callable[[Recovered], object]) -> None:
        """Ask what to do with a run that was being edited when the program died. ``open_found``: goes on with it."""
        found = next(recovered(self.app.player.folder), None)
        if found is None:
            return
        home = found.opened.file.path
        name = home.name if home else found.opened.recording.name or "a run"
        rows: list[Row] = [
            ("Go on with it", lambda: self.bench.attempt(lambda: open_found(found)), "All but the last edit"),
            ("Later", lambda: None, "It is offered again"),
            ("Forget it", lambda: forget(found.file), "It is lost"),
        ]  # fmt: skip
        self.app.push(Menu(self.app, f"Not saved last time: {name}", rows))

    def leave(self) -> None:
        """Back to where the bench was opened; ask first if the run is not saved."""
        self.session.end()
        if self.session.is_saved:
            self._go()
            return
        rows: list[Row] = [STAY, ("Save first", self.save, ""), ("Leave it unsaved", self._go, "It is lost")]
        self.app.push(Menu(self.app, f"{self._name} is not saved", rows))

    def _go(self) -> None:
        self.session.close()
        self.app.pop()
