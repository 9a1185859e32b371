"""Arrays in untrusted NumPy archives (.npz): what they claim is checked before memory is made, nothing is evaluated."""

from __future__ import annotations

import re
import struct
import sys
from typing import Any
from zipfile import ZipFile, ZipInfo

import numpy as np
from numpy.typing import NDArray

from ninja_game.files.zips import unpacked

UNREADABLE = (
    ValueError, KeyError, TypeError, AttributeError, EOFError, ArithmeticError, MemoryError, RecursionError,
    struct.error,
)  # fmt: skip
"""What odd files make the standard library and NumPy raise."""

MOST_ARRAYS = 2**16
"""In an archive; a trace has nine."""

_HEADER = re.compile(
    rb"\x93NUMPY(?:\x01\x00..|\x02\x00....)"
    rb"\{'descr': (.{1,400}), 'fortran_order': (True|False), 'shape': \(([0-9, ]{0,60})\), \} *\n",
    re.DOTALL,
)
"""Of an array, as NumPy writes it; NumPy's own reader would evaluate an untrusted text."""

_TEXT = re.compile(r"'<U\d{1,9}'")


def read_array(archive: ZipFile, entry: ZipInfo, wanted: np.dtype[Any], *, most: int, dimensions: int) -> NDArray[Any]:
    """An array of the wanted kind, which claims no more than its file holds.

    ``most``: along each of at most so many ``dimensions``. Raises an error of UNREADABLE for any other.
    """
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
