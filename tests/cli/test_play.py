"""`ninja-game play`: what the command line hands to the window."""

import re
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pygame
import pytest
from click.testing import CliRunner, Result

from ninja_game.cli import windows
from ninja_game.cli.main import cli
from ninja_game.files.bundled import bundled_levels
from ninja_game.play.lab.screen import FIGURES
from ninja_game.tas_editor.opening import open_tas_editor


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """What a stand-in for the window's main was called with."""
    noted: list[dict[str, Any]] = []

    def main(level_path: str | None, **named: Any) -> int:
        noted.append({"level_path": level_path, **named})
        return 0

    monkeypatch.setitem(sys.modules, "ninja_game.play.main", SimpleNamespace(main=main))
    return noted


def play(*words: str | Path) -> Result:
    """`ninja-game play WORDS…`."""
    return CliRunner().invoke(cli, ["play", *map(str, words)])


def test_without_a_level_the_menu_opens(calls: list[dict[str, Any]]) -> None:
    assert play().exit_code == 0
    assert calls[0]["level_path"] is None
    assert calls[0]["body"] == "circle"
    assert calls[0]["tas_editor"] is open_tas_editor


def test_options_reach_the_window(calls: list[dict[str, Any]], tmp_path: Path) -> None:
    level = tmp_path / "a.txt"
    level.touch()
    assert play(level, "--body", "box", "--frames", "3", "--screenshot", "x.png", "--size", "800x600").exit_code == 0
    call = calls[0]
    assert (call["level_path"], call["body"], call["frames"]) == (str(level), "box", 3)
    assert (call["screenshot"], call["size"]) == ("x.png", (800, 600))


def test_a_record_is_where_play_begins(calls: list[dict[str, Any]]) -> None:
    assert play(bundled_levels()[0], "--record", "17").exit_code == 0
    assert calls[0]["record"] == 17


def test_a_record_that_the_file_lacks_is_an_error() -> None:
    result = play(bundled_levels()[0], "--record", "1")
    assert (result.exit_code, "there is no record 1" in result.stderr) == (2, True)


def test_own_levels_are_known_by_name(calls: list[dict[str, Any]]) -> None:
    first = bundled_levels()[0]
    assert play(first.stem).exit_code == 0
    assert calls[0]["level_path"] == str(first)


@pytest.mark.parametrize(
    "words",
    [("no-such-level",), ("--size", "big"), ("--size", "0x5"), ("--frames", "0"), ("--body", "square"), ("a", "b")],
)
def test_wrong_usage(words: tuple[str, ...], calls: list[dict[str, Any]]) -> None:
    assert play(*words).exit_code == 2
    assert calls == []


def test_no_display_is_an_error_in_words(monkeypatch: pytest.MonkeyPatch) -> None:
    def build_app(**_: Any) -> None:
        raise pygame.error("no available video device")

    monkeypatch.setattr("ninja_game.play.main.build_app", build_app)
    result = play()
    assert result.exit_code == 2
    assert result.stderr == "ninja-game: the window cannot be opened: no available video device\n"


def test_the_lab_is_offered_with_all_its_figures() -> None:
    """The command names them itself, since its help imports no lab."""
    assert tuple(FIGURES) == windows.FIGURE_NAMES
    listed = CliRunner().invoke(cli, ["lab", "--help"]).output.split("Figures:")[1]
    assert re.findall(r"[\w-]+", listed) == list(FIGURES)
