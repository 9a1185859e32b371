"""The objects of the level with their ids, to be watched."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.menus.menu_screen import MenuScreen
from ninja_game.play.ui.list_view import ListView
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Button, Widget
from ninja_game.sim.kinds import DOOR, EXIT, GOLD, KIND_NAMES, KIND_OF, MINE

if TYPE_CHECKING:
    from ninja_game.play.app import App

Found = tuple[int, int, float, float]
"""Id, kind, x and y (px) of an object."""


class ObjectList(MenuScreen):
    """All objects. ``choose`` is called with a formula about the one that is chosen."""

    title = "Objects of this level"
    foot = "Enter proposes to watch an object; Esc goes back"

    def __init__(self, app: App, objects: Sequence[Found], choose: Callable[[str], object]) -> None:
        super().__init__(app)
        self._objects = objects
        self._choose = choose
        self.list = ListView((40, 88, 712, 430), 20, self._draw_row, self._chosen, empty="This level has no objects")
        self.list.fill(objects)

    def build(self) -> Sequence[Widget]:
        """The list and a way back."""
        return [self.list, Button((640, 530, 112, 24), "Back", self.back, size=10)]

    def draw_frame(self, surface: pygame.Surface) -> None:
        """The names of the columns."""
        super().draw_frame(surface)
        theme = self.app.theme
        for x, text in ((48, "Id"), (100, "What"), (300, "x, y at the start, px"), (500, "To be watched")):
            theme.text(surface, text, x, 68, size=10, colour=theme.palette.faint)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        id_, kind, px, py = self._objects[index]
        x, y, w, h = area
        theme.row(surface, (x, y, w, h - 1), chosen=focused, focused=False, filled=focused)
        cells = ((48, str(id_)), (100, KIND_NAMES[kind]), (300, f"{px:.6g}, {py:.6g}"), (500, proposal(id_, kind)))
        for at, text in cells:
            theme.text(surface, text, at, y + 4, size=10.5)

    def _chosen(self, index: int) -> None:
        self.app.pop()
        self._choose(proposal(*self._objects[index][:2]))


def proposal(id_: int, kind: int) -> str:
    """What one would watch of an object of a kind.

    >>> proposal(3, GOLD), proposal(4, EXIT)
    ('taken(3)', 'opened(4)')
    """
    if kind in (GOLD, MINE):
        return f"taken({id_})"
    if kind in (EXIT, DOOR):
        return f"opened({id_})"
    return f"object_x({id_})" if KIND_OF[kind].moves else f"status({id_})"
