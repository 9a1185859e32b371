"""All levels: the game's own pack, packs and files that the player has put into a folder.

Levels of a pack that no episode has are single levels.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import LeftOut, files_below, files_in, stamp_of
from ninja_game.files.user_folder import data_folder
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE
from ninja_game.formats.pack.pack import CERTIFICATES, Pack, PackFiles, certificate_name, is_pack
from ninja_game.formats.pack.pars import Pars
from ninja_game.formats.replay.text import Replay, episode_key, parse_replay
from ninja_game.sim.level import Level

OURS = "ninja-game"  # in the name of every author that is part of the project


class Mood(NamedTuple):
    """The look of a level: the column of its episode, and how many levels come before it in that column."""

    column: int = 0
    level: int = 0


@dataclass(frozen=True)
class Entry:
    """A level that can be played. ``source``: "game", "yours" or the name of a pack; ``episode``: "03-1" if any.

    ``pars``: its par times and difficulty, where its pack has them.
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
    def position(self) -> tuple[int, int] | None:
        """Number of its episode, and its place there from 0; None for a level in no episode."""
        episode, _, level = self.episode.partition("-")
        return (int(episode), int(level)) if level else None

    @property
    def place(self) -> str:
        """Its place as players count it; "" for a level in no episode."""
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
    """A pack as it is played. ``key``: "" for the game's own, else its name; ``singles``: levels in no episode.

    ``pack``: what it was read from, or None.
    """

    key: str
    name: str
    columns: tuple[str, ...]
    episodes: dict[int, Episode]
    singles: tuple[Entry, ...]
    pack: Pack | None = None

    @property
    def files(self) -> PackFiles | None:
        return self.pack.files if self.pack else None

    @property
    def path(self) -> Path | None:
        return self.pack.files.path if self.pack else None

    @property
    def changeable(self) -> bool:
        """Whether it is a folder of the player's own."""
        return bool(self.key and self.path and self.path.is_dir())

    @property
    def levels(self) -> list[Entry]:
        """Every level, those of the episodes first, in their order."""
        return [entry for number in sorted(self.episodes) for entry in self.episodes[number].levels] + [*self.singles]


def episode_code(number: int) -> str:
    """How players count an episode: its column and its place in it, from 1.

    Files, documents and boards count from 0, in two digits.

    >>> episode_code(0), episode_code(13)
    ('1.1', '2.4')
    """
    column, place = divmod(number, EPISODES_PER_COLUMN)
    return f"{column + 1}.{place + 1}"


def author_name(author: str) -> str:
    """What an author is called on screens: who or what of the project made a thing tells a player nothing.

    >>> author_name("the ninja-game team"), author_name("ninja-game check"), author_name("Ann")
    ('ninja-game', 'ninja-game', 'Ann')
    """
    return OURS if OURS in author else author


def episode_set(pack: Pack, key: str, name: str = "") -> EpisodeSet:
    """A pack's episodes and single levels as they are played; ``name``: what it is called, if not by its own.

    A level without an author is by that of the pack.
    """
    source = key or "game"

    def entry(level: NamedLevel, place: str = "") -> Entry:
        named = level if level.author else replace(level, author=pack.index.author)
        return Entry(named, source, place, pars.get(level.file))

    pars = {pack.files.place(file): each for file, each in pack.pars.items()}
    episodes = {}
    for index, levels in pack.episodes.items():
        entries = [entry(level, f"{index.number:02d}-{place}") for place, level in enumerate(levels)]
        episodes[index.number] = Episode(index.number, index.name, tuple(entries), key)
    placed = {level.file for levels in pack.episodes.values() for level in levels}
    singles = [level for level in pack.levels.values() if level.file not in placed]
    return EpisodeSet(key, name or pack.name, pack.index.columns, episodes, tuple(map(entry, singles)), pack)


class Catalogue:
    """All levels, read when they are first asked for. ``folder``: the player's own; ``more``: packs elsewhere."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder
        self.more: list[Path] = []
        self.problems: list[str] = []
        self._read: dict[Path, _ReadFile] = {}
        self._known: dict[str, EpisodeSet] = {}
        self._packs: dict[Path, tuple[object, Pack | None, str]] = {}
        self._sets: dict[Path, tuple[Pack, EpisodeSet]] = {}

    @cached_property
    def ours(self) -> EpisodeSet:
        """The game's own pack; empty, and a problem, where it cannot be read."""
        path = data_folder("levels")
        pack = self._pack_at(path)
        return self._set_of(path, pack, "", pack.name) if pack else EpisodeSet("", "", (), {}, ())

    @property
    def episodes(self) -> dict[int, Episode]:
        """The episodes of the game's own pack that have levels, by number."""
        return self.ours.episodes

    @property
    def shown_problems(self) -> list[str]:
        """The problems, each once, with paths below the player's folder."""
        return list(dict.fromkeys(problem.replace(f"{self.folder}{os.sep}", "") for problem in self.problems))

    def packs(self) -> list[EpisodeSet]:
        """The game's own pack, then the player's as they are now; what is wrong with them becomes ``problems``.

        Of several packs of one name the first has the key that it would have alone; each is called by what tells it
        from the others too: author, version, else its file.
        """
        read = {os.path.realpath(path): path for path in [*self.more, *self._pack_paths()]}
        packs = [(path, pack) for path in read.values() if (pack := self._pack_at(path))]
        titles = Counter(pack.index.title for _, pack in packs)
        found = {"": self.ours}
        for path, pack in packs:
            alike = [each.index for _, each in packs if each.name == pack.name]
            author, version = (len({getattr(each, key) for each in alike}) > 1 for key in ("author", "version"))
            index = replace(pack.index, author=pack.index.author * author, version=pack.index.version * version)
            name = index.title + f" ({path.name})" * (len(alike) > 1 < titles[pack.index.title])
            key = f"{pack.name} ({path.name})" if pack.name in found else pack.name
            found[key] = self._set_of(path, pack, key, name)
        self._known = found
        return list(found.values())

    def author_run(self, entry: Entry) -> Replay | None:
        """The certificate to the exit beside a level; None without one for exactly this level."""
        pack, file = self.ours if entry.source == "game" else self._known.get(entry.source), Path(entry.named.file)
        name = certificate_name(file.name, "exit")
        try:
            files = PackFiles(file.parent) if entry.source == "yours" and file.is_file() else pack and pack.files
            replay = parse_replay(files.text(name)) if files and name in files.names else None
        except (NinjaGameError, OSError):
            return None
        own = replay is not None and replay.level_digest == entry.digest
        return replace(replay, level=entry.named.level) if replay and own else None

    def episode_of(self, entry: Entry) -> Episode | None:
        pack = self.ours if entry.source == "game" else self._known.get(entry.source)
        return pack.episodes.get(entry.position[0]) if pack and entry.position else None

    def mood_of(self, level: Level) -> Mood | None:
        """The mood of a level of the game's own pack; None for any other."""
        return next((entry.mood for entry in self.ours.levels if entry.episode and entry.named.level == level), None)

    def following(self, episode: Episode) -> Episode | None:
        """The next existing episode of its column, or None."""
        later = [each for each in self._column(episode) if each.number > episode.number]
        return min(later, key=lambda each: each.number, default=None)

    def preceding(self, episode: Episode) -> Episode | None:
        """The episode before it in its column, which has to be passed first; None for the first one."""
        earlier = [each for each in self._column(episode) if each.number < episode.number]
        return max(earlier, key=lambda each: each.number, default=None)

    def _column(self, episode: Episode) -> list[Episode]:
        episodes = self._known[episode.pack].episodes if episode.pack in self._known else self.episodes
        return [each for each in episodes.values() if each.column == episode.column]

    def _pack_paths(self) -> Iterator[Path]:
        try:
            inside = sorted(self.folder.iterdir()) if self.folder else []
        except OSError:
            return
        yield from (path for path in inside if not path.name.startswith(".") and is_pack(path))

    def _set_of(self, path: Path, pack: Pack, key: str, name: str) -> EpisodeSet:
        """A pack as it is played, the same one as long as nothing has changed."""
        before, known = self._sets.get(path, (None, None))
        if known is None or before is not pack or (known.key, known.name) != (key, name):
            known = episode_set(pack, key, name)
            self._sets[path] = pack, known
        self.problems += pack.problems
        return known

    def _pack_at(self, path: Path) -> Pack | None:
        """A pack, read again when its files have changed; None, and a problem, where it cannot be read."""
        inside = CERTIFICATES, *files_in(path)
        stamp = [(file, stamp_of(file)) for file in (path, *(path / name for name in inside))]
        if path not in self._packs or self._packs[path][0] != stamp:
            try:
                self._packs[path] = stamp, Pack(path), ""
            except (NinjaGameError, OSError) as error:
                self._packs[path] = stamp, None, str(error)
        _, pack, problem = self._packs[path]
        self.problems += [problem] if problem else []
        return pack

    def singles(self) -> list[Entry]:
        """Every level as a single one: the player's, also those in folders of packs, the game's, then those of zips."""
        packs = sorted(self.packs(), key=lambda pack: not pack.changeable)
        return self.own() + [entry for pack in packs for entry in pack.levels]

    def own(self) -> list[Entry]:
        """The levels in the player's folder as it is now; what cannot be read becomes ``problems``.

        Files that have not changed since they were last asked for are not read again.
        """
        entries: list[Entry] = []
        if self.folder is not None:
            packs = [*self._pack_paths(), self.folder / CERTIFICATES]
            for found in files_below(self.folder):
                if isinstance(found, LeftOut):
                    self.problems.append(str(found))
                elif not any(found.is_relative_to(pack) for pack in packs):
                    entries += self._entries_of(found)
        return entries

    def _entries_of(self, file: Path) -> list[Entry]:
        stamp = stamp_of(file)
        known = self._read.get(file)
        if known is None or known.stamp != stamp:
            known = self._read[file] = _read(file, stamp)
        self.problems += known.problems
        return known.entries


class _ReadFile(NamedTuple):
    """What was found in a file, and when it had been changed last."""

    stamp: list[int]
    entries: list[Entry]
    problems: list[str]


def _read(file: Path, stamp: list[int]) -> _ReadFile:
    try:
        return _ReadFile(stamp, [Entry(level, "yours") for level in load_levels(file)], [])
    except NinjaGameError as error:
        return _ReadFile(stamp, [], [str(error)])
    except OSError as error:
        return _ReadFile(stamp, [], [f"{file.name}: {error.strerror}"])
