"""What the kill tests share: a child that is killed after a while, and the command line."""

from __future__ import annotations

import argparse
import multiprocessing
import os
import tempfile
import time
from collections.abc import Callable, Collection
from contextlib import suppress
from pathlib import Path
from typing import Any

PATIENCE = 120.0
"""Seconds to wait for a word of a child."""

Fact = tuple[str, str, int]
"""What a child says: the kind of fact, such as "saved", what it is about, a number."""


def life(player: Callable[..., None], folder: Path, seed: int, seconds: float, *, words: int) -> list[Fact]:
    """Let a child live, kill it; what it said was saved.

    ``seconds`` count from the moment when it has said so many ``words``; 0: from its birth, so that opening the files
    is interrupted too. How much it does in a second depends on the machine.
    """
    methods = multiprocessing.get_all_start_methods()
    context: Any = multiprocessing.get_context("fork" if "fork" in methods else "spawn")
    ours, theirs = context.Pipe(duplex=False)
    child = context.Process(target=player, args=(str(folder), seed, theirs), daemon=True)
    child.start()
    theirs.close()
    facts: list[Fact] = []
    # The last word may be cut off; what it was about counts as not said.
    with suppress(EOFError, OSError):
        while len(facts) < words and ours.poll(PATIENCE):
            facts.append(ours.recv())
    if words and not facts:
        facts.append(("no start", "", 0))
    time.sleep(seconds)
    child.kill()
    child.join()
    with suppress(EOFError, OSError):
        while ours.poll():
            facts.append(ours.recv())
    ours.close()
    return facts


def run_kills(
    doc: str | None, kill_test: Callable[..., tuple[float, list[str]]], told: str, *, kills: int = 100,
    players: Collection[str] = (),
) -> int:  # fmt: skip
    """Kill as the command line says and print what is wrong; exit code 1 if anything is.

    ``doc``: of the script; ``told``: what the test's number means; ``players``: who can be killed, the usual one first.
    """
    parser = argparse.ArgumentParser(description=(doc or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--kills", type=int, default=kills)
    parser.add_argument("--seed", type=int, default=1)
    if players:
        parser.add_argument("--what", choices=players, default=next(iter(players)))
    options = vars(parser.parse_args())
    for name, value in (
        ("PYGAME_HIDE_SUPPORT_PROMPT", "1"),
        ("SDL_VIDEODRIVER", "dummy"),
        ("SDL_AUDIODRIVER", "dummy"),
    ):
        os.environ.setdefault(name, value)
    with tempfile.TemporaryDirectory() as folder:
        number, wrong = kill_test(folder=Path(folder), report=True, **options)
    print(*wrong, f"{options['kills']} kills, {told.format(number)}, {len(wrong)} things wrong", sep="\n")
    return 1 if wrong else 0
