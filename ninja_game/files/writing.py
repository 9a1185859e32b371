"""Files that are whole or not there: written beside their place, then moved into it."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO


def write_atomically(path: Path, fill: Callable[[IO[bytes]], object] | bytes | str) -> None:
    """Put a file at ``path``, whole or not at all.

    ``fill`` is the content (text becomes UTF-8) or a function that writes it into a binary file. Raises OSError.
    """
    with open_atomically(path) as file:
        if callable(fill):
            fill(file)
        else:
            file.write(fill.encode("utf-8") if isinstance(fill, str) else fill)


@contextmanager
def open_atomically(path: Path) -> Iterator[IO[bytes]]:
    """A binary file that appears at ``path`` when the block ends, and never if it ends in an exception."""
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    part = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            yield file
        # mkstemp makes files private; this one is as open as any other new file.
        mask = os.umask(0)
        os.umask(mask)
        part.chmod(0o666 & ~mask)
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
