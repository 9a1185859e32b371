"""docs/command-line.md: every line of it is a command that exists; those that only read are run."""

import re
import shlex
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from ninja_game.cli.commands import COMMANDS
from ninja_game.cli.main import cli

ROOT = Path(__file__).resolve().parent.parent.parent
DOC = (ROOT / "docs" / "command-line.md").read_text(encoding="utf-8")
LINES = [
    line for block in re.findall(r"^```sh\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL) for line in block.splitlines()
]
READING = ("info", "convert", "verify", "trace", "splits", "compare")


@pytest.mark.parametrize("line", LINES)
def test_a_line_of_the_page_is_right(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    program, name, *words = shlex.split(line)
    assert program == "ninja-game"
    if name in READING:
        result = CliRunner().invoke(cli, [name, *words], prog_name="ninja-game")
        assert result.exit_code == 0, result.output
        assert result.stdout
    else:
        command = cli.get_command(click.Context(cli), name)
        assert command is not None
        command.make_context(name, words)


def test_the_page_has_every_command() -> None:
    shown = {shlex.split(line)[1] for line in LINES}
    table = set(re.findall(r"`(\w+)`", "".join(re.findall(r"^\| `.*?\|", DOC, re.MULTILINE))))
    assert shown == set(COMMANDS)
    assert set(COMMANDS) <= table
