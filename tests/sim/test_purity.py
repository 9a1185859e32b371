"""The rules use only arithmetic that is the same everywhere: + - * /, sqrt, floor, abs, comparisons."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import ninja_game.sim

FOLDER = Path(ninja_game.sim.__file__).parent
MEMORIES = {
    "declare.py",
    "layout.py",
    "compiled.py",
    "compiler.py",
    "interface.py",
    "plain.py",
    "digest.py",
    "loader.py",
    "schema.py",
    "level.py",
    "inputs.py",
}
RULES = sorted(path for path in FOLDER.rglob("*.py") if path.name not in MEMORIES)
FORBIDDEN_CALLS = {"pow", "sum", "round", "divmod", "hypot", "fmod", "sin", "cos", "tan", "atan2", "exp", "log", "set"}


@pytest.mark.parametrize("path", RULES, ids=lambda path: path.relative_to(FOLDER).as_posix())
def test_a_rule_uses_only_exact_arithmetic(path: Path) -> None:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        where = f"{path.name}:{getattr(node, 'lineno', 0)}"
        assert not isinstance(node, ast.Pow), f"{where}: ** differs between interpreters"
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            assert node.func.id not in FORBIDDEN_CALLS, f"{where}: {node.func.id}() is not exact everywhere"
        if isinstance(node, ast.ImportFrom) and node.module == "math":
            assert {alias.name for alias in node.names} <= {"sqrt"}, f"{where}: only sqrt comes from math"
        assert not isinstance(node, ast.Import), f"{where}: a rule imports only names of the simulation"
