"""Measure what a picture costs while somebody edits: a crowded level in the editor, a long run in the TAS editor.

    python3 tools/dev.py tool measure.edits editor --size 1584x1200 --objects 500
    python3 tools/dev.py tool measure.edits tas --size 1920x1080 --plain

From an event to the finished picture, without a display: median, 99th percentile and maximum in ms of the longest turn
of the program's loop. In the editor the pointer moves, things are drawn, and all of them are dragged. In the TAS editor
edits of each sort are made by keys and mouse at random places of a run of 4,000 ticks. Exit code 1: a median above 4 ms
(16 while all is dragged); in the TAS editor above 16 ms or a worst of 50, on the plain memory a worst of 200.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from random import Random
from unittest.mock import patch

import pygame

from ninja_game.editor.brush import OBJECT_TYPES, placed
from ninja_game.editor.files import Source
from ninja_game.editor.specs import BODY, points
from ninja_game.editor.stamp import WHOLE, Selection, Stamp, put
from ninja_game.files.user_folder import bundled_levels
from ninja_game.formats.load import load_level
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.levels.warnings import level_findings
from ninja_game.runs.run import run_level
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.level import Level
from tests.support.level_maker import ROOM, Maker, examine
from tests.support.tas_driver import TasDriver
from tests.support.tas_edits import EDITS, go_at_random

TICKS = 4000


def tell(name: str, times: list[float]) -> tuple[float, float]:
    """Print a row of the table; median and maximum, ms."""
    times = sorted(times)
    middle, late = times[len(times) // 2], times[len(times) * 99 // 100]
    print(f"{name:26} median {middle:6.2f}   99 % {late:6.2f}   max {times[-1]:6.2f} ms", flush=True)
    return middle, times[-1]


def measure_editor(folder: Path, options: argparse.Namespace) -> bool:
    """Whether a median is above its limit."""
    maker = Maker(folder, options.size)
    maker.open("Editor")
    places = ((30 + 37 * k % 730, 30 + 53 * k % 540) for k in range(options.objects + 20))
    objects = tuple(placed(OBJECT_TYPES[2 + 7 * k % 15].spec, *place, "quarter") for k, place in enumerate(places))
    maker.editor.session.begin(Source(put(ROOM, Stamp({}, objects))))
    examine(maker.editor)
    maker.frames(5)
    print(f"{len(maker.draft.objects)} objects")

    def run(name: str, event: Callable[[int], int], x: float = 40, y: float = 100, most: float = 4.0) -> bool:
        times = []
        for k in range(options.edits):
            place = maker.app.canvas.point(*maker.at(x + 7 * k % 700, y + 3 * k % 400))
            pygame.event.post(pygame.Event(event(k), pos=place, button=1, rel=(0, 0), buttons=(0, 0, 0)))
            began = options.clock()
            maker.frames()
            times.append(1000 * (options.clock() - began))
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=place, button=1))
        maker.frames()
        return tell(name, times)[0] > most

    def pressed(k: int) -> int:
        return pygame.MOUSEBUTTONDOWN if k % 20 == 0 else pygame.MOUSEMOTION

    slow = run("pointer moves, tile", lambda _: pygame.MOUSEMOTION)
    slow |= run("tiles are drawn", pressed)
    maker.press("grave", "0")
    slow |= run("pointer moves, gold", lambda _: pygame.MOUSEMOTION)
    slow |= run("gold is drawn", pressed)
    tools = maker.editor.session.tools
    tools.snap = "px"
    for name, area in (("tiles and objects dragged", WHOLE), ("objects are dragged", None)):
        maker.chord("a", pygame.KMOD_LCTRL)
        tools.selection = Selection(area, tools.selection.parts)
        place = points(tools.draft.objects[100])[BODY]
        slow |= run(name, lambda k: pygame.MOUSEMOTION if k else pygame.MOUSEBUTTONDOWN, *place, most=16.0)
        maker.chord("z", pygame.KMOD_LCTRL)
    times = []
    for _ in range(20):
        began = options.clock()
        level_findings(maker.draft.level)
        times.append(1000 * (options.clock() - began))
    tell("check, beside the loop", times)
    maker.editor.session.close()
    maker.close()
    return slow


def random_keys(seed: int) -> bytes:
    """Keys for 4,000 ticks, each for up to 24 ticks."""
    rng = Random(seed)
    keys: list[int] = []
    while len(keys) < TICKS:
        keys += [rng.choice((0, 1, 2, 1, 2, 5, 6))] * rng.randrange(1, 25)
    return with_press_bits(keys[:TICKS])


def long_run() -> tuple[Level, bytes]:
    """A run that lives for 4,000 ticks, or nearly, in one of our levels with about the median number of objects."""
    levels = sorted(map(load_level, bundled_levels()), key=lambda level: len(level.objects))
    middle = len(levels) // 2
    runs = [(level, random_keys(seed)) for level in levels[middle - 4 : middle + 5] for seed in range(12)]
    return max(runs, key=lambda run: run_level(*run).ticks)


def measure_tas(folder: Path, options: argparse.Namespace) -> bool:
    """Whether the median or the worst of all edits is above its limit."""

    class Timed(TasDriver):
        worst = 0.0

        def frames(self, count: int = 1, ms: int = 25) -> None:
            for _ in range(count):
                began = options.clock()
                super().frames(1, ms)
                self.worst = max(self.worst, 1000 * (options.clock() - began))

    level, inputs = long_run()
    path = folder / "long.replay.txt"
    path.write_text(write_replay(Replay(inputs, len(inputs) - 1, "", name="long", level=level)), "utf-8")
    print(f"{len(level.objects)} objects, {len(inputs)} ticks")
    rng = Random(1)
    times: dict[str, list[float]] = {name: [] for name in EDITS}
    with patch("ninja_game.backend.memories.compiled_available", lambda: False) if options.plain else nullcontext():
        at = Timed(folder / "player", path, options.size)
        at.frames(20)
        for number in range(options.edits):
            name = list(EDITS)[number % len(EDITS)]
            go_at_random(at, rng)
            at.frames(3)
            at.worst = 0.0
            EDITS[name](at, rng)
            times[name].append(at.worst)
        at.session.close()
        at.close()
    for name, each in times.items():
        tell(name, each)
    median, worst = tell("all", [time for each in times.values() for time in each])
    return worst > 200.0 if options.plain else median > 16.0 or worst > 50.0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("where", choices=("editor", "tas"))
    parser.add_argument("--size", default="1584x1200", type=lambda text: tuple(map(int, text.split("x"))))
    parser.add_argument("--edits", type=int, default=300)
    parser.add_argument("--objects", type=int, default=500, help="in the editor's level")
    parser.add_argument("--plain", action="store_true", help="the TAS editor without Numba")
    parser.add_argument("--cpu", dest="clock", action="store_const", const=time.process_time,
                        default=time.perf_counter, help="count processor time: the machine is busy")  # fmt: skip
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        return int((measure_editor if options.where == "editor" else measure_tas)(Path(folder), options))


if __name__ == "__main__":
    sys.exit(main())
