"""Checks the rules of this project's code that no linter has; `tools/dev.py lint` runs it after the linters."""

import ast
import re
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from tempfile import TemporaryDirectory

import grimp

from tools import ROOT

FOLDERS = ("ninja_game", "tests", "tools", "benchmarks", "examples")
PAGE = r"ninja_game/(web/(shim/|page/|figures\.py)|__main__\.py)"  # it has the names of pygame, and of programs

REASONS = {
    "UP": "a direction of the world; the folder above a page",
    "LOCKED": "how a switch's door is; how an episode is",
    "collide_own_tile": "of the box and of the circle: each body's form of one rule",
    "main": "what a program begins with",
}
"""Names that two modules share with a good reason; a command may have the name of what does its work."""

LIKE = {"demonstration"}  # a public function and the type of what it makes

HIDDEN_PARAMETERS = {"record", "site"}  # options beside a command of that name: click passes them by their names

PLAIN = {
    *("name", "author", "comment", "player", "file", "record", "line", "level", "body", "gold", "kind", "id", "slot"),
    *("recording", "replay", "run", "text", "seed", "tick", "ticks", "length", "x", "y", "dx", "dy", "vx", "vy"),
    *("prev_x", "prev_y", "switch_x", "switch_y", "in_air", "near_wall", "char", "outcome", "levels", "results"),
    *("task", "ours", "theirs", "lock", "progress", "counters", "checkpoints", "mask", "unreadable", "dead", "owner"),
}
"""Fields that need no words, in px and px/tick."""

EXPLAINED = r"ninja_game/(simulation\.py|errors\.py|(sim|formats|runs|batch|search|learn|levels)/)"
"""The modules behind the public functions and commands."""

ELSEWHERE = 8  # lines that a skip of the formatter saves outside of a table of data, at least

Sources = Mapping[str, str]  # texts of files by their paths from the project's folder

parsed = cache(ast.parse)


def names(node: ast.stmt) -> Iterator[tuple[str, str, str]]:
    """The public names that a statement of a module defines: kind and name, and the value of a constant."""
    if isinstance(node, ast.ClassDef):
        yield "type", node.name, ""
    elif isinstance(node, ast.FunctionDef) and not any("command(" in ast.unparse(mark) for mark in node.decorator_list):
        yield "function", node.name, ""
    if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
        return
    written = ast.unparse(node.value)
    for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
        if isinstance(target, ast.Name) and target.id[0].isupper() and not written.startswith("TypeVar("):
            yield ("constant", target.id, written) if target.id.isupper() else ("type", target.id, "")
        elif isinstance(target, ast.Tuple):
            parts = getattr(node.value, "elts", None) or [written] * len(target.elts)
            if numbered := re.fullmatch(r"range\((\d+)\)", written):
                parts = range(int(numbered[1]))
            for name, part in zip(map(ast.unparse, target.elts), parts, strict=True):
                if name.isupper():
                    yield "constant", name, ast.unparse(part) if isinstance(part, ast.AST) else str(part)


def two_meanings(sources: Sources) -> Iterator[str]:
    """Public constants of one name with different values, and types and functions of one name."""
    files: dict[tuple[str, str], set[tuple[str, str]]] = defaultdict(set)
    for file, text in sources.items():
        defined = (found for node in parsed(text).body for found in names(node))
        for kind, name, value in (found for found in defined if not found[1].startswith("_")):
            files[kind, name].add((file, value or file))
    shared = {named: places for named, places in files.items() if len({meaning for _, meaning in places}) > 1}
    for (kind, name), places in shared.items():
        if name not in REASONS:
            where = ", ".join(sorted(file for file, _ in places))
            yield f"{where}: {kind} {name}: say in the name what it is of; with _ if only its module uses it"
    for name in REASONS.keys() - {name for _, name in shared}:
        yield f"tools/lint.py: {name} means one thing now: strike it out"


def like_names(sources: Sources) -> Iterator[str]:
    """Names of a module that differ only by case; imports are not looked at."""
    for file, text in sources.items():
        body = parsed(text).body
        targets = [target for node in body for target in getattr(node, "targets", [getattr(node, "target", None)])]
        own = {part.id for target in targets if target for part in ast.walk(target) if isinstance(part, ast.Name)}
        own |= {node.name for node in body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
        for name in (name for name, count in Counter(map(str.casefold, own)).items() if count > 1 and name not in LIKE):
            yield f"{file}: {name}: two names differ only by case; say in one what it is of: _ROW_HEIGHT beside _row"


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


def hiding_names(sources: Sources) -> Iterator[str]:
    """Local names that hide an import or a function of their module."""
    for file, text in sources.items():
        module = {*own_names(parsed(text).body)}
        for line, name in local_names(parsed(text)):
            if name in module:
                yield f"{file}:{line}: {name} hides a name of the module: name it after what it holds here"


def silent_fields(sources: Sources) -> Iterator[str]:
    """Fields of larger records that no comment beside them and no docstring explains."""
    for file, text in ((file, text) for file, text in sources.items() if re.match(EXPLAINED, file)):
        for node in (node for node in parsed(text).body if isinstance(node, ast.ClassDef) and node.name[0] != "_"):
            marks = [ast.unparse(mark) for mark in (*node.bases, *node.decorator_list)]
            fields = [field for field in node.body if isinstance(field, ast.AnnAssign)]
            fields = [field for field in fields if not ast.unparse(field.target).startswith("_")]
            if len(fields) > 4 and any(mark == "NamedTuple" or mark.startswith("dataclass") for mark in marks):
                known = PLAIN | {*re.findall(r"\w+", ast.get_docstring(node) or "")}
                for line, name in ((field.lineno, ast.unparse(field.target)) for field in fields):
                    if not ({name, name.partition("_")[0]} & known or "#:" in text.splitlines()[line - 1]):
                        yield f"{file}:{line}: {name}: say after #: or in the docstring what it is, with its unit"


def hides_a_decision(node: ast.AST) -> bool:
    """Whether an expression or a statement of one has a decision where a reader does not look for one."""
    if isinstance(node, ast.IfExp):
        last = node.orelse
        parts = [node.test, node.body]
        parts += [last.test, last.body, last.orelse] if isinstance(last, ast.IfExp) else [last]
        return any(isinstance(inner, ast.IfExp) for part in parts for inner in ast.walk(part))
    if isinstance(node, ast.FormattedValue):
        return any(isinstance(inner, ast.JoinedStr) for inner in ast.walk(node.value))
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
        sides = (node.left, node.right)
        texts = [side for side in sides if isinstance(getattr(side, "value", None), str | bytes)]
        texts += [side for side in sides if isinstance(side, ast.JoinedStr | ast.List)]
        called = [ast.unparse(side.func) for side in sides if isinstance(side, ast.Call)]
        return bool(texts) and ("bool" in called or any(isinstance(side, ast.Compare | ast.BoolOp) for side in sides))
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.IfExp)


def mixes_ways(node: ast.Assign) -> bool:
    """Whether an assignment gives three or more names values in unlike ways: by different calls, by a condition..."""
    plain = ast.Name | ast.Attribute | ast.Constant | ast.Subscript | ast.UnaryOp | ast.BinOp
    parts = getattr(node.value, "elts", []) if isinstance(node.targets[0], ast.Tuple) else []
    ways = {type(part).__name__ for part in parts if not isinstance(part, ast.Call | plain)}
    ways |= {ast.unparse(part.func).rpartition(".")[2] for part in parts if isinstance(part, ast.Call)}
    return len(parts) >= 3 and len(ways) + any(isinstance(part, plain) for part in parts) > 1


def hidden_decisions(sources: Sources) -> Iterator[str]:
    """No f-string in another, no text times a truth value, no conditional as statement, or in one but its ``else``."""
    for file, text in sources.items():
        for node in ast.walk(parsed(text)):
            if isinstance(node, ast.expr | ast.Expr) and hides_a_decision(node):
                yield f"{file}:{node.lineno}: a decision is hidden in this expression"
            elif isinstance(node, ast.Assign) and mixes_ways(node):
                yield f"{file}:{node.lineno}: three names get values in unlike ways: give them a line each"


def forbidden_imports(sources: Sources) -> Iterator[str]:
    """What tests and tools share imports neither of them, and tools import no tests."""
    for file, text in sources.items():
        others = r"tests\.(?!support)|tests$" if file.startswith(("tools/", "tests/support/")) else "$^"
        others += r"|tools\b" if file.startswith("tests/support/") else ""
        for node in (node for node in ast.walk(parsed(text)) if isinstance(node, ast.Import | ast.ImportFrom)):
            module = node.names[0].name if isinstance(node, ast.Import) else str(node.module)
            if re.match(others, module):
                yield f"{file}:{node.lineno}: {module} may not be imported here"


def circles() -> Iterator[str]:
    """Files that import one another in a circle; imports within functions and for types count too."""
    for package in ("ninja_game", "tools"):
        graph = grimp.build_graph(package, cache_dir=None)
        try:
            TopologicalSorter({file: graph.find_modules_directly_imported_by(file) for file in graph.modules}).prepare()
        except CycleError as error:
            yield f"{package}: {' <- '.join(error.args[1])} import one another in a circle"


def idle_skips(sources: Sources) -> Iterator[str]:
    """Places where the formatter is skipped, and would not make the code longer; outside of tables, much longer."""
    places: dict[Path, tuple[str, int]] = {}
    with TemporaryDirectory() as folder:
        for file, text in sources.items():
            lines, tree = text.splitlines(), parsed(text)
            displays = ast.Dict | ast.List | ast.Set | ast.Tuple
            ends = {node.end_lineno for node in ast.walk(tree) if isinstance(node, displays)}
            ends |= {node.end_lineno for node in tree.body if isinstance(node, ast.Assign | ast.AnnAssign)}
            for number in (number for number, line in enumerate(lines, 1) if line.endswith("  # fmt: skip")):
                path = Path(folder) / f"{len(places)}.py"
                changed = [*lines[: number - 1], lines[number - 1].removesuffix("  # fmt: skip"), *lines[number:]]
                path.write_text("\n".join(changed), "utf-8")
                lone = file.startswith("ninja_game/") and number not in ends
                places[path] = (f"{file}:{number}", len(lines) + (ELSEWHERE - 1 if lone else 0))
        words = [sys.executable, "-m", "ruff", "format", "-q", "--config", f"{ROOT}/pyproject.toml", folder]
        subprocess.run(words, check=True)
        for path, (place, most) in places.items():
            if path.read_text("utf-8").count("\n") <= most:
                yield f"{place}: the formatter is skipped for too few lines"


def main() -> int:
    """Print what breaks a rule; 1 if anything does."""
    paths = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]
    everything = {path.relative_to(ROOT).as_posix(): path.read_text("utf-8") for path in paths}
    package = {file: text for file, text in everything.items() if file.startswith("ninja_game/")}
    named = {file: text for file, text in package.items() if not re.match(PAGE, file)}
    faults = [*two_meanings(named), *like_names(named), *hiding_names(named), *silent_fields(named)]
    faults += [*hidden_decisions(package), *forbidden_imports(everything), *circles(), *idle_skips(everything)]
    sys.stdout.writelines(f"{fault}\n" for fault in faults)
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main())
