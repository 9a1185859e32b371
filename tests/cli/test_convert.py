"""`ninja-game convert`: there and back gives the same levels."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from ninja_game.cli.main import cli
from ninja_game.formats.load import load_levels
from tests.support.samples import SPIKED, WALK, write_records


def convert(*words: str | Path) -> Result:
    """`ninja-game convert WORDS…`."""
    return CliRunner().invoke(cli, ["convert", *map(str, words)])


def test_string_becomes_ascii_and_comes_back_equal(tmp_path: Path) -> None:
    source, picture, back = tmp_path / "walk.nlevel", tmp_path / "walk.txt", tmp_path / "back.nlevel"
    source.write_text(WALK + "\n")
    assert convert(source, picture).exit_code == 0
    assert load_levels(picture)[0].ascii
    assert convert(picture, back).exit_code == 0
    assert back.read_text() == WALK + "\n"


def test_file_of_many_becomes_a_folder_and_comes_back_equal(tmp_path: Path) -> None:
    source, folder, back = tmp_path / "many.txt", tmp_path / "many", tmp_path / "back.txt"
    write_records(source, ("Walk / run", WALK, ""), ("", SPIKED, ""))
    assert convert(source, folder).exit_code == 0
    assert [path.name for path in sorted(folder.iterdir())] == ["000-walk-run.txt", "001.txt"]
    assert convert(folder, back).exit_code == 0
    assert [level.level for level in load_levels(back)] == [level.level for level in load_levels(source)]
    assert load_levels(back)[0].name == "Walk / run"


def test_terminal_is_a_target(tmp_path: Path) -> None:
    source = write_records(tmp_path / "walk.txt", ("Walk", WALK, ""))
    result = convert(source, "-", "--legend")
    assert result.exit_code == 0
    assert "name: Walk" in result.stdout
    assert "LEGEND" in result.stdout
    assert convert(source, "-", "--to", "string").stdout == WALK + "\n"


@pytest.mark.parametrize("form", ["ascii", "string", "file"])
def test_form_can_be_chosen(form: str, tmp_path: Path) -> None:
    source = write_records(tmp_path / "walk.txt", ("Walk", WALK, ""))
    assert convert(source, tmp_path / "out", "--to", form).exit_code == 0
    assert load_levels(tmp_path / "out")[0].form == form


def test_many_levels_do_not_overwrite_one_file(tmp_path: Path) -> None:
    source = write_records(tmp_path / "many.txt", ("a", WALK, ""), ("b", SPIKED, ""))
    target = tmp_path / "one.txt"
    target.write_text("mine")
    result = convert(source, target)
    assert result.exit_code == 2
    assert result.stderr.startswith(f"ninja-game: {target}: 2 levels do not fit into one file")
    assert target.read_text() == "mine"


@pytest.mark.parametrize("text", ["", "hello\nworld\n", "ninja-game level 1\n|??|\n", "$a#b#"])
def test_unreadable_input_names_the_file(text: str, tmp_path: Path) -> None:
    source = tmp_path / "odd.txt"
    source.write_text(text)
    result = convert(source, tmp_path / "out")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(f"ninja-game: {source}")
    assert not (tmp_path / "out").exists()


def test_missing_input_is_wrong_usage(tmp_path: Path) -> None:
    result = convert(tmp_path / "gone.txt", "-")
    assert result.exit_code == 2
    assert "gone.txt" in result.stderr
