"""Several games on one player's folder: saves of two at once, and many first starts at the same moment.

    python3 tools/dev.py tool soak.shared_folder --saves 1000 --starts 100

Two processes pass levels, die, move on in the episodes and change settings, each as fast as it can. Afterwards
everything that either reported as saved must be there, and neither may ever have seen its progress go back. Then many
processes open a new folder at once: each must save one death there, without a word of trouble.
"""

from __future__ import annotations

import argparse
import multiprocessing
import sys
import tempfile
from collections.abc import Callable
from multiprocessing.queues import Queue
from pathlib import Path
from typing import Any

from ninja_game.formats.n14.level_string import level_digest
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import LevelRun
from tools.soak.kills import entry_of, level_of, passed_attempt

LEVELS_OF_A_COLUMN = 50


def play(folder: Path, number: int, saves: int, answers: Queue[list[str]]) -> None:
    """One of two games; answers with what went wrong."""
    data = PlayerData(folder)
    wrong = []
    waited = 0
    best: dict[str, int] = {}
    far = data.progress.columns[number].beaten
    for save in range(saves // 2):
        level = level_of(40 * number + save % 40)
        attempt = passed_attempt(level, (saves - save) % 30)
        notices = LevelRun(data, entry_of(level)).passed(attempt)
        waited += any("Not saved" in notice for notice in notices)
        best[level_digest(level)] = max(best.get(level_digest(level), 0), attempt.score)
        for column in (number, 9):
            # A column of its own, and one that both go through.
            data.progress.level_passed((10 * column + save // 5 % 9, save % 5), legitimate=True)
        now = data.progress.columns[number].beaten
        if now < far:
            wrong.append(f"progress went back from {far} to {now}")
        far = now
        value = save % 100
        data.change_settings(data.settings.changed(**{("volume", "loop_volume")[number]: min(value, 99)}))
    data.close()
    again = PlayerData(folder)
    bests = again.records.level_bests()
    wrong += [f"a best is gone: {key}" for key, score in best.items() if key not in bests or bests[key].score < score]
    saved = (again.settings.volume, again.settings.loop_volume)[number]
    if saved != (saves // 2 - 1) % 100:
        wrong.append(f"a setting is {saved}")
    if saves >= 2 * LEVELS_OF_A_COLUMN and again.progress.columns[number].beaten != (10 * number + 9, 0):
        wrong.append(f"progress is {again.progress.columns[number].beaten}")
    if data.messages or data.store.problem:
        wrong.append(f"{data.messages} {data.store.problem}")
    again.close()
    answers.put([f"game {number}: {text}" for text in wrong] + [f"({waited} saves waited for the other game)"])


def start(folder: Path, number: int, begin: Any, answers: Queue[list[str]]) -> None:
    """One of many first starts; answers with what went wrong."""
    begin.wait()
    data = PlayerData(folder)

    def work() -> list[str]:
        data.statistics.attempt_ended("level", killer="mine", passed=False, ticks=1, gold=0)
        return []

    _, problem = data.store.save(work)
    data.close()
    remarks = [f"(start {number} saved only when it ended: {problem})"] if problem else []
    answers.put([f"start {number}: {text}" for text in data.messages] + remarks)


def together(target: Callable[..., None], arguments: list[tuple[Any, ...]]) -> list[str]:
    """Run processes at once; all their answers."""
    answers: Queue[list[str]] = multiprocessing.Queue()
    processes = [multiprocessing.Process(target=target, args=(*each, answers)) for each in arguments]
    for process in processes:
        process.start()
    found = [text for _ in processes for text in answers.get(timeout=600)]
    for process in processes:
        process.join()
    return found


def two_games(folder: Path, saves: int) -> list[str]:
    """What went wrong while two games saved; remarks stand in brackets."""
    told = together(play, [(folder, number, saves) for number in range(2)])
    data = PlayerData(folder)
    passes = data.statistics.played().passes
    data.close()
    return told + ([] if passes == saves // 2 * 2 else [f"{passes} passes are counted"])


def first_starts(folder: Path, count: int) -> list[str]:
    """What went wrong while so many games started for the first time."""
    begin = multiprocessing.Barrier(count)
    told = together(start, [(folder, number, begin) for number in range(count)])
    data = PlayerData(folder)
    deaths = data.statistics.deaths()["mine"]
    data.close()
    return told + ([] if deaths == count else [f"{deaths} deaths are counted"])


def main() -> int:
    """Exit code 1 if anything went wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--saves", type=int, default=1000)
    parser.add_argument("--starts", type=int, default=100)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        wrong = two_games(Path(folder) / "games", options.saves) + first_starts(Path(folder) / "new", options.starts)
    print(*wrong, sep="\n")
    bad = sum(not text.startswith("(") for text in wrong)
    print(f"{options.saves} saves of two games, {options.starts} first starts: {bad} things wrong")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
