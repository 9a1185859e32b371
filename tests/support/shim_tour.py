"""Goes through every screen of the game over the page's pygame, without a page; prints what is drawn, as JSON.

To be run by itself, with the shim's folder first on the path: `python -m tests.support.shim_tour FOLDER`.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pygame

from ninja_game import __version__
from tests.support.draw_log import DrawLog
from tests.support.game_screens import run_tour
from tests.support.menu_driver import MenuDriver


class NoPage:
    """In the place of host.js: whatever is asked of it gives 0, but for what is here."""

    width, height, rate = 792, 600, 60

    def __getattr__(self, name: str) -> Callable[..., int]:
        return lambda *_: 0

    def events(self) -> str:
        """No event."""
        return "[]"

    def ticks(self) -> float:
        """Milliseconds."""
        return 1000 * time.monotonic()

    def measure(self, text: str, size: int) -> int:
        """A width."""
        return len(text) * size // 2


def screens(folder: Path) -> dict[str, str]:
    """By the name of each screen, its texts and draw calls."""
    shown: dict[str, str] = {}
    log = DrawLog()

    def show(driver: MenuDriver, name: str) -> None:
        driver.app.stack.redraw_all()
        with log.recording(driver.app.theme.palette) as lines:
            driver.app.draw()
        shown[name] = "\n".join(lines).replace(str(folder), "FOLDER").replace(__version__, "VERSION") + "\n"

    with log.installed():
        run_tour(folder, (NoPage.width, NoPage.height), show)
    return shown


if __name__ == "__main__":
    import_module("pygame.host").LINK.page = NoPage()
    pygame.event.clear = pygame.event.get  # type: ignore[assignment]
    json.dump(screens(Path(sys.argv[1])), sys.stdout)
