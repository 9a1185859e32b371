"""The index of a pack: its name and other texts, its columns, and its episodes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from ninja_game.errors import PackError
from ninja_game.files.untrusted import parse_toml

MAX_COLUMNS, EPISODES_PER_COLUMN, LEVELS_PER_EPISODE = 10, 10, 5
MAX_EPISODES = MAX_COLUMNS * EPISODES_PER_COLUMN

NEVER_ACCEPTED = ("unreadable", "no-ninja", "too-many-objects")  # codes of findings about files that cannot be played

_LINE = re.compile(r"\(at line (\d+), column (\d+)\)")
_KEYS = ("name", "author", "comment", "version", "columns", "episode", "accept")
_EPISODE_KEYS = ("number", "name", "levels")
_ACCEPT_KEYS = ("file", "code", "reason")


@dataclass(frozen=True)
class EpisodeIndex:
    """An episode: ``number`` (0 to 99; the tens digit is its column), ``name``, and the files of its levels.

    ``levels``: the files listed in the index; None without a list: files called "NN-…" then belong to it. ``line``: its
    first line in the index.
    """

    number: int
    name: str
    levels: tuple[str, ...] | None
    line: int

    def files(self, names: list[str]) -> tuple[str, ...]:
        """Its level files: the listed ones, or else those of ``names`` that begin with its number.

        >>> EpisodeIndex(3, "", None, 1).files(["03-0-a.txt", "03-1-b.txt", "13-0-c.txt"])
        ('03-0-a.txt', '03-1-b.txt')
        """
        if self.levels is not None:
            return self.levels
        return tuple(sorted(name for name in names if name.startswith(f"{self.number:02d}-")))


@dataclass(frozen=True)
class Accepted:
    """A finding about a file of the pack that its maker accepts, and the reason."""

    file: str
    code: str
    reason: str


@dataclass(frozen=True)
class PackIndex:
    """The content of ``pack.toml``; ``episodes`` by their numbers."""

    name: str
    author: str
    comment: str
    columns: tuple[str, ...]  #: their names, from the left
    episodes: tuple[EpisodeIndex, ...]
    version: str = ""  #: as its maker writes it
    accepted: tuple[Accepted, ...] = ()  #: findings that its maker accepts

    @property
    def is_signed(self) -> bool:
        """Whether the index names an author."""
        return self.author.strip().casefold() not in ("", "unknown")

    @property
    def reasons(self) -> dict[tuple[str, str], str]:
        """The reasons for accepted findings, by file and code, without findings that no index may accept."""
        return {(odd.file, odd.code): odd.reason for odd in self.accepted if odd.code not in NEVER_ACCEPTED}

    @property
    def title(self) -> str:
        """Its name with author and version, to tell packs of the same name apart.

        >>> PackIndex("Walls", "Ann", "", (), (), "2").title, PackIndex("Walls", "", "", (), ()).title
        ('Walls by Ann, 2', 'Walls')
        """
        by = f" by {self.author}" if self.author else ""
        return f"{self.name}{by}{', ' if self.version else ''}{self.version}"

    @property
    def summary(self) -> str:
        """Title and comment in one line.

        >>> PackIndex("Walls", "Ann", "Jump", (), ()).summary, PackIndex("Walls", "Ann", "", (), ()).summary
        ('Walls by Ann. Jump', 'Walls by Ann')
        """
        return ". ".join(filter(None, (self.title, self.comment)))

    @property
    def byline(self) -> str:
        """The part of the title behind the name.

        >>> PackIndex("Walls", "Ann", "", (), (), "2").byline, PackIndex("Walls", "", "", (), (), "2").byline
        ('by Ann, 2', '2')
        """
        return self.title.removeprefix(self.name).strip(" ,")


def parse_index(text: str, *, file: str = "") -> PackIndex:
    """Read the index in a TOML text. Raises PackError with the line of the error."""
    try:
        table = parse_toml(text)
    except ValueError as error:
        place = _LINE.search(str(error))
        line, column = (int(place[1]), int(place[2])) if place else (0, 0)
        found = repr(text.splitlines()[line - 1].strip()[:40]) if 0 < line <= text.count("\n") + 1 and text else ""
        hint = 'a text stands in double quotes: name = "…"'
        raise PackError(f"no TOML: {_LINE.sub('', str(error)).strip()}", file, line, column, found, hint=hint) from None
    whole = _Table(table, file, text, 0)
    whole.check(_KEYS)
    name = whole.text("name")
    if not name:
        raise PackError("a pack without a name", file, whole.line("name"), expected='name = "…"')
    columns = whole.texts("columns") or ()
    if len(columns) > MAX_COLUMNS:
        found, expected = str(len(columns)), f"at most {MAX_COLUMNS}"
        raise PackError("too many columns", file, whole.line("columns"), found=found, expected=expected)
    accepted = []
    for entry in whole.tables("accept"):
        entry.check(_ACCEPT_KEYS)
        values = {key: entry.text(key) for key in _ACCEPT_KEYS}
        if missing := next((key for key, value in values.items() if not value), ""):
            raise PackError(f"accept without its {missing}", file, entry.start, expected=f'{missing} = "…"')
        accepted.append(Accepted(**values))
    author, comment, version = map(whole.text, ("author", "comment", "version"))
    return PackIndex(name, author, comment, columns, _episodes(whole), version, tuple(accepted))


def _episodes(whole: _Table) -> tuple[EpisodeIndex, ...]:
    indexes: dict[int, EpisodeIndex] = {}
    for table in whole.tables("episode"):
        table.check(_EPISODE_KEYS)
        number, file = table.table.get("number"), whole.file
        if type(number) is not int or not 0 <= number < MAX_EPISODES:
            place, expected = table.line("number") or table.start, f"a number from 0 to {MAX_EPISODES - 1}"
            raise PackError("an episode's number", file, place, found=repr(number)[:40], expected=expected)
        if number in indexes:
            other = f"line {indexes[number].line} too"
            raise PackError(f"episode {number} is there twice", file, table.start, found=other)
        levels = table.texts("levels")
        if levels and len(levels) > LEVELS_PER_EPISODE:
            what, expected = f"the levels of episode {number}", f"at most {LEVELS_PER_EPISODE} files"
            raise PackError(what, file, table.line("levels"), 0, str(len(levels)), expected)
        indexes[number] = EpisodeIndex(number, table.text("name"), levels, table.start)
    return tuple(indexes[number] for number in sorted(indexes))


@dataclass(frozen=True)
class _Table:
    """A table of the index and its place: after the line ``start`` of ``whole``, 0 for the first table."""

    table: dict[str, Any]
    file: str
    whole: str
    start: int

    def line(self, key: str) -> int:
        """The line of an entry; 0 if it is missing."""
        named = re.compile(rf"\s*\[*[\s\"']*{re.escape(key)}[\s\"']*[=\].]")
        for number, line in enumerate(self.whole.splitlines()[self.start :], self.start + 1):
            if named.match(line):
                return number
            if line.startswith("["):
                break
        return 0

    def check(self, keys: tuple[str, ...]) -> None:
        """Raise PackError for an entry that is not one of ``keys``."""
        if unknown := sorted(self.table.keys() - set(keys)):
            near = get_close_matches(unknown[0], keys, 1)
            hint = f"did you mean '{near[0]}'?" if near else ""
            expected = ", ".join(sorted(keys))
            raise PackError(
                "an unknown entry", self.file, self.line(unknown[0]) or self.start, 0, ascii(unknown[0]), expected, hint
            )

    def tables(self, key: str) -> list[_Table]:
        tables = self.table.get(key, [])
        if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
            raise PackError(
                f"not a list of tables: {key}", self.file, self.line(key), 0, "", f"a table [[{key}]] for each"
            )
        head = re.compile(rf"\s*\[\[\s*{key}\s*\]\]")
        heads = [n for n, line in enumerate(self.whole.splitlines(), 1) if head.match(line)]
        starts = heads if len(heads) == len(tables) else [0] * len(tables)
        return [_Table(table, self.file, self.whole, start) for table, start in zip(tables, starts, strict=True)]

    def text(self, key: str) -> str:
        value = self.table.get(key, "")
        if not isinstance(value, str):
            raise PackError(f"{key} is not text", self.file, self.line(key), 0, repr(value)[:40], f'{key} = "…"')
        return value

    def texts(self, key: str) -> tuple[str, ...] | None:
        """A list of texts; None for a missing entry."""
        value = self.table.get(key)
        if value is None:
            return None
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            what, expected = f"{key} is not a list of texts", f'{key} = ["…", "…"]'
            raise PackError(what, self.file, self.line(key), 0, repr(value)[:40], expected)
        return tuple(value)
