"""Goes through every screen of the game over the page's pygame, without a page; prints what is drawn, as JSON.

To be run by itself, with the shim's folder first on the path: `python -m tests.support.shim_tour FOLDER`.
"""

import json
import sys
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pygame

from tests.support.game_screens import screens_as_texts


class NoPage:
    """In the place of host.js: whatever is asked of it gives 0, but for what is here."""

    width, height, rate = 792, 600, 60

    def __getattr__(self, name: str) -> Callable[..., int]:
        return lambda *_: 0

    input = SimpleNamespace(take=lambda: "[]", clipboard="", typing=False)
    painter = sounds = property(lambda self: self)

    def ticks(self) -> float:
        """Milliseconds."""
        return 1000 * time.monotonic()

    def measure(self, text: str, size: int) -> int:
        """A width."""
        return len(text) * size // 3


if __name__ == "__main__":
    import_module("pygame.host").LINK.page = NoPage()
    pygame.event.clear = pygame.event.get  # type: ignore[assignment]
    json.dump(screens_as_texts(Path(sys.argv[1]), (NoPage.width, NoPage.height)), sys.stdout)
