"""The part of an address behind the #: ``#level=1.…``, ``#pack=1.…``, ``#replay=1.…`` (`docs/links.md`)."""

from __future__ import annotations

import re
import zlib
from base64 import urlsafe_b64decode, urlsafe_b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal
from urllib.parse import unquote

from ninja_game.errors import LinkError
from ninja_game.files.beside import PLACE
from ninja_game.files.reading import decoded

Kind = Literal["level", "pack", "replay"]
KINDS: tuple[Kind, ...] = ("level", "pack", "replay")

VERSION = 1
"""Raw deflate (RFC 1951) of the text in UTF-8 behind four bytes of CRC-32, in base64url without padding."""

MOST_CHARACTERS = 2 * 2**20
"""Length of a link: what browsers take."""

MOST_BYTES = 4 * 2**20
"""Size of its text when unpacked."""

MOST_TEXTS = 9
"""In a link of replays: the one that is watched, and as many ghosts as the viewer shows."""

_PART = re.compile(r"(level|pack|replay)=([0-9]{1,4})\.([A-Za-z0-9_-]*)")
_STEM = re.compile(r"[0-9a-f]{16}")
_ADDRESS = re.compile(r"[a-z]{2}:/", re.IGNORECASE)
_AROUND = "\0 \t\r\n.,;:!?)>]}\"'"
"""Characters that people and programs write behind a link."""


@dataclass(frozen=True)
class Link:
    """What a link carries: one text, or several of replays, as untrusted as any file."""

    kind: Kind
    texts: tuple[str, ...]


def link_kind(text: str | Path) -> Kind | None:
    """What a text, or a path made of it, is meant to be a link of, sound or not; None for no link of ours.

    A link begins with its # or holds an address before it: a file may have any other name.

    >>> link_kind("https://example.org/game/#pack=1.abc"), link_kind("levels/a#level=1.txt")
    ('pack', None)
    """
    before, _, fragment = "".join(str(text).split()).partition("#")
    if before.strip(_AROUND + "<([") and not _ADDRESS.search(before):
        return None
    fragment = unquote(fragment)
    return next((kind for kind in KINDS if fragment.startswith(f"{kind}=")), None)


def is_link(text: str | Path) -> bool:
    """Whether a text, or a path made of it, is meant as a link of ours."""
    return link_kind(text) is not None


def write_link(kind: Kind, texts: Sequence[str]) -> str:
    """The fragment, from the # on. Raises LinkError for more than a link can carry.

    >>> write_link("level", ["a text"])
    '#level=1.qWQqg0tUKEmtKAEA'
    """
    if not 1 <= len(texts) <= (MOST_TEXTS if kind == "replay" else 1):
        raise LinkError(f"no link carries {len(texts)} of {kind}", expected=f"at most {MOST_TEXTS} replays")
    link = "#" + "&".join(f"{kind}={VERSION}.{_packed(text)}" for text in texts)
    if len(link) > MOST_CHARACTERS:
        raise LinkError("too much for a link", found=f"{len(link):,} characters", hint="share the file itself")
    return link


def _packed(text: str) -> str:
    data = text.encode("utf-8", "replace")
    if len(data) > MOST_BYTES:
        raise LinkError("too much for a link", found=f"{len(data):,} bytes", hint="share the file itself")
    deflate = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS, 9)
    packed = zlib.crc32(data).to_bytes(4, "big") + deflate.compress(data) + deflate.flush()
    return urlsafe_b64encode(packed).rstrip(b"=").decode("ascii")


def read_link(text: str | Path) -> Link:
    """What a link carries; whatever stands before its # does not matter, nor do blanks and line breaks in it.

    Raises LinkError for anything that is not a whole and sound link, FileError for what is not text, in a time and
    memory that its length bounds.

    >>> read_link("https://example.org/#level=1.qWQqg0tUKEmtKAEA")
    Link(kind='level', texts=('a text',))
    """
    whole = str(text)
    if len(whole) > MOST_CHARACTERS:
        raise LinkError("the link is too long", PLACE, expected=f"at most {MOST_CHARACTERS:,} characters")
    _, mark, fragment = "".join(whole.split()).strip(_AROUND).partition("#")
    parts = unquote(fragment).split("&")
    found = [_PART.fullmatch(part) for part in parts[: MOST_TEXTS + 1]]
    if not mark or None in found:
        hint = "copy it again, whole"
        raise LinkError("not a link of a level, pack or replay", PLACE, found=repr(fragment[:40]), hint=hint)
    matches = [match for match in found if match]
    kind = next(kind for kind in KINDS if kind == matches[0][1])
    if len(matches) > (MOST_TEXTS if kind == "replay" else 1) or any(match[1] != kind for match in matches):
        raise LinkError("a link of too many things", PLACE, expected=f"a level, a pack, or up to {MOST_TEXTS} replays")
    left = MOST_BYTES
    texts = []
    for match in matches:
        if int(match[2]) != VERSION:
            hint = "a link from a newer ninja-game needs a newer ninja-game"
            raise LinkError("a link of an unknown version", PLACE, found=match[2], expected=str(VERSION), hint=hint)
        texts.append(_unpacked(match[3], left))
        left -= len(texts[-1])
    return Link(kind, tuple(texts))


def _unpacked(packed: str, most: int) -> str:
    """The text in the characters of a link, of ``most`` bytes at most. Raises LinkError."""
    hint = "it was truncated or changed on the way: copy all of it again"
    try:
        data = urlsafe_b64decode(packed + "=" * (-len(packed) % 4))
        inflate = zlib.decompressobj(-zlib.MAX_WBITS)
        unpacked = inflate.decompress(data[4:], most + 1)
        if len(unpacked) > most:
            raise LinkError("the link unpacks to too much", PLACE, expected=f"at most {MOST_BYTES:,} bytes in all")
        if not inflate.eof or inflate.unused_data or zlib.crc32(unpacked).to_bytes(4, "big") != data[:4]:
            raise LinkError("the link is not whole", PLACE, hint=hint)
    except (ValueError, zlib.error):
        raise LinkError("the link is not whole", PLACE, hint=hint) from None
    return decoded(unpacked, PLACE)


def write_watch(files: Sequence[str]) -> str:
    """The fragment for a page beside whose folder ``replays`` lies: watch these files of it, by their names' stems.

    >>> write_watch(["0123456789abcdef"])
    '#watch=0123456789abcdef'
    """
    return f"#watch={','.join(files[:MOST_TEXTS])}"


def watched(fragment: str) -> list[str]:
    """The files that a fragment of ``write_watch`` names, relative to the page; none for any other fragment.

    Raises LinkError for names that the board does not give: nothing else is ever fetched.

    >>> watched("#watch=0123456789abcdef")
    ['replays/0123456789abcdef.txt']
    """
    _, mark, names = fragment.partition("#watch=")
    found = names.split(",") if mark else []
    if len(found) > MOST_TEXTS or not all(_STEM.fullmatch(name) for name in found):
        raise LinkError("not a link of runs of this page", PLACE, found=ascii(names[:40]), hint="copy it again, whole")
    return [f"replays/{name}.txt" for name in found]
