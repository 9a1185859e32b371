"""How long from a key press to the picture that shows it, measured through a real X server.

    python3 tools/dev.py tool measure.input_latency --presses 200 --rate 60

Starts Xvfb, plays a level, and presses the jump key at random moments through the server
(XTEST), as a keyboard driver would. Three moments are noted for each press: the press itself, the tick that samples it,
the end of the picture after that tick. What keyboard and display add is in docs/input-latency.md.
"""

from __future__ import annotations

import argparse
import ctypes
import ctypes.util
import os
import subprocess
import tempfile
import threading
import time
from pathlib import Path
from random import Random

os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

import pygame

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.play.app import build_app
from ninja_game.play.input.bindings import Bindings
from ninja_game.play.level.screen import LevelScreen
from ninja_game.player.catalogue import Entry
from ninja_game.player.playthrough import LevelRun
from ninja_game.sim.inputs import JUMP_HELD

LEVEL = parse_level_string("0" * 713 + "|5^300,566!11^500,564,600,564")
KEYSYM_Z = 0x7A


class Keys:
    """Presses keys through an X server, without a window of its own."""

    def __init__(self) -> None:
        self.x11 = ctypes.CDLL(ctypes.util.find_library("X11") or "libX11.so.6")
        self.xtst = ctypes.CDLL(ctypes.util.find_library("Xtst") or "libXtst.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(None))
        self.code = self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(KEYSYM_Z))

    def send(self, *, down: bool) -> float:
        """Press or release; when that was."""
        now = time.perf_counter()
        self.xtst.XTestFakeKeyEvent(self.display, self.code, int(down), ctypes.c_ulong(0))
        self.x11.XFlush(self.display)
        return now


class NotingBindings(Bindings):
    """The game's bindings, which note when a jump was first seen held."""

    sampled: float | None = None
    waiting = False

    def held(self) -> int:
        """What is held, with the moment of the first jump after ``waiting`` was set."""
        bits = super().held()
        if bits & JUMP_HELD and self.waiting:
            self.waiting = False
            self.sampled = time.perf_counter()
        return bits


def start_server() -> subprocess.Popen[bytes]:
    """A virtual X server; its number is in DISPLAY then."""
    reading, writing = os.pipe()
    command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x768x24"]
    server = subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        os.environ["DISPLAY"] = f":{pipe.readline().strip()}"
    os.environ["SDL_VIDEODRIVER"] = "x11"
    return server


def press_at_random(
    keys: Keys, controls: NotingBindings, presses: int, times: list[float], done: threading.Event
) -> None:
    """The player: in a thread of its own, so that presses come at any moment of the game's loop."""
    rng = Random(1)
    for _ in range(presses):
        time.sleep(0.25 + 0.1 * rng.random())
        controls.waiting = True
        times.append(keys.send(down=True))
        time.sleep(0.12)
        keys.send(down=False)
    time.sleep(0.3)
    done.set()


def measure(presses: int, rate: int) -> list[tuple[float, float]]:
    """Of each press: ms until it was sampled, ms until the picture after that."""
    with tempfile.TemporaryDirectory() as home:
        controls = NotingBindings()
        app = build_app(Path(home), size=(792, 600), controls=controls)
        screen = LevelScreen(app, LevelRun(app.player, Entry(NamedLevel("latency", "", "", LEVEL, ""), "yours")))
        app.push(screen)
        screen.begin()
        times: list[float] = []
        found: list[tuple[float, float]] = []
        done = threading.Event()
        threading.Thread(target=press_at_random, args=(Keys(), controls, presses, times, done), daemon=True).start()
        clock = pygame.time.Clock()
        while not done.is_set():
            app.frame(clock.tick(rate))
            shown = time.perf_counter()
            if controls.sampled is not None:
                found.append((1000 * (controls.sampled - times[-1]), 1000 * (shown - times[-1])))
                controls.sampled = None
        app.stack.clear()
        pygame.quit()
    return found


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--presses", type=int, default=200)
    parser.add_argument("--rate", type=int, default=60, help="pictures a second")
    options = parser.parse_args()
    presses = options.presses
    server = start_server()
    try:
        found = measure(presses, options.rate)
    finally:
        server.terminate()
        server.wait()
    print(f"{len(found)} of {presses} presses were sampled")
    for what, column in (("press to sample", 0), ("press to picture", 1)):
        sorted_ms = sorted(row[column] for row in found)
        middle, late = sorted_ms[len(sorted_ms) // 2], sorted_ms[int(len(sorted_ms) * 0.95)]
        print(
            f"{what:16}  median {middle:5.1f} ms   95 % {late:5.1f} ms   mean {sum(sorted_ms) / len(sorted_ms):5.1f} ms"
        )


if __name__ == "__main__":
    main()
