"""The window among others: its name, its icon, and its way back from full screen to its size and place.

Runs under Xvfb with the window manager openbox, asked with xdotool and xprop; skipped where one of them is missing.
"""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.support.real_window import TIMEOUT

PROGRAMS = ("Xvfb", "openbox", "xdotool", "xprop")

pytestmark = pytest.mark.skipif(
    not all(map(shutil.which, PROGRAMS)), reason=f"one of {', '.join(PROGRAMS)} is not here"
)


class Desktop:
    """A screen of 1600 x 1000 px with the game in a window, and with a window manager or without."""

    def __init__(self, home: Path, root: Path, *, managed: bool = True) -> None:
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1600x1000x24", "-nolisten", "tcp", "-noreset"],
            pass_fds=[writing], stderr=subprocess.DEVNULL,
        )  # fmt: skip
        os.close(writing)
        with os.fdopen(reading) as pipe:
            display = f":{pipe.readline().strip()}"
        self.environment = os.environ | {
            "DISPLAY": display, "SDL_VIDEODRIVER": "x11", "SDL_AUDIODRIVER": "dummy", "NINJA_GAME_HOME": str(home),
            "PYTHONPATH": str(root),
        }  # fmt: skip
        self.managed = managed
        manager = ["openbox"] if managed else ["sleep", "1000"]
        self.manager = subprocess.Popen(manager, env=self.environment, stderr=subprocess.DEVNULL)
        while managed and "window id" not in self.ask("xprop", "-root", "_NET_SUPPORTING_WM_CHECK"):
            time.sleep(0.05)
        program = [sys.executable, "-m", "ninja_game", "play", "--size", "792x600"]
        self.game = subprocess.Popen(program, env=self.environment, cwd=home)
        self.window = ""

    def open(self) -> None:
        """Wait until the window is there, and managed."""
        self.wait_for(lambda: bool(self.ask("xdotool", "search", "--pid", str(self.game.pid))))
        self.window = self.ask("xdotool", "search", "--pid", str(self.game.pid)).split()[-1]
        if self.managed:
            self.wait_for(lambda: "WINDOW" in self.ask("xprop", "-root", "_NET_ACTIVE_WINDOW"))

    def ask(self, *words: str) -> str:
        """What a program answers."""
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False).stdout.strip()

    def wait_for(self, condition: Callable[[], bool]) -> None:
        """Wait until something is so."""
        end = time.monotonic() + TIMEOUT
        while not condition():
            assert time.monotonic() < end
            assert self.game.poll() is None
            time.sleep(0.1)

    def geometry(self) -> str:
        """Place and size of the window."""
        return self.ask("xdotool", "getwindowgeometry", "--shell", self.window)

    def close(self) -> None:
        """End all of it."""
        for process in (self.game, self.manager, self.server):
            process.terminate()
            process.wait()


@pytest.fixture
def desktop(tmp_path: Path, root: Path) -> Iterator[Desktop]:
    desktop = Desktop(tmp_path, root)
    try:
        desktop.open()
        yield desktop
    finally:
        desktop.close()


def test_full_screen_covers_a_screen_without_a_window_manager(tmp_path: Path, root: Path) -> None:
    desktop = Desktop(tmp_path, root, managed=False)
    try:
        desktop.open()
        before = desktop.geometry()
        assert "WIDTH=792" in before
        desktop.ask("xdotool", "windowfocus", "--sync", desktop.window)
        desktop.ask("xdotool", "key", "F11")
        desktop.wait_for(lambda: "X=0\nY=0\nWIDTH=1600\nHEIGHT=1000" in desktop.geometry())
        desktop.ask("xdotool", "key", "F11")
        desktop.wait_for(lambda: desktop.geometry() == before)
    finally:
        desktop.close()


def test_full_screen_leads_back_to_size_and_place(desktop: Desktop) -> None:
    desktop.ask("xdotool", "windowmove", "--sync", desktop.window, "100", "120")
    time.sleep(0.5)
    before = desktop.geometry()
    assert "WIDTH=792" in before
    desktop.ask("xdotool", "key", "F11")
    desktop.wait_for(lambda: "WIDTH=1600" in desktop.geometry())
    time.sleep(0.5)
    desktop.ask("xdotool", "key", "F11")
    desktop.wait_for(lambda: desktop.geometry() == before)


def test_window_has_a_name_of_its_own_and_an_icon(desktop: Desktop) -> None:
    properties = desktop.ask("xprop", "-id", desktop.window, "WM_CLASS", "_NET_WM_ICON")
    assert '"ninja-game"' in properties
    assert "Icon (64 x 64)" in properties
