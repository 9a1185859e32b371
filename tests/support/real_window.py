"""A player at a real window under Xvfb, with keys and a mouse pressed by xdotool."""

from __future__ import annotations

import os
import shutil
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pygame
import pytest

TIMEOUT = 60.0
"""Seconds that each step may take on a busy machine."""

NEEDS_WINDOW = pytest.mark.skipif(
    not (shutil.which("Xvfb") and shutil.which("xdotool")), reason="Xvfb or xdotool is not here"
)


@contextmanager
def virtual_screen() -> Iterator[str]:
    """A virtual screen of its own."""
    reading, writing = os.pipe()
    server = subprocess.Popen(
        # Without -noreset the server starts afresh, deaf for a moment, whenever the last xdotool has gone.
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=[writing], stderr=subprocess.DEVNULL,
    )  # fmt: skip
    os.close(writing)
    with os.fdopen(reading) as pipe:
        number = pipe.readline().strip()
    try:
        assert number, "Xvfb does not start"
        yield f":{number}"
    finally:
        server.terminate()
        server.wait()


class Player:
    """Someone at the keyboard of a running game. ``words``: how it is called, ``play`` without any."""

    def __init__(self, display: str, home: Path, root: Path, *words: str) -> None:
        self.home = home
        self.environment = os.environ | {
            "DISPLAY": display, "SDL_VIDEODRIVER": "x11", "SDL_AUDIODRIVER": "dummy", "NINJA_GAME_HOME": str(home),
            "PYTHONPATH": str(root),
        }  # fmt: skip
        while not self.tool("getmouselocation"):
            time.sleep(0.05)
        self.game = subprocess.Popen(
            [sys.executable, "-m", "ninja_game", *(words or ["play"]), "--size", "792x600"],
            env=self.environment,
            cwd=home,
        )
        self.wait_for(lambda: bool(self.tool("search", "--pid", str(self.game.pid))), "window")
        # A window is not yet an answer to keys.
        self.wait_for(self.answers, "answer to a key")

    def tool(self, *words: str) -> str:
        """What xdotool answers."""
        done = subprocess.run(["xdotool", *words], env=self.environment, capture_output=True, text=True, check=False)
        return done.stdout.strip()

    def press(self, *keys: str) -> None:
        """Press and release keys, as fast as a quick player."""
        for key in keys:
            self.tool("key", "--delay", "60", key)
            time.sleep(0.25)

    def wait_for(self, condition: Callable[[], bool], what: str, *, seconds: float = TIMEOUT) -> None:
        """Wait until something is so."""
        end = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < end, f"no {what} after {seconds:.0f} s"
            assert self.game.poll() is None, f"the game has ended while waiting for {what}"
            time.sleep(0.1)

    def answers(self) -> bool:
        """Whether the game does what a key says: here, save a picture."""
        self.press("F12")
        return any((self.home / "exports").glob("*.png"))

    def count(self, table: str) -> int:
        """Rows of a table of the records, read as another program would."""
        with suppress(sqlite3.OperationalError):
            db = sqlite3.connect(f"file:{self.home / 'records.sqlite'}?mode=ro", uri=True)
            try:
                return int(db.execute(f"SELECT count(*) FROM {table}").fetchone()[0])
            finally:
                db.close()
        return -1

    def picture(self) -> pygame.Surface:
        """The stage without what is written over it, as the game saves it on request."""
        before = set((self.home / "exports").glob("*.png"))
        self.press("F12")
        self.wait_for(lambda: bool(set((self.home / "exports").glob("*.png")) - before), "picture")
        time.sleep(0.3)
        return pygame.image.load((set((self.home / "exports").glob("*.png")) - before).pop()).subsurface(
            24, 60, 744, 516
        )

    def differs_from(self, other: pygame.Surface) -> int:
        """How many px of a picture taken now are not those of another."""
        same = pygame.mask.from_threshold(self.picture(), (0, 0, 0), (8, 8, 8, 255), other)
        return 744 * 516 - same.count()

    def drag(self, *places: tuple[float, float]) -> None:
        """Press the left mouse button at the first px of the window, go to the others, release it."""
        window = self.tool("search", "--pid", str(self.game.pid)).split()[-1]
        for number, (x, y) in enumerate(places):
            self.tool("mousemove", "--window", window, str(round(x)), str(round(y)))
            time.sleep(0.12)
            if number == 0:
                self.tool("mousedown", "1")
                time.sleep(0.12)
        self.tool("mouseup", "1")
        time.sleep(0.12)
