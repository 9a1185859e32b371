"""All levels: the game's own pack, and the packs and files in the player's folder.

Levels of a pack outside of its episodes are single levels.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.files.bundled import data_folder
from ninja_game.files.reading import Skipped, file_stamp, files_below, files_in
from ninja_game.formats.load import load_levels
from ninja_game.formats.pack.index import PackIndex
from ninja_game.formats.pack.pack import CERTIFICATES, Pack, PackFiles, certificate_name, is_pack
from ninja_game.formats.replay.text import Replay, parse_replay
from ninja_game.levels.episodes import GAME, YOURS, Entry, Episode, EpisodeSet, Mood, episode_set
from ninja_game.sim.level import Level


class Catalogue:
    """All levels, read when they are first needed. ``folder``: the player's own; ``more``: packs elsewhere."""

    def __init__(self, folder: Path | None = None) -> None:
        self.folder = folder
        self.more: list[Path] = []
        self.problems: list[str] = []
        self._read: dict[Path, tuple[object, list[Entry], str]] = {}
        self._known: dict[str, EpisodeSet] = {}
        self._packs: dict[Path, tuple[object, Pack | None, str]] = {}
        self._sets: dict[Path, tuple[Pack, EpisodeSet]] = {}
        self._runs: dict[str, tuple[object, Replay | None]] = {}

    @cached_property
    def ours(self) -> EpisodeSet:
        """The game's own pack; empty, with a problem, if it cannot be read."""
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
        """The game's own pack, then the player's present ones; errors in them become ``problems``.

        The key of a pack is its name, of the first of several with that name; no key is GAME or YOURS. Packs of one
        name are shown with author, version, or else file.
        """
        read = {os.path.realpath(path): path for path in [*self.more, *self._pack_paths()]}
        packs = [(path, pack) for path in read.values() if (pack := self._pack_at(path))]
        indexes = [pack.index for _, pack in packs]
        sets = {"": self.ours}
        for path, pack in packs:
            key = f"{pack.name} ({path.name})" if pack.name in {GAME, YOURS, *sets} else pack.name
            sets[key] = self._set_of(path, pack, key, _name_among(indexes, pack.index, path.name))
        self._known = sets
        return list(sets.values())

    def author_run(self, entry: Entry) -> Replay | None:
        """The certificate to the exit beside a level; None without one for exactly this level.

        A certificate that has not changed since it was last asked for is not read again.
        """
        pack, file = self._pack_of(entry), Path(entry.named.file)
        stamp = file, pack and pack.pack, file_stamp(file.parent / certificate_name(file.name, "exit"))
        if self._runs.get(entry.digest, ((), None))[0] != stamp:
            self._runs[entry.digest] = stamp, self._read_run(entry, pack, file)
        return self._runs[entry.digest][1]

    def _read_run(self, entry: Entry, pack: EpisodeSet | None, file: Path) -> Replay | None:
        name = certificate_name(file.name, "exit")
        try:
            files = PackFiles(file.parent) if entry.source != GAME and file.is_file() else pack and pack.files
            replay = parse_replay(files.text(name)) if files and name in files.names else None
        except (NinjaGameError, OSError):
            return None
        own = replay is not None and replay.level_digest == entry.digest
        return replace(replay, level=entry.named.level) if replay and own else None

    def episode_of(self, entry: Entry) -> Episode | None:
        pack = self._pack_of(entry)
        return pack.episodes.get(entry.position[0]) if pack and entry.position else None

    def is_own(self, entry: Entry) -> bool:
        """Whether the player has made a level: it is in no received pack, and no daily level."""
        pack = self._pack_of(entry)
        return entry.source == YOURS or bool(pack and pack.is_changeable and not pack.received)

    def _pack_of(self, entry: Entry) -> EpisodeSet | None:
        return self.ours if entry.source == GAME else self._known.get(entry.source)

    def mood_of(self, level: Level) -> Mood | None:
        """The mood of a level of the game's own pack; None for any other."""
        return next((entry.mood for entry in self.ours.levels if entry.episode and entry.named.level == level), None)

    def following(self, episode: Episode) -> Episode | None:
        """The next existing episode of its column, or None."""
        later = [other for other in self._column(episode) if other.number > episode.number]
        return min(later, key=lambda other: other.number, default=None)

    def preceding(self, episode: Episode) -> Episode | None:
        """The episode before it in its column, which must be passed first; None for the first one."""
        earlier = [other for other in self._column(episode) if other.number < episode.number]
        return max(earlier, key=lambda other: other.number, default=None)

    def _column(self, episode: Episode) -> list[Episode]:
        episodes = self._known[episode.pack].episodes if episode.pack in self._known else self.episodes
        return [other for other in episodes.values() if other.column == episode.column]

    def _pack_paths(self) -> Iterator[Path]:
        try:
            inside = sorted(self.folder.iterdir()) if self.folder else []
        except OSError:
            return
        yield from (path for path in inside if not path.name.startswith(".") and is_pack(path))

    def _set_of(self, path: Path, pack: Pack, key: str, name: str) -> EpisodeSet:
        """A pack as it is played, the same object while nothing has changed."""
        before, known = self._sets.get(path, (None, None))
        if known is None or before is not pack or (known.key, known.name) != (key, name):
            known = episode_set(pack, key, name)
            self._sets[path] = pack, known
        self.problems += pack.problems
        return known

    def _pack_at(self, path: Path) -> Pack | None:
        """A pack, read again if its files have changed; None, with a problem, if it cannot be read."""
        inside = CERTIFICATES, *files_in(path)
        stamp = [(file, file_stamp(file)) for file in (path, *(path / name for name in inside))]
        if path not in self._packs or self._packs[path][0] != stamp:
            try:
                self._packs[path] = stamp, Pack(path), ""
            except (NinjaGameError, OSError) as error:
                self._packs[path] = stamp, None, str(error)
        _, pack, problem = self._packs[path]
        self.problems += [problem] if problem else []
        return pack

    def single_levels(self) -> list[Entry]:
        """All single levels: the player's, also those in folders of packs, the game's, then those of zips."""
        packs = sorted(self.packs(), key=lambda pack: not pack.is_changeable)
        return self.own() + [entry for pack in packs for entry in pack.levels]

    def own(self) -> list[Entry]:
        """The present levels in the player's folder; errors become ``problems``.

        Files that have not changed since the last call are not read again.
        """
        entries: list[Entry] = []
        if self.folder is not None:
            packs = [*self._pack_paths(), self.folder / CERTIFICATES]
            for path in files_below(self.folder):
                if isinstance(path, Skipped):
                    self.problems.append(str(path))
                elif not any(path.is_relative_to(pack) for pack in packs):
                    entries += self._entries_of(path)
        return entries

    def _entries_of(self, file: Path) -> list[Entry]:
        stamp = file_stamp(file)
        if file not in self._read or self._read[file][0] != stamp:
            try:
                self._read[file] = stamp, [Entry(level, YOURS) for level in load_levels(file)], ""
            except NinjaGameError as error:
                self._read[file] = stamp, [], str(error)
            except OSError as error:
                self._read[file] = stamp, [], f"{file.name}: {error.strerror}"
        _, entries, problem = self._read[file]
        self.problems += [problem] if problem else []
        return entries


def _name_among(packs: Sequence[PackIndex], index: PackIndex, file: str) -> str:
    """The name of a pack: its title, with author, version or ``file`` if other packs have that title."""
    alike = [other for other in packs if other.name == index.name]
    authors, versions = {other.author for other in alike}, {other.version for other in alike}
    distinct = replace(
        index, author=index.author if len(authors) > 1 else "", version=index.version if len(versions) > 1 else ""
    )
    same_title = len(alike) > 1 and [pack.title for pack in packs].count(index.title) > 1
    return f"{distinct.title} ({file})" if same_title else distinct.title
