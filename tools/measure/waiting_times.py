"""How long a player waits: for the main menu, for a level to be there, for a retry, for a screen to open.

    python3 tools/dev.py tool measure.waiting_times [--rounds 9]

Without a window (dummy driver) at 1584 x 1200; medians and worst of some rounds. The menu counts from the start of the
process to its first picture; the others from the key press to the picture that answers it.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

import pygame

from ninja_game.play.app import App, build_app
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.main_menu import MainMenu
from ninja_game.player.playthrough import LevelRun
from tools import ROOT

SIZE = (1584, 1200)
LIMITS = {"main menu": 1.5, "level to play": 0.15, "retry": 0.1}
"""Seconds that the project promises."""

ENTRIES = ("Play", "Levels", "Records", "Replays", "Settings", "Help")


def timed(work: Callable[[], object]) -> float:
    """Seconds that something takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def start_of_program(home: str) -> None:
    """A whole process up to its first picture."""
    command = [sys.executable, "-m", "ninja_game", "play", "--frames", "1", "--size", f"{SIZE[0]}x{SIZE[1]}"]
    environment = os.environ | {"NINJA_GAME_HOME": home, "PYTHONPATH": str(ROOT)}
    subprocess.run(command, env=environment, check=True)


def measure(rounds: int) -> dict[str, list[float]]:
    """Seconds of each wait, all rounds."""
    found: dict[str, list[float]] = {}
    with tempfile.TemporaryDirectory() as home:
        found["main menu"] = [timed(lambda: start_of_program(home)) for _ in range(rounds)]
        app = build_app(Path(home), size=SIZE)
        app.push(MainMenu(app))
        app.frame(16)
        for _ in range(rounds):
            for entry in ENTRIES:
                found.setdefault(f"screen: {entry}", []).append(timed(lambda name=entry: open_entry(app, name)))  # type: ignore[misc]
                app.pop()
            for level in app.player.catalogue.singles():
                course = LevelRun(app.player, level)

                def open_level(course: LevelRun = course) -> None:
                    app.push(LevelScreen(app, course))
                    app.frame(16)

                found.setdefault("level to play", []).append(timed(open_level))
                screen = app.top
                assert isinstance(screen, LevelScreen)
                screen.begin()
                for _ in range(40):
                    app.frame(25)
                found.setdefault("retry", []).append(timed(lambda: press(app, pygame.K_r)))
                app.pop()
        app.player.close()
    return found


def press(app: App, key: int) -> None:
    """A key press and the picture after it."""
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=key, scancode=0, mod=0, unicode=""))
    app.frame(16)


def open_entry(app: App, name: str) -> None:
    """Choose an entry of the main menu, and its first picture."""
    menu = app.top
    assert isinstance(menu, MainMenu)
    next(widget for widget in menu.widgets if getattr(widget, "text", "") == name).confirm()
    app.frame(16)


def main() -> int:
    """Exit code 1 if a promise is broken."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--rounds", type=int, default=9)
    found = measure(parser.parse_args().rounds)
    late = False
    for what, seconds in found.items():
        limit = LIMITS.get(what)
        late |= limit is not None and median(seconds) > limit
        promise = f"   promised {1000 * limit:.0f} ms" if limit else ""
        print(f"{what:18} {1000 * median(seconds):7.1f} ms   worst {1000 * max(seconds):7.1f} ms{promise}")
    return int(late)


if __name__ == "__main__":
    sys.exit(main())
