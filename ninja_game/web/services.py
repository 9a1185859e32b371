"""The page's interface to the game: the present screen, keys for touch, verdicts on a file, the player's data.

Modules that the first picture does not need are imported when they are needed.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from ninja_game.budget import PAGE_BUDGET, TURN_WORK
from ninja_game.errors import BudgetError, NinjaGameError
from ninja_game.formats.links import is_link, watched_colours, watched_names
from ninja_game.play.app import App
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.main import first_screen, watch_screen
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.settings import SPECS
from ninja_game.ui.input.keys import scancode_named

PHONE_TEXT = 150  # size of texts on a phone, percent: 9 px letters in a picture at half its usual width


class PageServices:
    """The page's interface to a running game. ``address``: the page's own, for links; ``small``: it is a phone's."""

    def __init__(self, app: App, address: str, small: bool = False) -> None:
        self.app = app
        if app.settings.site != address and SPECS["site"].fits(address):
            # Texts are large on a first visit with a phone; the player's own choice stays.
            text_size = PHONE_TEXT if small and not app.settings.site else app.settings.text_size
            app.change_settings(site=address, text_size=text_size)

    def state(self) -> str:
        """The present screen: the phase of a level ("ready", "play", "dead", "passed"), "replay", else "menu"."""
        top = self.app.top if self.app.stack else None
        if isinstance(top, LevelScreen) and top.phase is not Phase.PAUSED:
            return str(top.phase.value)
        return "replay" if isinstance(top, ReplayScreen) else "menu"

    def scancodes(self, action: str) -> list[int]:
        """The keys of an action, as the player has bound them."""
        return [code for code in map(scancode_named, self.app.controls.keys.get(action, ())) if code]

    def use_touch(self, wanted: bool) -> None:
        """Whether the game's texts name keys, or the page's buttons on the screen."""
        self.app.controls.touched = wanted
        self.app.stack.redraw_all()

    def notify(self, text: str) -> None:
        self.app.notify(text)

    def flush(self) -> None:
        self.app.player.store.flush()

    def watched(self, fragment: str) -> list[str]:
        """The files of this site that a link names, relative to the page. Raises LinkError."""
        return watched_names(fragment)

    def open_link(self, fragment: str, texts: Iterable[str]) -> str:
        """Open the part of the address after its #, over the main menu; "" or the error.

        ``texts``: those of the files that ``watched`` gave.
        """
        recordings = list(texts)
        try:
            if not (recordings or is_link(fragment)):
                return ""
            first = (
                watch_screen(recordings, watched_colours(fragment))
                if recordings
                else first_screen(fragment, None, body="circle", practice=False)
            )
            self.app.stack.clear()
            self.app.push(first(self.app))
        except NinjaGameError as error:
            if not self.app.stack:
                self.app.push(MainMenu(self.app))
            return str(error)
        return ""

    def backup(self) -> bytes:
        """All data of the player as a zip (``player.backup``). Raises FileError, OSError, sqlite3.Error."""
        from tempfile import TemporaryDirectory

        from ninja_game.player.backup import write_backup

        with TemporaryDirectory() as folder:
            path = Path(folder) / "player.zip"
            write_backup(self.app.player, path)
            return path.read_bytes()

    def take_in(self, data: bytes) -> str:
        """Import such a zip; the result, in lines. The page must then be loaded again. Raises NinjaGameError."""
        from ninja_game.player.backup import read_backup

        try:
            return "\n".join(read_backup(self.app.player, bytes(data)))
        except (NinjaGameError, OSError, sqlite3.Error) as error:
            raise NinjaGameError(str(error)) from None

    def verdicts(self, name: str, data: bytes) -> Iterator[str | None]:
        """A verdict on every recording in a file, one by one: JSON as from ``ninja-game verify --json``; None pauses.

        ``{"unreadable": message}`` for one that cannot be read, or takes more work than a page does.
        """
        from tempfile import TemporaryDirectory

        from ninja_game.files.bundled import bundled_levels
        from ninja_game.formats.load import load_levels
        from ninja_game.formats.n14.level_string import level_digest
        from ninja_game.runs.recording_reader import Unreadable, recordings_in
        from ninja_game.runs.verify import verify_in_slices, with_demands

        names: dict[str, str] = {}
        for levels in bundled_levels():
            names |= {level_digest(level.level): level.name for level in load_levels(levels)}
            yield None
        with TemporaryDirectory() as folder:
            path = Path(folder) / Path(name).name
            try:
                path.write_bytes(bytes(data))
            except (OSError, ValueError):
                yield json.dumps({"unreadable": f"{name!a:.200}: no file can have this name"})
                return
            for recording in recordings_in([path]):
                if isinstance(recording, Unreadable):
                    yield json.dumps({"unreadable": recording.message})
                    continue
                try:
                    verdict = yield from verify_in_slices(recording, "plain", budget=PAGE_BUDGET, slice_work=TURN_WORK)
                    fields = with_demands(verdict, names, only_these=False, strict=False).as_json() | {"file": name}
                except BudgetError as error:
                    error = replace(error, hint="`ninja-game verify` judges it on a desktop", option="")
                    fields = {"unreadable": str(error)}
                except NinjaGameError as error:
                    fields = {"unreadable": str(error)}
                yield json.dumps(fields)
