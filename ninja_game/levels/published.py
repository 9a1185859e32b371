"""The levels that pages show, of a pack or of any file or folder, with their certificates."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.formats.load import load_levels
from ninja_game.formats.pack.pack import Pack, is_pack
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.levels.episodes import YOURS, Entry, EpisodeSet, episode_set

RUN_TITLES = {"exit": "To the exit", "gold": "With all gold"}


@dataclass(frozen=True)
class PublishedLevels:
    """Levels of the game or of a pack, as pages and boards show them."""

    name: str
    author: str
    comment: str
    levels: EpisodeSet
    pack: Pack | None = field(default=None, repr=False, compare=False)  #: the pack that was read; None: the game's own

    @cached_property
    def entries(self) -> dict[str, Entry]:
        """The levels by digest, in playing order; of equal ones the first."""
        by_key: dict[str, Entry] = {}
        for entry in self.levels.levels:
            by_key.setdefault(entry.digest, entry)
        return by_key

    @cached_property
    def runs(self) -> Mapping[str, Mapping[str, Recording]]:
        """Certificates by level digest, then by kind: "exit" or "gold"."""
        return {entry.digest: _certificates(self.pack, entry) for entry in self.levels.levels} if self.pack else {}


def published_levels(path: Path) -> PublishedLevels:
    """The levels of a pack, or of any file or folder. Raises NinjaGameError, OSError."""
    if not is_pack(path):
        entries = tuple(Entry(level, YOURS) for level in load_levels(path))
        name = path.resolve().stem  # of "." too
        return PublishedLevels(name, "", "", EpisodeSet("", name, (), {}, entries))
    pack = Pack(path)
    return PublishedLevels(pack.name, pack.index.author, pack.index.comment, episode_set(pack, ""), pack)


def _certificates(pack: Pack, entry: Entry) -> dict[str, Recording]:
    certificates = {}
    for kind in RUN_TITLES:
        name = pack.certificate(Path(entry.named.file).name, kind)
        with suppress(NinjaGameError):  # `levels lint` reports its problem; the page leaves it out
            if name is not None:
                (certificates[kind],) = parse_replays(pack.files.text(name), level=entry.named.level)
    return certificates
