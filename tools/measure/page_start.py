"""Measures how the page starts in Chromium, on a first and a second visit and without a network, and what it weighs.

python3 tools/dev.py tool measure.page_start --visits 5
"""

from __future__ import annotations

import argparse
import statistics
from typing import Any

from ninja_game.web.pages.frame import GAME
from tests.support.web_page import new_site

PAINT = "() => performance.getEntriesByName('first-contentful-paint')[0].startTime"
RUNS = "#trouble[open], body[data-state]"


def visit(page: Any, address: str) -> tuple[float, float]:
    """Seconds until the bar is seen and until the menu is there."""
    page.goto(address + GAME, wait_until="commit")
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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--visits", type=int, default=5, help="browsers that visit, each three times")
    visits = parser.parse_args().visits
    with new_site() as (files, address, chromium):
        print(
            f"size: {sum(f.size for f in files) / 1e6:.2f} MB, {sum(f.compressed for f in files) / 1e6:.2f} MB by gzip"
        )
        found = [three_visits(chromium, address) for _ in range(visits)]
    for name in found[0]:
        bar, menu = (statistics.median(times[name][k] for times in found) for k in (0, 1))
        worst = max(times[name][1] for times in found)
        print(f"{name + ' visit:':<15} bar after {bar:.2f} s, menu after {menu:.2f} s (worst {worst:.2f} s)")


if __name__ == "__main__":
    main()
