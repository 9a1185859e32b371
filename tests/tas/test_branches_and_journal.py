"""Branches and journals: trees, JSON, and what is left of a session that was killed at any byte."""

import json
import os
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import pytest
from hypothesis import example, given, settings, strategies as st

from ninja_game.errors import DAMAGED, FileError
from ninja_game.files.locking import remove_abandoned
from ninja_game.formats.load import load_replays
from ninja_game.sim.inputs import with_press_bits
from ninja_game.tas.contributions import Contributions
from ninja_game.tas.files import open_run, save_run
from ninja_game.tas.journal import JOURNAL_FOLDER, BesideRun, Journal, lost_runs, read_journal
from ninja_game.tas.session import OPENED, TICKS_PER_FRAME_PLAIN, TasSession
from ninja_game.tas.tracks import Branch, Branches, InputTrack, branches_of_json
from tests.support.samples import WALK_END, replay_of_walk
from tests.support.strategies import tracks
from tests.support.tas_edits import edit_at_random

branches_of_any_kind = st.builds(Branch, st.text(max_size=5), tracks(), st.none(), st.integers(-1, 99), st.just("dead"))


@given(
    st.lists(st.tuples(st.sampled_from(["keep", "keep", "drop", "checkout", "rename"]), branches_of_any_kind)),
    st.data(),
)
def test_branches_are_a_tree_whatever_is_done(steps: list[tuple[str, Branch]], data: st.DataObject) -> None:
    branches = Branches()
    reported = Branches()
    for what, branch in steps:
        number = data.draw(st.integers(0, max(0, len(branches) - 1)))
        if what == "keep":
            kept = branches.keep(branch)
            assert (branches.current, branches.all[kept].track) == (kept, branch.track)
            reported.do({"keep": json.loads(json.dumps(branches.as_json()["branches"][kept]))})
        elif not branches.all:
            continue
        elif what == "drop":
            parents = [each.parent for each in branches.all]
            names = {at: id(each.track) for at, each in enumerate(branches.all)}
            branches.drop(number)
            reported.do({"drop": number})
            for at, each in enumerate(branches.all):
                parent = parents[at + (at >= number)]
                parent = parents[number] if parent == number else parent
                assert (each.parent is None) == (parent is None)
                if parent is not None and each.parent is not None:
                    assert id(branches.all[each.parent].track) == names[parent]
        elif what == "checkout":
            assert branches.checkout(number) == branches.all[number].track
            reported.do({"checkout": number})
        else:
            branches.rename(number, branch.name)
            reported.do({"rename": number, "name": branch.name})
    seen = list(branches.in_tree())
    assert sorted(number for number, _ in seen) == list(range(len(branches)))
    depths = dict(seen)
    for number, branch in enumerate(branches.all):
        assert depths[number] == (0 if branch.parent is None else depths[branch.parent] + 1)
    again = branches_of_json(json.loads(json.dumps(branches.as_json())))
    assert (again.all, again.current) == (branches.all, branches.current) == (reported.all, reported.current)


def test_a_long_line_of_branches_is_shown() -> None:
    branches = Branches()
    for _ in range(3000):
        branches.keep(Branch("a", InputTrack(b"")))
    assert list(branches.in_tree())[-1] == (2999, 2999)


def damaged(text: str, rng: Random) -> str:
    """A text with a few characters changed, or cut."""
    for _ in range(rng.choice((1, 1, 3))):
        at = rng.randrange(len(text) + 1)
        new = rng.choice(("", "}", '"', ",", "1e999", "null", "[" * 3000, "-1", "9" * 5000, "\ud800", "x", "\n", "{}"))
        text = text[:at] + new + text[at + rng.choice((0, 1, 5, 200)) :]
    return text


def test_damaged_branches_are_reported() -> None:
    branches = Branches()
    branches.keep(Branch("one", InputTrack(b"\1\2").named(1, "a")))
    branches.keep(Branch("two", InputTrack(b"\1\2\3")))
    text = json.dumps(branches.as_json())
    rng = Random(2)
    refused = accepted = 0
    for _ in range(4000):
        try:
            branches = branches_of_json(json.loads(damaged(text, rng)))
        except DAMAGED:
            refused += 1
            continue
        assert len(list(branches.in_tree())) == len(branches.all)
        assert branches_of_json(branches.as_json()).as_json() == branches.as_json()
        accepted += 1
    assert refused > 0
    assert accepted > 0


@pytest.fixture(name="session")
def session_of_a_file(tmp_path: Path) -> TasSession:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    return TasSession(open_run(path), tmp_path, memory="plain")


def journal_of(folder: Path) -> Path:
    (file,) = (folder / JOURNAL_FOLDER).glob("*.jsonl")
    return file


def test_a_kill_at_any_byte_loses_at_most_the_last_edit(session: TasSession, tmp_path: Path) -> None:
    rng = Random(3)
    assert session.ticks_per_frame == TICKS_PER_FRAME_PLAIN
    states = [(session.track, list(session.branches.all))]
    sizes = []
    session.change(session.track.replaced(0, 0, [1]))
    file = journal_of(tmp_path)
    for _ in range(60):
        states.append((session.track, list(session.branches.all)))
        sizes.append(file.stat().st_size)
        edit_at_random(session, rng, strokes=False)
    whole = file.read_bytes()
    session.close(keep=True)
    begun = whole.index(b"\n")
    ends = [size + by for size in sizes for by in (-1, 0, 1)]
    for size in sorted({*range(begun, sizes[-1], 17), *ends}):
        file.write_bytes(whole[:size])
        found = read_journal(file)
        done = sum(each <= size for each in sizes)
        tracks = (found.opened.track, *found.tracks)
        track, branches = states[done]
        opened = done or not found.branches.all  # the run as it was opened is kept just before the first edit
        assert (tracks[-1], found.branches.all if opened else []) == (track, branches), size
        # What is written afterwards is read again, whatever was cut.
        journal = Journal(tmp_path, found.head, file)
        assert journal.note({"drop": 99})
        journal.close(keep=True)
        assert read_journal(file).tracks == found.tracks


def test_damaged_journals_give_only_edits_that_there_were(session: TasSession, tmp_path: Path) -> None:
    rng = Random(4)
    there = {session.track}
    for _ in range(25):
        edit_at_random(session, rng, strokes=False)
        there.add(session.track)
    session.close(keep=True)
    file = journal_of(tmp_path)
    whole = file.read_bytes().decode()
    for _ in range(500):
        file.write_bytes(damaged(whole, rng).encode("utf-8", "surrogatepass"))
        begin = file.read_bytes().split(b"\n")[0] == whole.encode().split(b"\n")[0]
        for found in lost_runs(tmp_path):
            if begin:
                assert {found.opened.track, *found.tracks} <= there
            TasSession(found.opened, tmp_path, memory="plain").close()


def test_a_run_goes_on_where_a_killed_session_was(session: TasSession, tmp_path: Path) -> None:
    session.begin()
    session.change(session.track.replaced(2, 3, [5]))
    session.redo()  # there is nothing, and the stroke ends
    session.change(session.track.replaced(5, 6, [1]))
    session.keep_branch("one")
    session.begin()
    for tick in range(5):
        session.change(session.track.replaced(tick, tick + 1, [4]))
    assert list(lost_runs(tmp_path)) == [], "it is running"
    stroke = session.track
    session.journal.close(keep=True)
    (found,) = lost_runs(tmp_path)
    assert found.tracks[-1] == stroke, "also in the middle of a stroke"
    assert len(found.tracks) == 3
    again = TasSession(found.opened, tmp_path, memory="plain")
    again.recover(found)
    assert again.file.path == tmp_path / "walk.replay.txt"
    assert (again.track, [each.name for each in again.branches.all]) == (stroke, [OPENED, "one"])
    assert not again.is_saved
    assert list(lost_runs(tmp_path)) == [], "it is gone on with"
    with pytest.raises(FileError, match="another window"):
        TasSession(found.opened, tmp_path, memory="plain").recover(found)
    again.change(again.track.replaced(9, 10, [7]))
    last = again.track
    again.journal.close(keep=True)
    (found,) = lost_runs(tmp_path)
    assert found.tracks[-1] == last
    third = TasSession(found.opened, tmp_path, memory="plain")
    third.recover(found)
    assert third.undo()
    assert third.track == stroke
    third.save(tmp_path / "walk.replay.txt")
    assert load_replays(tmp_path / "walk.replay.txt")[0].replay.playback(9)[:5] == with_press_bits([4] * 5)
    assert list((tmp_path / JOURNAL_FOLDER).iterdir()) == []


def test_the_run_as_it_was_opened_is_a_branch_from_the_first_edit_on(session: TasSession, tmp_path: Path) -> None:
    opened = session.track
    session.change(opened.named(2, "here"))
    assert not session.branches.all, "no key has changed"
    session.undo()
    session.begin()
    for tick in range(3):
        session.change(session.track.replaced(tick, tick + 1, [4]))
    session.end()
    (kept,) = session.branches.all
    assert (kept.name, kept.track, kept.outcome, kept.end) == (OPENED, opened, "exit", WALK_END)
    session.undo()
    assert session.is_saved, "nothing of the player's is to be saved"
    session.change(opened.replaced(0, 1, [4]))
    assert session.branches.all == [kept], "it is there already"
    session.save(tmp_path / "walk.replay.txt")
    assert open_run(tmp_path / "walk.replay.txt").branches.all == [kept], "also in the saved file"


def test_runs_beside_are_there_again_after_a_crash(session: TasSession, tmp_path: Path) -> None:
    first, second = (BesideRun(name, session.track.replaced(0, 1, [4]), Contributions(names=(name,))) for name in "ab")
    session.show_beside(first)
    assert not (tmp_path / JOURNAL_FOLDER).exists(), "nothing was edited yet"
    session.change(session.track.replaced(2, 3, [5]))
    session.show_beside(second)
    session.journal.close(keep=True)
    (found,) = lost_runs(tmp_path)
    assert found.beside == (first, second)
    again = TasSession(found.opened, tmp_path, memory="plain")
    again.recover(found)
    assert again.beside == [first, second]
    again.save(tmp_path / "walk.replay.txt")
    again.change(again.track.replaced(2, 3, [1]))
    again.journal.close(keep=True)
    assert next(lost_runs(tmp_path)).beside == (first, second)


def test_nobody_discards_what_another_window_goes_on_with(session: TasSession, tmp_path: Path) -> None:
    session.change(session.track.replaced(0, 1, [1]))
    session.journal.close(keep=True)
    (found,) = lost_runs(tmp_path)
    other = TasSession(found.opened, tmp_path, memory="plain")
    other.recover(found)
    assert not remove_abandoned(found.file)
    other.change(other.track.replaced(3, 4, [1]))
    other.journal.close(keep=True)
    assert [each.tracks[-1] for each in lost_runs(tmp_path)] == [other.track]


def test_what_cannot_be_written_is_reported_and_comes_later(
    session: TasSession, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    session.change(session.track.replaced(0, 1, [1]))
    write = os.write
    monkeypatch.setattr(os, "write", lambda handle, data: write(handle, data[: len(data) // 2]))
    session.keep_branch("lost?")
    session.change(session.track.replaced(1, 2, [1]))
    assert "the disk is full" in session.journal.problem
    monkeypatch.setattr(os, "write", write)
    session.rename_branch(0, "kept")
    session.change(session.track.replaced(2, 3, [1]))
    assert session.journal.problem == ""
    session.journal.close(keep=True)
    (found,) = lost_runs(tmp_path)
    assert found.tracks[-1] == session.track
    assert found.branches.all == session.branches.all


def test_a_run_beside_does_not_lose_edits_that_are_yet_to_be_written(session: TasSession, tmp_path: Path) -> None:
    (tmp_path / JOURNAL_FOLDER).write_text("in the way")
    session.change(session.track.replaced(0, 1, [1, 1]))
    session.show_beside(BesideRun("Cy", session.track, Contributions()))
    (tmp_path / JOURNAL_FOLDER).unlink()
    session.change(session.track.replaced(1, 2, [4]))
    session.journal.close(keep=True)
    (found,) = lost_runs(tmp_path)
    assert (found.tracks[-1:], [run.name for run in found.beside]) == ((session.track,), ["Cy"])


def test_a_place_without_files_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    (tmp_path / JOURNAL_FOLDER).write_text("in the way")
    session = TasSession(open_run(path), tmp_path, memory="plain")
    session.change(session.track.replaced(0, 1, [1]))
    assert "cannot be kept safe" in session.journal.problem


@settings(max_examples=30)
@given(st.integers(0, 10**6))
def test_undo_and_redo_bring_back_every_edit(seed: int) -> None:
    rng = Random(seed)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "walk.replay.txt"
        path.write_text(replay_of_walk(), "utf-8")
        session = TasSession(open_run(path), Path(folder), memory="plain")
        tracks = [session.track]
        for _ in range(20):
            session.change(session.track.replaced(rng.randrange(30), 30, [rng.randrange(8)]))
            if session.track != tracks[-1]:
                tracks.append(session.track)
        last = tracks[-1]
        while session.undo():
            tracks.pop()
            assert session.track == tracks[-1]
        assert len(tracks) == 1
        while session.redo():
            pass
        assert session.track == last
        session.close()


@settings(max_examples=30, deadline=None)
@given(
    st.lists(
        st.tuples(st.sampled_from(["whole", "edit", "undo", "redo", "keep", "drop", "checkout"]), st.integers(0, 9))
    )
)
@example([("edit", 0), ("keep", 0), ("whole", 0), ("undo", 0), ("drop", 1), ("drop", 0), ("edit", 1)])
def test_branches_stay_a_tree_whatever_is_edited_between(steps: list[tuple[str, int]]) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "walk.replay.txt"
        path.write_text(replay_of_walk(), "utf-8")
        session = TasSession(open_run(path), Path(folder), memory="plain")
        whole = session.track
        session.change(whole.replaced(0, len(whole), []))
        for step, number in steps:
            at = number % max(1, len(session.branches))
            if step == "whole":
                session.change(whole)
            elif step == "edit":
                session.change(session.track.replaced(number, number, [2]))
            elif step in ("undo", "redo"):
                getattr(session, step)()
            elif step == "keep":
                session.keep_branch(str(number))
            elif session.branches.all and step == "drop":
                session.drop_branch(at)
            elif session.branches.all:
                session.checkout_branch(at)
        session.end()
        assert branches_of_json(json.loads(json.dumps(session.branches.as_json()))).all == session.branches.all
        session.close()


def test_a_kill_between_the_file_and_its_journal_loses_nothing(session: TasSession, tmp_path: Path) -> None:
    first = session.track
    session.change(session.track.replaced(0, 24, []))
    session.change(InputTrack(b"\1"))
    path = session.file.path
    assert path is not None
    session.journal.close(keep=True)
    save_run(session.origin, session.track, session.branches, path, session.file)
    (found,) = lost_runs(tmp_path)
    again = TasSession(found.opened, tmp_path, memory="plain")
    again.recover(found)
    again.undo()
    again.undo()
    assert (again.track, again.is_saved) == (first, False)
    again.save(path, replacing=True)
    assert again.is_saved
    assert open_run(path).track == first


def test_edits_of_an_empty_run_are_found_again(session: TasSession, tmp_path: Path) -> None:
    session.change(InputTrack(b""))
    session.journal.begin_again(session._opened())
    session.change(InputTrack(b"\1"))
    session.journal.close(keep=True)
    (found,) = lost_runs(tmp_path)
    assert (found.opened.track, found.tracks) == (InputTrack(b""), (InputTrack(b"\1"),))


def test_watched_formulas_alone_are_something_to_save(session: TasSession, tmp_path: Path) -> None:
    before = session.is_saved
    session.watch(["x", "vy > 0"])
    assert (before, session.is_saved) == (True, False)
    session.close(keep=True)
    (found,) = lost_runs(tmp_path)
    assert found.branches.watched == ("x", "vy > 0")
