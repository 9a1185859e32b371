"""What a picture costs: `benchmark frame_cost`, a busy level at 1584 x 1200 px on SDL's software renderer.

The first level and the next one, a retry, drawing alone (median, 99th percentile, worst), then the share of a core that
playing at 60 pictures a second takes; `work` is the time in which the processor was ours. The targets are 50 ms for a
level, 2 ms, 5 ms and 10 ms for drawing, and 25 %. `--display` uses the real display instead of the dummy driver;
`--level` another level.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

import pygame

from benchmarks.busy import Restless, busy_level, busy_screen, go_on
from ninja_game.formats.load import load_levels
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.play.app import App, build_app
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.sim.level import Level
from ninja_game.ui.audio.player import AudioOutput

SIZE = (1584, 1200)


def measure_drawing(app: App, screen: LevelScreen, pictures: int) -> dict[str, float]:
    """Times of drawing, ms: everything from the world to the window's surface, showing it included.

    ``work``: the time in which the processor was ours; on a machine that others use too only that tells.
    """
    times, work = [], []
    for number in range(pictures):
        for event in pygame.event.get():
            screen.handle(app.controls.decode(event))
        screen.update(16 + number % 3 // 2)
        go_on(screen)
        start, used = time.perf_counter(), time.thread_time()
        app.draw()
        work.append(1000 * (time.thread_time() - used))
        times.append(1000 * (time.perf_counter() - start))
    found = {}
    for name, each in (("", sorted(times)), ("work_", sorted(work))):
        found[f"{name}median_ms"] = round(each[len(each) // 2], 3)
        found[f"{name}p99_ms"] = round(each[int(len(each) * 0.99)], 3)
        found[f"{name}worst_ms"] = round(each[-1], 3)
    return found


def measure_seek(app: App, level: Level, ticks: int = 3000) -> dict[str, float]:
    """Going to ticks of a long replay at random, the picture of it included, ms."""
    frames = bytes(1 + number // 37 % 2 for number in range(ticks))
    viewer = ReplayScreen(app, [Recording(level, Replay.of_inputs(frames, level, name="long"))])
    # The ninja of these keys may die early: the rest of the run is made here as the viewer makes it when it opens.
    while not viewer.is_settled:
        viewer.update(0)
    viewer.end = viewer.length = ticks
    while viewer.playback.simulation.tick < ticks:
        viewer.playback.step()
    app.push(viewer)
    app.frame(0)
    rng = Random(5)
    times = []
    for _ in range(150):
        start = time.thread_time()
        viewer.seek(rng.randrange(ticks))
        app.draw()
        times.append(1000 * (time.thread_time() - start))
    app.pop()
    times.sort()
    return {"seek_median_ms": round(times[75], 1), "seek_worst_ms": round(times[-1], 1)}


def measure_load(app: App, seconds: float) -> float:
    """Share of a core, %, that playing takes at 60 pictures a second."""
    clock = pygame.time.Clock()
    started, used = time.perf_counter(), time.process_time()
    last = pygame.time.get_ticks()
    while time.perf_counter() - started < seconds:
        now = pygame.time.get_ticks()
        app.frame(now - last)
        last = now
        if isinstance(app.top, LevelScreen):
            go_on(app.top)
        clock.tick(60)
    return 100 * (time.process_time() - used) / (time.perf_counter() - started)


def timed(name: str, what: Callable[[], object]) -> dict[str, float]:
    """How long something takes, ms: by the clock, and the time in which the processor was ours."""
    start, used = time.perf_counter(), time.thread_time()
    what()
    work = 1000 * (time.thread_time() - used)
    return {f"{name}_ms": round(1000 * (time.perf_counter() - start), 1), f"{name}_work_ms": round(work, 1)}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--display", action="store_true", help="use the real display")
    parser.add_argument("--level", type=Path, help="measure on this level")
    parser.add_argument("--pictures", type=int, default=3000)
    parser.add_argument("--seconds", type=float, default=8.0)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    if not arguments.display:
        os.environ |= {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    level = load_levels(arguments.level)[0].level if arguments.level else busy_level()
    home = tempfile.TemporaryDirectory()
    app = build_app(Path(home.name), size=SIZE, controls=Restless(), audio_output=AudioOutput())
    app.change_settings(show_keys=True)
    result = {"things": float(len(level.objects))}
    for name in ("first_level", "next_level"):
        result |= timed(name, lambda: busy_screen(app, level))
        gc.freeze()  # as the program does
    screen = app.top
    assert isinstance(screen, LevelScreen)
    result |= measure_drawing(app, screen, arguments.pictures)

    def again() -> None:
        screen.retry()
        app.frame(0)

    result |= timed("retry", again)
    screen.begin()
    result |= measure_seek(app, level)
    result["core_percent"] = round(measure_load(app, arguments.seconds), 1)
    app.player.close()
    home.cleanup()
    print(json.dumps(result) if arguments.json else "\n".join(f"{key:18} {value}" for key, value in result.items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
