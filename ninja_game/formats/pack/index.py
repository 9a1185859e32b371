"""The index of a pack: what it is called, its columns, and its episodes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from ninja_game.errors import PackError
from ninja_game.files.toml import parse_toml

MOST_EPISODES, EPISODES_PER_COLUMN, LEVELS_PER_EPISODE = 100, 10, 5

_LINE = re.compile(r"\(at line (\d+), column (\d+)\)")
_KEYS = {"name", "author", "comment", "columns", "episode"}
_EPISODE_KEYS = {"number", "name", "levels"}


@dataclass(frozen=True)
class EpisodeIndex:
    """An episode: ``number`` (0 to 99, its tens are its column), ``name``, and the files of its levels.

    ``levels``: the files that the index lists; empty where it lists none, then those called "NN-…" belong to it.
    ``line``: where it begins in the index.
    """

    number: int
    name: str
    levels: tuple[str, ...]
    line: int

    def files(self, names: list[str]) -> tuple[str, ...]:
        """Its level files: those listed, or else those of ``names`` that begin with its number.

        >>> EpisodeIndex(3, "", (), 1).files(["03-0-a.txt", "03-1-b.txt", "13-0-c.txt"])
        ('03-0-a.txt', '03-1-b.txt')
        """
        return self.levels or tuple(sorted(name for name in names if name.startswith(f"{self.number:02d}-")))


@dataclass(frozen=True)
class PackIndex:
    """What ``pack.toml`` says; ``episodes`` by their numbers."""

    name: str
    author: str
    comment: str
    columns: tuple[str, ...]
    episodes: tuple[EpisodeIndex, ...]


def parse_index(text: str, *, file: str = "") -> PackIndex:
    """The index in a TOML text. Raises PackError with the line of what is wrong."""
    try:
        table = parse_toml(text)
    except ValueError as error:
        place = _LINE.search(str(error))
        line, column = (int(place[1]), int(place[2])) if place else (0, 0)
        raise PackError(f"no TOML: {_LINE.sub('', str(error)).strip()}", file, line, column) from None
    _known(table, _KEYS, file, 0)
    name = _text(table, "name", file, 0)
    if not name:
        raise PackError("a pack without a name", file, expected='name = "…"')
    columns = _list_of_texts(table, "columns", file, 0)
    most = MOST_EPISODES // EPISODES_PER_COLUMN
    if len(columns) > most:
        raise PackError("too many columns", file, found=str(len(columns)), expected=f"at most {most}")
    episodes = _episodes(table, text, file)
    return PackIndex(name, _text(table, "author", file, 0), _text(table, "comment", file, 0), columns, episodes)


def _episodes(table: dict[str, Any], text: str, file: str) -> tuple[EpisodeIndex, ...]:
    tables = table.get("episode", [])
    if not isinstance(tables, list) or not all(isinstance(each, dict) for each in tables):
        raise PackError("not a list of episodes", file, expected="a table [[episode]] for each")
    heads = [n for n, line in enumerate(text.splitlines(), 1) if re.match(r"\s*\[\[\s*episode\s*\]\]", line)]
    found: dict[int, EpisodeIndex] = {}
    for place, each in enumerate(tables):
        line = heads[place] if len(heads) == len(tables) else 0
        _known(each, _EPISODE_KEYS, file, line)
        number = each.get("number")
        if type(number) is not int or not 0 <= number < MOST_EPISODES:
            raise PackError(
                "an episode's number", file, line, found=repr(number)[:40], expected="a number from 0 to 99"
            )
        if number in found:
            raise PackError(f"episode {number} is there twice", file, line, found=f"line {found[number].line} too")
        levels = _list_of_texts(each, "levels", file, line)
        if len(levels) > LEVELS_PER_EPISODE:
            raise PackError(f"the levels of episode {number}", file, line, 0, str(len(levels)), "at most five files")
        found[number] = EpisodeIndex(number, _text(each, "name", file, line), levels, line)
    return tuple(found[number] for number in sorted(found))


def _known(table: dict[str, Any], keys: set[str], file: str, line: int) -> None:
    unknown = sorted(table.keys() - keys)
    if unknown:
        raise PackError("an unknown entry", file, line, 0, ascii(unknown[0]), ", ".join(sorted(keys)))


def _text(table: dict[str, Any], key: str, file: str, line: int) -> str:
    value = table.get(key, "")
    if not isinstance(value, str):
        raise PackError(f"{key} is not text", file, line, found=repr(value)[:40], expected=f'{key} = "…"')
    return value


def _list_of_texts(table: dict[str, Any], key: str, file: str, line: int) -> tuple[str, ...]:
    value = table.get(key, [])
    if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
        raise PackError(f"{key} is not a list of texts", file, line, 0, repr(value)[:40], f'{key} = ["…", "…"]')
    return tuple(value)
