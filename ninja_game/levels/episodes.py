"""Levels in the lists of the game: entries with their looks and par times, episodes, packs of episodes."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from ninja_game.files.user_folder import DAILY
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE
from ninja_game.formats.pack.pack import RECEIVED, Pack, PackFiles
from ninja_game.formats.pack.pars import Pars
from ninja_game.formats.replay.text import episode_key

GAME, YOURS = "game", "yours"  # sources of levels other than packs: the game's own pack, files in the player's folder

_NUMBER = re.compile("[0-9]{1,2}-[0-9]")

OURS = "ninja-game"  # part of the name of every author who belongs to the project


class Mood(NamedTuple):
    """The look of a level: the column of its episode, and the number of levels before it in that column."""

    column: int = 0
    level: int = 0


@dataclass(frozen=True)
class Entry:
    """A level that can be played. ``source``: GAME, YOURS or the key of a pack; ``episode``: "03-1" or "".

    ``pars``: its par times and difficulty, if its pack has them.
    """

    named: NamedLevel
    source: str
    episode: str = ""
    pars: Pars | None = None

    @cached_property
    def digest(self) -> str:
        return level_digest(self.named.level)

    @cached_property
    def all_gold(self) -> int:
        return self.named.level.gold

    @property
    def number(self) -> str:
        """The number that players use: ``episode``, or a comment such as "18-2", as in lists of N's levels; or ""."""
        return self.episode or self.named.comment * bool(_NUMBER.fullmatch(self.named.comment))

    @property
    def position(self) -> tuple[int, int] | None:
        """Number of its episode, and its place there from 0; None for a level outside of episodes."""
        episode, _, level = self.episode.partition("-")
        return (int(episode), int(level)) if level else None

    @property
    def place(self) -> str:
        """Its place as players count it; "" for a level outside of episodes."""
        return f"Episode {episode_code(self.position[0])}, level {self.position[1] + 1}" if self.position else ""

    @property
    def mood(self) -> Mood:
        episode, level = self.position or (0, 0)
        column, place = divmod(episode, EPISODES_PER_COLUMN)
        return Mood(column, LEVELS_PER_EPISODE * place + level)

    @property
    def title(self) -> str:
        return self.named.name or Path(self.named.file).stem or "nameless"


@dataclass(frozen=True)
class Episode:
    """Up to five levels in a row. ``number``: 0 to 99, its place in the grid; ``pack``: key of its pack."""

    number: int
    name: str
    levels: tuple[Entry, ...]
    pack: str = ""

    @cached_property
    def key(self) -> str:
        return episode_key(entry.named.level for entry in self.levels)

    @property
    def column(self) -> int:
        return self.number // EPISODES_PER_COLUMN

    @property
    def code(self) -> str:
        return episode_code(self.number)

    def title(self, level: int) -> str:
        return f"Episode {self.code}, level {level + 1}: {self.levels[level].title}"


class EpisodeSet(NamedTuple):
    """A pack in the lists of the game. ``key``: "" for the game's own, else its name; ``singles``: other levels.

    ``pack``: the pack that was read, or None.
    """

    key: str
    name: str
    columns: tuple[str, ...]  #: their names, from the left
    episodes: dict[int, Episode]  #: episodes by number, 0 to 99
    singles: tuple[Entry, ...]
    pack: Pack | None = None

    @property
    def files(self) -> PackFiles | None:
        return self.pack.files if self.pack else None

    @property
    def path(self) -> Path | None:
        return self.pack.files.path if self.pack else None

    @property
    def is_changeable(self) -> bool:
        """Whether it is a folder that belongs to the player, other than that of the daily levels."""
        return bool(self.key and self.path and self.path.name != DAILY and self.path.is_dir())

    @property
    def received(self) -> bool:
        """Whether it came by a link and belongs to somebody else."""
        return bool(self.files and RECEIVED in self.files.names)

    @property
    def levels(self) -> list[Entry]:
        """Every level, those of the episodes first, in their order."""
        return [entry for number in sorted(self.episodes) for entry in self.episodes[number].levels] + [*self.singles]


def episode_code(number: int) -> str:
    """Number an episode as players do: its column and its place in it, from 1.

    Files, documents and boards count from 0, in two digits.

    >>> episode_code(0), episode_code(13)
    ('1.1', '2.4')
    """
    column, place = divmod(number, EPISODES_PER_COLUMN)
    return f"{column + 1}.{place + 1}"


def author_name(author: str) -> str:
    """The name of an author on screens: the project's own makers get one common name.

    >>> author_name("the ninja-game team"), author_name("ninja-game check"), author_name("Ann")
    ('ninja-game', 'ninja-game', 'Ann')
    """
    return OURS if OURS in author else author


def episode_set(pack: Pack, key: str, name: str = "") -> EpisodeSet:
    """Make the episodes and single levels of a pack; ``name``: the name to show instead of its own.

    A level without an author gets the author of the pack.
    """
    source = key or GAME

    def entry(level: NamedLevel, place: str = "") -> Entry:
        named = level if level.author else replace(level, author=pack.index.author)
        return Entry(named, source, place, pars.get(level.file))

    pars = {pack.files.place(file): par for file, par in pack.pars.items()}
    episodes = {}
    for index, levels in pack.episodes.items():
        entries = [entry(level, f"{index.number:02d}-{place}") for place, level in enumerate(levels)]
        episodes[index.number] = Episode(index.number, index.name, tuple(entries), key)
    placed = {level.file for levels in pack.episodes.values() for level in levels}
    singles = [level for level in pack.levels.values() if level.file not in placed]
    return EpisodeSet(key, name or pack.name, pack.index.columns, episodes, tuple(map(entry, singles)), pack)
