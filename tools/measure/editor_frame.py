"""Measure what a picture of the editor costs with a crowded level: the pointer moved, things drawn, all dragged.

    python3 tools/dev.py tool measure.editor_frame --size 1584x1200 --objects 500

Prints median, 95th percentile and maximum in ms of a whole turn of the program's loop, without a display.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from ninja_game.levels.warnings import level_findings
from ninja_game.sim.level import Level


def summary(times: list[float]) -> str:
    """Median, 95th percentile and maximum of some times in ms."""
    times = sorted(times)
    return f"median {times[len(times) // 2]:6.2f}   95 % {times[len(times) * 95 // 100]:6.2f}   max {times[-1]:6.2f} ms"


def check_times(level: Level) -> list[float]:
    """How long the check for problems takes, ms, often enough for a summary."""
    times = []
    for _ in range(20):
        began = time.perf_counter()
        level_findings(level)
        times.append(1000 * (time.perf_counter() - began))
    return times


def main() -> int:
    """Print the table; exit code 1 if a median is above 4 ms, or 16 ms while everything is dragged."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--size", default="1584x1200")
    parser.add_argument("--objects", type=int, default=500)
    parser.add_argument("--pictures", type=int, default=200)
    options = parser.parse_args()
    os.environ |= {"PYGAME_HIDE_SUPPORT_PROMPT": "1", "SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    import pygame

    from ninja_game.editor.brush import OBJECT_TYPES, placed
    from ninja_game.editor.files import Source
    from ninja_game.editor.records import BODY, points
    from ninja_game.editor.stamp import WHOLE, Selection, Stamp, put
    from tests.support.level_maker import ROOM, Maker, examine

    width, height = map(int, options.size.split("x"))
    slow = False
    with tempfile.TemporaryDirectory() as folder:
        maker = Maker(Path(folder), (width, height))
        maker.open("Editor")
        places = ((30 + 37 * k % 730, 30 + 53 * k % 540) for k in range(options.objects + 20))
        objects = tuple(
            placed(OBJECT_TYPES[2 + 7 * k % 15].record, *place, "quarter") for k, place in enumerate(places)
        )  # fmt: skip
        maker.editor.commands.edit(Source(put(ROOM, Stamp({}, objects))))
        examine(maker.editor)
        maker.frames(5)
        print(f"{len(maker.draft.objects)} objects, {options.size}")

        def run(name: str, event: Callable[[int], int], x: float = 40, y: float = 100, most: float = 4.0) -> bool:
            times = []
            for k in range(options.pictures):
                place = maker.app.canvas.point(*maker.at(x + 7 * k % 700, y + 3 * k % 400))
                pygame.event.post(pygame.Event(event(k), pos=place, button=1, rel=(0, 0), buttons=(0, 0, 0)))
                maker.frames()
                times.append(maker.app.frame_ms)
            pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=place, button=1))
            maker.frames()
            print(f"{name:24} {summary(times)}")
            return sorted(times)[len(times) // 2] > most

        def pressed(k: int) -> int:
            return pygame.MOUSEBUTTONDOWN if k % 20 == 0 else pygame.MOUSEMOTION

        slow |= run("pointer moves, tile", lambda _: pygame.MOUSEMOTION)
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
        print(f"{'check for problems':24} {summary(check_times(maker.draft.level))}   (beside the loop)")
        maker.editor.session.close()
        maker.close()
    return int(slow)


if __name__ == "__main__":
    sys.exit(main())
