"""The window: opening, full screen and back, the game's name."""

from __future__ import annotations

import os
import warnings
from functools import cache, partial
from pathlib import Path

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import SETTINGS, user_folder
from ninja_game.files.writing import write_atomically
from ninja_game.player.settings import Settings, read_usable_settings
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas, png_of
from ninja_game.ui.theme import Theme, palette_named
from ninja_game.view.ninja.figure import icon

TITLE = "ninja-game"
LOGO = "NINJA"  # the name over the main menu, and on the first picture

_INVISIBLE = {"dummy", "offscreen", "evdev"}
_ICON = 64
WIDEST = 2200, 1300  # largest size of a window that no player has resized, px


class Window:
    """The window. ``size``: px; by default that of the settings, or ``fitting_size`` with ``wide``.

    Raises NinjaGameError where there is no display, unless SDL_VIDEODRIVER asks for a driver without one.
    """

    def __init__(self, size: tuple[int, int] | None, settings: Settings, *, wide: bool = False) -> None:
        prepare_sdl()
        pygame.display.init()
        if pygame.display.get_driver() in _INVISIBLE and not os.environ.get("SDL_VIDEODRIVER"):
            pygame.display.quit()
            raise NinjaGameError("there is no display; SDL_VIDEODRIVER=dummy plays without one")
        if pygame.display.get_driver() == "x11":
            # Through shared memory only changed px are sent; OpenGL sends the whole window in every picture, which
            # costs 20 ms without a graphics card (measured with benchmarks/frame_cost.py --display).
            os.environ.setdefault("SDL_FRAMEBUFFER_ACCELERATION", "0")
        if not settings.frame_limit:
            # Where SDL draws through a renderer, whole pictures are shown at the display's request.
            os.environ.setdefault("SDL_RENDER_VSYNC", "1")
        pygame.display.set_icon(icon(_ICON))
        wished = settings.window_width, settings.window_height
        pygame.display.set_mode(size or fitting_size(wished, wide=wide), pygame.RESIZABLE)
        pygame.display.set_caption(TITLE)
        self.fullscreen = False
        self._place: tuple[int, int] | None = None
        self._managed = pygame.display.get_driver() != "x11" or _has_window_manager()
        self._size = pygame.display.get_window_size()
        self._own_size = None if size else self._size
        if settings.fullscreen:
            self.set_fullscreen(wanted=True)

    @property
    def was_resized(self) -> bool:
        """Whether the player has resized the window; not if a size was given."""
        return not self.fullscreen and self._own_size not in (None, pygame.display.get_window_size())

    @property
    def surface(self) -> pygame.Surface:
        surface = pygame.display.get_surface()
        assert surface is not None  # noqa: S101 - the window is open
        return surface

    def set_fullscreen(self, *, wanted: bool) -> None:
        """Fill the display, or go back to the earlier size and place."""
        if wanted == self.fullscreen:
            return
        with warnings.catch_warnings():
            # The display module's own toggle does not restore the size.
            warnings.simplefilter("ignore", DeprecationWarning)
            window = pygame.Window.from_display_module()
        self.fullscreen = wanted
        if wanted:
            self._size, self._place = window.size, window.position
        if not self._managed:
            # SDL asks the window manager for full screen, and assumes that it gets it.
            window.size = pygame.display.get_desktop_sizes()[0] if wanted else self._size
            window.position = (0, 0) if wanted or self._place is None else self._place
        elif wanted:
            window.set_fullscreen(desktop=True)
        else:
            window.set_windowed()
            window.size = self._size
            if self._place is not None:
                window.position = self._place


@cache
def open_at_once(size: tuple[int, int] | None, *, wide: bool = False) -> Window:
    """The window with its first picture: the game's name, while the rest of the program loads; opened once.

    ``size``, ``wide``: as in ``Window``. Raises NinjaGameError where there is no display.
    """
    settings = read_usable_settings(user_folder() / SETTINGS)
    try:
        window = Window(size, settings, wide=wide)
    except pygame.error as error:
        raise NinjaGameError(f"the window cannot be opened: {error}") from None
    pygame.font.init()
    theme = Theme(palette_named(settings.palette), Canvas(window.surface.get_size()), settings.text_size)
    window.surface.fill(theme.palette.background)
    write = partial(theme.text, window.surface, x=WIDTH / 2, align="centre")
    write(text=LOGO, y=HEIGHT / 2 - 60, size=72, bold=True)
    write(text="loading", y=HEIGHT / 2 + 30, size=12, colour=theme.palette.faint)
    # A new window must process its events before it shows anything.
    pygame.event.pump()
    pygame.display.flip()
    return window


def save_picture(surface: pygame.Surface, path: Path) -> None:
    write_atomically(path, png_of(surface))


def prepare_sdl() -> None:
    """Set the variables that SDL reads when it starts."""
    # The window class, by which desktops find its icon and group windows.
    os.environ["SDL_VIDEO_X11_WMCLASS"] = TITLE  # pygame has put the name of the script there
    os.environ.setdefault("SDL_VIDEO_WAYLAND_WMCLASS", TITLE)


def _has_window_manager() -> bool:
    """Whether a window manager has put its name on the X display's root window, as all with full screen do."""
    import ctypes

    try:
        x = ctypes.CDLL("libX11.so.6")
    except OSError:
        return True
    x.XOpenDisplay.restype = ctypes.c_void_p
    x.XDefaultRootWindow.argtypes, x.XDefaultRootWindow.restype = [ctypes.c_void_p], ctypes.c_ulong
    x.XInternAtom.argtypes, x.XInternAtom.restype = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int], ctypes.c_ulong
    x.XListProperties.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.POINTER(ctypes.c_int)]
    x.XListProperties.restype = ctypes.POINTER(ctypes.c_ulong)
    x.XFree.argtypes = x.XCloseDisplay.argtypes = [ctypes.c_void_p]
    display, count = x.XOpenDisplay(None), ctypes.c_int()
    if not display:
        return True
    names = x.XListProperties(display, x.XDefaultRootWindow(display), count)
    supported = x.XInternAtom(display, b"_NET_SUPPORTING_WM_CHECK", 0) in names[: count.value]
    if names:
        x.XFree(names)
    x.XCloseDisplay(display)
    return supported


def fitting_size(wished: tuple[int, int] = (0, 0), *, wide: bool = False) -> tuple[int, int]:
    """A wished size, limited to the desktop; else the stage times the most halves that leave some room.

    On 1920 x 1080 that is 1188 x 900, enough for the editor's palette. ``wide``: nearly all of the desktop, 1880 x 980
    there, for the TAS editor's roll beside its level.
    """
    sizes = pygame.display.get_desktop_sizes() or [(WIDTH, HEIGHT)]
    width, height = sizes[0]
    if all(wished):
        return min(wished[0], width), min(wished[1], height)
    if wide:
        return max(WIDTH, min(width - 40, WIDEST[0])), max(HEIGHT, min(height - 100, WIDEST[1]))
    halves = max(2, min(2 * (width - 20) // WIDTH, 2 * (height - 80) // HEIGHT))
    return WIDTH * halves // 2, HEIGHT * halves // 2


WIPE_MS = 300
_EDGE = 5  # width of the curtain's edge, logical px


class Wipe:
    """A transition, or none. It only covers: the new screen already takes keys and lets time pass."""

    def __init__(self) -> None:
        self.before: pygame.Surface | None = None
        self._left = 0

    def begin(self, surface: pygame.Surface) -> None:
        self.before, self._left = surface.copy(), WIPE_MS

    def update(self, real_ms: int) -> bool:
        """Let time pass; whether it was going on."""
        going_on, self._left = self.before is not None, self._left - real_ms
        if self._left <= 0:
            self.before = None
        return going_on

    def draw(self, surface: pygame.Surface, theme: Theme) -> None:
        if self.before is None:
            return
        width, height = surface.get_size()
        share = self._left / WIPE_MS
        left = width - round(width * share * share)
        surface.blit(self.before, (left, 0), (left, 0, width - left, height))
        surface.fill(theme.palette.accent, (left, 0, theme.canvas.px(_EDGE), height))
