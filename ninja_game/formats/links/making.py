"""Links of levels, packs and replays, and the texts that links carry, checked."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from ninja_game.errors import FormatError, LinkError
from ninja_game.files.beside import PLACE
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.links.fragment import Kind, Link, read_link, write_link
from ninja_game.formats.n14.level_file import write_level_file
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.recording import Recording, parse_replays, record_of
from ninja_game.formats.replay.episode import is_episode, parse_episode, write_episode
from ninja_game.formats.replay.text import Replay, is_replay, parse_replay, write_replay
from ninja_game.sim.level import Level

_NAME_LIMIT = 100
"""Characters of the name of a file in a pack."""
_LEFT_OUT = re.compile(r"^(?:waypoints|level-data):\n(?:(?: .*)?\n)*", re.MULTILINE)
"""Of certificates in links of packs: the pack has the levels, and the digest says the same as the waypoints."""


def level_link(level: Level, **headers: Any) -> str:
    """The link of a level, from the # on. ``headers``: as ``write_ascii_level`` has them. Raises LinkError."""
    return write_link("level", [write_ascii_level(level, **headers)])


def replay_text(replay: Replay, level: Level | None = None) -> str:
    """The text that a link of a replay carries: level inside, waypoints left out, since the digest says the same.

    ``level``: of a replay that does not hold its own. Raises LinkError where there is none.
    """
    level = replay.level or level
    if level is None:
        raise LinkError("a replay without its level", hint="record it with its level inside")
    digest = level_digest(level)
    return write_replay(replace(replay, level=level, level_digest=digest, level_path="", level_record=0, waypoints=()))


def replay_link(replays: Iterable[Replay]) -> str:
    """The link of replays with their levels inside; behind the first the others are its ghosts. Raises LinkError."""
    return write_link("replay", [replay_text(replay) for replay in replays])


def recording_link(recordings: Iterable[Recording]) -> str:
    """A link of recordings of any format; one of N stays N's record.

    Raises LinkError; LevelError or DemoError for what N's record cannot hold.
    """
    return write_link("replay", [_recording_text(each) for each in recordings])


def _recording_text(recording: Recording) -> str:
    if recording.form != "file":
        return replay_text(recording.replay, recording.level)
    return write_level_file([record_of(recording)])


def pack_link(texts: dict[str, str]) -> str:
    """The link of a pack from its files by name: index, levels, par times, certificates as short as they can be.

    Raises LinkError.
    """
    known = {name for name, text in texts.items() if is_replay(text) and "\nlevel-digest:" in text}
    short = {name: _LEFT_OUT.sub("", text) if name in known else text for name, text in texts.items()}
    return write_link("pack", [json.dumps(short, ensure_ascii=False, separators=(",", ":"))])


def whole_certificate(text: str, level: NamedLevel) -> str:
    """A certificate from a link with its level inside again; any other text as it is."""
    with suppress(FormatError):
        replay = parse_replay(text) if is_replay(text) else None
        if replay and replay.level is None and replay.level_digest == level_digest(level.level):
            own = replace(replay, level_path="", level_record=0, level=level.level)
            return write_replay(replace(own, level_name=level.name, level_author=level.author))
    return text


def pack_texts(link: str | Path) -> dict[str, str]:
    """The files of the pack in a link, by name. Raises LinkError."""
    (text,) = linked_texts(link, "pack")
    try:
        files = json.loads(text)
    except (ValueError, RecursionError):
        files = None
    if not isinstance(files, dict) or not all(isinstance(file, str) for file in files.values()):
        raise LinkError("no pack in this link", PLACE, found=repr(text[:40]), expected="files by their names, as JSON")
    odd = next((name for name in files if not _is_plain(name)), None)
    if odd is not None:
        raise LinkError("a name that no file of a pack has", PLACE, found=ascii(odd[:40]))
    return files


def _is_plain(name: str) -> bool:
    """Whether a name is that of a file in a pack, or of a certificate: no other path, nothing hidden."""
    name = name.removeprefix("certificates/")
    plain = name.isprintable() and not set(name) & set("/\\:") and not name.startswith(".")
    return plain and 0 < len(name) <= _NAME_LIMIT


def linked_texts(link: str | Path, *kinds: Kind) -> tuple[str, ...]:
    """The texts in a link of one of some kinds, as a file would hold them. Raises LinkError."""
    found: Link = read_link(link)
    if found.kind not in kinds:
        raise LinkError(f"a link of a {found.kind}", PLACE, expected=f"one of a {' or '.join(kinds)}")
    return tuple(map(_whole, found.texts))


def recordings_of(texts: Iterable[str]) -> list[Recording]:
    """The recordings in texts from elsewhere, which hold their levels. Raises LinkError, ReplayError, LevelError."""
    found = []
    for text in texts:
        found += parse_replays(_whole(text), file=PLACE)
    return found


def _whole(text: str) -> str:
    """A text from elsewhere; replays in a form in which nothing leads to a file. Raises LinkError, ReplayError.

    Without the name of a file its inputs take in no other files, and with its level inside no path is tried.
    """
    episode = is_episode(text)
    if not episode and not is_replay(text):
        return text
    try:
        replays = parse_episode(text) if episode else [parse_replay(text)]
    except FormatError as error:
        error.file = PLACE
        raise
    if any(replay.level is None for replay in replays):
        raise LinkError("a replay without its level", PLACE, hint="record it with its level inside")
    whole = [replace(replay, level_path="", level_record=0) for replay in replays]
    return write_episode(whole) if episode else write_replay(*whole)
