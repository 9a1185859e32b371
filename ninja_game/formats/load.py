"""Load levels or recordings from a file, a folder or a link in any format."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from ninja_game.errors import LevelError, ReplayError
from ninja_game.files.reading import LINK, SUFFIXES, read_text, text_files
from ninja_game.formats.links import is_link, linked_texts
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.formats.pack.pack import PackFiles, is_pack
from ninja_game.formats.recording import Recording, parse_replays
from ninja_game.sim.level import Level

__all__ = ["NamedLevel", "Recording", "load_level", "load_levels", "load_replays", "parse_level", "texts_of"]


def texts_of(path: Path | str, *, may_be_link: bool = True) -> Iterator[tuple[str, str]]:
    """The name and text of a file, of each file in a folder, or of the levels or replays in a link.

    ``may_be_link``: a person gave the path, which may be a link; a path that was found is always a file.

    Raises FileError, LinkError; OSError for a file that cannot be opened.
    """
    if may_be_link and is_link(path):
        yield from ((LINK, text) for text in linked_texts(path, "level", "replay"))
    else:
        yield from ((str(file), read_text(file)) for file in text_files(Path(path)))


def load_levels(path: Path | str) -> list[NamedLevel]:
    """Load all levels of a file, folder or link: ASCII levels, N level files, in-game strings, levels of recordings.

    Of a pack (a folder or zip with ``pack.toml``) only its level files.

    Raises LevelError (or ReplayError for a broken replay) naming the file; OSError for a file that cannot be opened.
    """
    if is_pack(Path(path)):
        pack = PackFiles(Path(path))
        levels = [level for name in pack.levels for level in parse_levels(pack.text(name), file=pack.place(name))]
    else:
        levels = [level for file, text in texts_of(path) for level in parse_levels(text, file=file)]
    if not levels:
        raise LevelError("no levels here", str(path), expected=f"files *{', *'.join(SUFFIXES)}")
    return levels


def load_level(path: Path | str, record: int = 0) -> Level:
    """The level of a file, or its level number ``record`` (from 0).

    Raises LevelError as ``load_levels`` does, and for a record that the file does not have.
    """
    return _level_at(load_levels(path), record, str(path))


def parse_level(text: str, record: int = 0) -> Level:
    """The level in a text of any format that ``load_level`` reads, or its level number ``record`` (from 0).

    Raises LevelError (or ReplayError for a broken replay) with line and column; also for a text that is not a level.
    """
    return _level_at(parse_levels(text), record, "")


def _level_at(levels: Sequence[NamedLevel], record: int, file: str) -> Level:
    if not 0 <= record < len(levels):
        raise LevelError(f"there is no record {record}", file, expected=f"0 to {len(levels) - 1}")
    return levels[record].level


def load_replays(path: Path | str, *, level: Level | None = None, changed: bool = False) -> list[Recording]:
    """Load all recordings of a file, folder or link: replays and ``$name#author#comment#level#demo#`` records.

    ``level``: the level of recordings that do not contain their own. ``changed``: also load recordings whose level was
    changed afterwards, with the level as it is now.

    Raises ReplayError, DemoError or LevelError naming file and line; OSError for a file that cannot be opened.
    """
    recordings = [
        run for file, text in texts_of(path) for run in parse_replays(text, file=file, level=level, changed=changed)
    ]
    if not recordings:
        raise ReplayError("no recordings here", str(path), expected=f"files *{', *'.join(SUFFIXES)}")
    return recordings
