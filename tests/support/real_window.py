"""A player at a real window under Xvfb, with keys and a mouse pressed by xdotool."""

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

from tests.support.menu_driver import MenuDriver

TIMEOUT = 240.0  # seconds that each step may take on a busy machine

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


def difference(one: pygame.Surface, other: pygame.Surface) -> int:
    """How many px of two pictures of one size are not the same."""
    same = pygame.mask.from_threshold(one, (0, 0, 0), (8, 8, 8, 255), other)
    return one.get_width() * one.get_height() - same.count()


class Player:
    """Someone at the keyboard of a running game. ``words``: how it is called, ``play`` without any."""

    def __init__(self, display: str, home: Path, root: Path, *words: str) -> None:
        self.home = home
        if not (home / "settings.toml").exists():  # nothing moves without end
            (home / "settings.toml").write_text("[look]\nreduced-motion = true\n", "utf-8")
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
        self.await_answer()

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

    def await_answer(self) -> None:
        """A window is not yet an answer to keys: wait until all that were pressed have saved a picture.

        Keys that were pressed too early are lost or wait in the queue: few are pressed, so that few pictures come late.
        """
        pause = 1.0
        while not self.pictures():
            self.press("F12")
            with suppress(AssertionError):
                self.wait_for(lambda: bool(self.pictures()), "answer to a key", seconds=pause)
            pause *= 2
            assert pause < TIMEOUT, "no answer to a key"
        seen = -1
        while seen != (seen := len(self.pictures())):
            time.sleep(1.0)

    def pictures(self) -> set[Path]:
        """What the game has saved when F12 was pressed."""
        return set((self.home / "exports").glob("*.png"))

    def catch_up(self) -> None:
        """Wait until the game has done all that was pressed: the second picture is of a later turn than the first."""
        self.picture()
        self.picture()

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
        before = self.pictures()
        self.press("F12")
        self.wait_for(lambda: bool(self.pictures() - before), "picture")
        return pygame.image.load((self.pictures() - before).pop()).subsurface(24, 60, 744, 516)

    def still_picture(self) -> pygame.Surface:
        """A picture when nothing moves any more: three in a row are the same, but for a few px."""
        shown = [self.picture()]

        def is_still() -> bool:
            shown.append(self.picture())
            return len(shown) > 2 and all(difference(shown[-1], each) < 20 for each in shown[-3:-1])

        self.wait_for(is_still, "end of all movement")
        return shown[-1]

    def differs_from(self, other: pygame.Surface) -> int:
        """How many px of a picture taken now are not those of another."""
        return difference(self.picture(), other)

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


class GuidedPlayer(Player):
    """Someone to whom a guide shows the buttons: the same program without a window, led through the same screens."""

    def __init__(self, display: str, home: Path, root: Path) -> None:
        super().__init__(display, home, root)
        self.guide = MenuDriver(home / "guide")

    def click(self, place: tuple[float, float]) -> None:
        """Click a logical point in both."""
        self.drag(place)
        self.guide.mouse(*place)

    def choose(self, *texts: str) -> None:
        """Click the button with each text, one after the other, in both."""
        for text in texts:
            self.click(self.guide.button(text).centre)

    def press_both(self, *keys: str) -> None:
        """Press keys that lead to another screen, named as xdotool names them."""
        self.press(*keys)
        for key in keys:
            if key.startswith("ctrl+"):
                self.guide.chord(key.removeprefix("ctrl+"), pygame.KMOD_CTRL)
            else:
                self.guide.press(key.lower())


@contextmanager
def guided_player(home: Path, root: Path) -> Iterator[GuidedPlayer]:
    """One at a window of its own, which is closed in the end."""
    with virtual_screen() as display:
        player = GuidedPlayer(display, home, root)
        try:
            yield player
        finally:
            player.game.kill()
            player.game.wait(TIMEOUT)
            player.guide.close()
