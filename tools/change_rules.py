"""Test the tests of the rules: break one rule at a time and see whether a test notices.

    python3 tools/dev.py change-rules [NAME ...]

Each break of ``rule_changes`` is one line, by pattern; a pattern that does not fit is an error, so that the list stays
in step with the rules. It is made in a scratch copy without ../shared, and the tests run on the plain memory.
docs/testing.md says which breaks are left and why. Exit code 1 if more than ``ALLOWED`` go unnoticed.
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

from tools import ROOT
from tools.rule_changes import CHANGES

COPIED = ("ninja_game", "tests", "tools", "levels", "assets", "pyproject.toml", "README.md")
SIM = "ninja_game/sim"
TESTS = [
    f"tests/sim/test_{name}.py"
    for name in ("golden", "check_values", "edges", "objects_harmless", "objects_deadly", "properties")
]
ALLOWED = 5


def misfits() -> list[str]:
    """The changes whose pattern does not stand in its file exactly once."""
    counts = [(ROOT / SIM / file).read_text("utf-8").count(old) for _, file, old, _ in CHANGES]
    return [
        f"{name}: {old!r} stands {count} times in {SIM}/{file}"
        for (name, file, old, _), count in zip(CHANGES, counts, strict=True)
        if count != 1
    ]


def unnoticed(change: tuple[str, str, str, str] | None) -> bool:
    """Run the tests with a change (None: without one); True if they all pass."""
    with tempfile.TemporaryDirectory() as copy:
        for source in (ROOT / name for name in COPIED):
            target = Path(copy, source.name)
            if source.is_dir():
                shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, target)
        if change:
            path = Path(copy, SIM, change[1])
            path.write_text(path.read_text("utf-8").replace(*change[2:]), encoding="utf-8")
        command = [sys.executable, "-m", "pytest", *TESTS, "-k", "not compiled and not memories", "-x", "-q"]
        environment = os.environ | {"PYTHONPATH": copy}
        return subprocess.run(command, cwd=copy, env=environment, capture_output=True, check=False).returncode == 0


def main(names: Sequence[str]) -> int:
    """Try the named changes, or all; the number of unnoticed ones decides the exit code."""
    if wrong := misfits():
        print("\n".join(wrong))
        return 2
    if not unnoticed(None):
        print("the tests fail without any change; mend that first")
        return 2
    changes = [change for change in CHANGES if not names or change[0] in names]
    missing = 0
    with ThreadPoolExecutor(2) as pool:
        for change, missed in zip(changes, pool.map(unnoticed, changes), strict=True):
            print(f"{'UNNOTICED' if missed else 'noticed  '}  {change[0]}", flush=True)
            missing += missed
    print(f"{len(changes) - missing} of {len(changes)} changes noticed")
    return 1 if missing > ALLOWED else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
