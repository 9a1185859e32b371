"""Test the tests: break the program at random places, one at a time, and list the breaks that no test notices.

    python3 tools/dev.py tool breaks --count 400 --seed 1 [--part formats] [--jobs 2]

A break changes one node of a syntax tree: a comparison, an operator, `and` and `or`, a number or truth value, what a
function returns, a call or `+=` that is left out. Each is tried in a scratch worktree of HEAD, on the tests nearest to
its module: those that import it, or share its folder or name. Breaks of the rules are drawn only with `--part sim`;
`change_rules` has a list of them. What came of each is a line of JSON in the log, where the next call with that HEAD
goes on. A survivor is an untested line, or a break that changes nothing; read it before you write a test.
"""

from __future__ import annotations

import argparse
import ast
import copy
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from itertools import accumulate
from pathlib import Path
from queue import Queue
from typing import Any, NamedTuple

from tools import ROOT

LEFT_OUT = ("ninja_game/sim/", "ninja_game/web/shim/", "ninja_game/web/page/")
LOG = ROOT / "build" / "breaks.jsonl"
MOST, SECONDS = 4, 600
"""How many test files are run for a break, and for how long."""
PAIRS = "Lt LtE Gt GtE Eq NotEq Is IsNot In NotIn And Or Add Sub Mult Div BitAnd BitOr LShift RShift".split()  # noqa: SIM905
OTHER = {getattr(ast, name): getattr(ast, PAIRS[place ^ 1]) for place, name in enumerate(PAIRS)}
"""What an operator becomes."""
SEE_ALL = {"ninja_game/play/": "tests/play/test_recorded_screens.py"}
"""A test that sees all of a room, though it imports little of it."""
NOT_RUN = {"annotation", "returns", "decorator_list", "type_params"}


class Break(NamedTuple):
    """A piece of a file, by its offsets in bytes, and what it becomes."""

    file: str
    start: int
    end: int
    new: str


def breaks_of(file: str) -> Iterator[Break]:
    """All breaks of a file."""
    source = (ROOT / file).read_text("utf-8")
    lines = list(accumulate(map(len, source.encode().splitlines(keepends=True)), initial=0))
    for node in _nodes(ast.parse(source)):
        for new in _broken(node):
            end = lines[(node.end_lineno or 0) - 1] + (node.end_col_offset or 0)
            yield Break(file, lines[node.lineno - 1] + node.col_offset, end, new)


def _nodes(node: ast.AST) -> Iterator[ast.expr | ast.stmt]:
    """What can be broken; no annotations, decorators, imports, nor what only type checkers read."""
    for name, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            if name in NOT_RUN or not isinstance(child, ast.AST) or isinstance(child, ast.JoinedStr):
                continue
            if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.dump(child.test):
                continue
            if isinstance(child, (ast.expr, ast.stmt)):
                yield child
            yield from _nodes(child)


def _broken(node: ast.expr | ast.stmt) -> Iterator[str]:
    """What may stand in a node's place."""
    match node:
        case ast.Compare(ops=[op]) | ast.BinOp(op=op) | ast.BoolOp(op=op) if type(op) in OTHER and not _joins(node):
            changed: Any = copy.copy(node)
            changed.op = OTHER[type(op)]()
            changed.ops = [changed.op]
            yield f"({ast.unparse(changed)})"
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield f"({ast.unparse(operand)})"
        case ast.Constant(value=bool() as value):
            yield str(not value)
        case ast.Constant(value=int() as value):
            yield str(value + 1)
        case ast.Constant(value=float() as value):
            yield str(2 * value or 1.0)
        case ast.Return(value=ast.expr() as value) if not (isinstance(value, ast.Constant) and value.value is None):
            yield "return None"
        case ast.Expr(value=ast.Call()) | ast.AugAssign():
            yield "pass"


def _joins(node: ast.expr | ast.stmt) -> bool:
    """Whether an operator works on text: no other would."""
    sides = (getattr(node, "left", None), getattr(node, "right", None))
    return any(isinstance(side, ast.JoinedStr) or isinstance(getattr(side, "value", 0), str) for side in sides)


@cache
def imports() -> dict[str, set[str]]:
    """What each file of the program and the tests imports of these, anywhere in it."""
    paths = [path for room in ("ninja_game", "tests") for path in (ROOT / room).rglob("*.py")]
    files = [path.relative_to(ROOT).as_posix() for path in paths]
    modules = {file.removesuffix(".py").removesuffix("/__init__").replace("/", "."): file for file in files}
    found: dict[str, set[str]] = {}
    for file in files:
        names = set()
        for node in ast.walk(ast.parse((ROOT / file).read_text("utf-8"))):
            if isinstance(node, ast.Import):
                names |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module:
                names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        found[file] = {modules[name] for name in names & modules.keys()}
    return found


@cache
def tests_near(file: str) -> list[str]:
    """The test files that are nearest to a module: by imports from them to it, by folders, by name."""
    distance, front = {file: 0}, {file}
    while front:
        front = {test for test, seen in imports().items() if test not in distance and seen & front}
        distance |= dict.fromkeys(front, max(distance.values()) + 1)
    stem, rooms = Path(file).stem.strip("_"), set(Path(file).parts[1:-1])

    def far(test: str) -> int:
        same_name = Path(test).stem in {f"test_{stem}", f"test_{stem}s"}
        return distance.get(test, 9) - 2 * len(rooms & {*Path(test).parts}) - 4 * same_name

    tests = sorted(test for test in imports() if Path(test).name.startswith("test_"))
    whole = [test for room, test in SEE_ALL.items() if file.startswith(room)]
    return [*whole, *sorted(tests, key=far)[:MOST]]


def try_out(broken: Break, trees: Queue[Path], sound: dict[str, bool]) -> tuple[str, list[str]]:
    """What came of a break, and the tests that failed or ran; a test file that fails without a break does not count."""
    tree = trees.get()
    path = tree / broken.file
    before = path.read_bytes()
    while True:
        tests = [test for test in tests_near(broken.file) if sound.get(test, True)]
        path.write_bytes(before[: broken.start] + broken.new.encode() + before[broken.end :])
        result, failed = run_tests(tree, tests)
        path.write_bytes(before)
        for test in failed:
            if test not in sound:
                sound[test] = run_tests(tree, [test])[0] == "survived"
        if all(sound[test] for test in failed):
            trees.put(tree)
            return result, failed or tests


def run_tests(tree: Path, tests: list[str]) -> tuple[str, list[str]]:
    """Whether the tests of a worktree survive ("timeout": an endless loop, or slow tests), and the files that fail."""
    words = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests]
    environment = os.environ | {"PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"}
    with (tree / "output.txt").open("w+", encoding="utf-8") as output:
        process = subprocess.Popen(
            words, cwd=tree, env=environment, stdout=output, stderr=output, start_new_session=True
        )
        try:
            code = process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return "timeout", []
        output.seek(0)
        failed = re.findall(r"^(?:FAILED|ERROR) (tests/\S+?\.py)", output.read(), re.MULTILINE)
    return "noticed" if code else "survived", sorted({*failed})


def git(*words: str) -> str:
    return subprocess.run(["git", "-C", ROOT, *words], check=True, capture_output=True, text=True).stdout.strip()


def main() -> int:
    """Print the survivors; exit code 1 if there are any."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100, help="how many breaks to draw (100)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (1)")
    parser.add_argument("--part", default="", help="only of this folder of ninja_game; also sim")
    parser.add_argument("--jobs", type=int, default=1, help="how many at a time (1)")
    parser.add_argument("--log", type=Path, default=LOG, help="where the results are (build/breaks.jsonl)")
    options = parser.parse_args()
    if git("status", "--porcelain", "ninja_game", "tests"):
        sys.exit("breaks: ninja_game or tests differ from HEAD, whose copy is tried; commit first")
    files = [path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "ninja_game" / options.part).rglob("*.py"))]
    left_out = LEFT_OUT if not options.part else ()
    every = [broken for file in files if not file.startswith(left_out) for broken in breaks_of(file)]
    drawn = random.Random(options.seed).sample(every, min(options.count, len(every)))
    options.log.parent.mkdir(parents=True, exist_ok=True)
    commit, trees = git("rev-parse", "HEAD"), Queue[Path]()
    with (
        tempfile.TemporaryDirectory() as scratch,
        ThreadPoolExecutor(options.jobs) as pool,
        options.log.open("a+", encoding="utf-8") as log,
    ):
        log.seek(0)
        results = {Break(*row["break"]): row["result"] for row in map(json.loads, log) if row["commit"] == commit}
        for number in range(options.jobs):
            git("worktree", "add", "--detach", f"{scratch}/{number}", commit)
            trees.put(Path(scratch, str(number)))
        todo = [broken for broken in drawn if broken not in results]
        for broken, (result, tests) in zip(todo, pool.map(partial(try_out, trees=trees, sound={}), todo), strict=True):
            print(
                json.dumps({"commit": commit, "break": broken, "result": result, "tests": tests}), file=log, flush=True
            )
            results[broken] = result
            print(f"{len(results)} {result}: {told(broken)}", flush=True)
    git("worktree", "prune")
    survivors = [broken for broken in drawn if results[broken] == "survived"]
    print(f"\n{len(survivors)} of {len(drawn)} survived", *map(told, survivors), sep="\n")
    return 1 if survivors else 0


def told(broken: Break) -> str:
    """A break as a reader finds it."""
    text = (ROOT / broken.file).read_bytes()
    line = text[: broken.start].count(b"\n") + 1
    old = " ".join(text[broken.start : broken.end].decode().split())
    return f"{broken.file}:{line}: {old}  ->  {broken.new}"


if __name__ == "__main__":
    sys.exit(main())
