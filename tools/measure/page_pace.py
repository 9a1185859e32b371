"""What a turn of the game costs in Chromium, and here: `tool measure.page_pace`, a busy level at 1584 x 1200 px.

A turn is everything that the page does for a picture: Python, the world, painting. Targets: median 6 ms, 99th
percentile 14 ms, none over 33 ms in a minute after the first second. `work`: the processor time of the page's thread in
a turn; on a machine that others use too only that tells. `gap`: the time from one picture to the next.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")

from ninja_game.files.user_folder import HOME_VARIABLE
from ninja_game.play.app import build_app
from ninja_game.play.audio.player import AudioOutput
from tests.support.web_page import BUSY, SIZE, browser, built_site, python_page, run_in, served
from tools.measure.busy import Restless, busy_screen, go_on

SETTLED_SECONDS = 1.0

START = f"""
import os
os.environ["{HOME_VARIABLE}"] = "/player"
import boot
import js

boot.start(js.host)
app = boot.app()
app.controls.held = Restless().held
app.change_settings(show_keys=True)
screen = busy_screen(app)
"""

PLAY = """
async (seconds) => {
  const turn = python.pyimport("boot").turn;
  const [goOn, screen] = ["go_on", "screen"].map((name) => python.globals.get(name));
  const [turns, gaps, starts] = [[], [], []];
  const begun = performance.now();
  await new Promise((resolve) => {
    const loop = (now) => {
      const started = performance.now();
      if (started - begun > 1000 * seconds) return resolve();
      goOn(screen);
      turn(now);
      turns.push(performance.now() - started);
      if (starts.length) gaps.push(now - starts[starts.length - 1]);
      starts.push(now);
      requestAnimationFrame(loop);
    };
    requestAnimationFrame(loop);
  });
  const settled = starts.findIndex((now) => now - starts[0] > 1000);
  return { turn: turns.slice(settled), gap: gaps.slice(settled) };
}
"""


def summary(times: Sequence[float]) -> dict[str, float]:
    """Median, 99th percentile and worst of some times."""
    ordered = sorted(times)
    shares = {"median": 0.5, "p90": 0.9, "p99": 0.99, "p99.9": 0.999, "worst": 1.0}
    last = len(ordered) - 1
    return {name: round(ordered[int(share * last)], 2) for name, share in shares.items()} | {"pictures": len(ordered)}


def in_the_page(seconds: float, folder: Path) -> dict[str, dict[str, float]]:
    """Turns and gaps between pictures in Chromium, ms."""
    site = built_site(folder)
    with browser() as chromium, served(site) as address, python_page(chromium, address) as page:
        page.set_default_timeout(0)
        run_in(page, BUSY)
        page.evaluate("text => { python.runPython(text); }", START)
        chromium.start_tracing(page=page, categories=["devtools.timeline"])
        measured: dict[str, Any] = page.evaluate(PLAY, seconds + SETTLED_SECONDS)
        events = json.loads(chromium.stop_tracing())["traceEvents"]
    work = [event["tdur"] / 1000 for event in events if event["name"] == "FireAnimationFrame" and "tdur" in event]
    measured["work"] = work[-len(measured["turn"]) :]
    return {f"page {name}": summary(times) for name, times in measured.items()}


def here(seconds: float, folder: Path) -> dict[str, dict[str, float]]:
    """Turns of the same here, without a display, ms."""
    app = build_app(folder, size=SIZE, controls=Restless(), audio_output=AudioOutput())
    app.change_settings(show_keys=True)
    screen = busy_screen(app)
    times, work = [], []
    for number in range(int(60 * seconds)):
        go_on(screen)
        started, used = time.perf_counter(), time.thread_time()
        app.frame(16 + (number % 3 > 0))
        work.append(1000 * (time.thread_time() - used))
        times.append(1000 * (time.perf_counter() - started))
    app.player.close()
    return {"here turn": summary(times[60:]), "here work": summary(work[60:])}


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        site, player = Path(scratch) / "site", Path(scratch) / "player"
        result = in_the_page(arguments.seconds, site) | here(arguments.seconds, player)
    if arguments.json:
        print(json.dumps(result))
    else:
        print(f"{SIZE[0]} x {SIZE[1]} px, ms")
        for name, values in result.items():
            print(f"{name:10}", "  ".join(f"{key} {value}" for key, value in values.items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
