"""docs/making-levels.md: what it tells to do is done here, from an empty folder to a shared pack."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.formats.pack.index import parse_index
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.pack.pars import MARGINS
from ninja_game.play.main import first_screen

DOC = (Path(__file__).resolve().parents[2] / "docs" / "making-levels.md").read_text("utf-8")
LEVEL = "00-0-over-the-mine.txt"


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL)


def done(line: str) -> str:
    """Do what a line says; what it printed. Playing only opens what would be played."""
    program, *words = shlex.split(line)
    if program == "python3":
        return subprocess.run([sys.executable, *words], check=True, capture_output=True, text=True).stdout
    assert program == "ninja-game"
    if words[0] == "play":
        command = cli.get_command(click.Context(cli), "play")
        assert command is not None
        path, *options = words[1:]
        command.make_context("play", [path, *options])
        first_screen(path, None, body="circle", practice="--practice" in options)
        return ""
    result = CliRunner().invoke(cli, words, prog_name="ninja-game")
    assert result.exit_code == 0, result.output
    return result.stdout


def test_ten_minutes_lead_from_nothing_to_a_certified_shared_pack(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my-pack").mkdir()
    (tmp_path / "my-pack" / "pack.toml").write_text(blocks("toml")[0])
    (tmp_path / "my-pack" / LEVEL).write_text(blocks("level")[0])
    printed = [
        done(line.replace("--seconds 20", "--seconds 2")) for block in blocks("sh") for line in block.splitlines()
    ]
    assert sum("nothing odd" in text for text in printed) == 2
    for path in ("my-pack", "my-pack.zip"):
        pack = Pack(Path(path))
        assert [len(levels) for levels in pack.episodes.values()] == [1]
        assert pack.certificate(LEVEL, "gold")
        assert pack.pars[LEVEL].gold is not None


def test_example_of_an_index_is_right_and_shows_every_entry() -> None:
    index = parse_index(blocks("toml")[1])
    assert (index.name, index.columns) == ("My pack", ("Easy", "Hard"))
    assert [episode.number for episode in index.episodes] == [0, 10]
    named = set(re.findall(r"^\| `(\w+)`", DOC, re.MULTILINE))
    assert {"name", "author", "columns", "levels"} <= named


def test_margins_of_the_medals_are_those_of_the_game() -> None:
    factors = {
        medal: float(factor) - 1 for medal, factor in re.findall(r"^\| (\w+) \| ([\d.]+) T \|", DOC, re.MULTILINE)
    }
    assert factors == pytest.approx(MARGINS)
