"""A menu of stamps with their pictures, beside the rows."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pygame

from ninja_game.editor.files import open_source
from ninja_game.editor.specs import points
from ninja_game.editor.stamp import area_around, level_stamp
from ninja_game.errors import NinjaGameError
from ninja_game.play.app import App
from ninja_game.play.menu_screen import Menu, MenuRow
from ninja_game.sim.grid import cell_of
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import COLUMNS, Level, ObjectSpec
from ninja_game.view.sprites.thumbnail import thumbnail

_WIDE, _HIGH, _CELL = 44.0, 28.0, 10.0  # the most room of a picture, and the largest side of a cell in it, px


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
                (left, top), (width, height) = canvas.point(x - 13 - _WIDE / 2, y + h / 2), picture.get_size()
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
        side = self.theme.canvas.px(min(_CELL, _WIDE / width, _HIGH / height))
        picture = thumbnail(level, self.app.palette_in(self.mood), side * (COLUMNS + 2))
        area = picture.get_rect().clip((left * side, top * side, width * side, height * side))
        stamp_picture = pygame.Surface(area.size)
        stamp_picture.blit(picture, (0, 0), area)
        return stamp_picture
