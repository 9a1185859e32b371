"""Test the tests: change one rule at a time in a scratch copy and see whether a test notices.

    python3 tools/dev.py change-rules [NAME …]

Only tests that need no reference data run (the scratch copy has no ../shared), on the plain memory. Each change is
one line, by pattern; a pattern that no longer fits is an error, so that the list stays in step with the rules. Changes
that no test notices are listed at the end; docs/testing.md says which are left and why. Exit code 1 if more than
``ALLOWED`` go unnoticed.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tools import ROOT
from tools.rule_changes import CHANGES, Change

ALLOWED = 5
COPIED = ("ninja_game", "tests", "levels", "pyproject.toml", "README.md")
FILES = [
    f"tests/sim/test_{name}.py"
    for name in ("golden", "check_values", "edges", "objects_harmless", "objects_deadly", "properties")
]
TESTS = (*FILES, "-x", "-q", "-k", "not compiled and not memories", "-p", "no:cacheprovider")


def scratch_copy(folder: Path) -> None:
    """Copy what the tests need into an empty folder."""
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        elif source.exists():
            shutil.copy(source, folder / name)


def misfits(changes: list[Change]) -> list[str]:
    """The changes whose pattern does not stand in its file exactly once."""
    counts = [(ROOT / "ninja_game/sim" / change.file).read_text("utf-8").count(change.old) for change in changes]
    return [
        f"{change.name}: {change.old!r} stands {count} times in sim/{change.file}"
        for change, count in zip(changes, counts, strict=True)
        if count != 1
    ]


def apply(change: Change, folder: Path) -> None:
    """Change one line of the copy."""
    path = folder / "ninja_game" / "sim" / change.file
    path.write_text(path.read_text("utf-8").replace(change.old, change.new), encoding="utf-8")


def unnoticed(change: Change | None) -> bool:
    """Run the tests with a change (None: without one); True if they all pass."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "ninja-game"
        folder.mkdir()
        scratch_copy(folder)
        if change:
            apply(change, folder)
        command = [sys.executable, "-m", "pytest", *TESTS]
        environment = os.environ | {"PYTHONPATH": str(folder)}
        return subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=False).returncode == 0


def main(names: list[str]) -> int:
    """Try the named changes, or all; the number of unnoticed ones decides the exit code."""
    changes = [change for change in CHANGES if not names or change.name in names]
    if wrong := misfits(changes):
        print("\n".join(wrong))
        return 2
    if not unnoticed(None):
        print("the tests fail without any change; mend that first")
        return 2
    missing = []
    with ThreadPoolExecutor(2) as pool:
        for change, missed in zip(changes, pool.map(unnoticed, changes), strict=True):
            print(f"{'UNNOTICED' if missed else 'noticed  '}  {change.name}", flush=True)
            missing += [change.name] if missed else []
    print(f"{len(changes) - len(missing)} of {len(changes)} changes noticed")
    return 1 if len(missing) > ALLOWED else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
