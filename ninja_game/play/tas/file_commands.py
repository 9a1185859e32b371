"""What the TAS editor does with files: save, open, what was not saved last time, leave."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from itertools import islice
from pathlib import Path
from time import localtime, strftime
from typing import TYPE_CHECKING

from ninja_game.editor.files import OccupiedError
from ninja_game.errors import NinjaGameError, reason
from ninja_game.files.locking import forget
from ninja_game.files.shown_text import file_stem
from ninja_game.files.user_folder import REPLAYS, data_folder, free_path
from ninja_game.formats.links.making import replay_link
from ninja_game.play.clipboard import copy_link
from ninja_game.play.menus.help import HelpPage
from ninja_game.play.menus.panels import CANCEL, Form, Menu, Row, nothing
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.play.tas.controls import COMMANDS
from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.tas.part import Commands
from ninja_game.player.saving import keep_replay
from ninja_game.tas.files import SUFFIX, branches_path, replay_of_track, same_level
from ninja_game.tas.journal import Recovered, recovered

if TYPE_CHECKING:
    from ninja_game.play.app import App

HELP = """\
A row of the roll is a tick: click L, R or J to change a key, drag to paint, click the number of a tick to go there. \
The level shows the world after that tick. Enter takes over: play on yourself, Enter again ends it.
Mark some ticks and press F to search for better keys there; a click on a result puts it into the run.
The wheel scrolls the roll, and shows the level or a plot larger; the right button moves the level, the left one \
a plot. With Ctrl the wheel goes tick by tick. Drag what is between the parts to give one of them more room."""
"""What one has to know to begin."""


class FileCommands:
    """The commands that concern files.

    ``run``: does a command of any part by its name; ``go_on``: opens what was not saved.
    """

    def __init__(
        self, app: App, editor: TasEditor, run: Callable[[str], object], go_on: Callable[[Recovered], object]
    ) -> None:
        self.app = app
        self._go_on = go_on
        self.editor = editor
        self.session = editor.session
        self._run = run

    def commands(self) -> Commands:
        """By name."""
        return {"menu": self.menu, "help": self.help, "save": self.save, "save_as": self.save_as}

    def help(self) -> None:
        """All commands on one page."""
        self.app.push(HelpPage(self.app, "The TAS editor", HELP, COMMANDS))

    def menu(self) -> None:
        """The file menu."""
        rows: list[Row] = [
            ("Save", self.save, "Ctrl+S"), ("Save as...", self.save_as, "Ctrl+Shift+S"),
            ("Open another run...", lambda: self._run("open_other"), "Beside this one: Ctrl+O"),
            ("Not saved last time...", self.list_recovered, "Runs that were edited when the program ended"),
            ("Watch", self.watch, "In the replay viewer, which makes films too"),
            ("Keep as a replay", self.keep, "Among yours"), ("Copy a link", self.copy_link, "Opens the run"),
            ("Help", self.help, "F1"), ("Leave", self.leave, ""),
        ]  # fmt: skip
        self.app.push(Menu(self.app, "Run", rows))

    @property
    def _name(self) -> str:
        return self.session.about.name or "run"

    # --- saving ---

    def save(self, then: Callable[[], object] = nothing) -> None:
        """Write the run into its file, and do ``then``; of one without a file ask for a name."""
        if self.session.file.path:
            self.save_to(self.session.file.path, then)
        else:
            self.save_as(then)

    @property
    def _folder(self) -> Path:
        """Where the run is, or was opened from; else the player's replays, also for runs of the game."""
        opened = self.session.file.path or Path(self.session.about.file)
        with suppress(OSError):
            if opened.is_file() and not opened.resolve().is_relative_to(data_folder("levels").resolve()):
                return opened.parent
        return self.app.player.folder / REPLAYS

    def save_as(self, then: Callable[[], object] = nothing) -> None:
        """Ask for the name of the file, write the run, and do ``then``."""
        path, folder = self.session.file.path, self._folder
        free = free_path(folder, file_stem(self._name, "run"), SUFFIX)
        name = (path or free).name.removesuffix(SUFFIX)

        def on_accept(texts: list[str]) -> None:
            path = folder / Path(texts[0].strip()).expanduser()
            if path.parent.is_dir():
                self.save_to(path.with_name(f"{file_stem(path.name.removesuffix(SUFFIX), 'run')}{SUFFIX}"), then)
            else:
                self.app.notify(f"Not saved: there is no folder {path.parent}")

        self.app.push(
            Form(self.app, f"Save in {folder.absolute()}", [("Name or path of the file", name, 300)], "Save", on_accept)
        )

    def save_to(self, path: Path, then: Callable[[], object] = nothing, *, replacing: bool = False) -> None:
        """Write the run, and do ``then``; ask before anything is replaced."""
        try:
            self.session.save(path, replacing=replacing)
        except OccupiedError as error:
            text = str(error)
            rows: list[Row] = [
                ("Save under another name", lambda: self.save_as(then), ""),
                ("Replace it", lambda: self.save_to(path, then, replacing=True), "What it holds now is lost"), CANCEL,
            ]  # fmt: skip
            self.app.push(Menu(self.app, text[0].upper() + text[1:], rows))
        except (NinjaGameError, OSError) as error:
            self.app.notify(f"Not saved: {reason(error)}")
        else:
            tail = ", with what is behind its end (Ctrl+E takes that out)" if self.session.has_tail else ""
            beside = " and its branches beside it" * branches_path(path).exists()
            self.app.notify(f"Saved{tail}: {path}{beside}")
            then()

    def keep(self) -> None:
        """Put the run among the player's replays."""
        if self.session.has_tail:
            self.app.notify("Keys are pressed behind the end: take them out first, with Ctrl+E")
            return
        about, track = self.session.about, self.session.track
        self.editor.attempt(lambda: self.app.notify(keep_replay(self.app.player, replay_of_track(about, track))))

    def copy_link(self) -> None:
        """The run as a link, in the clipboard."""
        about, track = self.session.about, self.session.track
        copy_link(self.app, lambda: replay_link([replay_of_track(about, track)]), title=self._name)

    def watch(self) -> None:
        """The run in the replay viewer."""
        self.app.push(ReplayScreen(self.app, [self.session.recording()], editable=False))

    # --- what was not saved ---

    def offer_recovered(self) -> None:
        """Ask what to do with this run, if it was being edited when the program died; tell of others.

        Of a run that was recorded on another level ask whether it is to be edited on this one.
        """
        lost = list(recovered(self.app.player.folder))
        own = next((found for found in lost if self._is_of_this_run(found)), None)
        if own:
            self._offer(own)
        elif self.session.moved:
            rows: list[Row] = [
                ("Edit it on this level", lambda: None, "Its keys stay; it is saved as a new recording"),
                ("Leave", self._go, ""),
            ]
            self.app.push(Menu(self.app, f"{self._name}: this level is not the one that was recorded", rows))
        elif lost:
            self.app.notify(f"Not saved last time: {_name_of(lost[0])}. Esc, Not saved last time")

    def _is_of_this_run(self, found: Recovered) -> bool:
        opened, session = found.opened, self.session
        if opened.file.path or session.file.path:
            return opened.file.path == (session.file.path and session.file.path.absolute())
        return opened.track == session.track and same_level(opened.recording, session.about)

    def list_recovered(self) -> None:
        """All runs that were being edited when the program died, or was closed."""
        rows: list[Row] = [
            (_name_of(found), partial(self._offer, found), _when(found))
            for found in islice(recovered(self.app.player.folder), 8)
        ]  # fmt: skip
        if rows:
            self.app.push(Menu(self.app, "Not saved last time", [*rows, ("Back", lambda: None, "")]))
        else:
            self.app.notify("All runs that were edited are saved")

    def _offer(self, found: Recovered) -> None:
        forgetting: list[Row] = [
            ("Keep for later", nothing, "It is offered again"),
            ("Discard", lambda: forget(found.file), "It is lost"),
        ]  # fmt: skip
        rows: list[Row] = [
            ("Recover", lambda: self.editor.attempt(lambda: self._go_on(found)), _when(found)),
            ("Keep for later", nothing, "It is offered again"),
            ("Discard...", lambda: self.app.push(Menu(self.app, f"Discard {_when(found)}?", forgetting)), ""),
        ]  # fmt: skip
        self.app.push(Menu(self.app, f"Not saved last time: {_name_of(found)}", rows))

    def leave(self) -> None:
        """Back to where the TAS editor was opened; ask first if the run is not saved."""
        self.session.end()
        if self.session.is_saved:
            self._go()
            return
        rows: list[Row] = [
            CANCEL,
            ("Save", lambda: self.save(self._go), ""),
            ("Discard changes", self._go, ""),
        ]
        self.app.push(Menu(self.app, f"{self._name} is not saved", rows))

    def _go(self) -> None:
        self.session.close()
        self.app.pop()


def _name_of(found: Recovered) -> str:
    home = found.opened.file.path
    return home.name if home else found.opened.recording.name or "a run"


def _when(found: Recovered) -> str:
    """How many edits, and when the last one was."""
    count = len(found.tracks)
    last = strftime("%Y-%m-%d %H:%M", localtime(found.file.stat().st_mtime)) if found.file.exists() else "gone"
    return f"{count} edit{'s' * (count != 1)}, the last {last}"
