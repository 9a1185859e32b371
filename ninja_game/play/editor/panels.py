"""The editor's own panels: which level to open, and the words of its help page."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ninja_game.play.app import App
from ninja_game.play.editor.controls import COMMANDS
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.help import HelpPage
from ninja_game.play.ui.widgets import Button, Widget
from ninja_game.player.catalogue import Entry


class LevelChoice(Browser):
    """The browser of levels, to choose one for the editor."""

    title = "Open a level"

    def __init__(self, app: App, choose: Callable[[Entry], object]) -> None:
        super().__init__(app)
        self._choose = choose
        self.list.hint = "Enter opens the level in the editor"

    def build(self) -> Sequence[Widget]:
        return [*list(super().build())[:3], Button((436, 470, 320, 32), "Edit", lambda: self._play(self.list.index))]

    def _play(self, index: int, *, practice: bool = False) -> None:
        if index < len(self.shown):
            self.app.pop()
            self._choose(self.shown[index])


_WORDS = """\
A first level: draw a floor with the left mouse button. Take the ninja from the objects at the right and click where \
it begins; take the exit, click where it is, then where its switch is. Test plays the level, Certify lets the solver \
look for a run, Save (in File) puts it into the menu Levels.
The right button erases, the middle one picks. Doors go to the nearest side of a cell; then click where the switch is. \
Tiles: 1 to 8 choose a shape, Q W A S its solid corner, E is full, D empty. Objects: the keys that the palette shows; \
W A S D turn them. Without a mouse: arrows move the pointer, Space draws, Shift and arrows move what is selected."""


def help_page(app: App) -> HelpPage:
    """What one has to know to begin, and all commands."""
    return HelpPage(app, "The editor", _WORDS, COMMANDS)
