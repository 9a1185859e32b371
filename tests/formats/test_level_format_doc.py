"""Every example of docs/level-format.md is read: levels, parts of pictures and lists, mistakes and their messages."""

import re
from pathlib import Path

import pytest

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.legend import SYMBOLS, TILE_CHARS
from ninja_game.formats.ascii.object_lines import DOORS, FORMS, MOVEMENTS, SIDES, read_object_line
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.levels.lint import level_warnings

ROOT = Path(__file__).resolve().parent.parent.parent
DOC = (ROOT / "docs" / "level-format.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\S+)\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL)
EMPTY = "|" + "." * 31 + "|"


def blocks(kind: str) -> list[str]:
    return [text for name, text in BLOCKS if name == kind]


def with_header(rows: list[str], lines: str = "") -> str:
    return "\n".join(["ninja-game level 1", "name: From the documentation", *rows, lines])


@pytest.mark.parametrize("text", blocks("level"))
def test_whole_levels_are_proper(text: str) -> None:
    assert level_warnings(parse_ascii_level(text).level) == []


@pytest.mark.parametrize("text", blocks("part"))
def test_parts_of_levels_read(text: str) -> None:
    picture, lines = text.split("\n\n")
    rows = picture.splitlines()
    assert len(parse_ascii_level(with_header([EMPTY] * (23 - len(rows)) + rows, lines)).level.objects) == 9


@pytest.mark.parametrize("text", blocks("picture"))
def test_fragments_of_pictures_read(text: str) -> None:
    rows = [f"|{row}|" for row in text.splitlines()]
    assert parse_ascii_level(with_header([EMPTY] * (23 - len(rows)) + rows)).level.objects == ()


@pytest.mark.parametrize("text", blocks("list"))
def test_lines_of_lists_read(text: str) -> None:
    assert all(read_object_line(line) for line in text.splitlines())


@pytest.mark.parametrize("number", range(len(blocks("wrong"))))
def test_mistakes_get_the_message_that_stands_below_them(number: int) -> None:
    with pytest.raises(LevelError) as caught:
        parse_ascii_level(with_header([EMPTY] * 23, blocks("wrong")[number]), file="cave.txt")
    assert str(caught.value) == blocks("error")[number].strip()


def test_every_character_and_every_word_is_explained() -> None:
    quoted = " ".join(re.findall(r"`([^`\n]+)`", DOC)).split()
    assert [char for char in TILE_CHARS if char not in quoted] == []
    assert [symbol.char for symbol in SYMBOLS if symbol.char not in quoted] == []
    words = [*FORMS, *DOORS, *MOVEMENTS, *SIDES]
    assert [word for word in words if f"`{word}`" not in DOC] == []
