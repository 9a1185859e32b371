"""A process killed at any moment loses nothing that it has called saved (`tools/soak/kills.py` does more of this)."""

import sys
from pathlib import Path
from random import Random
from unittest.mock import Mock, patch

import pytest

from tools.soak.kills import Drawing, Track, digest_of_track, kill_test, opened_run, say_and_save


@pytest.mark.slow
@pytest.mark.parametrize("what, kills, least", [("records", 10, 1), ("tas", 30, 100), ("editor", 2, 1)])
def test_killed_processes_lose_nothing(
    what: str, kills: int, least: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if what == "editor" and sys.platform == "win32":
        pytest.skip("children are forked")
    # Two seconds are the promise; tests run on machines that are busy with others.
    monkeypatch.setattr(Drawing, "most", 8.0)
    count, wrong = kill_test(kills, 7, tmp_path, what=what)
    assert not wrong
    assert count > least


def test_the_trial_sees_what_is_lost(tmp_path: Path) -> None:
    edits = [("edited", "a", 10**9), ("edited", "b", 3 * 10**9)]
    assert list(Drawing(tmp_path).losses(tmp_path, edits, 6 * 10**9)) == ["5.00 s lost"]


@pytest.mark.parametrize(
    "noted, edits, wrong",
    [
        ("ABCBA", "ABCB", []),  # killed before the last undo was reported
        ("A", "ABCD", ["3 edits lost"]),
        ("ABC", "ABCD", []),
        ("AE", "ABCD", ["3 edits lost"]),  # what was not said is no excuse
    ],
)
def test_an_undo_that_was_not_said_loses_nothing(noted: str, edits: str, wrong: list[str], tmp_path: Path) -> None:
    state = Track(tmp_path / "home")
    session = opened_run(tmp_path / "home")
    tracks = {name: session.track.named(number, name) for number, name in enumerate("ABCDE")}
    for name in noted:
        session.change(tracks[name])
    session.close(keep=True)
    facts = [("edited", digest_of_track(tracks[name]), 0) for name in edits]
    assert list(state.losses(tmp_path / "home", facts)) == wrong
    assert state.last == digest_of_track(tracks[noted[-1]])
    assert list(state.losses(tmp_path / "home", [])) == [], "it is as it was found"


def test_what_is_behind_the_exit_is_not_expected_in_the_saved_file(tmp_path: Path) -> None:
    state, pipe, rng = Track(tmp_path / "home"), Mock(), Random()
    session = opened_run(tmp_path / "home")
    session.change(session.track.replaced(len(session.track), len(session.track), [0] * 40 + [1]))
    assert session.tail_behind() == "exit"
    with patch.object(rng, "random", lambda: 0.0):
        say_and_save(session, rng, pipe)
    session.close(keep=True)
    facts = [call.args[0] for call in pipe.send.call_args_list]
    assert list(state.losses(tmp_path / "home", facts)) == []
