"""Let attract mode run and watch the memory: 30 minutes must not make the program grow.

    python3 tools/dev.py tool soak.attract_mode                30 minutes of game time, as fast as the machine can
    python3 tools/dev.py tool soak.attract_mode --minutes 1    a short one
    python3 tools/dev.py tool soak.attract_mode --real-time    at the pace of a player's screen

Runs without a window. Every minute of game time a line: memory, pictures drawn, replays begun. The first tenth is for
warming up (caches fill); after it the memory may grow by --allowed MiB.
"""

from __future__ import annotations

import argparse
import gc
import os
import sys
import tempfile
import time
from pathlib import Path

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

from ninja_game.play.app import build_app
from ninja_game.play.menus.main_menu import MainMenu

RATE = 60
"""Pictures a second of game time."""


def memory() -> float:
    """Resident memory of this process in MiB; where the system does not tell, its peak."""
    try:
        pages = int(Path("/proc/self/statm").read_text("ascii").split()[1])
        return pages * os.sysconf("SC_PAGESIZE") / 2**20
    except OSError:
        import resource

        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (2**20 if sys.platform == "darwin" else 2**10)


def main() -> int:
    """Exit code 1 if the memory has grown by more than is allowed."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--real-time", action="store_true")
    parser.add_argument("--allowed", type=float, default=4.0, metavar="MiB")
    options = parser.parse_args()
    frames = round(options.minutes * 60 * RATE)
    with tempfile.TemporaryDirectory() as home:
        app = build_app(Path(home), size=(792, 600))
        menu = MainMenu(app)
        app.push(menu)
        for frame in range(frames):
            started = time.perf_counter()
            app.frame((frame + 1) * 1000 // RATE - frame * 1000 // RATE)
            if options.real_time:
                time.sleep(max(0.0, 1 / RATE - (time.perf_counter() - started)))
            if frame == frames // 10:
                gc.collect()
                warm = memory()
            if (frame + 1) % (60 * RATE) == 0:
                minute = (frame + 1) // (60 * RATE)
                print(f"minute {minute}: {memory():.1f} MiB, {menu.attract.shown} replays", flush=True)
        gc.collect()
        growth = memory() - warm
        app.stack.clear()
        app.player.close()
    print(f"{frames} pictures, {menu.attract.shown} replays, {growth:+.2f} MiB after warming up")
    return 1 if growth > options.allowed else 0


if __name__ == "__main__":
    sys.exit(main())
