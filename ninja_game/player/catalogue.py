"""The levels there are: the game's own pack, in episodes, and those that the player has put into a folder.

Levels of the pack that no episode has are single levels.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import LeftOut, files_below
from ninja_game.files.resources import data_folder
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.formats.pack.pack import Pack
from ninja_game.player.records import episode_key


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
    def pack(self) -> Pack | None:
        """The game's own pack; None, and a problem, where it cannot be read."""
        try:
            return Pack(data_folder("levels"))
        except (NinjaGameError, OSError) as error:
            self.problems.append(str(error))
            return None

    @cached_property
    def episodes(self) -> dict[int, Episode]:
        """The episodes that have levels, by number; what is wrong with their files becomes ``problems``."""
        if self.pack is None:
            return {}
        found = {}
        for index, levels in self.pack.episodes.items():
            entries = [Entry(level, "game", f"{index.number:02d}-{place}") for place, level in enumerate(levels)]
            found[index.number] = Episode(index.number, index.name, tuple(entries))
        self.problems += self.pack.problems
        return found

    def singles(self) -> list[Entry]:
        """Every level as a single one: the episodes' first, then the other bundled ones, then the player's."""
        entries = [entry for number in sorted(self.episodes) for entry in self.episodes[number].levels]
        named = {entry.named.file for entry in entries}
        bundled = self.pack.levels.values() if self.pack else ()
        entries += [Entry(level, "game") for level in bundled if level.file not in named]
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
