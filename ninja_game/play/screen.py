"""The base of all screens, their stack, and work that continues under any screen."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import pygame

from ninja_game.levels.episodes import Mood
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.theme import Theme


class Host(Protocol):
    """The part of ``App`` that every screen needs; a protocol, since ``app`` imports this module."""

    theme: Theme
    mood: Mood

    def pop(self) -> None: ...

    def quit(self) -> None: ...


class BaseScreen:
    """One thing that fills the window: a menu, a level being played, a panel over it. Subclasses say what it does."""

    see_through = False  #: whether the screen below is drawn first
    wipes = True  #: whether it comes and goes with a wipe
    below_runs = False  #: whether the screen below is updated too
    plays = False  #: whether a level is played in it, over which nothing is to be written
    hides_game = False  #: whether it shows that nobody plays, and no notice
    small_notices = False  #: whether notices of one line are as high as a border
    foot_height = 1.0  #: px at the foot that notices leave free

    def __init__(self, app: Host) -> None:
        self.app = app
        self.redraw = True  #: set by the app when the whole window must be drawn again (resized, uncovered, recoloured)

    @property
    def theme(self) -> Theme:
        """The colours and letters of this screen, and its area in the window."""
        return self.app.theme

    @property
    def notice_room(self) -> tuple[float, float]:
        """The left and the right end of the area where notices may lie, logical px."""
        canvas = self.theme.canvas
        return canvas.logical((0, 0))[0], canvas.logical(canvas.window)[0]

    @property
    def mood(self) -> Mood:
        """The mood of this screen; by default that of the screen below."""
        return self.app.mood

    @property
    def music(self) -> str:
        """The name of the music while this screen is on top (ui/audio/music.py); "" if the music that plays goes on."""
        return ""

    def enter(self) -> None:
        """Called when this becomes the top screen: pushed, or uncovered again."""

    def look_again(self) -> None:
        """Called when levels or packs on the disk have changed while another screen was on top."""

    def leave(self) -> None:
        """Called when this is no longer the top screen: covered or popped. Looped sounds end here."""

    def capture(self, event: InputEvent) -> bool:
        """Handle an event before the keys that the app has on every screen; True if it was used."""
        return False

    def handle(self, event: InputEvent) -> None:
        """React to an event of the window."""

    def update(self, real_ms: int) -> None:
        """Let ``real_ms`` of real time pass, whole ms since the last picture."""

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """Draw; the px rectangles that changed, or None if all of the window may have changed."""
        raise NotImplementedError


class BackgroundTask:
    """Work that continues whatever screen is on top."""

    def update(self) -> None:
        """Called in each turn of the loop."""

    def end(self) -> None:
        """Called when the program ends."""


class ScreenStack:
    """The open screens. The top one gets the events; ``enter`` and ``leave`` are called as it changes."""

    def __init__(self) -> None:
        self.screens: list[BaseScreen] = []

    def __len__(self) -> int:
        return len(self.screens)

    def __contains__(self, screen: BaseScreen) -> bool:
        return screen in self.screens

    @property
    def top(self) -> BaseScreen:
        """The screen that gets the events. Raises IndexError if there is none."""
        return self.screens[-1]

    @property
    def below(self) -> BaseScreen | None:
        """The screen below the top one, if any."""
        return self.screens[-2] if len(self) > 1 else None

    def push(self, screen: BaseScreen) -> None:
        if self.screens:
            self.top.leave()
        self.screens.append(screen)
        self._uncover()

    def pop(self) -> None:
        """Go back to the screen below."""
        self.screens.pop().leave()
        self._uncover()

    def replace(self, screen: BaseScreen) -> None:
        self.screens.pop().leave()
        self.screens.append(screen)
        self._uncover()

    def clear(self) -> None:
        while self.screens:
            self.screens.pop().leave()

    def _uncover(self) -> None:
        self.redraw_all()
        if self.screens:
            self.top.enter()

    def redraw_all(self) -> None:
        for screen in self.screens:
            screen.redraw = True

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        """Draw the visible screens; the px rectangles that changed, or None if all of the window may have changed."""
        visible = self._from_last(lambda screen: not screen.see_through)
        if len(visible) > 1 and any(screen.redraw or screen.below_runs for screen in visible[1:]):
            visible[0].redraw = True
        changed: list[pygame.Rect] | None = []
        for screen in visible:
            whole = screen.redraw
            if not whole and screen is not self.top:
                # Covered by another screen, and unchanged: drawing it again would paint over that.
                continue
            rects = screen.draw(surface)
            screen.redraw = False
            changed = None if whole or rects is None or changed is None else changed + rects
        return changed

    def running(self) -> list[BaseScreen]:
        """The screens that are updated, lowest first."""
        return self._from_last(lambda screen: not screen.below_runs)

    def _from_last(self, covers: Callable[[BaseScreen], bool]) -> list[BaseScreen]:
        """The screens from the last one that covers those below it, or from the first."""
        ends = [index for index, screen in enumerate(self.screens) if covers(screen)]
        return self.screens[max(ends, default=0) :]
