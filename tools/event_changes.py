"""Wrong events: every call in the world that reports one, dropped and with each of its arguments wrong.

The list is read from the sources, so that a new event is in it by itself; ``change_events`` tries it.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from tools import ROOT
from tools.changes import Change

SIM = ROOT / "ninja_game" / "sim"

ARGUMENTS = {
    "emit": {"slot": 2, "x": 3, "y": 4, "dx": 5, "dy": 6},
    "kill": {"cause": 1, "slot": 2, "dx": 3, "dy": 4, "x": 5, "y": 6},
}
"""Which argument of which call means what."""

ENTRIES = ("events.py", "memory/kernels.py")
"""Where the calls are defined or passed on."""


def event_changes() -> tuple[Change, ...]:
    """All changes, in order of files and lines."""
    files = (path for path in sorted(SIM.rglob("*.py")) if path.relative_to(SIM).as_posix() not in ENTRIES)
    return tuple(change for path in files for change in _changes_of(path))


def _changes_of(path: Path) -> Iterator[Change]:
    text = path.read_text("utf-8")
    file = path.relative_to(SIM).as_posix()
    for statement in ast.walk(ast.parse(text)):
        call = statement.value if isinstance(statement, ast.Expr) else None
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id in ARGUMENTS:
            old = ast.get_source_segment(text, call) or ""
            arguments = [ast.get_source_segment(text, argument) or "" for argument in call.args]
            name = f"{call.func.id}-{file.rpartition('/')[2].removesuffix('.py')}-{call.lineno}"
            yield Change(f"{name}-dropped", file, old, "pass")
            for what, wrong in _wrong(arguments, ARGUMENTS[call.func.id]):
                yield Change(f"{name}-{what}", file, old, f"{call.func.id}({', '.join(wrong)})")


def _wrong(arguments: list[str], at: dict[str, int]) -> Iterator[tuple[str, list[str]]]:
    """Each way in which the arguments can be wrong and yet make sense: its name, and the arguments."""

    def changed(**new: str) -> list[str]:
        out = arguments.copy()
        for name, value in new.items():
            out[at[name]] = value
        return out

    now = {name: arguments[position] for name, position in at.items()}
    yield "place", changed(x=now["y"], y=now["x"])
    if now["slot"] != "0":
        yield "slot", changed(slot="0")
    if "cause" in now:
        yield "cause", changed(cause=f"{now['cause']} + 1")
    if (now["dx"], now["dy"]) != ("0.0", "0.0"):
        yield "vector", changed(dx=now["dy"], dy=now["dx"])
        yield "direction", changed(dx=f"-({now['dx']})", dy=f"-({now['dy']})")
