"""Files as people have them: texts in any encoding, with any line ends, alone or in folders. Only regular files.

A text may include others by their names, from its own folder or below it (``read_included``). Every format reads them
here, so that a verification knows all files that its results depend on, and can read them from memory on another
machine (``known_files``).
"""

from __future__ import annotations

import codecs
import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import IO, NamedTuple

from ninja_game.errors import FileError, NinjaGameError, reason

SUFFIXES = (".txt", ".nlevel", ".level", ".replay", ".demo", ".tas")  # suffixes of the files of a folder that are read

MAX_BYTES = 64 * 2**20  # far more than any file of levels or replays has

_inputs: set[tuple[int, int]] | None = None  # device and number of each file that was read, while inputs are kept


@dataclass(frozen=True)
class Skipped:
    """A file or folder that a walk could not read, and why."""

    path: Path
    why: str

    def __str__(self) -> str:
        return f"{self.path}: {self.why}"


def files_below(folder: Path, *, follow_links: bool = True) -> Iterator[Path | Skipped]:
    """The files below a folder that may hold levels or recordings, in order of their names, without hidden ones.

    Links are followed, or left out. Every folder is visited once, so that loops end. Only the folders on the path to
    the present file are in memory. Unreadable ones are given as Skipped and stop nothing.
    """
    visited: set[tuple[int, int]] = set()
    waiting = [(folder, True)]
    while waiting:
        path, is_folder = waiting.pop()
        try:
            status = os.stat(path, follow_symlinks=follow_links or path == folder)  # noqa: PTH116 - of each run of a board
            if stat.S_ISLNK(status.st_mode):
                yield Skipped(path, "a link; put the file itself here")
                continue
            if not is_folder:
                yield (
                    path if stat.S_ISREG(status.st_mode) else Skipped(path, f"{file_type(status.st_mode)}, not a file")
                )
                continue
            if (status.st_dev, status.st_ino) in visited:
                yield Skipped(path, "a link to a folder that is visited already")
                continue
            visited.add((status.st_dev, status.st_ino))
            with os.scandir(path) as entries:
                names = sorted(((entry.name, _is_folder(entry)) for entry in entries), reverse=True)
        except (OSError, ValueError) as error:
            yield Skipped(path, getattr(error, "strerror", "") or str(error))
            continue
        waiting += [
            (path / name, below)
            for name, below in names
            if not name.startswith(".") and (below or name.lower().endswith(SUFFIXES))
        ]


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:
        # A circle of links: the walk reports it if it has the name of a file.
        return False


def files_in(folder: Path, *, follow_links: bool = True) -> list[str]:
    """The names of the regular files in a folder, sorted, without hidden ones; none for a missing folder."""
    try:
        with os.scandir(folder) as entries:
            files = [entry.name for entry in entries if entry.is_file(follow_symlinks=follow_links)]
            return sorted(name for name in files if not name.startswith("."))
    except OSError:
        return []


def text_files(path: Path) -> list[Path]:
    """The file itself, or ``files_below`` a folder without the skipped ones."""
    if not path.is_dir():
        return [path]
    return [file for file in files_below(path) if isinstance(file, Path)]


def path_below(folder: Path, name: str) -> Path | None:
    """The path of a name in a folder or below it; None for one that leads elsewhere: texts are untrusted."""
    try:
        path = (folder / name).resolve()
        return path if path.is_relative_to(folder.resolve()) else None
    except (OSError, ValueError, RuntimeError):
        return None


def protect_inputs(on: bool) -> None:
    """From now on ``files.writing`` replaces no file that was read; or, off, any."""
    global _inputs  # noqa: PLW0603 - of the process, as its files are
    _inputs = set() if on else None


def is_input(status: os.stat_result) -> bool:
    """Whether a file was read while inputs are kept."""
    return _inputs is not None and (status.st_dev, status.st_ino) in _inputs


def open_regular(path: Path) -> IO[bytes]:
    """A regular file, open for reading. Raises FileError for a folder, device or pipe; OSError as it comes."""
    try:
        # Without O_NONBLOCK a pipe without a writer would block here.
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    except ValueError as error:
        raise FileError("no file has this name", ascii(str(path)), found=str(error)) from None
    status = os.fstat(handle)
    mode = status.st_mode
    if _inputs is not None:
        _inputs.add((status.st_dev, status.st_ino))
    if not stat.S_ISREG(mode):
        os.close(handle)
        raise FileError("only a regular file is read", str(path), found=file_type(mode))
    return os.fdopen(handle, "rb")


NO_FILE: list[int] = []  # the stamp of a missing file


def file_stamp(path: Path | str) -> list[int]:
    """Changes when a file or folder is written or replaced: its size, times and number; copies set no ctime."""
    try:
        status = os.stat(path)  # noqa: PTH116 - a path of text is cheaper, and a board asks of each run
    except (OSError, ValueError):
        return NO_FILE
    return [status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino]


def digest_of(data: bytes) -> str:
    """Sha256 (hex) of a file's content."""
    return sha256(data).hexdigest()


def read_bytes(path: Path, limit: int = MAX_BYTES) -> bytes:
    """A regular file's content. Raises FileError as ``open_regular``, and for more than ``limit`` bytes; OSError."""
    with open_regular(path) as file:
        data = file.read(limit + 1)
    if len(data) > limit:
        raise FileError("the file is too large", str(path), expected=f"at most {limit >> 20} MiB")
    return data


def read_utf8(path: Path, limit: int = MAX_BYTES) -> str:
    """A file of ours as text. Raises FileError, with line and column, where it is not UTF-8; else as ``read_bytes``."""
    data = read_bytes(path, limit)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = data[: error.start].split(b"\n")
        place = len(before), len(before[-1]) + 1
        raise FileError("not a text in UTF-8", str(path), *place, f"the byte {data[error.start]:#04x}") from None


def read_text(path: Path) -> str:
    """A text file's content as ``decoded`` gives it; else as ``read_bytes``."""
    return decoded(read_bytes(path), str(path))


def decoded(data: bytes, file: str) -> str:
    """A file's content as text with plain line ends: UTF-8, UTF-16 with its mark, or else Latin-1.

    Raises FileError for a file that is not text.
    """
    try:
        if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
            text = data.decode("utf-16")
        else:
            text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    if "\0" in text:
        raise FileError("not a text file", file, text[: text.index("\0")].count("\n") + 1, found="a zero byte")
    return text


def file_type(mode: int) -> str:
    """The type of a file by its mode, for error messages.

    >>> file_type(stat.S_IFIFO)
    'a pipe'
    """
    kinds = {
        stat.S_IFDIR: "a folder", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket", stat.S_IFLNK: "a link",
        stat.S_IFCHR: "a device", stat.S_IFBLK: "a device", stat.S_IFREG: "a regular file",
    }  # fmt: skip
    return kinds.get(stat.S_IFMT(mode), "something else")


class IncludedFile(NamedTuple):
    """A file that a text includes: its path, "" if outside the folder; its text, None if unreadable; the reason.

    The reason is "" if there is no regular file.
    """

    path: str
    text: str | None = None
    problem: str = ""


_KNOWN: ContextVar[tuple[dict[str, IncludedFile], bool] | None] = ContextVar("known files", default=None)


@contextmanager
def known_files(known: dict[str, IncludedFile], *, no_more: bool) -> Iterator[None]:
    """In the block, texts come from ``known``, by name; other files are read and added, or with ``no_more`` errors."""
    token = _KNOWN.set((known, no_more))
    try:
        yield
    finally:
        _KNOWN.reset(token)


LINK = "link"  # the name of a link's text; a file of that name in the current folder is another one


def has_folder(file: str) -> bool:
    """Whether the text of that name lies in a folder; one of a link does not."""
    known = _KNOWN.get()
    sent = bool(known and known[1] and known[0])
    return sent or (file != LINK and os.path.isfile(file))  # noqa: PTH113 - fails on no name


def read_included(file: str, name: str) -> IncludedFile:
    """The file of a name in the text ``file``."""
    known, no_more = _KNOWN.get() or ({}, False)
    if name not in known:
        if no_more:
            raise FileError("a file that was not read before its text was sent here", file, found=repr(name[:40]))
        known[name] = _read(file, name)
    return known[name]


def _read(file: str, name: str) -> IncludedFile:
    path = path_below(Path(file).parent, name) if name else None
    if path is None or not os.path.isfile(path):  # noqa: PTH113
        return IncludedFile(str(path or ""))
    try:
        return IncludedFile(str(path), read_text(path))
    except (OSError, NinjaGameError) as error:
        return IncludedFile(str(path), problem=reason(error))
