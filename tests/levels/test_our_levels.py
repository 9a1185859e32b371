"""The levels in levels/: each is proper, named, and comes back from its own text."""

from __future__ import annotations

from pathlib import Path

import pytest

from ninja_game.formats.ascii.reader import parse_ascii_level, write_ascii_level
from ninja_game.levels.warnings import level_warnings
from ninja_game.sim.kinds import GOLD

LEVELS = sorted((Path(__file__).resolve().parent.parent.parent / "levels").glob("*.txt"))


def test_there_are_levels_in_order() -> None:
    assert len(LEVELS) >= 6
    assert [path.name[:2] for path in LEVELS] == [f"{number:02d}" for number in range(1, len(LEVELS) + 1)]


@pytest.mark.parametrize("path", LEVELS, ids=lambda path: str(path.stem))
def test_a_level_of_ours_is_proper(path: Path) -> None:
    read = parse_ascii_level(path.read_text(encoding="utf-8"), file=str(path))
    assert read.name
    assert read.author
    assert read.comment
    assert level_warnings(read.level) == []
    assert any(record.kind == GOLD for record in read.level.objects)
    assert parse_ascii_level(write_ascii_level(read.level)).level == read.level
