"""Small levels and recordings for the tests of commands, made by the formats themselves."""

from dataclasses import replace
from pathlib import Path

from ninja_game import Simulation
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.n14.demo import write_demo
from ninja_game.formats.n14.level_file import LevelRecord, write_level_file
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.sim.inputs import Demo

WALK = "0" * 713 + "|5^100,566!11^160,564,130,564!0^115,566"
"""An empty level: holding right leads over a piece of gold and a switch into the exit, in tick WALK_END."""

WALK_END = 23

SPIKED = "0" * 713 + "|5^100,566!12^130,566!0^400,100"  # the same run ends on a mine

NO_NINJA = "0" * 713 + "|0^100,100"


def unclaimed_text(level: str, *lines: str, headers: str = "") -> str:
    """A replay text without claims: such inputs on a level given as an in-game string."""
    picture = "".join(f"  {line}\n" for line in write_ascii_level(parse_level_string(level)).splitlines())
    inputs = "".join(f"  {line}\n" for line in lines)
    return f"ninja-game replay 3\n{headers}level-data:\n{picture}inputs:\n{inputs}"


def running(ticks: int) -> str:
    """The demo of holding right for this many ticks."""
    return write_demo(Demo(bytes([2] * ticks), float(ticks)))


def write_records(path: Path, *records: tuple[str, str, str]) -> Path:
    """A file of `$name#author#comment#level#demo#` records from (name, level, demo)."""
    text = write_level_file(LevelRecord(name, "me", "test", level, demo) for name, level, demo in records)
    path.write_text(text, "utf-8")
    return path


def replay_of_walk(**changes: object) -> str:
    """A replay of ours of the run through WALK; ``changes`` make it lie."""
    level = parse_level_string(WALK)
    world = Simulation(level)
    inputs = bytes([2] * (WALK_END + 1))
    for keys in inputs:
        world.step_keys(keys)
    replay = Replay(inputs, WALK_END, world.outcome, world.gold, world.replay_digest(), name="walk", level=level)
    return write_replay(replace(replay, **changes))  # type: ignore[arg-type]
