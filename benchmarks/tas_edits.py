"""From a key to its picture in the TAS editor: `benchmark tas_edits`, a run of 4,000 ticks in a level of 61 objects.

300 random edits at random ticks (a key down or up, ticks cleared, put in, taken out, undone) by the events of the
keyboard, at 1584 x 1200 px on SDL's software renderer: the processor time from the event to the finished picture, in
which the run is simulated again up to its end. Then the same with all overlays on. The targets are 7.4 ms in the median
and 15.8 ms at worst, and 10 ms with overlays. `loop_s`, the time of a plain loop, says how fast the machine is; what
others do to its caches it does not show: `frame_cost`, run beside it, does.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
from pathlib import Path
from random import Random

import pygame

from benchmarks.busy import busy_level
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.play.app import App, build_app
from ninja_game.sim import kinds
from ninja_game.sim.level import Level
from ninja_game.tas.files import open_run
from ninja_game.tas_editor.screen import TasScreen
from ninja_game.ui.audio.player import AudioOutput
from ninja_game.ui.input.keys import SCANCODES
from ninja_game.view.overlays import OVERLAY_ACTIONS

OBJECTS = 61  # of the busy level: ninja, exit, drones, thwumps, floor guards, bounce blocks, turrets, two mines
KEYS = ("a", "d", "z", "delete", "i", "backspace", "ctrl+z")


def random_keys(ticks: int, seed: int = 3) -> bytes:
    """Keys held for 4 to 19 ticks each."""
    rng, keys = Random(seed), bytearray()
    while len(keys) < ticks:
        keys += bytes([rng.choice((0, 1, 2, 5, 6))]) * rng.randrange(4, 20)
    return bytes(keys[:ticks])


def press(key: str) -> None:
    """The events of a key that is pressed and released, with Ctrl if its name says so."""
    modifiers = pygame.KMOD_LCTRL if key.startswith("ctrl+") else 0
    for kind in (pygame.KEYDOWN, pygame.KEYUP):
        scancode = SCANCODES[key.removeprefix("ctrl+")]
        pygame.event.post(pygame.Event(kind, key=0, scancode=scancode, mod=modifiers, unicode=""))


def measure_edits(app: App, screen: TasScreen, edits: int, name: str) -> dict[str, float]:
    """Processor time from the key to the picture, ms."""
    rng, editor = Random(5), screen.editor
    times: list[float] = []
    while len(times) < edits:
        first = rng.randrange(len(editor.track) - 12)
        editor.select(first, first + rng.randrange(1, 12))
        for _ in range(2):  # the picture of the place, and one in which nothing happens
            app.frame(16)
        before = editor.track
        press(rng.choice(KEYS))
        start = time.process_time()
        app.frame(16)
        spent = 1000 * (time.process_time() - start)
        if editor.track is before:  # there was no key to clear, nothing to undo
            continue
        if not editor.session.timeline.is_complete:
            raise SystemExit("the run was not simulated up to its end in one picture")
        times.append(spent)
    times.sort()
    places = {"median": edits // 2, "p99": edits * 99 // 100, "worst": -1}
    return {f"{name}_{place}_ms": round(times[k], 2) for place, k in places.items()}


def loop_seconds() -> float:
    """Processor time of a plain loop, which says how fast the machine is at this moment."""
    start, total = time.process_time(), 0
    for number in range(2_000_000):
        total += number * number % 7
    return round(time.process_time() - start, 3)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--ticks", type=int, default=4000)
    parser.add_argument("--edits", type=int, default=300)
    parser.add_argument("--size", default="1584x1200", metavar="WIDTHxHEIGHT", help="of the window, px")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    os.environ |= {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}
    width, height = map(int, options.size.split("x"))
    busy = busy_level()
    things = tuple(thing for thing in busy.objects if thing.kind != kinds.LAUNCHER)  # rockets would end the run
    level = Level(busy.tiles, things[:OBJECTS])
    result = {"objects": len(level.objects), "ticks": options.ticks, "edits": options.edits, "loop_s": loop_seconds()}
    with tempfile.TemporaryDirectory() as home:
        run = Path(home, "busy.replay.txt")
        run.write_text(write_replay(Replay.of_inputs(random_keys(options.ticks), level, name="busy")), "utf-8")
        app = build_app(Path(home), size=(width, height), audio_output=AudioOutput())
        screen = TasScreen(app, open_run(run))
        app.push(screen)
        press("a")  # what is first used is loaded
        for _ in range(4):
            app.frame(16)
        result["memory"] = screen.session.timeline.memory
        result |= measure_edits(app, screen, options.edits, "edit")
        for action in OVERLAY_ACTIONS:
            screen.level.picture.overlays.toggle(action)
        app.frame(16)
        result |= measure_edits(app, screen, options.edits, "overlays")
        app.player.close()
    result["loop_after_s"] = loop_seconds()
    print(json.dumps(result) if options.json else "\n".join(f"{key:20} {value}" for key, value in result.items()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
