"""Links that contain a whole level, pack or replays as compressed text after the # of an address.

``#level=1.…``, ``#pack=1.…``, ``#replay=1.…`` (`docs/links.md`).
"""

from __future__ import annotations

import json
import re
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal
from urllib.parse import unquote

from ninja_game.errors import FormatError, LinkError
from ninja_game.files.reading import LINK, decoded
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.n14.level_file import write_level_file
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.recording import Recording, parse_replays, record_of
from ninja_game.formats.replay.text import (
    Replay,
    is_episode,
    is_replay,
    parse_episode,
    parse_replay,
    write_episode,
    write_replay,
)
from ninja_game.sim.level import Level

LinkKind = Literal["level", "pack", "replay"]
LINK_KINDS: tuple[LinkKind, ...] = ("level", "pack", "replay")

LINK_VERSION = 1
"""The format: four bytes of CRC-32, then the raw deflate (RFC 1951) of the UTF-8 text, in base64url without padding."""

MAX_CHARACTERS = 2 * 2**20  # length of a link: what browsers take

MAX_LINK_BYTES = 4 * 2**20  # size of its text when unpacked

MAX_TEXTS = 9  # most texts in a link of replays: the watched one, and as many ghosts as the viewer shows

_PART = re.compile(r"(level|pack|replay)=([0-9]{1,4})\.([A-Za-z0-9_-]*)")
_STEM = re.compile(r"([0-9a-f]{16})(?:-([0-9]))?")
_ADDRESS = re.compile(r"[a-z]{2}:/", re.IGNORECASE)
_AROUND = "\0 \t\r\n.,;:!?)>]}\"'"  # characters that people and programs write after a link


@dataclass(frozen=True)
class ParsedLink:
    """The content of a link: one text, or several of replays. Trust it as little as any file."""

    kind: LinkKind
    texts: tuple[str, ...]


def link_kind(text: str | Path) -> LinkKind | None:
    """The kind of link that a text, or a path made of it, looks like, valid or not; None for any other text.

    A link begins with its #, or with an address before it; a file may have any other name.

    >>> link_kind("https://example.org/game/#pack=1.abc"), link_kind("levels/a#level=1.txt")
    ('pack', None)
    """
    before, _, fragment = "".join(str(text).split()).partition("#")
    if before.strip(_AROUND + "<([") and not _ADDRESS.search(before):
        return None
    fragment = unquote(fragment)
    return next((kind for kind in LINK_KINDS if fragment.startswith(f"{kind}=")), None)


def is_link(text: str | Path) -> bool:
    """Whether a text, or a path made of it, looks like a link of this project."""
    return link_kind(text) is not None


def write_link(kind: LinkKind, texts: Sequence[str]) -> str:
    """The fragment, from the # on. Raises LinkError for more than a link can hold.

    >>> write_link("level", ["a text"])
    '#level=1.qWQqg0tUKEmtKAEA'
    """
    if not 1 <= len(texts) <= (MAX_TEXTS if kind == "replay" else 1):
        raise LinkError(f"no link carries {len(texts)} of {kind}", expected=f"at most {MAX_TEXTS} replays")
    contents = [text.encode("utf-8", "replace") for text in texts]
    if (size := sum(map(len, contents))) > MAX_LINK_BYTES:
        raise LinkError("too much for a link", found=f"{size:,} bytes", hint="share the file itself")
    link = "#" + "&".join(f"{kind}={LINK_VERSION}.{_packed(content)}" for content in contents)
    if len(link) > MAX_CHARACTERS:
        raise LinkError("too much for a link", found=f"{len(link):,} characters", hint="share the file itself")
    return link


def _packed(data: bytes) -> str:
    deflate = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS, 9)
    packed = zlib.crc32(data).to_bytes(4, "big") + deflate.compress(data) + deflate.flush()
    return urlsafe_b64encode(packed).rstrip(b"=").decode("ascii")


def read_link(text: str | Path) -> ParsedLink:
    """Read a link; text before its # is ignored, and so are blanks and line breaks in it.

    Raises LinkError for anything but a complete and valid link, FileError for content that is not text. The length of
    the link limits time and memory.

    >>> read_link("https://example.org/#level=1.qWQqg0tUKEmtKAEA")
    ParsedLink(kind='level', texts=('a text',))
    """
    whole = str(text)
    if len(whole) > MAX_CHARACTERS:
        raise LinkError("the link is too long", LINK, expected=f"at most {MAX_CHARACTERS:,} characters")
    _, mark, fragment = "".join(whole.split()).strip(_AROUND).partition("#")
    parts = unquote(fragment).split("&")
    candidates = [_PART.fullmatch(part) for part in parts[: MAX_TEXTS + 1]]
    if not mark or None in candidates:
        hint = "copy it again, whole"
        raise LinkError("not a link of a level, pack or replay", LINK, found=repr(fragment[:40]), hint=hint)
    matches = [match for match in candidates if match]
    kind = next(kind for kind in LINK_KINDS if kind == matches[0][1])
    if len(matches) > (MAX_TEXTS if kind == "replay" else 1) or any(match[1] != kind for match in matches):
        raise LinkError("a link of too many things", LINK, expected=f"a level, a pack, or up to {MAX_TEXTS} replays")
    left = MAX_LINK_BYTES
    texts = []
    for match in matches:
        if int(match[2]) != LINK_VERSION:
            hint = "a link from a newer ninja-game needs a newer ninja-game"
            raise LinkError("a link of an unknown version", LINK, found=match[2], expected=str(LINK_VERSION), hint=hint)
        content = _unpacked(match[3], left)
        left -= len(content)
        texts.append(decoded(content, LINK))
    return ParsedLink(kind, tuple(texts))


def _unpacked(packed: str, most: int) -> bytes:
    """Unpack the characters of a link to at most ``most`` bytes. Raises LinkError."""
    hint = "it was truncated or changed on the way: copy all of it again"
    try:
        data = urlsafe_b64decode(packed + "=" * (-len(packed) % 4))
        inflate = zlib.decompressobj(-zlib.MAX_WBITS)
        unpacked = inflate.decompress(data[4:], most + 1)
        if len(unpacked) > most:
            raise LinkError("the link unpacks to too much", LINK, expected=f"at most {MAX_LINK_BYTES:,} bytes in all")
        if not inflate.eof or inflate.unused_data or zlib.crc32(unpacked).to_bytes(4, "big") != data[:4]:
            raise LinkError("the link is not whole", LINK, hint=hint)
    except (ValueError, zlib.error):
        raise LinkError("the link is not whole", LINK, hint=hint) from None
    return unpacked


def write_watch(files: Sequence[str]) -> str:
    """The fragment with which a page beside the folder ``replays`` shows these files of it, named without suffix.

    >>> write_watch(["0123456789abcdef"])
    '#watch=0123456789abcdef'
    """
    return f"#watch={','.join(files[:MAX_TEXTS])}"


def watched_names(fragment: str) -> list[str]:
    """The files that a fragment of ``write_watch`` names, relative to the page; empty for any other fragment.

    Raises LinkError for names that no board gives, so that a page fetches nothing else.

    >>> watched_names("#watch=0123456789abcdef")
    ['replays/0123456789abcdef.txt']
    """
    _, mark, names = fragment.partition("#watch=")
    parts = names.split(",") if mark else []
    if len(parts) > MAX_TEXTS or not all(_STEM.fullmatch(name) for name in parts):
        raise LinkError("not a link of runs of this page", LINK, found=ascii(names[:40]), hint="copy it again, whole")
    return [f"replays/{name.partition('-')[0]}.txt" for name in parts]


def watched_colours(fragment: str) -> list[int]:
    """The numbers of the runs' colours, which a fragment of ``watched_names`` may have, one per run.

    >>> watched_colours("#watch=0123456789abcdef-2,fedcba9876543210-0"), watched_colours("#watch=0123456789abcdef")
    ([2, 0], [])
    """
    return [int(match[2]) for match in _STEM.finditer(fragment) if match[2]]


_NAME_LIMIT = 100  # most characters of the name of a file in a pack
_LEFT_OUT = re.compile(r"^(?:waypoints|level-data):\n(?:(?: .*)?\n)*", re.MULTILINE)
"""Removed from certificates in links of packs: the pack has the levels, and the digest replaces the waypoints."""


def level_link(level: Level, **headers: Any) -> str:
    """The link of a level, from the # on. ``headers``: as for ``write_ascii_level``. Raises LinkError."""
    return write_link("level", [write_ascii_level(level, **headers)])


def replay_text(replay: Replay, level: Level | None = None) -> str:
    """The text of a replay in a link: with its level, without waypoints, since the digest replaces them.

    ``level``: the level of a replay that does not contain its own. Raises LinkError if there is none.
    """
    level = replay.level or level
    if level is None:
        raise LinkError("a replay without its level", hint="record it with its level inside")
    digest = level_digest(level)
    return write_replay(replace(replay, level=level, level_digest=digest, level_path="", level_record=0, waypoints=()))


def replay_link(replays: Iterable[Replay]) -> str:
    """The link of replays with their levels; the replays after the first are its ghosts. Raises LinkError."""
    return write_link("replay", [replay_text(replay) for replay in replays])


def recording_link(recordings: Iterable[Recording]) -> str:
    """A link of recordings of any format; a record of N stays a record of N.

    Raises LinkError; LevelError or DemoError for content that N's record cannot hold.
    """
    texts = [
        write_level_file([record_of(run)]) if run.of_n else replay_text(run.replay, run.level) for run in recordings
    ]
    return write_link("replay", texts)


def pack_link(texts: dict[str, str]) -> str:
    """The link of a pack from its files by name: index, levels, par times, shortened certificates. Raises LinkError."""
    known = {name for name, text in texts.items() if is_replay(text) and "\nlevel-digest:" in text}
    short = {name: _LEFT_OUT.sub("", text) if name in known else text for name, text in texts.items()}
    return write_link("pack", [json.dumps(short, ensure_ascii=False, separators=(",", ":"))])


def whole_certificate(text: str, level: NamedLevel) -> str:
    """Put the level back into a certificate from a link; any other text stays the same."""
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
        raise LinkError("no pack in this link", LINK, found=repr(text[:40]), expected="files by their names, as JSON")
    odd = next((name for name in files if not _is_plain(name)), None)
    if odd is not None:
        raise LinkError("a name that no file of a pack has", LINK, found=ascii(odd[:40]))
    return files


def _is_plain(name: str) -> bool:
    """Whether a name is that of a file in a pack, or of a certificate: no other path, no hidden file."""
    name = name.removeprefix("certificates/")
    plain = name.isprintable() and not set(name) & set("/\\:") and not name.startswith(".")
    return plain and 0 < len(name) <= _NAME_LIMIT


def linked_texts(link: str | Path, *kinds: LinkKind) -> tuple[str, ...]:
    """The texts in a link of one of these kinds, as files would contain them. Raises LinkError."""
    content: ParsedLink = read_link(link)
    if content.kind not in kinds:
        raise LinkError(f"a link of a {content.kind}", LINK, expected=f"one of a {' or '.join(kinds)}")
    return tuple(map(_whole, content.texts))


def recordings_in_links(texts: Iterable[str]) -> list[Recording]:
    """The recordings in untrusted texts that contain their levels. Raises LinkError, ReplayError, LevelError."""
    recordings = []
    for text in texts:
        recordings += parse_replays(_whole(text), file=LINK)
    return recordings


def _whole(text: str) -> str:
    """Make an untrusted text safe: replays lose their paths to files. Raises LinkError, ReplayError.

    Without a file name its inputs cannot include other files, and with its level inside no path is followed.
    """
    episode = is_episode(text)
    if not episode and not is_replay(text):
        return text
    try:
        replays = parse_episode(text) if episode else [parse_replay(text)]
    except FormatError as error:
        error.file = LINK
        raise
    if any(replay.level is None for replay in replays):
        raise LinkError("a replay without its level", LINK, hint="record it with its level inside")
    whole = [replace(replay, level_path="", level_record=0) for replay in replays]
    return write_episode(whole) if episode else write_replay(*whole)
