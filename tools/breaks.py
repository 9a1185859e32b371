"""Test the tests: break the program at random places, one at a time, and list the breaks that no test notices.

    python3 tools/dev.py tool breaks --count 400 --seed 1 [--part formats] [--jobs 2]

A break changes one node of a syntax tree: a comparison, an operator, `and` and `or`, a number or truth value, what a
function returns, a call or `+=` that is left out. The first call at a HEAD runs all tests once under coverage.py, which
tells which tests execute a line. Each break is tried in a scratch worktree of HEAD on the tests that execute its line,
or lines that name what it defines, fastest first; where none does, on the test files that import its module, or share
its folder or name. Breaks of the rules are drawn only with `--part sim`. The result of each is a line of JSON in the
log, where the next call with that HEAD goes on. A survivor is an untested line, or a break that changes nothing; read
it before you write a test.

    python3 tools/dev.py change-rules [NAME ...]

tries the breaks of the rules that `rule_changes.tsv` lists, without ../shared, on the plain memory; docs/testing.md
says which are left and why.
"""

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
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import cache, partial
from itertools import accumulate
from pathlib import Path
from queue import Queue
from typing import Any, NamedTuple

from coverage import Coverage, CoverageData

from tools import ROOT

LEFT_OUT = ("ninja_game/sim/", "ninja_game/web/shim/", "ninja_game/web/page/")
LOG = ROOT / "build" / "breaks.jsonl"
MAX_TESTS, BUDGET, SECONDS = 4, 120.0, 600
"""For a break: test files that are near, seconds that its tests take without it, seconds after which they are ended."""
PAIRS = "Lt LtE Gt GtE Eq NotEq Is IsNot In NotIn And Or Add Sub Mult Div BitAnd BitOr LShift RShift".split()  # noqa: SIM905
OTHER = {getattr(ast, name): getattr(ast, PAIRS[place ^ 1]) for place, name in enumerate(PAIRS)}
"""What an operator becomes."""
ALL = ("--ignore=tests/sim",)  # of a run of all tests: those of the rules execute little else, for long
CLOCK = re.compile(r"\b(monotonic|perf_counter)\(\)")
NOT_RUN = {"annotation", "returns", "decorator_list", "type_params"}

RULE_TESTS = [
    *("-k", "not compiled and not memories"),
    *(f"tests/sim/test_{name}.py" for name in ("golden", "check_values", "edges")),
    *(f"tests/sim/test_{name}.py" for name in ("objects_harmless", "objects_deadly", "properties")),
]
"""What the breaks of rule_changes.tsv are tried on."""
ALLOWED = 5  # how many of them may survive


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
    tree = ast.parse(source)
    equivalent = set(_equivalent(tree))
    for node in _nodes(tree):
        for new in () if node in equivalent else _broken(node):
            end = lines[(node.end_lineno or 0) - 1] + (node.end_col_offset or 0)
            yield Break(file, lines[node.lineno - 1] + node.col_offset, end, new)


def _equivalent(tree: ast.AST) -> Iterator[ast.AST]:
    """What is not broken, since the program does the same after it, or only a debugger shows it."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name="__repr__"):
                yield from ast.walk(node)
            case ast.FunctionDef(returns=ast.Name("bool")):
                # None is as false.
                returns = (part for part in ast.walk(node) if isinstance(part, ast.Return))
                yield from (part for part in returns if getattr(part.value, "value", None) is False)
            case ast.keyword("repr", value):
                yield value
            case ast.Call(func=ast.Name("zip"), keywords=[ast.keyword("strict", ast.Constant(True) as value)]):
                yield value
            case ast.Compare() if CLOCK.search(ast.unparse(node)):
                # No clock shows exactly the limit.
                yield node


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

    return sorted(sorted(test for test in imports() if Path(test).name.startswith("test_")), key=far)[:MAX_TESTS]


class Executed:
    """What tools/executed.py has seen in a run of all tests at a HEAD."""

    def __init__(self, folder: Path, tree: Path, jobs: int) -> None:
        if not (folder / "seconds.json").exists():
            folder.mkdir(parents=True, exist_ok=True)
            print("running all tests, to see what they execute", flush=True)
            run_tests(tree, ["-p", "tools.executed", "-n", str(jobs), *ALL], seconds=None, EXECUTED=str(folder))
            together = Coverage(folder / "lines")
            together.combine([str(folder)])
            together.save()
        self.seconds: dict[str, float] = json.loads((folder / "seconds.json").read_text("utf-8"))
        # What is not read before it is asked is erased.
        data = CoverageData(str(folder / "lines"))
        data.read()
        self.lines = cache(data.contexts_by_lineno)

    def tests_of(self, broken: Break) -> list[str]:
        """The tests to try a break on, fastest first, as many as fit into BUDGET; or test files near it."""
        text = (ROOT / broken.file).read_bytes()
        first, last = (text[:offset].count(b"\n") + 1 for offset in (broken.start, broken.end))
        seen = self.lines(broken.file)
        # Of an expression on several lines that is a constant, only the first one may have been seen.
        first = max((line for line in seen if line <= first), default=first)
        found = {test for line in range(first, last + 1) for test in seen.get(line, ())}
        # A constant is executed by whoever imports its module first: the tests of those who name it see it.
        if named := re.match(r"(\w+(?:, \w+)*)(?:: .+?)? = ", text.decode().splitlines()[first - 1]):
            found |= {test for name in named[1].split(", ") for test in self._naming(name, broken.file)}
        tests: list[str] = []
        total = 0.0
        executing = (test for test in self.seconds if test in found or test.partition("::")[0] in found)
        for test in sorted(executing, key=self.seconds.__getitem__):
            total += self.seconds[test]
            if tests and total > BUDGET:
                break
            tests.append(test)
        return tests or tests_near(broken.file)

    @cache  # noqa: B019 - one object lives as long as the program
    def _naming(self, name: str, module: str) -> set[str]:
        """The tests that execute a line with this name in it, of its module or one that imports it."""
        word = re.compile(rf"\b{name}\b")
        return {
            test
            for file, imported in imports().items()
            if file.startswith("ninja_game/") and (file == module or module in imported)
            for number, line in enumerate((ROOT / file).read_text("utf-8").splitlines(), 1)
            if word.search(line)
            for test in self.lines(file).get(number, ())
        }


def rule_breaks() -> dict[str, Break]:
    """The listed breaks of the rules by name; ends the program for one whose text does not stand there exactly once."""
    found = {}
    for line in (ROOT / "tools" / "rule_changes.tsv").read_text("utf-8").splitlines():
        if line.startswith("#"):
            continue
        name, file, old, new = (part.replace("\\n", "\n") for part in line.split("\t"))
        source = (ROOT / "ninja_game" / "sim" / file).read_bytes()
        if source.count(old.encode()) != 1:
            sys.exit(f"{name}: {old!r} stands {source.count(old.encode())} times in ninja_game/sim/{file}")
        start = source.index(old.encode())
        found[name] = Break(f"ninja_game/sim/{file}", start, start + len(old.encode()), new)
    return found


def try_out(
    broken: Break, tests_of: Callable[[Break], list[str]], trees: Queue[Path], sound: dict[str, bool]
) -> tuple[str, list[str], float]:
    """The result of a break, the tests that failed or ran, seconds; a test that fails without it does not count."""
    tree, began = trees.get(), time.monotonic()
    before = (path := tree / broken.file).read_bytes()
    try:
        while True:
            tests = [test for test in tests_of(broken) if sound.get(test, True)]
            unsound = [f"--deselect={test}" for test, is_sound in [*sound.items()] if not is_sound]
            path.write_bytes(before[: broken.start] + broken.new.encode() + before[broken.end :])
            result, failed = run_tests(tree, ["-x", *unsound, *tests])
            path.write_bytes(before)
            for test in {*failed} - sound.keys():
                sound[test] = run_tests(tree, [test])[0] == "survived"
            if all(sound[test] for test in failed):
                return result, failed or tests, round(time.monotonic() - began, 1)
    finally:
        path.write_bytes(before)
        trees.put(tree)


def run_tests(
    tree: Path, words: Sequence[str], seconds: float | None = SECONDS, **environment: str
) -> tuple[str, list[str]]:
    """Whether the tests of a worktree survive ("timeout": an endless loop, or slow tests), and those that fail."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *words]
    environment = os.environ | {"PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"} | environment
    with (tree / "output.txt").open("w+", encoding="utf-8") as output:
        process = subprocess.Popen(
            command, cwd=tree, env=environment, stdout=output, stderr=output, start_new_session=True
        )
        try:
            code = process.wait(seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return "timeout", []
        output.seek(0)
        failed = re.findall(r"^(?:FAILED|ERROR) ([^\s\[]+)", output.read(), re.MULTILINE)
    files = [word if word.startswith("-") else word.partition("::")[0] for word in words]
    if code in (4, 5) and not failed and files != words:  # a break may only rename a test
        return run_tests(tree, files, seconds, **environment)
    return "noticed" if code not in (0, 5) else "survived", sorted({*failed})


def git(*words: str) -> str:
    return subprocess.run(["git", "-C", ROOT, *words], check=True, capture_output=True, text=True).stdout.strip()


def main() -> int:
    """Print the survivors; exit code 1 if there are any."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100, help="how many breaks to draw (100)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (1)")
    parser.add_argument("--part", default="", help="only of this folder of ninja_game; also sim")
    parser.add_argument("--rules", nargs="*", metavar="NAME", help="instead these of rule_changes.tsv, or all")
    parser.add_argument("--jobs", type=int, default=1, help="how many at a time (1)")
    parser.add_argument("--log", type=Path, default=LOG, help="where the results are (build/breaks.jsonl)")
    options = parser.parse_args()
    if git("status", "--porcelain", "ninja_game", "tests"):
        sys.exit("breaks: ninja_game or tests differ from HEAD, whose copy is tried; commit first")
    if options.rules is not None:
        listed = rule_breaks()
        drawn = [listed[name] for name in options.rules or listed]
    else:
        paths = sorted((ROOT / "ninja_game" / options.part).rglob("*.py"))
        files = [path.relative_to(ROOT).as_posix() for path in paths]
        left_out = LEFT_OUT if not options.part else ()
        every = [broken for file in files if not file.startswith(left_out) for broken in breaks_of(file)]
        drawn = random.Random(options.seed).sample(every, min(options.count, len(every)))
    options.log.parent.mkdir(parents=True, exist_ok=True)
    commit, trees = git("rev-parse", "HEAD"), Queue[Path]()
    with (
        ExitStack() as at_last,
        tempfile.TemporaryDirectory() as scratch,
        ThreadPoolExecutor(options.jobs) as pool,
        options.log.open("a+", encoding="utf-8") as log,
    ):
        at_last.callback(git, "worktree", "prune")
        log.seek(0)
        results = {Break(*row["break"]): row["result"] for row in map(json.loads, log) if row["commit"] == commit}
        for number in range(options.jobs):
            git("worktree", "add", "--detach", f"{scratch}/{number}", commit)
            trees.put(Path(scratch, str(number)))
        todo = [broken for broken in drawn if broken not in results]
        folder = options.log.parent / f"executed-{commit[:12]}"
        executed = None if options.rules is not None else Executed(folder, Path(scratch, "0"), options.jobs)
        tests_of = executed.tests_of if executed else lambda _: RULE_TESTS
        tried = pool.map(partial(try_out, tests_of=tests_of, trees=trees, sound={}), todo)
        for broken, (result, failed, seconds) in zip(todo, tried, strict=True):
            row = {"commit": commit, "break": broken, "result": result, "seconds": seconds, "tests": failed}
            print(json.dumps(row), file=log, flush=True)
            results[broken] = result
            print(f"{len(results)} {result}: {described(broken)}", flush=True)
    survivors = [broken for broken in drawn if results[broken] == "survived"]
    print(f"\n{len(survivors)} of {len(drawn)} survived", *map(described, survivors), sep="\n")
    return 1 if len(survivors) > (ALLOWED if options.rules is not None else 0) else 0


def described(broken: Break) -> str:
    """A break as a reader finds it."""
    text = (ROOT / broken.file).read_bytes()
    line = text[: broken.start].count(b"\n") + 1
    old = " ".join(text[broken.start : broken.end].decode().split())
    return f"{broken.file}:{line}: {old}  ->  {broken.new}"


if __name__ == "__main__":
    sys.exit(main())
