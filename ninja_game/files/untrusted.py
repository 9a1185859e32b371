"""Untrusted TOML texts and zips: read by the library, within limits that are checked before memory is allocated."""

from __future__ import annotations

import io
import re
import struct
import sys
import tomllib
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import IO, TYPE_CHECKING, Any
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile, ZipInfo

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MAX_PARTS = 50  # parts of a key with dots; the library's time grows with their square

_PART = r"""(?:(?<![\w-])[\w-]++|(?<!\\)"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')"""
_LONG_KEY = re.compile(rf"(?:{_PART}[ \t]*+\.[ \t]*+){{{MAX_PARTS}}}")


def parse_toml(text: str, *, any_number: bool = False) -> dict[str, Any]:
    """The table in a TOML text. Raises ValueError, with line and column in its message if known.

    ``any_number``: also with numbers that TOML does not have, whose digits Python may refuse to write.
    """
    long_key = _LONG_KEY.search(text)
    if long_key:
        before = text[: long_key.start()]
        place = f"(at line {before.count(chr(10)) + 1}, column {len(before) - before.rfind(chr(10))})"
        raise ValueError(f"A key of more than {MAX_PARTS} parts {place}")
    try:
        table = tomllib.loads(text)
        if not any_number:
            _check_numbers(table)
    except RecursionError:
        raise ValueError("Nested too deep") from None
    return table


def _check_numbers(value: object) -> None:
    if isinstance(value, dict | list):
        for item in value.values() if isinstance(value, dict) else value:
            _check_numbers(item)
    elif isinstance(value, int) and not -(2**63) <= value < 2**63:
        raise ValueError("A whole number of more than 64 bits")


_ENTRY = b"PK\1\2"
_BLOCK = 2**20
# Bytes of the index: the library's time grows with the square of the data beside a name.
_MAX_ENTRY_BYTES = 512  # per file
_MAX_INDEX_BYTES = 2**23


class _Index(io.RawIOBase):
    """A file whose zip index is read only in bounded pieces; it has the methods that the library calls."""

    def __init__(self, file: IO[bytes], most: int) -> None:
        self._file = file
        self._most = max(most, 2**17)  # the library looks for the end of the index in the last 64 KiB

    def read(self, size: int = -1) -> bytes:
        if size > self._most:
            raise ValueError(f"an index of more than {self._most >> 10} KiB in a zip")
        return self._file.read(size)

    def seek(self, offset: int, whence: int = 0) -> int:
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        return self._file.tell()


def open_zip(file: IO[bytes], *, most_files: int, most_bytes: int) -> ZipFile:
    """The zip in a file: with bounds on the number of its files and on their unpacked bytes.

    Raises ValueError for more, and for anything but a zip.
    """
    # The library creates an object for each entry before it reports their number.
    if sum(block.count(_ENTRY) for block in iter(partial(file.read, _BLOCK), b"")) > most_files:
        raise ValueError(f"more than {most_files} files in a zip")
    file.seek(0)
    with _value_errors():
        archive = ZipFile(_Index(file, min(most_files * _MAX_ENTRY_BYTES, _MAX_INDEX_BYTES)))
        archive.fp = file
    if sum(entry.file_size for entry in archive.infolist()) > most_bytes:
        raise ValueError(f"more than {most_bytes >> 20} MiB, unpacked")
    return archive


def unpacked(archive: ZipFile, entry: ZipInfo) -> bytes:
    """A file's content, of no more bytes than its entry says. Raises ValueError."""
    # Other compression methods allocate as much memory as the file demands.
    if entry.compress_type not in (ZIP_STORED, ZIP_DEFLATED):
        raise ValueError("packed in an unusual way")
    with _value_errors():
        return archive.read(entry)


@contextmanager
def _value_errors() -> Iterator[None]:
    """Turn the library's errors for an odd zip into ValueError."""
    try:
        yield
    except (BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, OverflowError, OSError) as error:
        raise ValueError(str(error)) from None


UNREADABLE = (
    ValueError, KeyError, TypeError, AttributeError, EOFError, ArithmeticError, MemoryError, RecursionError,
    struct.error,
)  # fmt: skip
"""Errors of the standard library and NumPy for odd files."""

MAX_ARRAYS = 2**16  # in an archive; a trace has nine

_HEADER = re.compile(
    rb"\x93NUMPY(?:\x01\x00..|\x02\x00....)"
    rb"\{'descr': (.{1,400}), 'fortran_order': (True|False), 'shape': \(([0-9, ]{0,60})\), \} *\n",
    re.DOTALL,
)
"""The head of an array, as NumPy writes it; NumPy's own reader would evaluate an untrusted text."""

_TEXT = re.compile(r"'<U\d{1,9}'")


def read_array(archive: ZipFile, entry: ZipInfo, wanted: np.dtype[Any], *, most: int, dimensions: int) -> NDArray[Any]:
    """An array of the wanted kind that claims no more than its file holds.

    ``most``: along each of at most that many ``dimensions``. Raises an error of UNREADABLE for any other.
    """
    import numpy as np  # packs are read without it, as in the page

    data = unpacked(archive, entry)
    header = _HEADER.match(data)
    if not header:
        raise ValueError("an array with a header that NumPy does not write")
    kind, by_columns, sizes = (part.decode("latin-1") for part in header.groups())
    dtype = np.dtype(kind[1:-1]) if wanted.kind == "U" and _TEXT.fullmatch(kind) else wanted
    if kind != repr(np.lib.format.dtype_to_descr(dtype)):
        raise ValueError(f"an array of {kind} instead of {wanted}")
    shape = tuple(int(size) for size in sizes.split(",") if size.strip())
    if len(shape) > dimensions or max(shape, default=0) > most:
        raise ValueError(f"an array of the shape {shape}")
    if wanted.kind == "U" and (np.frombuffer(data[header.end() :], np.uint32) > sys.maxunicode).any():
        raise ValueError("a text of numbers that are not characters")
    return np.ndarray(shape, dtype, data, header.end(), order="F" if by_columns == "True" else "C")
