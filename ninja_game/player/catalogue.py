"""The levels there are: the game's own, in episodes, and those that the player has put into a folder.

The game's episodes are listed in ``levels/episodes.toml``; bundled levels that no episode names are single levels.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.reading import LeftOut, files_below, read_utf8
from ninja_game.files.resources import bundled_levels
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.player.progress import COLUMNS, EPISODES_PER_COLUMN, LEVELS_PER_EPISODE
from ninja_game.player.records import episode_key

EPISODES_FILE = "episodes.toml"


@dataclass(frozen=True)
class Entry:
    """A level that can be played. ``source``: "game" or "yours"; ``episode``: "03-1" where it belongs to one."""

    named: NamedLevel
    source: str
    episode: str = ""

    @cached_property
    def digest(self) -> str:
        """The level's digest, its key in the records."""
        return level_digest(self.named.level)

    @property
    def title(self) -> str:
        """What the level is called in lists."""
        return self.named.name or Path(self.named.file).stem or "nameless"


@dataclass(frozen=True)
class Episode:
    """Up to five levels in a row. ``number``: 0 to 99, its place in the grid."""

    number: int
    name: str
    levels: tuple[Entry, ...]

    @cached_property
    def key(self) -> str:
        """Its key in the records."""
        return episode_key(entry.named.level for entry in self.levels)

    @property
    def column(self) -> int:
        """Its column in the grid."""
        return self.number // EPISODES_PER_COLUMN

    def title(self, level: int) -> str:
        """How a level of it is announced (game.md §2.1)."""
        return f"Episode {self.number} Level {level}: {self.levels[level].title}"


class Catalogue:
    """All levels, read when they are first asked for. ``folder``: the player's own levels."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder
        self.problems: list[str] = []
        self._read: dict[Path, _ReadFile] = {}

    @cached_property
    def bundled(self) -> dict[str, NamedLevel]:
        """The game's own levels by file name; broken files become ``problems``."""
        return {Path(named.file).name: named for named in self._load(bundled_levels())}

    @cached_property
    def episodes(self) -> dict[int, Episode]:
        """The episodes by number."""
        files = bundled_levels()
        listing = files[0].parent / EPISODES_FILE if files else None
        if listing is None or not listing.is_file():
            return {}
        try:
            return {episode.number: episode for episode in read_episodes(listing, self.bundled)}
        except NinjaGameError as error:
            self.problems.append(str(error))
            return {}

    def singles(self) -> list[Entry]:
        """Every level as a single one: the episodes' first, then the other bundled ones, then the player's."""
        entries = [entry for number in sorted(self.episodes) for entry in self.episodes[number].levels]
        named = {entry.named.file for entry in entries}
        entries += [Entry(level, "game") for level in self.bundled.values() if level.file not in named]
        return entries + self.own()

    def own(self) -> list[Entry]:
        """The levels in the player's folder as it is now; what cannot be read becomes ``problems``.

        Files that have not changed since they were last asked for are not read again.
        """
        entries: list[Entry] = []
        if self.folder is not None:
            for found in files_below(self.folder):
                if isinstance(found, LeftOut):
                    self.problems.append(str(found))
                else:
                    entries += self._entries_of(found)
        return entries

    def _entries_of(self, file: Path) -> list[Entry]:
        """The levels of one file of the player's."""
        try:
            state = file.stat()
        except OSError:
            return []
        stamp = state.st_mtime_ns, state.st_size
        known = self._read.get(file)
        if known is None or known.stamp != stamp:
            before = len(self.problems)
            entries = [Entry(level, "yours") for level in self._load([file])]
            known = self._read[file] = _ReadFile(stamp, entries, self.problems[before:])
        else:
            self.problems += known.problems
        return known.entries

    def _load(self, files: Iterable[Path]) -> list[NamedLevel]:
        found: list[NamedLevel] = []
        for file in files:
            try:
                found += load_levels(file)
            except NinjaGameError as error:
                self.problems.append(str(error))
            except OSError as error:
                self.problems.append(f"{file.name}: {error.strerror}")
        return found


class _ReadFile(NamedTuple):
    """What was found in a file, and when it had been changed last."""

    stamp: tuple[int, int]
    entries: list[Entry]
    problems: list[str]


def read_episodes(listing: Path, levels: dict[str, NamedLevel]) -> list[Episode]:
    """The episodes that ``episodes.toml`` lists, made of ``levels`` by file name.

    Raises LevelError for a listing that is wrong: unknown file, number out of range, too many levels.
    """
    try:
        tables = tomllib.loads(read_utf8(listing)).get("episode", [])
    except (ValueError, RecursionError) as error:
        raise LevelError(f"not a list of episodes: {error}", str(listing)) from None
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise LevelError("not a list of episodes", str(listing), expected="a table [[episode]] for each")
    episodes = []
    for table in tables:
        number, files = table.get("number"), table.get("levels", [])
        if not isinstance(number, int) or not 0 <= number < COLUMNS * EPISODES_PER_COLUMN:
            raise LevelError("an episode's number", str(listing), found=repr(number), expected="a number from 0 to 99")
        named = isinstance(files, list) and all(isinstance(file, str) for file in files)
        if not named or not 1 <= len(files) <= LEVELS_PER_EPISODE:
            raise LevelError(f"the levels of episode {number}", str(listing), expected="one to five file names")
        missing = [file for file in files if file not in levels]
        if missing:
            raise LevelError(f"episode {number} names a level that is not here", str(listing), found=str(missing[0]))
        entries = [Entry(levels[file], "game", f"{number:02d}-{place}") for place, file in enumerate(files)]
        episodes.append(Episode(number, str(table.get("name", "")), tuple(entries)))
    return sorted(episodes, key=lambda episode: episode.number)
