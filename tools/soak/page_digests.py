"""Plays every certificate, replay, scene and 200 crowded levels in Node and in Chromium: `tool soak.page_digests`.

Each must have the digest that it has here, on the plain memory. `--every 10` plays a tenth, `--only node` there alone.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path

from tests.support.page_digests import digests
from tests.support.page_runs import Run, digests_in_node, digests_in_page, page_runs
from tests.support.web_page import PYODIDE, browser, built_site, python_page, served


def in_node(runs: list[Run], folder: Path) -> dict[str, str]:
    """What Node says."""
    return digests_in_node(PYODIDE, runs, folder)


def in_chromium(runs: list[Run], folder: Path) -> dict[str, str]:
    """What Chromium says."""
    with browser() as chromium, served(folder / "site") as address, python_page(chromium, address) as page:
        page.set_default_timeout(0)
        return digests_in_page(page, runs)


PLACES = {"node": in_node, "chromium": in_chromium}


def main() -> int:
    """Play and compare; 1 if anything differs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--only", choices=PLACES)
    arguments = parser.parse_args()
    runs = page_runs()[:: arguments.every]
    ticks = sum(len(keys) // 2 for *_, keys in runs)
    expected = digests(runs)
    print(f"{len(runs)} runs, {ticks:,} ticks")
    wrong = 0
    with tempfile.TemporaryDirectory() as scratch:
        built_site(Path(scratch) / "site")
        for name in [arguments.only] if arguments.only else PLACES:
            started = time.perf_counter()
            found = PLACES[name](runs, Path(scratch))
            different = [run for run in expected if found.get(run) != expected[run]]
            wrong += len(different)
            seconds = time.perf_counter() - started
            print(
                f"{name:9} {len(runs) - len(different)} of {len(runs)} the same, {seconds:.0f} s",
                *different[:20],
                flush=True,
            )
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
