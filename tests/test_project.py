"""The project keeps its own promises: commands in documents exist, versions agree."""

from __future__ import annotations

import ast
import re
import shlex
import subprocess
import sys
import tomllib
from graphlib import TopologicalSorter
from pathlib import Path

import grimp
import pytest
from click.testing import CliRunner

import ninja_game
from ninja_game.cli.commands import COMMANDS
from ninja_game.cli.main import cli
from tools import dev

ROOT = Path(__file__).resolve().parent.parent
FOLDERS = ("ninja_game", "tests", "tools", "benchmarks", "examples")
FIRST_WORDS = {"episode", "level", "replay"}  # what follows "ninja-game" in the first line of our files


def commands_in(text: str, program: str) -> list[list[str]]:
    """The words after ``program`` on every line of ``text``'s code that starts with it."""
    code = "\n".join(re.findall(r"^```.*?^```|^    [^\n]*$", text, re.MULTILINE | re.DOTALL))
    lines = re.findall(rf"^ *(?:\$ )?{re.escape(program)} +([^#\n]+)", code, re.MULTILINE)
    inline = re.findall(rf"`{re.escape(program)} +([^`]+)`", text)
    return [shlex.split(line) for line in lines + inline]


def test_documents_name_only_commands_that_exist() -> None:
    pages = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("tests/**/README.md")]
    text = "\n".join(page.read_text("utf-8") for page in pages)
    assert {words[0] for words in commands_in(text, "ninja-game")} - FIRST_WORDS <= {*COMMANDS, "--version", "--help"}
    known = set(re.findall(r"^  ([\w-]+)  +\S", dev.__doc__ or "", re.MULTILINE))
    named = commands_in(text, "python3 tools/dev.py")
    assert {"play", "test"} <= {words[0] for words in named} <= {*known, "COMMAND"}
    tools = {words[1] for words in named if words[0] == "tool"} - {"NAME"}
    assert not [name for name in tools if not (ROOT / "tools" / f"{name.replace('.', '/')}.py").is_file()]


def test_what_tests_and_tools_share_imports_neither() -> None:
    support = [path.read_text("utf-8") for path in (ROOT / "tests" / "support").glob("*.py")]
    assert support
    assert not [text for text in support if re.search(r"^\s*(from|import) tools\b", text, re.MULTILINE)]
    assert not [text for text in support if re.search(r"^\s*from tests\.(?!support)", text, re.MULTILINE)]
    tools = [path.read_text("utf-8") for path in (ROOT / "tools").rglob("*.py")]
    assert not [text for text in tools if re.search(r"^\s*from tests\.(?!support)", text, re.MULTILINE)]
    assert not [text for text in tools if "sys.path" in text]


def test_what_tests_import_at_the_top_exists_on_windows() -> None:
    posix = {"fcntl", "grp", "pty", "pwd", "resource", "termios", "tty"}
    imported = [
        (str(path.relative_to(ROOT)), node.names[0].name if isinstance(node, ast.Import) else str(node.module))
        for folder in ("tests", "tools")
        for path in (ROOT / folder).rglob("*.py")
        for node in ast.parse(path.read_text("utf-8")).body
        if isinstance(node, ast.Import | ast.ImportFrom)
    ]
    assert len(imported) > 1000
    assert not [(path, module) for path, module in imported if module in posix], "import it where it is used"


def test_changelog_knows_the_version() -> None:
    changelog = (ROOT / "CHANGELOG.md").read_text("utf-8")
    released = re.findall(r"^## \[(\d+\.\d+(?:\.\d+)?)\]", changelog, re.MULTILINE)
    assert "## [Unreleased]" in changelog
    # Before the first release the version is the one that will be.
    assert not released or released[0] == ninja_game.__version__


def test_version_option_prints_the_version() -> None:
    result = CliRunner().invoke(cli, ["--version"])
    assert result.output == f"ninja-game {ninja_game.__version__}\n"


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_help_with_an_example(name: str) -> None:
    result = CliRunner().invoke(cli, [name, "--help"], prog_name="ninja-game")
    assert result.exit_code == 0
    assert "Example" in result.output
    assert f"ninja-game {name}" in result.output.split("Example")[1]
    assert COMMANDS[name].help in " ".join(result.output.split())


def test_no_files_import_one_another_in_a_circle() -> None:
    for package in ("ninja_game", "tools"):
        graph = grimp.build_graph(package, cache_dir=None)
        # Raises CycleError, which names the files; imports within functions and for types count too.
        TopologicalSorter({name: graph.find_modules_directly_imported_by(name) for name in graph.modules}).prepare()


def test_the_drawing_of_the_architecture_has_the_floors_of_the_import_contract() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    drawing, text = page.partition("```text\n")[2].split("```\n", 1)
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"]
    layers = next(contract["layers"] for contract in contracts if contract["id"] == "layers")
    floors = [line[20:] for line in drawing.splitlines()]
    assert floors == layers
    assert not [name for floor in floors for name in floor.split(" | ") if f"`{name}`" not in text]


ELSEWHERE = 8  # lines that a skip saves outside of a table of data, at least


def table_ends(tree: ast.Module) -> set[int | None]:
    """The last lines of tables of data: of displays and of assignments of modules."""
    displays = {
        node.end_lineno for node in ast.walk(tree) if isinstance(node, ast.Dict | ast.List | ast.Set | ast.Tuple)
    }
    return displays | {node.end_lineno for node in tree.body if isinstance(node, ast.Assign | ast.AnnAssign)}


def test_the_formatter_is_skipped_only_where_that_saves_lines(tmp_path: Path) -> None:
    skip, before = "  # fmt: skip", {}
    for file in (file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*.py"))):
        lines = file.read_text("utf-8").splitlines()
        tables = (
            table_ends(ast.parse("\n".join(lines))) if ROOT / "ninja_game" in file.parents else range(len(lines) + 1)
        )
        for number in (number for number, line in enumerate(lines) if line.endswith(skip)):
            name = f"{file.relative_to(ROOT)} line {number + 1}".replace("/", ".")
            changed = [*lines[:number], lines[number].removesuffix(skip), *lines[number + 1 :]]
            (tmp_path / f"{name}.py").write_text("\n".join(changed), "utf-8")
            before[name] = len(lines) + (0 if number + 1 in tables else ELSEWHERE - 1)
    config = ROOT / "pyproject.toml"
    subprocess.run([sys.executable, "-m", "ruff", "format", "-q", "--config", config, tmp_path], check=True)
    assert before
    assert not [
        name for name, count in before.items() if (tmp_path / f"{name}.py").read_text("utf-8").count("\n") <= count
    ]


def hides_a_decision(node: ast.AST) -> bool:
    """Whether an expression has a decision where a reader does not look for one."""
    if isinstance(node, ast.IfExp):
        last = node.orelse
        parts = [node.test, node.body]
        parts += [last.test, last.body, last.orelse] if isinstance(last, ast.IfExp) else [last]
        return any(isinstance(inner, ast.IfExp) for part in parts for inner in ast.walk(part))
    if isinstance(node, ast.FormattedValue):
        return any(isinstance(inner, ast.JoinedStr) for inner in ast.walk(node.value))
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult):
        texts = [isinstance(side, ast.JoinedStr | ast.List) or is_text(side) for side in (node.left, node.right)]
        return any(texts) and any(map(is_truth, (node.left, node.right)))
    return False


def is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str | bytes)


def is_truth(node: ast.expr) -> bool:
    called = node.func.id if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) else ""
    return isinstance(node, ast.Compare | ast.BoolOp) or called == "bool"


@pytest.mark.parametrize("code", ["f'{a + f\"{b}\"}'", '"s" * (n > 1)', "[a] * bool(b)", "(a if b else c) if d else e"])
def test_a_hidden_decision_is_seen(code: str) -> None:
    assert any(map(hides_a_decision, ast.walk(ast.parse(code))))


def test_expressions_hide_no_decisions() -> None:
    """No f-string in an f-string, no text times a truth value, no conditional in another but as its ``else``, once."""
    hidden = [
        f"{path.relative_to(ROOT)}:{node.lineno}"
        for path in (ROOT / "ninja_game").rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.expr) and hides_a_decision(node)
    ]
    assert not hidden
