"""When the files of a folder were added: as its git repository says, else as the file system does."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from datetime import UTC, datetime
from pathlib import Path

PATIENCE = 60
"""Seconds that git may take."""

_LOG = ("log", "--no-renames", "--diff-filter=A", "--relative", "--format=%x01%ct", "--name-only", "-z", "--", ".")
_SAFE = ("-c", "core.fsmonitor=false", "-c", "log.showSignature=false", "-c", "core.quotePath=false")
"""Nothing that a repository's own configuration names is started."""


def dates_of(folder: Path, files: Iterable[str]) -> dict[str, int]:
    """When each file was added, in seconds since 1970; of one that git does not know yet: when it was written."""
    known = _from_git(folder)
    found = {}
    for file in files:
        try:
            found[file] = known[file] if file in known else int((folder / file).lstat().st_mtime)
        except OSError:
            found[file] = 0
    return found


def _from_git(folder: Path) -> dict[str, int]:
    """The date of the first commit of each file, by its path from the folder; none without git or a repository."""
    command = ["git", "--no-pager", *_SAFE, "-C", str(folder), *_LOG]
    try:
        done = subprocess.run(command, capture_output=True, timeout=PATIENCE, check=True)  # noqa: S603
    except (OSError, subprocess.SubprocessError):
        return {}
    return dates_in_log(done.stdout.decode("utf-8", "surrogateescape"))


def dates_in_log(text: str) -> dict[str, int]:
    r"""Dates by file in what git's log says: the earliest, for a file that was removed and added again.

    >>> dates_in_log("\x0120\0\na.txt\0b.txt\0\x0110\0\na.txt\0")
    {'a.txt': 10, 'b.txt': 20}
    """
    found: dict[str, int] = {}
    for commit in text.split("\x01")[1:]:
        date, _, names = commit.partition("\0")
        for name in names.lstrip("\n").split("\0"):
            if name and date.strip().isdecimal():
                found[name] = int(date)
    return found


def day(seconds: int) -> str:
    """A date in UTC, "" for 0.

    >>> day(0), day(86_400)
    ('', '1970-01-02')
    """
    return datetime.fromtimestamp(seconds, UTC).date().isoformat() if seconds else ""
