"""A public name of a module means one thing in the whole package."""

from __future__ import annotations

import ast
import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

import ninja_game

PACKAGE = Path(ninja_game.__path__[0])

ELSEWHERE = ("web/shim/", "web/page/", "web/figures.py", "__main__.py")
"""Modules of the page, which have the names of pygame, and the program itself."""

TWO_MEANINGS = {
    "UP": "a direction of the world; the folder above a page",
    "LOCKED": "how a switch's door is; how an episode is",
}
"""Names that two modules share with a good reason: both are plain words that are read beside their module."""

TWINS = {
    "collide_own_tile": "of the box and of the circle: each body's form of one rule",
    "main": "what a program begins with",
}
"""Functions of one name in two modules, with a good reason; a command may have the name of what does its work."""


def modules() -> dict[str, ast.Module]:
    """The modules of the package by their files, as syntax trees."""
    files = {path.relative_to(PACKAGE).as_posix(): path for path in sorted(PACKAGE.rglob("*.py"))}
    return {file: ast.parse(path.read_text("utf-8")) for file, path in files.items() if not file.startswith(ELSEWHERE)}


def values(node: ast.stmt) -> Iterator[tuple[str, str]]:
    """The public constants that a statement sets, and their values as they are written."""
    if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
        return
    written = ast.unparse(node.value)
    for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
        if isinstance(target, ast.Name) and is_public(target.id) and not written.startswith("TypeVar("):
            yield target.id, written
        elif isinstance(target, ast.Tuple):
            parts = getattr(node.value, "elts", None) or [written] * len(target.elts)
            if numbered := re.fullmatch(r"range\((\d+)\)", written):
                parts = range(int(numbered[1]))
            for name, part in zip(map(ast.unparse, target.elts), parts, strict=True):
                if is_public(name):
                    yield name, ast.unparse(part) if isinstance(part, ast.AST) else str(part)


def is_public(name: str) -> bool:
    return name.isupper() and not name.startswith("_")


def test_no_two_public_constants_of_one_name_have_different_values() -> None:
    files: dict[str, dict[str, list[str]]] = defaultdict(lambda: defaultdict(list))
    for file, tree in modules().items():
        for name, value in (pair for node in tree.body for pair in values(node)):
            files[name][value].append(file)
    shared = {name: dict(by_value) for name, by_value in files.items() if len(by_value) > 1}
    assert not {name: by_value for name, by_value in shared.items() if name not in TWO_MEANINGS}, (
        "say in the name what it is of (MAX_TRACE_TICKS), or begin it with _ if only its module uses it"
    )
    assert not TWO_MEANINGS.keys() - shared.keys(), "they mean one thing now: strike them out"


HIDDEN_PARAMETERS = {"record", "site"}
"""Options of commands beside a command of that name: click passes them by their names."""


def own_names(body: list[ast.stmt]) -> Iterator[str]:
    """The imports, functions and classes of a module."""
    for node in body:
        if isinstance(node, ast.If):
            yield from own_names(node.body + node.orelse)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            yield from ((alias.asname or alias.name).partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name


def local_names(node: ast.AST, *, inside: bool = False) -> Iterator[tuple[int, str]]:
    """Line and name of parameters, of the names that functions set, and of those of comprehensions."""
    inside |= isinstance(node, ast.FunctionDef | ast.Lambda | ast.comprehension)
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.arg) and child.arg not in HIDDEN_PARAMETERS:
            yield child.lineno, child.arg
        elif inside and isinstance(child, ast.Name) and isinstance(child.ctx, ast.Store):
            yield child.lineno, child.id
        yield from local_names(child, inside=inside)


def test_no_local_name_hides_an_import_or_a_function_of_its_module() -> None:
    hidden = []
    for file, tree in modules().items():
        names = {*own_names(tree.body)}
        hidden += [f"{file}:{line}: {name}" for line, name in local_names(tree) if name in names]
    assert not hidden, "name the local one after what it holds here"


def types(node: ast.stmt) -> Iterator[str]:
    """The public types that a statement names: its class, or its aliases of types."""
    if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
        yield node.name
    if isinstance(node, ast.Assign | ast.AnnAssign) and not ast.unparse(node.value or node).startswith("TypeVar("):
        for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
            if isinstance(target, ast.Name) and target.id[0].isupper() and not target.id.isupper():
                yield target.id


def test_no_two_public_types_have_one_name() -> None:
    files = defaultdict(list)
    for file, tree in modules().items():
        for name in (name for node in tree.body for name in types(node)):
            files[name].append(file)
    assert not {name: where for name, where in files.items() if len(where) > 1}, (
        "say in the name of an alias what it is of (RunKey), or begin it with _ if only its module uses it"
    )


def test_no_two_public_functions_have_one_name() -> None:
    files = defaultdict(list)
    for file, tree in modules().items():
        for node in tree.body:
            if isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and not is_command(node):
                files[node.name].append(file)
    shared = {name: where for name, where in files.items() if len(where) > 1}
    assert not {name: where for name, where in shared.items() if name not in TWINS}, "say in the name what it is of"
    assert not TWINS.keys() - shared.keys(), "they have names of their own now: strike them out"


def is_command(node: ast.FunctionDef) -> bool:
    """Whether it is a command of click, named as users type it."""
    return any("command(" in ast.unparse(decorator) for decorator in node.decorator_list)


ONE_WORD = {
    "demonstration": "learn's public function and what it makes",
    **dict.fromkeys(
        ("_answer", "_arranging", "_missing", "_row", "heard", "properties", "shown_ticks"), "of the editor"
    ),
}
"""Names of which a module has two that differ only by case, with a good reason."""


def test_no_two_names_of_a_module_differ_only_by_case() -> None:
    pairs = []
    for file, tree in modules().items():
        names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
        for node in (node for node in tree.body if isinstance(node, ast.Assign | ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names |= {part.id for target in targets for part in ast.walk(target) if isinstance(part, ast.Name)}
        twice = [name for name, count in Counter(map(str.casefold, names)).items() if count > 1]
        pairs += [f"{file}: {name}" for name in twice if name not in ONE_WORD]
    assert not pairs, "say in one of the names what it is of: _ROW_HEIGHT beside _row"


PLAIN = {
    *("name", "author", "comment", "player", "file", "record", "line", "level", "body", "gold", "kind", "id", "slot"),
    *("recording", "replay", "run", "text", "seed", "tick", "ticks", "length", "x", "y"),
    *("prev_x", "prev_y", "dx", "dy"),
    *("vx", "vy", "switch_x", "switch_y", "in_air", "near_wall", "char", "outcome", "levels", "results", "task"),
    *("ours", "theirs", "lock", "progress", "counters", "checkpoints", "mask", "unreadable", "dead", "owner"),
}
"""Fields that need no words, in px and px/tick."""

EXPLAINED = ("simulation.py", "errors.py", "sim/", "formats/", "runs/", "batch/", "search/", "learn/", "levels/")
"""The modules behind the public functions and commands."""


def test_fields_of_larger_records_are_explained() -> None:
    silent = []
    for file, tree in modules().items():
        lines = (PACKAGE / file).read_text("utf-8").splitlines()
        for node in (node for node in tree.body if isinstance(node, ast.ClassDef) and file.startswith(EXPLAINED)):
            fields = [field for field in node.body if isinstance(field, ast.AnnAssign) and is_record(node)]
            fields = [field for field in fields if not ast.unparse(field.target).startswith("_")]
            words = set(re.findall(r"\w+", ast.get_docstring(node) or ""))
            for field in fields if len(fields) > 4 and not node.name.startswith("_") else ():
                name = ast.unparse(field.target)
                if not ({name, name.partition("_")[0]} & (words | PLAIN) or "#:" in lines[field.lineno - 1]):
                    silent.append(f"{file}: {node.name}.{name}")
    assert not silent, "say beside it, after #:, or in the docstring what it is, with its unit"


def is_record(node: ast.ClassDef) -> bool:
    written = [ast.unparse(part) for part in (*node.bases, *node.decorator_list)]
    return any(part == "NamedTuple" or part.startswith("dataclass") for part in written)
