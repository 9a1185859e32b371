"""The program with a window: its loop, its screens, its look."""

from __future__ import annotations

import io
import os
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import pygame

from ninja_game.files.writing import write_atomically
from ninja_game.play.audio.output import AudioOutput, NullAudio
from ninja_game.play.input.controls import Controls, Keyboard
from ninja_game.play.options import Options
from ninja_game.play.screen import TITLE, Panels, Screen, ScreenStack
from ninja_game.play.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.play.ui.palette import PALETTES
from ninja_game.play.ui.theme import Theme

if TYPE_CHECKING:
    from ninja_game.player.player_data import PlayerData

FALLBACK_RATE = 60
"""Pictures per second where the display does not say its rate."""


class App:
    """The window with its stack of screens, and what all screens share.

    ``controls``: keys to actions. ``audio_output``: sound. ``options``: what the player chose; after a change call
    ``apply_options``. ``size``: px of the window; by default the stage times the largest whole number that fits.
    """

    def __init__(
        self,
        options: Options | None = None,
        controls: Controls | None = None,
        audio_output: AudioOutput | None = None,
        *,
        size: tuple[int, int] | None = None,
    ) -> None:
        pygame.display.init()
        pygame.font.init()
        prefer_shared_memory()
        self.options = options or Options()
        self.controls: Controls = controls or Keyboard()
        self.audio_output: AudioOutput = audio_output or NullAudio()
        self.stack = ScreenStack()
        self.player: PlayerData | None = None
        self.panels: Panels | None = None
        self.hiding: type[Screen] | None = None
        self.running = True
        self.frame_ms = 0.0
        self._size = size or fitting_size()
        self._fullscreen = self.options.fullscreen
        self.surface = self._open_window()
        self.canvas = Canvas(self.surface.get_size())
        self.theme = Theme(PALETTES[self.options.palette], self.canvas)

    # --- the window ---

    def _open_window(self) -> pygame.Surface:
        flags = pygame.FULLSCREEN if self._fullscreen else pygame.RESIZABLE
        with warnings.catch_warnings():
            # Where no window manager runs, leaving full screen keeps the size: any size will do.
            warnings.simplefilter("ignore", RuntimeWarning)
            surface = pygame.display.set_mode((0, 0) if self._fullscreen else self._size, flags)
        pygame.display.set_caption(TITLE)
        return surface

    def apply_options(self) -> None:
        """Show what changed in the options: palette, full screen."""
        if self.options.fullscreen != self._fullscreen:
            self._fullscreen = self.options.fullscreen
            self.surface = self._open_window()
        self._relayout()

    def _relayout(self) -> None:
        """Draw everything again, at the window's present size and in the present palette."""
        self.surface = pygame.display.get_surface() or self.surface
        self.canvas = Canvas(self.surface.get_size())
        self.theme = Theme(PALETTES[self.options.palette], self.canvas)
        self.stack.redraw_all()

    # --- the screens ---

    @property
    def top(self) -> Screen:
        """The screen that gets the events."""
        return self.stack.top

    def push(self, screen: Screen) -> None:
        """Cover the top screen by another."""
        self.stack.push(screen)

    def replace(self, screen: Screen) -> None:
        """Put another screen in the top one's place."""
        self.stack.replace(screen)

    def pop(self) -> None:
        """Go back to the screen below; from the lowest one, end."""
        self.stack.pop()
        if not self.stack:
            self.running = False

    def pop_to(self, kind: type[Screen]) -> None:
        """Go back to the topmost screen of a kind, or to the lowest one."""
        self.stack.pop_to(kind)

    def quit(self) -> None:
        """End the program after this picture."""
        self.running = False

    # --- the loop ---

    def run(self, frames: int | None = None) -> None:
        """Run until a screen quits, or for ``frames`` pictures.

        Without a real display (SDL's dummy driver) a bounded run takes its time from the count of pictures, 60 a
        second, and does not wait: it always shows the same.
        """
        clock = pygame.time.Clock()
        simulated = frames is not None and pygame.display.get_driver() in {"dummy", "offscreen"}
        last = pygame.time.get_ticks()
        count = 0
        while self.running and self.stack and (frames is None or count < frames):
            count += 1
            now = last + (count * 1000 // 60 - (count - 1) * 1000 // 60) if simulated else pygame.time.get_ticks()
            self.frame(now - last)
            last = now
            if not simulated:
                clock.tick(self._rate())
        self.stack.clear()

    def _rate(self) -> int:
        return self.options.frame_limit or pygame.display.get_current_refresh_rate() or FALLBACK_RATE

    def frame(self, real_ms: int) -> None:
        """One turn of the loop: events, time, picture."""
        started = time.perf_counter()
        for event in pygame.event.get():
            self._handle(event)
            if not (self.running and self.stack):
                return
        for screen in self.stack.running():
            screen.update(real_ms)
        if self.stack:
            self.draw()
        self.frame_ms = 1000 * (time.perf_counter() - started)

    def _handle(self, event: pygame.Event) -> None:
        """Deal with what concerns the window; everything goes to the top screen."""
        if event.type == pygame.QUIT:
            self.quit()
        elif event.type in {pygame.VIDEORESIZE, pygame.WINDOWSIZECHANGED}:
            if not self._fullscreen:
                self._size = pygame.display.get_window_size()
            self._relayout()
        elif event.type in {pygame.WINDOWEXPOSED, pygame.WINDOWRESTORED}:
            self.stack.redraw_all()
        actions = self.controls.actions(event)
        if "fullscreen" in actions:
            self.options.fullscreen = not self.options.fullscreen
            self.apply_options()
        elif "boss" in actions:
            self._hide_the_game()
        elif "screenshot" in actions:
            self.save_screenshot(free_name(Path.cwd(), "ninja-game", ".png"))
        self.top.handle(event)

    def _hide_the_game(self) -> None:
        """Show something dull; the same key comes back."""
        if self.hiding and not isinstance(self.top, self.hiding):
            self.push(self.hiding(self))

    def draw(self) -> None:
        """Draw the screens that are seen and show what changed."""
        visible = self.stack.visible()
        if len(visible) > 1 and any(screen.redraw or screen.below_runs for screen in visible[1:]):
            visible[0].redraw = True
        changed: list[pygame.Rect] | None = []
        for screen in visible:
            whole = screen.redraw
            if not whole and screen is not self.top:
                # Covered and still: drawing it again would paint over what covers it.
                continue
            rects = screen.draw(self.surface)
            screen.redraw = False
            changed = None if whole or rects is None or changed is None else changed + rects
        if changed is None:
            pygame.display.flip()
        elif changed:
            pygame.display.update(changed)

    def save_screenshot(self, path: Path) -> None:
        """Write the picture as it is to a PNG file. Raises OSError, NinjaGameError."""
        picture = io.BytesIO()
        pygame.image.save(self.surface, picture, "picture.png")
        write_atomically(path, picture.getvalue())


def prefer_shared_memory() -> None:
    """Under X11 show pictures through shared memory instead of OpenGL, unless the environment says otherwise.

    Only the px that changed are sent then; through OpenGL the whole window goes to the card in every picture, and
    without a card that costs 20 ms (measured with tools/measure/frame_cost.py --display).
    """
    if pygame.display.get_driver() == "x11":
        os.environ.setdefault("SDL_FRAMEBUFFER_ACCELERATION", "0")


def fitting_size() -> tuple[int, int]:
    """The stage times the largest whole number that leaves the desktop some room."""
    sizes = pygame.display.get_desktop_sizes() or [(WIDTH, HEIGHT)]
    width, height = sizes[0]
    factor = max(1, min((width - 20) // WIDTH, (height - 80) // HEIGHT))
    return WIDTH * factor, HEIGHT * factor


def free_name(folder: Path, stem: str, suffix: str) -> Path:
    """A file name in a folder that is not taken: the stem with the next number."""
    number = 1
    while (folder / f"{stem}-{number}{suffix}").exists():
        number += 1
    return folder / f"{stem}-{number}{suffix}"
