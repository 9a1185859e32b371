"""What fills the window: a screen, and the stack of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pygame

from ninja_game.play.input.bindings import InputEvent
from ninja_game.play.ui.canvas import HEIGHT, WIDTH
from ninja_game.play.ui.theme import Area, Theme

if TYPE_CHECKING:
    from ninja_game.play.app import App


class Screen:
    """One thing that fills the window: a menu, a level being played, a panel over it. Subclasses say what it does.

    ``see_through``: the screen below is drawn first. ``below_runs``: the screen below is updated too. ``redraw``: the
    app sets it when the whole window must be drawn again (resized, uncovered, another palette). ``notice_area``: where
    notices are shown, logical px.
    """

    see_through = False
    below_runs = False
    notice_area: Area = (0, HEIGHT - 24, WIDTH, 24)

    def __init__(self, app: App) -> None:
        self.app = app
        self.redraw = True

    @property
    def theme(self) -> Theme:
        """The look of what it draws, and where on the window that is."""
        return self.app.theme

    def enter(self) -> None:
        """Called when this becomes the top screen: pushed, or uncovered again."""

    def leave(self) -> None:
        """Called when this is no longer the top screen: covered or popped. Loops of sound end here."""

    def capture(self, event: InputEvent) -> bool:
        """Take an event before the keys that the app has on every screen; whether it was taken."""
        return False

    def handle(self, event: InputEvent) -> None:
        """React to an event of the window."""

    def update(self, real_ms: int) -> None:
        """Let ``real_ms`` of real time pass, whole ms since the last picture."""

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """Draw; the px rectangles that changed, or None if everything may have."""
        raise NotImplementedError


class ScreenStack:
    """Screens on top of each other; only the top one gets events."""

    def __init__(self) -> None:
        self._screens: list[Screen] = []

    def __bool__(self) -> bool:
        return bool(self._screens)

    def __len__(self) -> int:
        return len(self._screens)

    def __contains__(self, screen: Screen) -> bool:
        return screen in self._screens

    @property
    def top(self) -> Screen:
        """The screen that gets the events. Raises IndexError if there is none."""
        return self._screens[-1]

    def push(self, screen: Screen) -> None:
        """Cover the top screen by another."""
        if self._screens:
            self.top.leave()
        self._screens.append(screen)
        self._uncover()

    def pop(self) -> None:
        """Go back to the screen below."""
        self._screens.pop().leave()
        self._uncover()

    def replace(self, screen: Screen) -> None:
        """Put another screen in the top one's place."""
        self._screens.pop().leave()
        self._screens.append(screen)
        self._uncover()

    def clear(self) -> None:
        """Leave every screen."""
        while self._screens:
            self._screens.pop().leave()

    def _uncover(self) -> None:
        self.redraw_all()
        if self._screens:
            self.top.enter()

    def redraw_all(self) -> None:
        """Have every screen draw everything again."""
        for screen in self._screens:
            screen.redraw = True

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """Draw the screens that are seen; the px rectangles that changed, or None if everything may have."""
        first = len(self._screens) - 1
        while first > 0 and self._screens[first].see_through:
            first -= 1
        visible = self._screens[max(first, 0) :]
        if len(visible) > 1 and any(screen.redraw or screen.below_runs for screen in visible[1:]):
            visible[0].redraw = True
        changed: list[pygame.Rect] | None = []
        for screen in visible:
            whole = screen.redraw
            if not whole and screen is not self.top:
                # Covered and still: drawing it again would paint over what covers it.
                continue
            rects = screen.draw(surface)
            screen.redraw = False
            changed = None if whole or rects is None or changed is None else changed + rects
        return changed

    def running(self) -> list[Screen]:
        """The screens for which time passes, lowest first."""
        first = len(self._screens) - 1
        while first > 0 and self._screens[first].below_runs:
            first -= 1
        return self._screens[max(first, 0) :]
