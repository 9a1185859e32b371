"""A screen that lists the folders and files of a folder, to choose a file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pygame

from ninja_game.files.reading import files_in
from ninja_game.files.user_folder import short_path
from ninja_game.play.app import App
from ninja_game.play.menu_screen import MenuScreen
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Widget

_BOTTOM = 546.0


class FilesScreen(MenuScreen):
    """A list of files to choose from. ``folder``: the one that is shown; ``top``: the upper edge of the list, px."""

    foot = "Enter opens a folder or a file; Esc goes back"
    suffixes: Sequence[str] = ()  #: ends of the names of the files that are listed

    def __init__(self, app: App, folder: Path, top: float = 62) -> None:
        super().__init__(app)
        self.folder = folder
        self.paths: list[Path] = []
        self.list = ListView((44, top, 712, _BOTTOM - top), 26, self._draw_row, self._choose, opens=True)

    def build(self) -> Sequence[Widget]:
        self.look()
        return [self.list]

    def look(self) -> None:
        """List the folder."""
        self.title = short_path(self.folder)[-40:]
        named = [name for name in files_in(self.folder) if name.lower().endswith(tuple(self.suffixes))]
        self.paths = [self.folder.parent, *_folders_in(self.folder), *self.fitting(named)]
        self.list.fill(self.paths)

    def fitting(self, names: Sequence[str]) -> list[Path]:
        """The names, of files in the folder, that are listed."""
        return [self.folder / name for name in names]

    def open_file(self, path: Path) -> None:
        """Do what the screen is for with the file that was chosen."""
        raise NotImplementedError

    def open_folder(self, folder: Path) -> None:
        self.folder, self.list.index, self.redraw = folder, 0, True
        self.look()

    def _choose(self, index: int) -> None:
        path = self.paths[index]
        if path.is_dir():
            self.open_folder(path)
        else:
            self.open_file(path)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        path, (x, y, w, h) = self.paths[index], area
        theme.row(surface, (x, y + 1, w, h - 2), chosen=index == self.list.index, focused=focused, radius=3)
        up, folder = path == self.folder.parent, path.is_dir()
        name = "..  the folder above" if up else f"{path.name}/" if folder else path.name
        theme.text(surface, name, x + 10, y + 6, size=11, bold=folder, width=w - 20)


def _folders_in(folder: Path) -> list[Path]:
    try:
        return sorted(path for path in folder.iterdir() if path.is_dir() and not path.name.startswith("."))
    except OSError:
        return []
