"""The generated levels that come with the game: a thousand, of all difficulties, each passed by its run."""

import lzma
from collections import Counter
from pathlib import Path

import pytest

from ninja_game.errors import FileError
from ninja_game.files.bundled import data_folder
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.generator import packed
from ninja_game.generator.packed import PACKED, pack, read_line, read_packed_levels
from ninja_game.runs.run import run_level

ALL = read_packed_levels()


def test_there_are_a_hundred_of_each_difficulty_and_no_two_alike() -> None:
    assert Counter(each.wanted for each in ALL) == dict.fromkeys(range(1, 11), 100)
    assert len({level_digest(each.level) for each in ALL}) == len(ALL)
    assert read_packed_levels(difficulty=4) == [each for each in ALL if each.wanted == 4]


@pytest.mark.parametrize("number", range(0, 1000, 83))
def test_its_run_passes_it(number: int) -> None:
    each = ALL[number]
    assert run_level(each.level, each.inputs, memory="plain").outcome == "exit"


def test_a_level_comes_back_from_its_line() -> None:
    assert [read_line(each.line) for each in ALL[::97]] == ALL[::97]


def test_the_file_is_below_a_megabyte_and_the_same_lines_are_the_same_bytes() -> None:
    data = (data_folder("assets") / PACKED).read_bytes()
    assert len(data) < 1_000_000
    assert pack([each.line for each in ALL]) == data


@pytest.mark.parametrize("data", [b"", b"no archive", lzma.compress(b"x" * 100)[:-20], lzma.compress(b"\xff")])
def test_a_broken_file_is_reported(data: bytes, tmp_path: Path) -> None:
    (tmp_path / "broken.xz").write_bytes(data)
    with pytest.raises(FileError, match="cannot be read"):
        packed._lines(tmp_path / "broken.xz")


def test_a_line_with_too_few_fields_is_reported() -> None:
    with pytest.raises(FileError, match="5 fields"):
        read_line("1\t2\tname\t2.0\tlevel")


def test_a_bomb_takes_no_more_than_the_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(packed, "MAX_PACKED_BYTES", 5000)
    (tmp_path / "bomb.xz").write_bytes(lzma.compress(b"x" * 10_000_000))
    with pytest.raises(FileError, match="cannot be read"):
        packed._lines(tmp_path / "bomb.xz")
