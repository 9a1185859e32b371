"""`ninja-game export`: films of recordings, at the size and speed that were asked for."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from PIL import Image, ImageSequence

from ninja_game.cli.game.export import command
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records


def export(*words: object) -> Result:
    return CliRunner().invoke(command, [str(word) for word in words])


def shown_ms(film: Path) -> int:
    """How long a film of 264 x 200 px lasts."""
    with Image.open(film) as image:
        assert image.size == (264, 200)
        return sum(frame.info["duration"] for frame in ImageSequence.Iterator(image))


@pytest.fixture
def replay(tmp_path: Path) -> Path:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk())
    return path


def test_film_has_the_size_and_the_speed_that_were_asked_for(replay: Path, tmp_path: Path) -> None:
    ms = {}
    for speed in (0.5, 1, 4):
        film = tmp_path / f"{speed}.gif"
        assert export(replay, "-o", film, "--size", "264x200", "--speed", speed).exit_code == 0
        ms[speed] = shown_ms(film)
    ticks = WALK_END + 1 + 40
    assert ms[1] == pytest.approx(25 * ticks, abs=30)
    assert ms[0.5] == pytest.approx(50 * ticks, abs=60)
    assert ms[4] == pytest.approx(25 / 4 * ticks, abs=60)


def test_record_of_a_file_becomes_a_folder_of_pictures(tmp_path: Path) -> None:
    file = write_records(tmp_path / "two.txt", ("one", WALK, running(3)), ("two", WALK, running(5)))
    assert export(file, "--record", 1, "-o", tmp_path / "film", "--size", "132x100").exit_code == 0
    assert len(list((tmp_path / "film").glob("*.png"))) == 5 + 1 + 1 + 40
    found = export(file, "--record", 2)
    assert "no record 2" in str(found.exception)


def test_film_never_replaces_its_replay_and_needs_a_known_form(replay: Path, tmp_path: Path) -> None:
    text = replay.read_text()
    assert export(replay, "-o", replay).exit_code == 2
    assert replay.read_text() == text
    assert ".gif" in str(export(replay, "-o", tmp_path / "film.mp4").exception)
    assert not (tmp_path / "film.mp4").exists()


def test_film_that_cannot_be_written_names_its_place(replay: Path, tmp_path: Path) -> None:
    found = export(replay, "-o", tmp_path / "nowhere" / "film.gif", "--size", "132x100")
    assert "film.gif: the film cannot be written" in str(found.exception)


def test_failed_film_leaves_nothing(replay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from ninja_game.formats.load import load_replays
    from ninja_game.play.replay.export import export_film
    from ninja_game.play.replay.playback import recorded_run

    run = recorded_run(load_replays(replay)[0])
    assert not export_film(run, tmp_path / "film.gif", report=lambda done: done < 20)
    assert not (tmp_path / "film.gif").exists()
