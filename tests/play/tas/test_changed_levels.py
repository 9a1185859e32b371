"""A run whose level was changed after the recording is mended on the TAS editor; its file stays as it is."""

from pathlib import Path

import pygame
import pytest

from ninja_game import verify_recording
from ninja_game.errors import ReplayError
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.play.menu_screen import FormPanel, Menu
from ninja_game.sim.inputs import KEY_RIGHT
from ninja_game.tas.files import RunFile, open_run
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records
from tests.support.tas_driver import TasDriver

FARTHER = WALK.replace("160,564", "220,564")  # the same level, its exit farther away


@pytest.fixture
def old(tmp_path: Path) -> Path:
    """A replay whose level's file has changed since."""
    (tmp_path / "hill.txt").write_text(FARTHER, "utf-8")
    digest = level_digest(parse_level_string(WALK))
    path = tmp_path / "walk.replay.txt"
    text = replay_of_walk(level=None, level_path="hill.txt", level_digest=digest, author="A. Maker")
    path.write_text(text, "utf-8")
    return path


def test_the_question_leads_to_the_run_on_the_changed_level_and_to_a_new_recording(old: Path, tmp_path: Path) -> None:
    before = old.read_bytes()
    with pytest.raises(ReplayError, match="`ninja-game tas` opens the run on the changed level"):
        load_replays(old)
    at = TasDriver(tmp_path / "player", old)
    question = at.shown(Menu)
    assert question.title == "walk: this level is not the one that was recorded"
    at.choose("Edit it on this level")
    assert at.editor.track.inputs == bytes([KEY_RIGHT] * (WALK_END + 1))
    assert at.session.timeline.end[1] == "running", "the exit is farther away now"
    at.editor.select(WALK_END, WALK_END + 21)
    at.editor.edit(lambda track: track.with_key(WALK_END, WALK_END + 21, KEY_RIGHT, down=True))
    assert at.session.timeline.end[1] == "exit"
    at.chord("s", pygame.KMOD_LCTRL)
    form = at.shown(FormPanel)
    assert form.texts == ["walk-2"]
    form.texts[0] = "walk"
    at.choose("Save")
    assert at.top().title == "A file named walk.replay.txt already exists"  # type: ignore[attr-defined]
    at.choose("Save under another name")
    at.choose("Save")
    at.close()
    assert old.read_bytes() == before
    (new,) = load_replays(tmp_path / "walk-2.replay.txt")
    assert (new.author, new.level) == ("A. Maker", parse_level_string(FARTHER))
    assert verify_recording(new).good
    assert open_run(tmp_path / "walk-2.replay.txt").file.path is not None


def test_one_who_does_not_want_that_leaves(old: Path, tmp_path: Path) -> None:
    at = TasDriver(tmp_path / "player", old)
    at.choose("Leave")
    assert not at.app.running
    at.close()


def test_any_recording_opens_on_a_level_that_is_given(old: Path, tmp_path: Path) -> None:
    was, now = parse_level_string(WALK), parse_level_string(FARTHER)
    demos = write_records(tmp_path / "demos.txt", ("Walk", WALK, running(WALK_END)))
    inside = tmp_path / "inside.replay.txt"
    inside.write_text(replay_of_walk(), "utf-8")
    for path in (old, demos, inside):
        opened = open_run(path, level=now)
        assert (opened.moved, opened.file, opened.recording.level) == (True, RunFile(), now)
        assert opened.recording.replay is not None
        assert opened.recording.replay.unclaimed
    for path in (demos, inside):
        assert open_run(path, level=was).recording == open_run(path).recording
    again = open_run(old, level=was).recording
    assert (again.level, again.replay and again.replay.unclaimed) == (was, True), "the level as it was, from elsewhere"
