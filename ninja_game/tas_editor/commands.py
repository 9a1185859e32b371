"""The TAS editor's commands with their keys; and the commands on the file of a run."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from functools import partial
from itertools import islice
from pathlib import Path
from time import localtime, strftime

from ninja_game.files.bundled import is_bundled
from ninja_game.files.locking import remove_abandoned
from ninja_game.files.shown_text import counted, file_stem
from ninja_game.files.user_folder import REPLAY_SUFFIX, REPLAYS, free_path, short_path
from ninja_game.formats.links import replay_link
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_link
from ninja_game.play.menu_screen import Action, FormPanel, Menu, MenuRow, nothing
from ninja_game.play.panels.help import HelpPage
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.play.workspace import CommandMenu, Commands, CommandTable, DocumentCommands, bundled_commands, key_text
from ninja_game.player.player_data import keep_replay
from ninja_game.tas.contributions import NONE
from ninja_game.tas.files import branches_path, replay_of_track, same_level
from ninja_game.tas.journal import RecoveredRun, lost_runs
from ninja_game.tas_editor.editor import TasEditor

BY_PAD = {
    "start": "take_over", "y": "play", "leftshoulder": "step_back", "rightshoulder": "step", "x": "undo",
    "dpad-up": "up", "dpad-down": "down",
}  # fmt: skip
"""Commands by buttons of a pad; while the player plays on by hand, only those that step."""

TAS_COMMANDS = CommandTable(bundled_commands("tas-editor.txt"), BY_PAD)
"""All commands with a key, unless the player plays on by hand: then the keys of the game count."""

SPLICES = {
    "splice_start": "Its beginning, then my rest",
    "splice_here": "My beginning, then its rest",
    "splice": "The selected ticks",
}
_SHOWN_OF_PATH = 38  # characters of the title
_IN_MENU = {"save", "save_as", "open_other", "help"}


_HELP = """\
A row of the roll is a tick: click L, R or J to change a key, drag to paint, click the number of a tick to go there. \
The level shows the world after that tick. Enter takes over: play on yourself, Enter again ends it.
Select some ticks and press F to search for better keys there; a click on a result puts it into the run.
The wheel scrolls the roll, and shows the level or a plot larger; the right button moves the level, the left one \
a plot. With Ctrl the wheel goes tick by tick. Drag what is between the parts to give one of them more room."""


class RunCommands(DocumentCommands):
    """The commands on files.

    ``run``: does a command of any part by its name; ``recover``: opens unsaved work; ``begin_new``: a new run.
    """

    def __init__(
        self,
        app: App,
        editor: TasEditor,
        run: Callable[[str], object],
        recover: Callable[[RecoveredRun], object],
        begin_new: Action,
    ) -> None:
        super().__init__(app, editor.session)
        self.editor = editor
        self.session = editor.session
        self._run = run
        self._recover, self._begin_new = recover, begin_new
        self._asked_name = False

    def commands(self) -> Commands:
        return {"menu": self.menu, "help": self.help, "save": self.save, "save_as": self.save_as}

    def help(self) -> None:
        self.app.push(HelpPage(self.app, "The TAS editor", _HELP, TAS_COMMANDS.commands))

    def menu(self) -> None:
        key = {name: key_text(command) for name, command in TAS_COMMANDS.by_name.items()}
        rows: list[MenuRow] = [
            ("Save", self.save, key["save"]), ("Save as...", self.save_as, key["save_as"]),
            ("Open another run...", lambda: self._run("open_other"), f"Beside this one: {key['open_other']}"),
            ("Take from the other run...", self.splice, "Its beginning, its rest or some ticks; O chooses the run"),
            ("New run on this level", self._begin_new, "Empty; Esc, Leave comes back to this one"),
            ("Not saved last time...", self.list_recovered, "Runs that were edited when the program ended"),
            ("Watch", self.watch, "In the replay viewer, with the runs beside it"),
            ("Film", partial(self.watch, film=True), "Among your exports, with the runs beside it"),
            ("Keep as a replay", self.keep, "Among yours"), ("Copy a link", self.copy_link, "Opens the run"),
            ("Help", self.help, key["help"]), ("Leave", self.leave, ""),
        ]  # fmt: skip
        self.app.push(CommandMenu(self.app, "Run", rows, table=TAS_COMMANDS, names=_IN_MENU, run=self._run))

    def splice(self) -> None:
        rows: list[MenuRow] = [
            (text, partial(self._run, name), f"At the cursor. {key_text(TAS_COMMANDS.by_name[name])}")
            for name, text in SPLICES.items()
        ]
        self.app.push(Menu(self.app, "Take from the other run", [*rows, ("Back", nothing, "")]))

    def own_path(self) -> Path | None:
        return self.session.file.path

    @property
    def _folder(self) -> Path:
        """The folder of the run's file; else the player's replays, also for runs of the game."""
        opened = self.session.file.path or Path(self.session.origin.file)
        with suppress(OSError):
            if opened.is_file() and not is_bundled(opened):
                return opened.parent
        return self.app.player.folder / REPLAYS

    def save(self, then: Action = nothing) -> None:
        """Save; the first time, for somebody without a name, ask for it."""
        if self._asks_name and not self._asked_name:
            self.save_as(then)
        else:
            super().save(then)

    def save_as(self, then: Action = nothing) -> None:
        path, folder = self.session.file.path, self._folder
        free = free_path(folder, file_stem(self.session.name, "run"), REPLAY_SUFFIX)
        name = (path or free).name.removesuffix(REPLAY_SUFFIX)

        def on_accept(texts: list[str]) -> None:
            text, *player = texts
            if player and player[0].strip():
                self.app.remember_author("", player[0])
                self.session.name_player(self.app.settings.name)
            path = folder / os.path.expanduser(text.strip() or name)  # noqa: PTH111 - fails on no name
            if os.path.isdir(path.parent):  # noqa: PTH112 - likewise
                stem = file_stem(path.name.removesuffix(REPLAY_SUFFIX), "run")
                self.save_to(path.with_name(f"{stem}{REPLAY_SUFFIX}"), then)
            else:
                self.app.notify(f"Not saved: there is no folder {path.parent}")

        place = short_path(folder.absolute())
        if len(place) > _SHOWN_OF_PATH:  # the end of a long path says more
            place = f"...{place[-_SHOWN_OF_PATH:]}"
        title = f"Save in {place}"
        fields = [("Name or path of the file", name, 300)]
        if self._asks_name:
            self._asked_name = True
            fields.append(("Your name, kept in the settings", "", 40))
        self.app.push(FormPanel(self.app, title, fields, "Save", on_accept))

    def saved_text(self, path: Path) -> str:
        session, behind_exit = self.session, ", without what is behind its exit"
        behind_death = ", with what is behind its end (Ctrl+E removes it)"
        tail = {"dead": behind_death, "exit": behind_exit}.get(session.tail_behind(), "")
        branches = " and its branches beside it" if branches_path(path).exists() else ""
        replay = session.origin.replay
        nobody = "" if replay.author or replay.co_authors else "; its player is unknown"
        name_note = ": Save as asks for your name" if self._asks_name else ""
        return f"Saved{tail}: {path}{branches}{nobody}{name_note}"

    @property
    def _asks_name(self) -> bool:
        """Whether the run's editor has no name yet."""
        author = self.session.origin.replay.author or self.app.settings.name
        return self.session.track.made != NONE and not author

    def keep(self) -> None:
        if self.session.tail_behind() == "dead":
            self.app.notify("Keys are pressed behind the death: take them out first, with Ctrl+E")
            return
        origin, track = self.session.origin, self.session.track
        self.editor.attempt(lambda: self.app.notify(keep_replay(self.app.player, replay_of_track(origin, track))))

    def copy_link(self) -> None:
        origin, track = self.session.origin, self.session.track
        copy_link(self.app, lambda: replay_link([replay_of_track(origin, track)]), title=self.session.name)

    def watch(self, *, film: bool = False) -> None:
        """Show it in the replay viewer, which makes films."""
        others = self.editor.others if self.editor.ghosts else ()
        beside = [self.session.recording(other.track, other.name) for other in others]
        beside = [replace(run, replay=replace(run.replay, author=run.replay.name)) for run in beside]
        viewer = ReplayScreen(self.app, [self.session.recording(), *beside], editable=False)
        self.app.push(viewer)
        if film:
            viewer.start_export()

    def offer_recovered(self) -> None:
        """Ask what to do with this run if it was open when the program crashed; name others.

        For a run recorded on another level ask whether to edit it on this one.
        """
        lost = list(lost_runs(self.app.player.folder))
        own = next((run for run in lost if self._is_of_this_run(run)), None)
        if own:
            self._offer(own)
        elif self.session.moved:
            rows: list[MenuRow] = [
                ("Edit it on this level", nothing, "Its keys stay; it is saved as a new recording"),
                ("Leave", self.close, ""),
            ]
            self.app.push(Menu(self.app, f"{self.session.name}: this level is not the one that was recorded", rows))
        elif lost:
            self.app.notify(f"Not saved last time: {_name_of(lost[0])}. Esc, Not saved last time")

    def _is_of_this_run(self, recovered_run: RecoveredRun) -> bool:
        opened, session = recovered_run.opened, self.session
        if opened.file.path or session.file.path:
            return opened.file.path == (session.file.path and session.file.path.absolute())
        return opened.track == session.track and same_level(opened.recording, session.origin)

    def list_recovered(self) -> None:
        rows: list[MenuRow] = [
            (_name_of(run), partial(self._offer, run), _when(run))
            for run in islice(lost_runs(self.app.player.folder), 8)
        ]
        if rows:
            self.app.push(Menu(self.app, "Not saved last time", [*rows, ("Back", nothing, "")]))
        else:
            self.app.notify("All runs that were edited are saved")

    def _offer(self, run: RecoveredRun) -> None:
        recover, discard = partial(self._recover, run), partial(remove_abandoned, run.file)
        self.ask_about_recovered(_name_of(run), recover, discard, about=f"{_when(run)}; every edit can be undone")


def _name_of(run: RecoveredRun) -> str:
    home = run.opened.file.path
    return home.name if home else run.opened.recording.name or "a run"


def _when(run: RecoveredRun) -> str:
    count = len(run.tracks)
    last = strftime("%Y-%m-%d %H:%M", localtime(run.file.stat().st_mtime)) if run.file.exists() else "gone"
    return f"{counted(count, 'edit')}, the last {last}"
