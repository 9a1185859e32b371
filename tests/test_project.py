"""The project keeps its own promises: commands in documents exist, versions agree."""

import re
import shlex
import tomllib
from pathlib import Path

import pytest
from click.testing import CliRunner

import ninja_game
from ninja_game.cli.commands import COMMANDS
from ninja_game.cli.main import cli
from tools import dev

ROOT = Path(__file__).resolve().parent.parent
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


def test_the_drawing_of_the_architecture_has_the_floors_of_the_import_contract() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    drawing, text = page.partition("```text\n")[2].split("```\n", 1)
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["importlinter"]["contracts"]
    layers = next(contract["layers"] for contract in contracts if contract["id"] == "layers")
    floors = [line[20:] for line in drawing.splitlines()]
    assert floors == layers
    assert not [name for floor in floors for name in floor.split(" | ") if f"`{name}`" not in text]


def test_the_architecture_says_where_the_tests_are_of_what_has_no_folder_of_tests() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    (row,) = re.findall(r"^\| `tests` \|.*", page, re.MULTILINE)
    tested = {room.name for room in (ROOT / "tests").iterdir()}
    rooms = {path.parent.name for path in (ROOT / "ninja_game").glob("*/__init__.py")}
    assert rooms - tested == {*re.findall(r"`(\w+)`", row)} - {"tests"}
    assert all((ROOT / folder).is_dir() for folder in re.findall(r"`(tests/\w+)`", row))
