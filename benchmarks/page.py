"""Measure the page with the game in Chromium: how it starts, what it weighs, what its turns take of the processor.

    python3 tools/dev.py benchmark page --visits 5 --seconds 30

Starts: a first and a second visit, and one without a network. Turns: of the busy level, and of the start of a level;
time of the thread, not of the clock, so that what else the machine does hardly counts. 0 leaves out the one or other.
"""

from __future__ import annotations

import argparse
import gzip
import json
import statistics
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from ninja_game.web.pages.frame import GAME_PAGE
from ninja_game.web.site.build import build_site
from tests.support.visitor import LOADING
from tests.support.web_page import BUSY, CACHE, SIZE, browser, missing, run_in, served

PAINT = "() => performance.getEntriesByName('first-contentful-paint')[0].startTime"
RUNS = "#trouble[open], body[data-state]"


def visit(page: Any, address: str) -> tuple[float, float]:
    """Seconds until the bar is seen and until the menu is there."""
    page.goto(address + GAME_PAGE, wait_until="commit")
    page.locator(RUNS).first.wait_for(state="attached", timeout=120_000)
    assert not page.locator("#trouble[open]").count(), page.locator("#trouble").inner_text()
    menu = page.evaluate("() => performance.getEntriesByName('ninja-game: menu')[0].startTime")
    return page.evaluate(PAINT) / 1000, menu / 1000


def three_visits(chromium: Any, address: str) -> dict[str, tuple[float, float]]:
    """A browser's first visit, its second one, and one without a network."""
    context = chromium.new_context(viewport={"width": 1188, "height": 900})
    page = context.new_page()
    times = {"first": visit(page, address)}
    page.evaluate("() => navigator.serviceWorker.ready.then(() => ninjaGame.kept)")
    times["second"] = visit(page, address)
    context.set_offline(True)
    times["offline"] = visit(page, address)
    context.close()
    return times


def tell_starts(chromium: Any, address: str, visits: int) -> None:
    found = [three_visits(chromium, address) for _ in range(visits)]
    for name in found[0]:
        bar, menu = (statistics.median(times[name][k] for times in found) for k in (0, 1))
        worst = max(times[name][1] for times in found)
        print(f"{name + ' visit:':<15} bar after {bar:.2f} s, menu after {menu:.2f} s (worst {worst:.2f} s)")


KINDS = ["devtools.timeline", "toplevel"]
OPEN = "import boot\nboot.app().controls = Restless()\nbusy_screen(boot.app())"


def turns(chromium: Any, page: Any, act: Callable[[], object]) -> list[float]:
    """The thread's ms of every turn of a page while something is done."""
    chromium.start_tracing(page=page, categories=KINDS)
    act()
    events = json.loads(chromium.stop_tracing())["traceEvents"]
    return [each["tdur"] / 1000 for each in events if each["name"] == "FireAnimationFrame" and "tdur" in each]


def summary(name: str, found: list[float]) -> str:
    middle, high, worst = np.percentile(found, (50, 99, 100))
    return f"{name}: {len(found)} turns, median {middle:.1f} ms, 99th percentile {high:.1f}, worst {worst:.1f}"


def tell_turns(chromium: Any, address: str, seconds: int) -> None:
    page = chromium.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
    page.set_default_timeout(LOADING)
    page.goto(address + GAME_PAGE)
    page.locator("body[data-state=menu]").wait_for(state="attached")
    page.wait_for_timeout(5000)  # what the next visit needs is put aside

    def start() -> None:
        for key in ("Enter", "ArrowRight"):
            page.keyboard.press(key, delay=60)
            page.wait_for_timeout(2000)

    print(summary("start of a level", turns(chromium, page, start)))
    page.evaluate("() => (window.python = ninjaGame.python)")
    run_in(page, BUSY)
    page.evaluate("text => { python.runPython(text); }", OPEN)
    page.wait_for_timeout(1000)
    print(summary("busy level", turns(chromium, page, lambda: page.wait_for_timeout(1000 * seconds))))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--visits", type=int, default=5, help="browsers that visit, each three times")
    parser.add_argument("--seconds", type=int, default=30, help="of play in the busy level")
    options = parser.parse_args()
    if words := missing():
        raise SystemExit(words)
    with TemporaryDirectory() as folder, browser() as chromium:
        files = build_site(Path(folder) / "site", None, CACHE).values()
        size, packed = sum(map(len, files)) / 1e6, sum(len(gzip.compress(each, 9)) for each in files) / 1e6
        print(f"size: {size:.2f} MB, {packed:.2f} MB by gzip")
        with served(Path(folder) / "site") as address:
            if options.visits:
                tell_starts(chromium, address, options.visits)
            if options.seconds:
                tell_turns(chromium, address, options.seconds)


if __name__ == "__main__":
    main()
