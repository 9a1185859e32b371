"""Test the tests: change one line of the program at a time in a scratch copy and see whether a test notices.

Each change is one line, by pattern; a pattern that no longer fits is an error, so that a list stays in step with the
program. Only tests that need no reference data can notice: the scratch copy has no ../shared.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

from tools import ROOT

COPIED = ("ninja_game", "tests", "tools", "levels", "assets", "pyproject.toml", "README.md")


class Change(NamedTuple):
    """One line of a file and what it becomes; ``file`` is a path within the suite's folder."""

    name: str
    file: str
    old: str
    new: str


class Suite(NamedTuple):
    """Changes of files in a ``folder``, the words for pytest that should notice them, and how many may go unnoticed."""

    folder: str
    changes: Sequence[Change]
    tests: Sequence[str]
    allowed: int

    def misfits(self) -> list[str]:
        """The changes whose pattern does not stand in its file exactly once."""
        counts = [(ROOT / self.folder / change.file).read_text("utf-8").count(change.old) for change in self.changes]
        return [
            f"{change.name}: {change.old!r} stands {count} times in {self.folder}/{change.file}"
            for change, count in zip(self.changes, counts, strict=True)
            if count != 1
        ]

    def unnoticed(self, change: Change | None) -> bool:
        """Run the tests with a change (None: without one); True if they all pass."""
        with tempfile.TemporaryDirectory() as name:
            copy = Path(name) / "ninja-game"
            copy.mkdir()
            scratch_copy(copy)
            if change:
                path = copy / self.folder / change.file
                path.write_text(path.read_text("utf-8").replace(change.old, change.new), encoding="utf-8")
            command = [sys.executable, "-m", "pytest", *self.tests, "-x", "-q", "-p", "no:cacheprovider"]
            environment = os.environ | {"PYTHONPATH": str(copy)}
            return subprocess.run(command, cwd=copy, env=environment, capture_output=True, check=False).returncode == 0

    def run(self, names: Sequence[str]) -> int:
        """Try the named changes, or all; the number of unnoticed ones decides the exit code."""
        if wrong := self.misfits():
            print("\n".join(wrong))
            return 2
        changes = [change for change in self.changes if not names or change.name in names]
        if not self.unnoticed(None):
            print("the tests fail without any change; mend that first")
            return 2
        missing = []
        with ThreadPoolExecutor(2) as pool:
            for change, missed in zip(changes, pool.map(self.unnoticed, changes), strict=True):
                print(f"{'UNNOTICED' if missed else 'noticed  '}  {change.name}", flush=True)
                missing += [change.name] if missed else []
        print(f"{len(changes) - len(missing)} of {len(changes)} changes noticed")
        return 1 if len(missing) > self.allowed else 0


def scratch_copy(folder: Path) -> None:
    """Copy what the tests need into an empty folder."""
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        elif source.exists():
            shutil.copy(source, folder / name)
