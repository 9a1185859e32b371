"""The rules use only arithmetic that is the same everywhere: + - * /, sqrt, floor, abs, comparisons."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

import ninja_game.sim

FOLDER = Path(ninja_game.sim.__file__).parent
SCHEMA = {path.relative_to(FOLDER).as_posix() for path in (FOLDER / "schema").glob("*.py")}
ALSO_OTHER_CODE = {"loader.py", "inputs.py", "digest.py"} | SCHEMA
"""Files whose rules are only their compiled functions."""
RULES = sorted(FOLDER.rglob("*.py"))
assert {path.relative_to(FOLDER).as_posix() for path in RULES} >= ALSO_OTHER_CODE > SCHEMA > set()
FORBIDDEN_CALLS = {"pow", "sum", "round", "divmod", "hypot", "fmod", "sin", "cos", "tan", "atan2", "exp", "log", "set"}


def rules_of(path: Path) -> Iterator[ast.AST]:
    """Everything in a file that is a rule: the whole file, or its functions marked for compilation."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    if path.relative_to(FOLDER).as_posix() not in ALSO_OTHER_CODE:
        yield from ast.walk(tree)
    for function in tree.body:
        if isinstance(function, ast.FunctionDef):
            marks = {mark.id for mark in function.decorator_list if isinstance(mark, ast.Name)}
            if marks & {"fast", "kernel"}:
                yield from ast.walk(function)


@pytest.mark.parametrize("path", RULES, ids=lambda path: path.relative_to(FOLDER).as_posix())
def test_a_rule_uses_only_exact_arithmetic(path: Path) -> None:
    for node in rules_of(path):
        where = f"{path.name}:{getattr(node, 'lineno', 0)}"
        assert not isinstance(node, ast.Pow), f"{where}: ** differs between interpreters"
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            assert node.func.id not in FORBIDDEN_CALLS, f"{where}: {node.func.id}() is not exact everywhere"
        if isinstance(node, ast.ImportFrom) and node.module == "math":
            assert {alias.name for alias in node.names} <= {"sqrt"}, f"{where}: only sqrt comes from math"
        assert not isinstance(node, ast.Import), f"{where}: a rule imports only names of the simulation"
