"""Kill the TAS editor at random moments of editing and saving: at most the last edit may be lost, and never a file.

    python3 tools/dev.py tool soak.tas_kills --kills 100
    python3 tools/dev.py tool soak.tas_kills --kills 100 --what window

A child process opens a run in the player's folder, continues with what the last one left, edits, saves now and then,
and says after each edit what the run is. It is killed (SIGKILL) after a random time, also in the middle of a stroke.
Then the folder must offer the run as it was said last, or later, and the file must be as it was saved last.
"""

from __future__ import annotations

import os
import sys
import time
from hashlib import sha256
from itertools import groupby
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random

from ninja_game.errors import NinjaGameError
from ninja_game.files.locking import hold
from ninja_game.tas.files import open_run
from ninja_game.tas.input_track import InputTrack
from ninja_game.tas.journal import FOLDER, recovered
from ninja_game.tas.session import Session
from tests.support.samples import replay_of_walk
from tests.support.tas_edits import edit_at_random, use_at_random
from tools.soak.killing import PATIENCE, life, run_kills

LONGEST_LIFE = 0.05
"""Seconds after its last word that is waited for at which a child is killed at the latest."""

MOST_WORDS = 20
"""How many words of a child are waited for at most."""

RUN = "walk.replay.txt"


def digest(track: InputTrack) -> str:
    """Of keys and names; ticks without a key at the end do not count: a saved file may leave them out."""
    return sha256(track.inputs.rstrip(b"\0") + repr(track.markers).encode()).hexdigest()


def opened(folder: Path) -> Session:
    """The run, or what was not saved of it."""
    found = next(recovered(folder), None)
    session = Session(found.opened if found else open_run(folder / RUN), folder, memory="plain")
    if found:
        session.recover(found)
    return session


def await_locks(folder: Path) -> None:
    """Wait until the system has freed the locks of a process that has died: on some systems that takes a moment."""
    end = time.monotonic() + PATIENCE
    for file in (folder / FOLDER).glob("*.jsonl"):
        while (handle := hold(file.with_suffix(".lock"))) is None and time.monotonic() < end:
            time.sleep(0.01)
        if handle is not None:
            os.close(handle)


def say_and_save(session: Session, rng: Random, pipe: Connection) -> None:
    """Say what the run is; now and then save it."""
    pipe.send(("edited", digest(session.track), 0))
    if rng.random() < 0.05:
        pipe.send(("about", digest(session.track), 0))
        session.save(session.file.path or Path(), replacing=True)
        pipe.send(("saved", digest(session.track), 0))


def edit(folder: str, seed: int, pipe: Connection) -> None:
    """Edit for ever, without a window: far more edits a second."""
    rng = Random(seed)
    session = opened(Path(folder))
    while True:
        edit_at_random(session, rng)
        say_and_save(session, rng, pipe)


def edit_in_window(folder: str, seed: int, pipe: Connection) -> None:
    """The whole program: the TAS editor with its own keys and mouse."""
    from tests.support.tas_driver import TasDriver

    rng = Random(seed)
    at = TasDriver(Path(folder), Path(folder) / RUN)
    if at.top() is not at.screen:
        at.choose("Recover")
        at.adopt()
    while True:
        use_at_random(at, rng)
        say_and_save(at.session, rng, pipe)


PLAYERS = {"session": edit, "window": edit_in_window}


def kill_test(
    kills: int, seed: int, folder: Path, *, what: str = "session", report: bool = False
) -> tuple[int, list[str]]:
    """Kill so many benches; how many edits they had told of, and everything that is wrong."""
    rng = Random(seed)
    told, last, saved = 0, "", {""}
    wrong: list[str] = []
    for number in range(kills):
        home = folder / str(number // 10)
        if number % 10 == 0:
            home.mkdir(parents=True)
            (home / RUN).write_text(replay_of_walk(), "utf-8")
            last = digest(open_run(home / RUN).track)
            saved = {last}
        words, seconds = rng.randrange(1, MOST_WORDS + 1), rng.random() * LONGEST_LIFE
        facts = life(PLAYERS[what], home, rng.randrange(2**31), seconds, words=words)
        # What changes nothing, such as undo without an edit, is not an edit that could be lost.
        said = [each for each, _ in groupby([last, *(each for kind, each, _ in facts if kind == "edited")])]
        for kind, each, _ in facts:
            saved = {each} if kind == "saved" else saved | {each} if kind == "about" else saved
        told += len(said) - 1
        await_locks(home)
        try:
            session = opened(home)
            last = digest(session.track)
            session.close(keep=True)
            lost = said[::-1].index(last) if last in said else 0
            in_file = digest(open_run(home / RUN).track)
        except (NinjaGameError, OSError) as error:
            wrong.append(f"kill {number + 1}: {error}")
            continue
        if lost > 1:
            wrong.append(f"kill {number + 1}: {lost} edits lost")
        if in_file not in saved:
            wrong.append(f"kill {number + 1}: the file is not as it was saved")
        if not any(kind == "edited" for kind, _, _ in facts):
            wrong.append(f"kill {number + 1}: the TAS editor did not start")
        if report and (number + 1) % 10 == 0:
            print(*wrong, f"{number + 1} kills, {told} edits, {len(wrong)} things wrong", sep="\n", flush=True)
    return told, wrong


if __name__ == "__main__":
    sys.exit(run_kills(__doc__, kill_test, "{} edits", players=PLAYERS))
