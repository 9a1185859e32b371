"""Kill the editor at random moments of drawing and saving: at most two seconds of work may be lost, and never a file.

    python3 tools/dev.py tool soak.editor_kills --kills 100

A child process opens the editor in the player's folder, continues with what the last one left, draws, saves now and
then, and says what it has drawn and saved. It is killed (SIGKILL) after a random time. Then the folder must offer a
draft that is at most two seconds old, and the saved file must be readable and as it was last saved.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random

from ninja_game.editor.files import recovered
from ninja_game.errors import NinjaGameError
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest
from tools.soak.killing import life, run_kills

LONGEST_LIFE = 2.5
"""Seconds after its first word at which a child is killed at the latest."""

MOST_LOST = 2.0
"""Seconds of work that may be lost."""


def edit(folder: str, seed: int, pipe: Connection) -> None:
    """Draw for ever in the editor, by its own mouse events; say the digest of every state and when it was reached."""
    from tests.support.level_maker import Maker

    rng = Random(seed)
    maker = Maker(Path(folder))
    maker.open("Editor")
    if maker.top() is not maker.editor:
        maker.choose("Recover")
    session = maker.editor.session
    while True:
        maker.press(rng.choice(("e", "d", "1", "grave", "3", "m")))
        maker.drag(*((rng.uniform(30, 760), rng.uniform(30, 570)) for _ in range(rng.randrange(1, 4))))
        session.tools.finish()
        digest = level_digest(session.draft.level)
        pipe.send(("drawn", digest, time.monotonic_ns()))
        if rng.random() < 0.04:
            pipe.send(("about", digest, 0))
            session.save(Path(folder) / "levels" / "kept.txt", replacing=True)
            if session.is_saved:
                pipe.send(("saved", digest, time.monotonic_ns()))
        time.sleep(0.01)


@dataclass
class Said:
    """What the children of the present folder have said: states with their times, and what their file may hold.

    ``made``: whether there is a file for certain.
    """

    drawn: list[tuple[str, int]] = field(default_factory=list)
    saved: set[str] = field(default_factory=set)
    made: bool = False

    def note(self, facts: list[tuple[str, str, int]]) -> None:
        """Take in what a child said."""
        for kind, digest, at in facts:
            if kind == "drawn":
                self.drawn.append((digest, at))
            elif kind == "saved":
                self.saved, self.made = {digest}, True
            elif kind == "about":
                self.saved |= {digest}


def seconds_lost(folder: Path, said: Said, killed_at: int) -> float:
    """How old the first change is that is neither offered nor in the file; 0 if nothing is lost."""
    there = {level_digest(found.draft.level) for found in recovered(folder)}
    file = folder / "levels" / "kept.txt"
    there |= {level_digest(load_levels(file)[0].level)} if file.exists() else set()
    last = max((number for number, (digest, _) in enumerate(said.drawn) if digest in there), default=-1)
    return (killed_at - said.drawn[last + 1][1]) / 1e9 if last + 1 < len(said.drawn) else 0.0


def kill_test(
    kills: int, seed: int, folder: Path, *, most: float = MOST_LOST, report: bool = False
) -> tuple[float, list[str]]:
    """Kill so many editors; the most seconds that were lost, and everything that is wrong."""
    rng = Random(seed)
    said, worst = Said(), 0.0
    wrong: list[str] = []
    for number in range(kills):
        home = folder / str(number // 10)
        if number % 10 == 0:
            said = Said()
        said.drawn.clear()
        facts = life(edit, home, rng.randrange(2**31), rng.random() * LONGEST_LIFE, words=1)
        killed_at = time.monotonic_ns()
        said.note(facts)
        try:
            lost = seconds_lost(home, said, killed_at)
            file = home / "levels" / "kept.txt"
            if (said.made or file.exists()) and level_digest(load_levels(file)[0].level) not in said.saved:
                wrong.append(f"kill {number + 1}: the file is not as it was saved")
        except (NinjaGameError, OSError) as error:
            lost = 0.0
            wrong.append(f"kill {number + 1}: {error}")
        if not said.drawn:
            wrong.append(f"kill {number + 1}: the editor did not start")
        if lost > most:
            wrong.append(f"kill {number + 1}: {lost:.2f} s lost")
        worst = max(worst, lost)
        if report and (number + 1) % 10 == 0:
            print(f"{number + 1} kills, at most {worst:.2f} s lost, {len(wrong)} things wrong", flush=True)
    return worst, wrong


if __name__ == "__main__":
    sys.exit(run_kills(__doc__, kill_test, "at most {:.2f} s lost"))
