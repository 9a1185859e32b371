"""Small levels and recordings for the tests of commands, made by the formats themselves."""

from __future__ import annotations

from pathlib import Path

from ninja_game.formats.demo import Demo, write_demo
from ninja_game.formats.level_file import LevelRecord, write_level_file

WALK = "0" * 713 + "|5^100,566!11^160,564,130,564!0^115,566"
"""An empty level: the ninja runs right over a piece of gold and a switch into the exit, in tick 25."""

SPIKED = "0" * 713 + "|5^100,566!12^130,566!0^400,100"
"""The same run ends on a mine."""

NO_NINJA = "0" * 713 + "|0^100,100"


def running(ticks: int) -> str:
    """The demo of holding right for so many ticks."""
    return write_demo(Demo(bytes([2] * ticks), float(ticks)))


def write_records(path: Path, *records: tuple[str, str, str]) -> Path:
    """A file of `$name#author#comment#level#demo#` records from (name, level, demo)."""
    text = write_level_file(LevelRecord(name, "me", "test", level, demo) for name, level, demo in records)
    path.write_text(text, "utf-8")
    return path
