"""A pack that somebody sent is opened: from a zip, or from the link in the clipboard."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.formats.links import link_kind
from ninja_game.play.app import App
from ninja_game.play.clipboard import pasted_text
from ninja_game.play.menu_screen import CANCEL, Menu, MenuRow
from ninja_game.play.panels.files import FilesScreen

Take = Callable[[Path], object]  # gets the path of a zip, or a link of a pack as a path


def open_pack(app: App, title: str) -> None:
    """Ask where a pack comes from; the screen on top gets it like a file that is dropped."""

    def take(path: Path) -> None:
        pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))

    rows: list[MenuRow] = [
        ("From a zip...", lambda: app.push(ZipsScreen(app, take)), "It can be dropped on the window, too"),
        ("From a link", partial(paste_link, app, take), "Copy all of the link first"),
        CANCEL,
    ]
    app.push(Menu(app, title, rows))


def paste_link(app: App, take: Take) -> None:
    """Take the link of a pack in the clipboard."""
    with app.errors_as_notices():
        text = pasted_text()
        if link_kind(text) != "pack":
            raise NinjaGameError("there is no link of a pack in the clipboard: copy all of it first")
        take(Path(f"#{text.partition('#')[2]}"))


class ZipsScreen(FilesScreen):
    """Chooses the zip of a pack; it starts in the folder of downloads."""

    foot = "Enter opens a folder, or receives the pack of a zip; Esc goes back"
    suffixes = (".zip",)

    def __init__(self, app: App, take: Take) -> None:
        home, loaded = Path.home(), Path.home() / "Downloads"
        super().__init__(app, loaded if loaded.is_dir() else home)
        self._take = take

    def look(self) -> None:
        """The newest zip is chosen at first."""
        super().look()
        zips = [path for path in self.paths if path.is_file()]
        with self.app.errors_as_notices():
            if zips and not self.list.index:
                self.list.select(self.paths.index(max(zips, key=lambda path: path.stat().st_mtime)))

    def open_file(self, path: Path) -> None:
        self.app.pop()
        self._take(path)
