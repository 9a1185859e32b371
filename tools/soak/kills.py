"""Kill the game at random moments of playing and saving, and look whether anything that was called saved is lost.

    python3 tools/dev.py tool soak.kills --kills 200

A child process opens the player's folder and plays: passes levels, keeps replays, changes settings, and says after
each save what it has saved. It is killed (SIGKILL) after a random time, also while the files are being made. Then
the folder is opened as the game would open it, and everything that was said must be there.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
import tempfile
import time
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random
from typing import Any

from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import LevelRun
from ninja_game.sim.level import Level

LONGEST_LIFE = 0.25
"""Seconds after which a child is killed at the latest."""

PATIENCE = 10.0
"""Seconds to wait for a child's first save."""

Fact = tuple[str, str, int]
"""What was saved ("best", "replay", "volume", "progress"), its key, its number."""


def level_of(number: int) -> Level:
    """A level that is passed by running right; each number makes another one."""
    return parse_level_string("0" * 713 + f"|5^100,566!11^160,564,130,564!0^{300 + number},100")


def passed_attempt(level: Level, wait: int) -> Attempt:
    """An attempt that passes the level after standing for ``wait`` ticks."""
    attempt = Attempt(level)
    while attempt.outcome == "running":
        attempt.tick(2 if attempt.simulation.tick >= wait else 0)
    return attempt


def play(folder: str, seed: int, pipe: Connection) -> None:
    """The child: play and save for ever, saying each time what is saved."""
    chance = Random(seed)
    data = PlayerData(Path(folder))
    while True:
        level = level_of(chance.randrange(40))
        attempt = passed_attempt(level, chance.randrange(30))
        LevelRun(data, Entry(NamedLevel("killed", "", "", level, "killed.txt"), "game")).passed(attempt)
        pipe.send(("best", level_digest(level), attempt.score))
        pipe.send(("replay", "", data.records.keep_replay(attempt.replay())))
        volume = chance.randrange(100)
        data.change_settings(data.settings.changed(volume=volume))
        pipe.send(("volume", "", volume))
        place = chance.randrange(9), chance.randrange(5)
        data.progress.level_passed(place, legitimate=True)
        pipe.send(("progress", "0", data.progress.columns[0].beaten[0] * 5 + data.progress.columns[0].beaten[1]))


def life(folder: Path, seed: int, seconds: float, *, settled: bool) -> list[Fact]:
    """Let a child live for so long, kill it; what it said was saved.

    ``settled``: the time counts from its first save, else from its birth, so that opening the files is interrupted too.
    """
    methods = multiprocessing.get_all_start_methods()
    context: Any = multiprocessing.get_context("fork" if "fork" in methods else "spawn")
    ours, theirs = context.Pipe(duplex=False)
    child = context.Process(target=play, args=(str(folder), seed, theirs), daemon=True)
    child.start()
    theirs.close()
    if settled:
        ours.poll(PATIENCE)
    time.sleep(seconds)
    child.kill()
    child.join()
    facts: list[Fact] = []
    try:
        while ours.poll():
            facts.append(ours.recv())
    except (EOFError, OSError):
        # The last word was cut off; what it was about counts as not said.
        pass
    ours.close()
    return facts


def losses(folder: Path, said: dict[tuple[str, str], int], last_volume: int | None) -> list[str]:
    """What is wrong with the folder: facts that are lost, and whether it could not be opened as it was."""
    data = PlayerData(folder)
    bests = data.records.level_bests()
    wrong = [f"not opened: {message}" for message in data.messages]
    for (kind, key), number in said.items():
        if kind == "best" and (key not in bests or bests[key].score < number):
            wrong.append(f"best of {key[:8]}: {number} was saved, {bests.get(key)} is there")
        elif kind == "replay" and data.records.replay(number) is None:
            wrong.append(f"replay {number} is gone")
        elif kind == "progress":
            episode, level = data.progress.columns[0].beaten
            if episode * 5 + level < number:
                wrong.append(f"progress: {number} was saved, {(episode, level)} is there")
    if last_volume is not None and not (folder / "settings.toml").is_file():
        wrong.append("the settings are gone")
    data.close()
    return wrong


def kill_test(kills: int, seed: int, folder: Path, *, report: bool = False) -> tuple[int, list[str]]:
    """Kill so many children; how many saves they had told of, and everything that was lost."""
    chance = Random(seed)
    said: dict[tuple[str, str], int] = {}
    told = 0
    wrong: list[str] = []
    volume = None
    for number in range(kills):
        # Every tenth folder is a new one, so that making the files is interrupted too.
        home = folder / str(number // 10)
        if number % 10 == 0:
            said, volume = {}, None
        seconds = chance.random() * LONGEST_LIFE
        facts = life(home, chance.randrange(2**31), seconds, settled=number % 4 > 0)
        told += len(facts)
        for kind, key, value in facts:
            if kind == "volume":
                volume = value
            said[kind, key if kind != "replay" else str(value)] = max(value, said.get((kind, key), 0))
        lost = losses(home, said, volume)
        wrong += [f"kill {number + 1}: {text}" for text in lost]
        if report and (lost or (number + 1) % 50 == 0):
            print(f"{number + 1} kills, {told} saves, {len(wrong)} losses", flush=True)
    return told, wrong


def main() -> int:
    """Exit code 1 if anything was lost."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        told, wrong = kill_test(options.kills, options.seed, Path(folder), report=True)
    for text in wrong:
        print(text)
    print(f"{options.kills} kills, {told} saves told of, {len(wrong)} lost")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
