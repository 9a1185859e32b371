"""The levels that pages show: those of a pack with episodes, par times and certificates, or of any file or folder."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache, cached_property
from hashlib import sha256
from io import BytesIO
from pathlib import Path

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.formats.links.fragment import write_watch
from ninja_game.formats.load import load_levels
from ninja_game.formats.pack.files import is_pack
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.player.catalogue import Entry, EpisodeSet, episode_set
from ninja_game.sim.level import Level
from ninja_game.ui.theme import CLASSIC
from ninja_game.view.sprites.thumbnail import thumbnail

PICTURE_WIDTH = 792
CERTIFICATES = ("exit", "gold")


@dataclass(frozen=True)
class PublishedLevels:
    """Levels with what is known of them."""

    name: str
    author: str
    comment: str
    levels: EpisodeSet
    pack: Pack | None = field(default=None, repr=False, compare=False)

    @cached_property
    def entries(self) -> dict[str, Entry]:
        """The levels by digest, in playing order; of equal ones the first."""
        found: dict[str, Entry] = {}
        for entry in self.levels.levels:
            found.setdefault(entry.digest, entry)
        return found

    @cached_property
    def runs(self) -> Mapping[str, Mapping[str, Recording]]:
        """By level digest the certificates there are, "exit" or "gold"."""
        return {entry.digest: _certificates(self.pack, entry) for entry in self.levels.levels} if self.pack else {}


def published_levels(path: Path) -> PublishedLevels:
    """The levels of a pack, or of any file or folder. Raises NinjaGameError, OSError."""
    if not is_pack(path):
        entries = tuple(Entry(level, "yours") for level in load_levels(path))
        return PublishedLevels(path.stem, "", "", EpisodeSet("", path.stem, (), {}, entries))
    pack = Pack(path)
    return PublishedLevels(pack.name, pack.index.author, pack.index.comment, episode_set(pack, ""), pack)


def _certificates(pack: Pack, entry: Entry) -> dict[str, Recording]:
    found = {}
    for kind in CERTIFICATES:
        name = pack.certificate(Path(entry.named.file).name, kind)
        if name is not None:
            try:
                (found[kind],) = parse_replays(pack.files.text(name), level=entry.named.level)
            except NinjaGameError:
                # `levels lint` tells what is wrong with it; the page does without.
                continue
    return found


def page_name(digest: str) -> str:
    return f"levels/{digest[:16]}.html"


def picture_name(digest: str) -> str:
    return f"pictures/{digest[:16]}.png"


def picture(level: Level, width: int = PICTURE_WIDTH) -> bytes:
    """The level as a PNG, as the game draws it; colours are reduced, so that it is small."""
    from PIL import Image

    _keep_freed_memory()
    surface = thumbnail(level, CLASSIC, width)
    image = Image.frombytes("RGB", surface.get_size(), pygame.image.tobytes(surface, "RGB"))
    out = BytesIO()
    image.quantize(128, Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE).save(out, "png")
    return out.getvalue()


@cache
def _keep_freed_memory() -> None:
    """Keep what is freed: glibc gives back all beyond twice the largest piece freed so far, of 32 MiB at most.

    To get it again for each surface took a third of a picture's time.
    """
    bytearray(31 << 20)


def shared_text(replay: Replay, level: Level) -> str:
    """A replay as the page fetches it: its level inside, no path, no waypoints, nothing that is only claimed."""
    return write_replay(
        replace(replay, level=level, level_path="", level_record=0, level_digest="", digest="", waypoints=())
    )


def shared_name(text: str) -> str:
    """The stem of the file in ``replays`` that holds a text."""
    return sha256(text.encode()).hexdigest()[:16]


def watch_address(game: str, *stems: str) -> str:
    """Where runs are watched: ``game`` is the address of the page with the game."""
    return game + write_watch(stems)
