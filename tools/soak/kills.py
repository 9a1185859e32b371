"""Kill the game at random moments of playing and saving, and look whether anything that was called saved is lost.

    python3 tools/dev.py tool soak.kills --kills 200
    python3 tools/dev.py tool soak.kills --kills 500 --what window
    SDL_VIDEODRIVER=x11 DISPLAY=:73 python3 tools/dev.py tool soak.kills --kills 100 --what settings

A child process opens the player's folder and plays: passes levels, keeps replays, changes settings, and says after
each save what it has saved. It is killed (SIGKILL) after a random time, also while the files are being made. Then
the folder is opened as the game would open it: everything that was said must be there, and nothing half written.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path
from random import Random

from ninja_game.files import writing
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import LevelRun
from ninja_game.sim.level import Level
from tools.soak.killing import Fact, life, run_kills

LONGEST_LIFE = 0.25
"""Seconds after which a child is killed at the latest."""


def level_of(number: int) -> Level:
    """A level for which running right is enough; each number makes another one."""
    return parse_level_string("0" * 713 + f"|5^100,566!11^160,564,130,564!0^{300 + number},100")


def entry_of(level: Level) -> Entry:
    """A level as lists have it."""
    return Entry(NamedLevel("killed", "", "", level, "killed.txt"), "game")


def passed_attempt(level: Level, wait: int) -> Attempt:
    """An attempt that passes the level after standing for ``wait`` ticks."""
    attempt = Attempt(level)
    while attempt.outcome == "running":
        attempt.tick(2 if attempt.simulation.tick >= wait else 0)
    return attempt


# --- the children: each plays and saves for ever, saying each time what is saved ---


def play_records(folder: str, seed: int, pipe: Connection) -> None:
    """What the game saves, without its window: far more saves a second."""
    rng = Random(seed)
    data = PlayerData(Path(folder))
    while True:
        level = level_of(rng.randrange(40))
        attempt = passed_attempt(level, rng.randrange(30))
        LevelRun(data, entry_of(level)).passed(attempt)
        pipe.send(("best", level_digest(level), attempt.score))
        pipe.send(("replay", "", data.records.keep_replay(attempt.replay())))
        volume = rng.randrange(100)
        pipe.send(("about", "", volume))
        data.change_settings(data.settings.changed(volume=volume))
        pipe.send(("volume", "", volume))
        data.progress.level_passed((rng.randrange(9), rng.randrange(5)), legitimate=True)
        episode, place = data.progress.columns[0].beaten
        pipe.send(("progress", "0", episode * 5 + place))


def play_in_window(folder: str, seed: int, pipe: Connection) -> None:
    """The whole program: levels played by keys, replays kept, settings changed on the way."""
    from ninja_game.play.level.screen import LevelScreen
    from tests.support.menu_driver import MenuDriver

    rng = Random(seed)
    driver = MenuDriver(Path(folder))
    while True:
        level = level_of(rng.randrange(40))
        screen = LevelScreen(driver.app, LevelRun(driver.player, entry_of(level)))
        driver.app.push(screen)
        for _ in range(3):
            driver.keys.script = [1] * rng.randrange(1, 15) + [2] * 120
            while screen.attempt.outcome != "exit":
                driver.frames()
            if any("saved" in notice for notice in screen.play.notices):
                pipe.send(("best", level_digest(level), screen.attempt.score))
            screen.keep_replay()
            if "saved" in driver.app.notice:
                pipe.send(("replay", "", driver.player.records.replays()[0].id))
            driver.press("r")
        volume = rng.randrange(100)
        pipe.send(("about", "", volume))
        driver.app.change_settings(volume=volume)
        pipe.send(("volume", "", volume))
        screen.quit()


def play_settings(folder: str, seed: int, pipe: Connection) -> None:
    """The settings screen: its volume moved by keys, up and down."""
    from tests.support.menu_driver import MenuDriver

    driver = MenuDriver(Path(folder))
    driver.open("Settings")
    screen = driver.settings_page("Sound")
    screen.focus = screen.widgets[1]
    step = 3 if seed % 2 else -3
    while True:
        if not 0 <= driver.player.settings.volume + step <= 99:
            step = -step
        pipe.send(("about", "", driver.player.settings.volume + step))
        driver.press("right" if step > 0 else "left")
        pipe.send(("volume", "", driver.player.settings.volume))


PLAYERS = {"records": play_records, "window": play_in_window, "settings": play_settings}

# --- killing them ---


@dataclass
class Said:
    """What the children of a folder said was saved: the best number by kind and key, and the volumes."""

    numbers: dict[tuple[str, str], int] = field(default_factory=dict)
    volumes: set[int] = field(default_factory=set)

    def note(self, facts: list[Fact]) -> None:
        """Take in what a child said."""
        for kind, key, number in facts:
            if kind == "volume":
                self.volumes = {number}
            elif kind == "about":
                self.volumes = {*self.volumes, number} if self.volumes else set()
            else:
                place = kind, key if kind != "replay" else str(number)
                self.numbers[place] = max(number, self.numbers.get(place, 0))


def losses(folder: Path, said: Said) -> list[str]:
    """What is wrong with the folder: facts that are lost, files half written, or that it cannot be opened as it was."""
    writing._tidied.clear()  # noqa: SLF001 - as a new process
    data = PlayerData(folder)
    bests = data.records.level_bests()
    wrong = [f"not opened: {message}" for message in data.messages]
    for (kind, key), number in said.numbers.items():
        if kind == "best" and (key not in bests or bests[key].score < number):
            wrong.append(f"best of {key[:8]}: {number} was saved, {bests.get(key)} is there")
        elif kind == "replay" and data.records.replay(number) is None:
            wrong.append(f"replay {number} is gone")
        elif kind == "progress":
            episode, level = data.progress.columns[0].beaten
            if episode * 5 + level < number:
                wrong.append(f"progress: {number} was saved, {(episode, level)} is there")
        elif kind == "no start":
            wrong.append("the game did not start")
    if said.volumes and data.settings.volume not in said.volumes:
        wrong.append(f"volume: {said.volumes} was saved, {data.settings.volume} is there")
    data.close()
    known = {"settings.toml", "records.sqlite", "levels", "replays", "exports"}
    known |= {".settings.toml.lock", ".records.sqlite.lock"}
    return wrong + [
        f"left over: {name}" for name in sorted(each.name for each in folder.iterdir()) if name not in known
    ]


def kill_test(
    kills: int, seed: int, folder: Path, *, what: str = "records", report: bool = False
) -> tuple[int, list[str]]:
    """Kill so many children; how many saves they had told of, and everything that was lost."""
    rng = Random(seed)
    said = Said()
    told = 0
    wrong: list[str] = []
    for number in range(kills):
        # Every tenth folder is a new one, so that making the files is interrupted too.
        home = folder / str(number // 10)
        if number % 10 == 0:
            said = Said()
        seconds = rng.random() * LONGEST_LIFE
        facts = life(PLAYERS[what], home, rng.randrange(2**31), seconds, words=min(number % 4, 1))
        told += sum(kind not in {"about", "no start"} for kind, _, _ in facts)
        said.note(facts)
        lost = losses(home, said)
        wrong += [f"kill {number + 1}: {text}" for text in lost]
        if report and (lost or (number + 1) % 50 == 0):
            print(f"{number + 1} kills, {told} saves, {len(wrong)} losses", flush=True)
    return told, wrong


if __name__ == "__main__":
    sys.exit(run_kills(__doc__, kill_test, "{} saves told of", kills=200, players=PLAYERS))
