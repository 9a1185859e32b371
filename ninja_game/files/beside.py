"""Files that a text takes in by their names: from its own folder or below it, and from nowhere else.

Every format reads them here. So a verification knows all of what its results depend on, and can have it read from
memory on another machine: ``known_files``.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import NamedTuple

from ninja_game.errors import FileError, NinjaGameError, reason
from ninja_game.files.reading import path_below, read_text


class Beside(NamedTuple):
    """A file that a text names: its path, "" for one elsewhere; its text, None where it cannot be read; why not.

    There is no reason where no regular file is there.
    """

    path: str
    text: str | None = None
    problem: str = ""


_KNOWN: ContextVar[tuple[dict[str, Beside], bool] | None] = ContextVar("known files", default=None)


@contextmanager
def known_files(known: dict[str, Beside], *, no_more: bool) -> Iterator[None]:
    """For a while files come from ``known``, by name; others are read and noted there, or, ``no_more``, are errors."""
    token = _KNOWN.set((known, no_more))
    try:
        yield
    finally:
        _KNOWN.reset(token)


PLACE = "link"
"""What the text of a link is called; a file of that name in the current folder is another one."""


def has_folder(file: str) -> bool:
    """Whether the text of that name lies in a folder; one of a link does not."""
    known = _KNOWN.get()
    sent = bool(known and known[1] and known[0])
    return sent or (file != PLACE and os.path.isfile(file))  # noqa: PTH113 - fails on no name


def read_beside(file: str, name: str) -> Beside:
    """The file of a name that stands in the text ``file``."""
    known, no_more = _KNOWN.get() or ({}, False)
    if name not in known:
        if no_more:
            raise FileError("a file that was not read before its text was sent here", file, found=repr(name[:40]))
        known[name] = _read(file, name)
    return known[name]


def _read(file: str, name: str) -> Beside:
    path = path_below(Path(file).parent, name) if name else None
    if path is None or not os.path.isfile(path):  # noqa: PTH113
        return Beside(str(path or ""))
    try:
        return Beside(str(path), read_text(path))
    except (OSError, NinjaGameError) as error:
        return Beside(str(path), problem=reason(error))
