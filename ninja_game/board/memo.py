"""A cache of results, from one command to the next, in the user's own cache folder only."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

from ninja_game.errors import DAMAGED
from ninja_game.files.reading import digest_of, read_bytes
from ninja_game.files.writing import write_atomically

_MAX_BYTES = 2**30  # the memo of a million runs has two thirds of that
MAX_MEMOS = 100  # the newest stay


def values_digest(data: object) -> str:
    """Sha256 (hex) of plain values."""
    return digest_of(json.dumps(data).encode("utf-8", "replace"))


@cache
def program() -> str:
    """Digest of everything that cached results depend on: the package's code and the templates of pages."""
    package = Path(__file__).parents[1]
    files = sorted({*package.rglob("*.py"), *package.glob("web/pages/*.*")})
    return values_digest([digest_of(file.read_bytes()) for file in files])


class Memo:
    """A cache of plain values by key. ``save`` drops entries that were neither recalled nor noted.

    ``path``: of its file, None: nothing is kept; a missing or broken one is empty. ``again``: recall nothing from it.
    """

    def __init__(self, path: Path | None = None, *, again: bool = False) -> None:
        self.path, self.again = path, again
        self._before: dict[str, Any] = {}
        self._now: dict[str, Any] = {}
        try:
            pages = json.loads(read_bytes(path, _MAX_BYTES)) if path else {}
            self._before = pages if isinstance(pages, dict) else {}
        except (*DAMAGED, OSError):
            pass

    def recall(self, key: str) -> Any:
        """The value noted under a key, None for nothing."""
        if key not in self._now and key in self._before and not self.again:
            self._now[key] = self._before[key]
        return self._now.get(key)

    def note(self, key: str, value: Any) -> None:
        self._now[key] = value

    @property
    def forgotten(self) -> set[str]:
        """Keys that were neither recalled nor noted this time."""
        return self._before.keys() - self._now.keys()

    def save(self) -> None:
        """Write the cache to its file. Raises FileError, OSError."""
        if self.path and self._now != self._before:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(self.path, json.dumps(self._now))
            memos = sorted(self.path.parent.glob("*.json"), key=lambda path: path.stat().st_mtime, reverse=True)
            for old in memos[MAX_MEMOS:]:
                old.unlink(missing_ok=True)
