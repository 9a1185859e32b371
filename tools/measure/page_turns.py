"""Measures in Chromium what each turn of the page takes of the processor: the busy level, and the start of a level.

Time of the thread, not of the clock: what else the machine does hardly counts.
python3 tools/dev.py tool measure.page_turns --seconds 30
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from typing import Any

import numpy as np

from tests.support.visitor import LOADING
from tests.support.web_page import BUSY, SIZE, new_site, run_in

KINDS = ["devtools.timeline", "toplevel"]
OPEN = "import boot\nboot.app().controls = Restless()\nbusy_screen(boot.app())"


def turns(chromium: Any, page: Any, act: Callable[[], object]) -> list[float]:
    """The thread's ms of every turn of a page while something is done."""
    chromium.start_tracing(page=page, categories=KINDS)
    act()
    events = json.loads(chromium.stop_tracing())["traceEvents"]
    return [each["tdur"] / 1000 for each in events if each["name"] == "FireAnimationFrame" and "tdur" in each]


def told(name: str, found: list[float]) -> str:
    middle, high, worst = np.percentile(found, (50, 99, 100))
    return f"{name}: {len(found)} turns, median {middle:.1f} ms, 99th percentile {high:.1f}, worst {worst:.1f}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=int, default=30, help="of play in the busy level")
    seconds = parser.parse_args().seconds
    with new_site() as (_, address, chromium):
        page = chromium.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
        page.set_default_timeout(LOADING)
        page.goto(f"{address}play.html")
        page.locator("body[data-state=menu]").wait_for(state="attached")
        page.wait_for_timeout(5000)  # what the next visit needs is put aside

        def start() -> None:
            for key in ("Enter", "ArrowRight"):
                page.keyboard.press(key, delay=60)
                page.wait_for_timeout(2000)

        print(told("start of a level", turns(chromium, page, start)))
        page.evaluate("() => (window.python = ninjaGame.python)")
        run_in(page, BUSY)
        page.evaluate("text => { python.runPython(text); }", OPEN)
        page.wait_for_timeout(1000)
        print(told("busy level", turns(chromium, page, lambda: page.wait_for_timeout(1000 * seconds))))


if __name__ == "__main__":
    main()
