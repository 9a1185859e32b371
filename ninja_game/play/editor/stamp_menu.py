"""The menus of stamps: cells and objects that are kept as files, with their pictures beside the rows."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.editor.files import SUFFIX, Source, open_source, save as save_draft
from ninja_game.editor.specs import points
from ninja_game.editor.stamp import Stamp, area_around, level_stamp, with_stamp
from ninja_game.editor.tools import EditorTools
from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import file_stem
from ninja_game.files.user_folder import STAMPS, free_path, short_path
from ninja_game.play.app import App
from ninja_game.play.menu_screen import CANCEL, Menu, MenuRow, Question, ask_text
from ninja_game.sim.grid import cell_of
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import COLUMNS, Level, ObjectSpec
from ninja_game.view.sprites.thumbnail import thumbnail

_WIDTH, _HEIGHT, _CELL = 44.0, 28.0, 10.0  # the most room of a picture, and the largest side of a cell in it, px


STAMPS_SHOWN = 10  # the most stamps in their menu, the newest


class StampMenu(Menu):
    """A menu whose first rows are about stamps. ``files``: of these; one that cannot be read has no picture."""

    row_height, side, size = 37, 66, 11.0

    def __init__(self, app: App, title: str, files: Sequence[Path], rows: Sequence[MenuRow]) -> None:
        super().__init__(app, title, rows)
        self._files = files
        self._pictures: list[pygame.Surface | None] = []

    def draw_widgets(self, surface: pygame.Surface) -> None:
        super().draw_widgets(surface)
        canvas = self.theme.canvas
        self._pictures = self._pictures or [self._picture(path) for path in self._files]
        for picture, row in zip(self._pictures, self.widgets, strict=False):
            if picture:
                x, y, _, h = row.area
                (left, top), (width, height) = canvas.point(x - 13 - _WIDTH / 2, y + h / 2), picture.get_size()
                surface.blit(picture, (left - width // 2, top - height // 2))

    def _picture(self, path: Path) -> pygame.Surface | None:
        """The cells of a stamp, as large as there is room."""
        try:
            draft = open_source(path).draft
        except (NinjaGameError, OSError):
            return None
        stamp = level_stamp(draft)
        parts = [cell_of(*place) for spec in stamp.objects for place in points(spec).values()]
        if not (cells := [*stamp.tiles, *parts]):
            return None
        left, top, width, height = area_around(cells)
        # A far ninja, since no level is played without one; the stamp's own comes later, and is shown.
        level = Level(draft.level.tiles, (ObjectSpec(NINJA, (-400.0, -400.0)), *draft.level.objects))
        side = self.theme.canvas.px(min(_CELL, _WIDTH / width, _HEIGHT / height))
        picture = thumbnail(level, self.app.palette_in(self.mood), side * (COLUMNS + 2))
        area = picture.get_rect().clip((left * side, top * side, width * side, height * side))
        stamp_picture = pygame.Surface(area.size)
        stamp_picture.blit(picture, (0, 0), area)
        return stamp_picture


class StampCommands:
    """Pasting, keeping, renaming and deleting stamps."""

    def __init__(self, app: App, tools: EditorTools) -> None:
        self.app = app
        self._tools = tools
        self._folder = app.player.folder / STAMPS

    def choose(self) -> None:
        """Ask for a stamp to paste; what is selected, or was copied last, can be kept as one."""
        app, tools = self.app, self._tools
        tools.copy()
        keep = partial(self._keep, tools.clipboard) if tools.clipboard else None
        ask = keep and partial(ask_text, app, "Keep as a stamp", "Name of the stamp", "", "Keep", keep, 40)
        files = sorted(self._folder.glob(f"*{SUFFIX}"), key=lambda path: -path.stat().st_mtime)[:STAMPS_SHOWN]
        rows: list[MenuRow] = [(path.stem, partial(self._paste, path), short_path(path)) for path in files]
        rows.append(("Keep as a stamp...", ask, "What is selected; without that, what was copied last"))
        change: list[MenuRow] = [(path.stem, partial(self._change, path), short_path(path)) for path in files]
        if files:
            menu = StampMenu(app, "Rename or delete which stamp?", files, [*change, CANCEL])
            rows.append(("Rename or delete...", partial(app.push, menu), ""))
        app.push(StampMenu(app, "Stamps", files, [*rows, CANCEL]))

    def _paste(self, path: Path) -> None:
        with self.app.errors_as_notices():
            self._tools.clipboard = level_stamp(open_source(path).draft)
            self._tools.paste()

    def _keep(self, stamp: Stamp, name: str) -> None:
        with self.app.errors_as_notices():
            path = free_path(self._folder, file_stem(name.strip(), "stamp"), SUFFIX)
            path.parent.mkdir(parents=True, exist_ok=True)
            save_draft(Source(Draft(Level())), with_stamp(Draft(Level(), name), stamp), path)
            self.app.notify(f"Kept as a stamp: {path.stem}")

    def _change(self, path: Path) -> None:
        app, name = self.app, path.stem
        delete = partial(self._delete, path)
        ask = partial(ask_text, app, f"Rename {name}", "Name", name, "Rename", partial(self._rename, path), 40)
        question = Question(app, f"Delete the stamp {name}?", "Delete it", delete, short_path(path))
        rows: list[MenuRow] = [("Rename...", ask, ""), ("Delete...", partial(app.push, question), "")]
        app.push(Menu(app, name, [*rows, CANCEL]))

    def _rename(self, path: Path, name: str) -> None:
        stem = file_stem(name.strip(), path.stem)
        if stem != path.stem:
            with self.app.errors_as_notices():
                path.rename(free_path(self._folder, stem, SUFFIX))

    def _delete(self, path: Path) -> None:
        with self.app.errors_as_notices():
            path.unlink(missing_ok=True)
