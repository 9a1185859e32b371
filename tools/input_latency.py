"""From a key to the picture: what the game adds, measured in a real window (X11; Xvfb will do).

    xvfb-run -s "-screen 0 1700x1300x24" python tools/input_latency.py

A thread presses keys through the X server at random moments. Stages, each from the moment of the press: the event
reaches the program, the first tick that samples it ends, the first picture that shows it is in the window.
`docs/input-latency.md` holds the budget.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import threading
import time
from pathlib import Path
from random import Random

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

import pygame

from ninja_game.play.app import App
from ninja_game.play.controls import Keyboard
from ninja_game.play.course import SingleLevel
from ninja_game.play.level_screen import LevelScreen
from ninja_game.play.options import Options
from ninja_game.play.phase import Phase
from ninja_game.sim.level_data import LevelData, Record

SIZE = (1584, 1200)


class Presser(threading.Thread):
    """Presses and releases the left and right keys through `xdotool`; ``pressed_at`` is the last press's time."""

    def __init__(self, count: int) -> None:
        super().__init__(daemon=True)
        self.count = count
        self.pressed_at = 0.0
        self.done = False
        self._tool = subprocess.Popen(["xdotool", "-"], stdin=subprocess.PIPE, text=True)

    def _send(self, line: str) -> None:
        assert self._tool.stdin
        self._tool.stdin.write(line + "\n")
        self._tool.stdin.flush()

    def run(self) -> None:
        """One press every third of a second or so, at no fixed phase of ticks or pictures."""
        chance = Random(7)
        for number in range(self.count):
            key = "Right" if number % 2 else "Left"
            time.sleep(0.25 + 0.1 * chance.random())
            self.pressed_at = time.perf_counter()
            self._send(f"keydown {key}")
            time.sleep(0.15)
            self._send(f"keyup {key}")
        time.sleep(0.3)
        self.done = True
        if self._tool.stdin:
            self._tool.stdin.close()
        self._tool.wait(5)


def measure(app: App, screen: LevelScreen, count: int, rate: int) -> dict[str, list[float]]:
    """Times of each stage in ms."""
    presser = Presser(count)
    stages: dict[str, list[float]] = {"event": [], "tick": [], "picture": []}
    clock = pygame.time.Clock()
    last, seen, state = pygame.time.get_ticks(), 0.0, ""
    presser.start()
    while not presser.done:
        for event in pygame.event.get():
            if event.type == pygame.KEYDOWN and presser.pressed_at != seen:
                seen, state = presser.pressed_at, "waiting"
                stages["event"].append(1000 * (time.perf_counter() - seen))
        now = pygame.time.get_ticks()
        before = screen.attempt.simulation.tick
        screen.update(now - last)
        last = now
        if state == "waiting" and screen.attempt.simulation.tick > before and screen.last_frame:
            state = "ticked"
            stages["tick"].append(1000 * (time.perf_counter() - seen))
        app.draw()
        if state == "ticked":
            state = ""
            stages["picture"].append(1000 * (time.perf_counter() - seen))
        clock.tick(rate)
    return stages


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--presses", type=int, default=60)
    parser.add_argument("--rate", type=int, default=60, help="pictures a second")
    arguments = parser.parse_args()
    if not shutil.which("xdotool") or not os.environ.get("DISPLAY"):
        print("needs xdotool and an X display: see above", file=sys.stderr)
        return 2
    app = App(Options(), Keyboard(), size=SIZE)
    level = LevelData((0,) * 713, (Record(5, (396.0, 566.0)),))
    screen = LevelScreen(app, SingleLevel("latency", level, practice=True))
    app.push(screen)
    app.frame(0)
    screen.begin()
    assert screen.phase is Phase.PLAY
    # The keys go to the window that has the focus.
    window = pygame.display.get_wm_info()["window"]
    subprocess.run(["xdotool", "windowfocus", "--sync", str(window)], check=False, timeout=10)
    for name, times in measure(app, screen, arguments.presses, arguments.rate).items():
        times.sort()
        if times:
            print(
                f"{name:8} n {len(times):3}   median {times[len(times) // 2]:5.1f}   "
                f"p95 {times[int(len(times) * 0.95)]:5.1f}   worst {times[-1]:5.1f} ms"
            )
    pygame.quit()
    return 0


if __name__ == "__main__":
    sys.exit(main())
