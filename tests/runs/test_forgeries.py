"""What `verify --strict` must not believe: forged recordings, each with the field or the words that tell."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner

from ninja_game import parse_level
from ninja_game.cli.main import cli
from ninja_game.formats.load import NamedLevel, load_levels
from ninja_game.formats.n14.level_file import LevelRecord
from ninja_game.formats.recording import demo_recording
from ninja_game.runs.archive import verify_all
from ninja_game.runs.chunks import Result
from ninja_game.runs.recording_reader import Unreadable
from ninja_game.runs.verify import verify_recording
from ninja_game.sim.rules import LIFETIME
from tests.support.forgeries import (
    BELL,
    EASY,
    FORGERIES,
    GOLD_LATER,
    JUMP,
    LAST_START,
    RIGHT,
    TRIGGER,
    WALKING,
    record,
    replay,
)
from tests.support.reference import recordings
from tests.support.samples import SPIKED, WALK, replay_of_walk


@pytest.fixture
def counting(tmp_path: Path) -> list[NamedLevel]:
    """The levels that count; an easier one lies beside them."""
    (tmp_path / "easy.txt").write_text(EASY + "\n")
    (tmp_path / "levels").mkdir()
    (tmp_path / "levels" / "count.txt").write_text(f"{WALK}\n{SPIKED}\n{GOLD_LATER}\n")
    return load_levels(tmp_path / "levels")


def strict(text: str, folder: Path, levels: list[NamedLevel]) -> list[Result]:
    """What a strict verification says of a text in a file."""
    path = folder / "forged.txt"
    path.write_text(text, "utf-8")
    return list(verify_all([path], memory="plain", jobs=1, processes=False, levels=levels, strict=True))


def reasons(results: list[Result]) -> Iterator[str]:
    """What is wrong, in words; nothing for a result that is believed."""
    for result in results:
        yield from [result.message] if isinstance(result, Unreadable) else map(str, result.problems)


def test_there_are_sixty_forgeries() -> None:
    assert len(FORGERIES) >= 60


@pytest.mark.parametrize("text, field", FORGERIES.values(), ids=list(FORGERIES))
def test_a_forgery_is_refused_and_its_field_told(
    text: str, field: str, tmp_path: Path, counting: list[NamedLevel]
) -> None:
    results = strict(text, tmp_path, counting)
    assert len(results) == 1
    assert any(field in words for words in reasons(results)), results


@pytest.mark.parametrize(
    "text",
    [
        record(),
        record(bytes([RIGHT] * 40)),
        record(bytes([JUMP + TRIGGER] + [0] * 90) + WALKING),
        record(bytes(LAST_START) + WALKING),
        record(bytes(LIFETIME - 30) + WALKING, GOLD_LATER),
        replay(),
        replay_of_walk(digest=""),
        replay(bytes([3] * 5) + WALKING + b"\2"),
    ],
    ids=[
        "a record",
        "some ticks more",
        "a jump",
        "the exit in the last tick",
        "gold in the last ticks",
        "a replay",
        "no digest",
        "two keys at once",
    ],
)
def test_an_honest_run_is_believed(text: str, tmp_path: Path, counting: list[NamedLevel]) -> None:
    assert list(reasons(strict(text, tmp_path, counting))) == []


def test_without_level_the_games_own_levels_count(tmp_path: Path) -> None:
    from ninja_game.files.bundled import bundled_replays

    results = list(verify_all(bundled_replays(), memory="plain", jobs=1, processes=False, strict=True))
    assert list(reasons(results)) == []
    assert all(result.level_name for result in results if not isinstance(result, Unreadable))
    (refused,) = strict(record(), tmp_path, [])
    assert "level_digest" in " ".join(reasons([refused]))


def test_one_level_is_also_that_of_recordings_without(tmp_path: Path, counting: list[NamedLevel]) -> None:
    results = strict(record(level=""), tmp_path, counting[:1])
    assert list(reasons(results)) == []


def test_a_run_on_another_level_fails_without_strict_too(tmp_path: Path) -> None:
    (tmp_path / "walk.txt").write_text(WALK)
    (tmp_path / "forged.txt").write_text(record(b"\2\2", EASY))
    words = ["verify", str(tmp_path / "forged.txt"), "--level", str(tmp_path / "walk.txt"), "--json"]
    result = CliRunner().invoke(cli, words)
    assert result.exit_code == 1
    assert json.loads(result.stdout)["problems"][0].startswith("not run: its level is not one of those that count")


def test_names_forge_no_rows_and_command_no_terminal(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(replay(WALKING[:-3], name=BELL))
    result = CliRunner().invoke(cli, ["verify", str(tmp_path), "--report", str(tmp_path / "report")], color=True)
    report = (tmp_path / "report").read_text()
    assert "\x1b[2J" not in result.stdout + report
    assert len(report.splitlines()) == 2
    assert "\\x1b[2J" in report


def test_a_truncated_demo_is_called_so(tmp_path: Path) -> None:
    (tmp_path / "cut.txt").write_text(record(demo="23:35791394"))
    result = CliRunner().invoke(cli, ["verify", str(tmp_path / "cut.txt")])
    assert "does not reach the exit: the demo is truncated, it holds 7 of its 23 ticks" in result.stdout
    assert "FAIL running    24 ticks    1 gold" in result.stdout


def test_runs_at_a_keyboard_are_possible_by_keyboard() -> None:
    """The published recordings of people; of those made with tools nineteen are not."""
    impossible = dict.fromkeys(("rta", "tas", "mbd"), 0)
    for row in recordings():
        recording = demo_recording(LevelRecord(row.label, "", "", row.data, row.demo), "", parse_level(row.data))
        verdict = verify_recording(recording)
        assert verdict.in_time
        impossible[row.source] += not verdict.possible_by_keyboard
    assert impossible["rta"] == 0
    assert sum(impossible.values()) == 19
