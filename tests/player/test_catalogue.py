"""The game's episodes are made of its levels; what the player drops into a folder is there too."""

from __future__ import annotations

import os
from pathlib import Path

from ninja_game.files.resources import bundled_levels
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.player.catalogue import Catalogue
from tests.support.players import short_level


def test_bundled_episodes_can_be_read_and_name_each_level_once() -> None:
    catalogue = Catalogue()
    assert catalogue.episodes
    assert not catalogue.problems
    listed = [entry.named.file for episode in catalogue.episodes.values() for entry in episode.levels]
    assert len(listed) == len(set(listed))
    assert {entry.named.file for entry in catalogue.singles()} == {str(path) for path in bundled_levels()}


def test_files_in_the_players_folder_are_offered_as_they_come(tmp_path: Path) -> None:
    catalogue = Catalogue(tmp_path)
    assert catalogue.own() == []
    (tmp_path / "mine.txt").write_text(write_level_string(short_level()))
    assert [(entry.title, entry.source) for entry in catalogue.own()] == [("mine", "yours")]


def test_broken_file_is_named_and_the_others_stay(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(write_level_string(short_level()))
    (tmp_path / "b.txt").write_text("ninja-game level 1\nnonsense")
    catalogue = Catalogue(tmp_path)
    assert len(catalogue.own()) == 1
    assert "b.txt" in catalogue.problems[0]


def test_odd_things_in_the_players_folder_are_named_and_stop_nothing(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text(write_level_string(short_level()))
    os.mkfifo(tmp_path / "pipe.txt")
    (tmp_path / "loop").symlink_to(tmp_path)
    (tmp_path / "gone.txt").symlink_to(tmp_path / "nowhere")
    (tmp_path / "folder.txt").mkdir()
    catalogue = Catalogue(tmp_path)
    assert [entry.title for entry in catalogue.own()] == ["mine"]
    assert len(catalogue.problems) == 3
    assert "a pipe, not a file" in catalogue.problems[-1]
    assert Catalogue(tmp_path / "missing").own() == []


def test_unchanged_file_is_read_once_and_a_changed_one_again(tmp_path: Path) -> None:
    file = tmp_path / "mine.txt"
    file.write_text(write_level_string(short_level()))
    (tmp_path / "broken.txt").write_text("ninja-game level 1\nnonsense")
    catalogue = Catalogue(tmp_path)
    first = catalogue.own()
    assert catalogue.own()[0] is first[0]
    assert len(catalogue.problems) == 2
    file.write_text(write_level_string(short_level(1, gold=1)))
    assert catalogue.own()[0].digest != first[0].digest
