"""The game in a menu of programs: what is written, and what systems make of it."""

import io
import os
import shutil
import subprocess
import sys
from configparser import RawConfigParser
from pathlib import Path

import pygame
import pytest
from click.testing import CliRunner

from ninja_game.cli.machine import desktop_files, program_words
from ninja_game.cli.main import cli

LEVEL_TYPE, REPLAY_TYPE = "text/x-ninja-game-level", "text/x-ninja-game-replay"


@pytest.fixture
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the user's data, on a system that has such menus."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setattr(sys, "platform", "linux")
    return tmp_path / "data"


def test_what_is_put_in_is_taken_out_again(data: Path) -> None:
    assert CliRunner().invoke(cli, ["desktop"]).exit_code == 0
    made = desktop_files(data, program_words())
    assert {path.relative_to(data).parts[0] for path in made} == {"applications", "icons", "mime"}
    assert all(path.is_file() for path in made)
    icon = pygame.image.load(io.BytesIO(next(path for path in made if path.suffix == ".png").read_bytes()))
    assert icon.get_size() == (256, 256)
    assert CliRunner().invoke(cli, ["desktop", "--remove"]).exit_code == 0
    assert not any(path.exists() for path in made)


@pytest.mark.parametrize("file, words", [("ninja-game", "play %f"), ("ninja-game-replay", "play --replay %f")])
def test_a_program_in_any_folder_is_found(file: str, words: str) -> None:
    """Rules of the key Exec: a string's escapes first, then those within quotes."""
    menu = RawConfigParser()
    menu.optionxform = str  # type: ignore[assignment, method-assign]
    menu.read_string(
        str(desktop_files(Path("x"), ['/my $5 "50%" \\ games/run'])[Path(f"x/applications/{file}.desktop")])
    )
    entry = menu["Desktop Entry"]
    assert entry["Exec"].replace("\\\\", "\\") == f'"/my \\$5 \\"50%%\\" \\\\ games/run" {words}'
    assert entry["MimeType"] == f"{REPLAY_TYPE if 'replay' in file else LEVEL_TYPE};"


@pytest.mark.skipif(
    not all(map(shutil.which, ("update-mime-database", "gio"))), reason="needs shared-mime-info and gio"
)
@pytest.mark.parametrize(
    "name, kind",
    [("a.level", LEVEL_TYPE), ("a.nlevel", LEVEL_TYPE), ("a.replay.txt", REPLAY_TYPE), ("plain.txt", "text/plain")],
)
def test_a_system_knows_levels_and_replays(name: str, kind: str, data: Path, tmp_path: Path) -> None:
    assert CliRunner().invoke(cli, ["desktop"]).exit_code == 0
    (tmp_path / name).write_text("text", "utf-8")
    words = ["gio", "info", "-a", "standard::content-type", str(tmp_path / name)]
    output = subprocess.run(words, capture_output=True, text=True, check=True, env=dict(os.environ))
    assert output.stdout.split()[-1] == kind


def test_where_there_is_no_such_menu_it_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "darwin")
    result = CliRunner().invoke(cli, ["desktop"])
    assert result.exit_code == 2
    assert "this system's menu of programs is not known here" in result.stderr
