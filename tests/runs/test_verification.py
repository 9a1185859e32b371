"""Verification at scale: the same results whoever computes them; checkpoint logs; workers that die."""

import json
import os
import pickle
import signal
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, replace
from functools import partial
from io import BytesIO
from multiprocessing import active_children
from pathlib import Path
from typing import Any

import pytest

from ninja_game import parse_level
from ninja_game.backend.memories import compiled_available
from ninja_game.errors import FileError, FormatError
from ninja_game.files.reading import IncludedFile, files_below
from ninja_game.formats.n14.level_file import LevelRecord
from ninja_game.formats.named_level import NamedLevel
from ninja_game.runs import archive as archives
from ninja_game.runs.archive import Totals, verify_all, write_report
from ninja_game.runs.chunks import (
    _RECORDS,
    HEADER,
    CheckpointLog,
    Chunk,
    Result,
    VerifyOptions,
    chunks_in,
    result_from_data,
    results_from_text,
    self_contained,
    verify_chunk,
)
from ninja_game.runs.recording_reader import Unreadable, records_of
from ninja_game.runs.verify import Verdict, with_demands
from ninja_game.runs.workers import (
    JOB_SECONDS,
    WORKER_BYTES,
    ClusterError,
    Local,
    WorkerLostError,
    open_workers,
    results_of,
)
from ninja_game.sim.level import Level
from ninja_game.sim.loader import object_table
from tests.support.samples import (
    NO_NINJA,
    SPIKED,
    WALK,
    WALK_END,
    replay_of_walk,
    running,
    unclaimed_text,
    write_records,
)
from tests.support.special_files import needs_special_files

verify_plainly = partial(verify_all, memory="plain", processes=False)
"""In threads: processes of its own would take longer than all that they are to do."""


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    """A folder with everything: good and bad runs, replays of ours, a level, rubbish, a broken record among others."""
    folder = tmp_path / "archive"
    (folder / "b").mkdir(parents=True)
    many = [(f"Run {number}", WALK if number % 3 else SPIKED, running(WALK_END)) for number in range(_RECORDS + 6)]
    write_records(folder / "a.txt", *many)
    write_records(folder / "b" / "none.txt", ("Walk", WALK, running(9)), ("None", NO_NINJA, running(5)))
    (folder / "b" / "level.txt").write_text(WALK)
    (folder / "b" / "walk.replay.txt").write_text(replay_of_walk())
    (folder / "b.replay.txt").write_text(replay_of_walk(gold=7))
    broken = write_records(folder / "c.txt", *many[1:3]).read_text().splitlines()
    (folder / "c.txt").write_text("\n".join([broken[0], "$bad#me#x#" + WALK + "#A\x01\x02#", broken[1]]))
    (folder / "d.txt").write_bytes(b"\0\1\2 nothing of ours")
    (folder / "picture.png").write_bytes(b"not looked at")
    return folder


def expected(archive: Path) -> list[Result]:
    """The results, one worker, nothing fancy."""
    return [result for chunk in chunks_in([archive]) for result in verify_chunk(chunk, VerifyOptions("plain"))]


def test_nothing_stops_the_rest(archive: Path) -> None:
    totals = Totals()
    for result in expected(archive):
        totals.add(result)
    assert totals.recordings == _RECORDS + 6 + 2 + 1 + 1 + 1
    assert totals.unreadable >= 3
    assert totals.outcomes["dead"] == (_RECORDS + 6 + 2) // 3
    messages = [result.message for result in expected(archive) if isinstance(result, Unreadable)]
    assert any("none.txt" in message and "record 1" in message for message in messages)
    assert any("d.txt" in message for message in messages)


@pytest.mark.parametrize("note", [":" * 100_000 + " x", "A" + "1" * 100_000 + "\x01 x", "1" * 100_000])
def test_the_note_of_a_record_is_looked_at_in_no_time(note: str) -> None:
    started = time.process_time()
    assert records_of(f"$a#b#c#{WALK}#{note}#") == []
    assert time.process_time() - started < 1


def test_files_come_in_the_order_of_their_names_as_paths_have_it(archive: Path) -> None:
    found = [file for file in files_below(archive) if isinstance(file, Path)]
    assert found == sorted(found)
    assert len(found) == 7


@pytest.mark.parametrize("jobs, processes", [(1, False), (3, False), (2, None)])
def test_results_do_not_depend_on_the_workers(
    jobs: int, processes: bool | None, archive: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The plain memory runs on processes unless threads are asked for."""
    monkeypatch.setattr(archives, "JOB_WEIGHT", 2)
    results = verify_plainly([archive], jobs=jobs, processes=processes)
    first = next(results)
    assert bool(active_children()) == (processes is None)
    assert [first, *results] == expected(archive)


def test_an_empty_folder_is_said(tmp_path: Path) -> None:
    assert list(verify_plainly([tmp_path])) == [Unreadable(f"{tmp_path}: no recordings here")]


def test_a_text_of_something_else_in_a_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("just some notes\n")
    (result,) = verify_plainly([tmp_path])
    assert isinstance(result, Unreadable)
    assert "notes.txt:1: no recording" in result.message


def test_a_report_holds_all_results_and_their_sums(archive: Path) -> None:
    out = BytesIO()
    results = list(write_report(verify_plainly([archive]), out))
    report = json.loads(out.getvalue())
    assert len(report["results"]) == len(results)
    assert report["summary"]["recordings"] + report["summary"]["unreadable"] == len(results)
    assert report["results"][0]["name"] == "Run 0"


@pytest.mark.parametrize("demo", ["23:35791394|x|35791394", "A\x01\x02", "23;35791394|35791394"])
def test_a_corrupt_demo_in_a_folder_is_named_and_counted(demo: str, tmp_path: Path) -> None:
    (tmp_path / "corrupt.txt").write_text(f"$Walk#me#test#{WALK}#{demo}#\n")
    for path in (tmp_path, tmp_path / "corrupt.txt"):
        (result,) = verify_plainly([path])
        assert isinstance(result, Unreadable)
        assert "corrupt.txt:1: record 0 has no demo" in result.message


def test_free_text_behind_a_level_is_no_corrupt_demo(tmp_path: Path) -> None:
    (tmp_path / "level.txt").write_text(f"$Walk#me#test#{WALK}#\nThe next level is harder: have fun\n")
    assert list(verify_plainly([tmp_path])) == []


@needs_special_files
def test_a_folder_with_pipes_and_loops_is_verified_and_what_was_left_out_is_named(tmp_path: Path) -> None:
    write_records(tmp_path / "a.txt", ("Walk", WALK, running(WALK_END)))
    os.mkfifo(tmp_path / "pipe.txt")
    (tmp_path / "loop").symlink_to(tmp_path)
    results = list(verify_plainly([tmp_path]))
    assert [getattr(result, "outcome", "") for result in results] == ["exit", "", ""]
    messages = [result.message for result in results if isinstance(result, Unreadable)]
    assert ["loop" in messages[0], "pipe.txt: a pipe" in messages[1]] == [True, True]


# --- checkpoint logs ---


def test_a_journal_lets_a_stopped_run_go_on_where_it_was(
    archive: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(archives, "JOB_WEIGHT", 1)
    path = tmp_path / "log"
    stopped = verify_plainly([archive], jobs=1, resume=path)
    for _ in range(_RECORDS + 3):
        next(stopped)
    stopped.close()  # type: ignore[attr-defined]
    with CheckpointLog(path) as log:
        done = len(log)
    assert 1 < done < 8
    ran: list[str] = []

    def spy(chunk: Chunk, *asked: Any) -> list[Result]:
        ran.append(chunk.digest)
        return verify_chunk(chunk, *asked)

    monkeypatch.setattr(archives, "verify_chunk", spy)
    assert list(verify_plainly([archive], jobs=1, resume=path)) == expected(archive)
    assert len(ran) == 8 - done
    ran.clear()
    assert list(verify_plainly([archive], jobs=1, resume=path)) == expected(archive)
    assert not ran


def test_a_line_that_was_not_finished_is_done_again(archive: Path, tmp_path: Path) -> None:
    path = tmp_path / "log"
    list(verify_plainly([archive], resume=path))
    whole = path.read_bytes()
    path.write_bytes(whole[:-9])
    with CheckpointLog(path) as log:
        assert len(log) == 7
    assert list(verify_plainly([archive], resume=path)) == expected(archive)
    assert path.read_bytes() == whole


def test_a_file_that_changed_is_verified_again(tmp_path: Path) -> None:
    path, run = tmp_path / "log", tmp_path / "run.replay.txt"
    run.write_text(replay_of_walk(gold=7))
    (first,) = verify_plainly([run], resume=path)
    run.write_text(replay_of_walk())
    (second,) = verify_plainly([run], resume=path)
    assert [getattr(first, "good", None), getattr(second, "good", None)] == [False, True]


def test_a_level_that_changed_is_verified_again(tmp_path: Path) -> None:
    log, run, level = tmp_path / "log", tmp_path / "run.replay.txt", tmp_path / "level.txt"
    level.write_text(WALK)
    run.write_text(replay_of_walk(level=None, level_path="level.txt"))
    (first,) = verify_plainly([run], resume=log)
    level.write_text(SPIKED)
    (second,) = verify_plainly([run], resume=log)
    assert [getattr(first, "outcome", None), getattr(second, "outcome", None)] == ["exit", "dead"]


def test_size_and_time_of_a_file_prove_nothing(tmp_path: Path) -> None:
    log, run = tmp_path / "log", tmp_path / "run.replay.txt"
    run.write_text(replay_of_walk(gold=1))
    (first,) = verify_plainly([run], resume=log)
    about = run.stat()
    run.write_text(replay_of_walk(gold=7))
    os.utime(run, ns=(about.st_atime_ns, about.st_mtime_ns))
    assert run.stat().st_size == about.st_size
    (second,) = verify_plainly([run], resume=log)
    assert [getattr(first, "good", None), getattr(second, "good", None)] == [True, False]


@pytest.mark.parametrize(
    "text",
    [
        "nonsense\n",
        "one line of somebody's notes, not ended",
        json.dumps(HEADER)[:20] + "...",
        json.dumps(HEADER | {"version": "0"}) + "\n",
        "[1]\n[2]\n",
        json.dumps(HEADER) + "\n[1]\n",
        json.dumps(HEADER) + '\n{"chunk": "x", "results": 3}\n',
        json.dumps(HEADER) + '\n{"chunk": "x", "results": [{"outcome": "exit"}]}\n',
        json.dumps(HEADER) + '\n{"chunk": "x", "results": [{"message": 3}]}\n',
        json.dumps(HEADER) + "\n" + "[" * 100_000 + "\n",
        json.dumps(HEADER) + "\n" + "9" * 5_000 + "\n",
    ],
)
def test_another_file_is_no_checkpoint_log_and_keeps_every_byte(text: str, tmp_path: Path) -> None:
    path = tmp_path / "log"
    path.write_text(text)
    with pytest.raises(FormatError, match="not a checkpoint log that can be resumed"):
        list(verify_plainly([tmp_path / "x.txt"], resume=path))
    assert path.read_text() == text


def test_a_log_whose_first_line_was_not_finished_begins_again(archive: Path, tmp_path: Path) -> None:
    path = tmp_path / "log"
    path.write_text(json.dumps(HEADER)[:20])
    assert list(verify_plainly([archive], resume=path)) == expected(archive)
    assert json.loads(path.read_text().splitlines()[0]) == HEADER


# --- workers ---


def double(number: int) -> int:
    """Twice the number."""
    return 2 * number


def die_once(mark: str, number: int) -> int:
    """Twice the number; number 5 takes its worker with it the first time."""
    if number == 5 and not Path(mark).exists():
        Path(mark).touch()
        time.sleep(0.05)
        os._exit(1)
    return 2 * number


def die(number: int) -> int:
    """Twice the number; number 3 always takes its worker with it."""
    if number == 3:
        os._exit(1)
    return 2 * number


def test_jobs_are_taken_as_they_are_needed() -> None:
    taken: list[int] = []

    def jobs() -> Iterator[int]:
        for number in range(1000):
            taken.append(number)
            yield number

    with open_workers(2) as pool:
        results = results_of(pool, double, jobs())
        assert [next(results) for _ in range(3)] == [(0, 0), (1, 2), (2, 4)]
        assert len(taken) < 20


def test_what_a_dead_process_had_is_done_again_and_counted_once(tmp_path: Path) -> None:
    pool = Local(2, processes=True)
    results = list(results_of(pool, partial(die_once, str(tmp_path / "mark")), range(20)))
    pool.close()
    assert results == [(number, 2 * number) for number in range(20)]
    assert (tmp_path / "mark").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C is another thing there")
def test_ctrl_c_in_a_terminal_is_nothing_to_a_worker_that_starts() -> None:
    pool = Local(1, processes=True)
    future = pool.submit(double, 4)
    for child in active_children():
        assert child.pid
        os.kill(child.pid, signal.SIGINT)
    assert future.result() == 8
    pool.close()


@pytest.mark.slow
def test_a_job_that_kills_every_process_is_named(tmp_path: Path) -> None:
    pool = Local(2, processes=True)
    results = dict(results_of(pool, die, range(6)))
    pool.close()
    assert isinstance(results.pop(3), WorkerLostError)
    assert results == {number: 2 * number for number in (0, 1, 2, 4, 5)}


def test_a_piece_for_another_machine_holds_its_level(tmp_path: Path) -> None:
    (tmp_path / "levels").mkdir()
    level = tmp_path / "levels" / "walk.txt"
    level.write_text(WALK)
    run = tmp_path / "walk.replay.txt"
    run.write_text(replay_of_walk(level=None, level_path="levels/walk.txt"))
    (chunk,) = map(self_contained, chunks_in([run]))
    level.unlink()
    (verdict,) = verify_chunk(chunk, VerifyOptions("plain"))
    assert getattr(verdict, "good", verdict) is True


# --- what a verdict depends on ---


@pytest.mark.parametrize(
    "name, text, part",
    [
        ("a.tas", "Read,part.tas\n", "part.tas"),
        ("b.tas", "Read,part\n", "part.tas"),
        ("c.tas", "Read,other.txt\n", "part.tas"),
        ("d.replay.txt", unclaimed_text(WALK, "include part.tas"), "part.tas"),
        ("e.replay.txt", unclaimed_text(WALK, "include other.txt"), "part.tas"),
    ],
)
def test_a_file_that_was_taken_in_and_changed_is_verified_again(
    name: str, text: str, part: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_text(text)
    (tmp_path / "other.txt").write_text("   1\nRead,part.tas\n")
    (tmp_path / part).write_text("  60,R\n")
    level = [NamedLevel("walk", "", "", parse_level(WALK), "walk.txt")]
    outcomes = []
    for keys in ("  60,R\n", "  60,L\n", None, "  60,R\n"):
        if keys is None:
            (tmp_path / part).unlink()
        else:
            (tmp_path / part).write_text(keys)
        (result,) = verify_plainly([tmp_path / name], resume=tmp_path / "log", levels=level)
        (alone,) = verify_plainly([tmp_path / name], levels=level)
        assert result == alone
        outcomes.append(getattr(result, "outcome", None))
    assert outcomes == ["exit", "running", None, "exit"]


def test_the_log_of_one_level_says_nothing_of_another(tmp_path: Path) -> None:
    log, run = tmp_path / "log", tmp_path / "run.tas"
    run.write_text("  60,R\n")
    found: dict[str, Result] = {}
    for level in (WALK, SPIKED, WALK):
        counting = [NamedLevel("", "", "", parse_level(level), "a.txt")]
        (result,) = verify_plainly([run], resume=log, levels=counting)
        found.setdefault(level, result)
        assert found[level] == result
    assert [getattr(result, "outcome", None) for result in found.values()] == ["exit", "dead"]


def test_the_log_of_some_levels_that_count_says_nothing_of_others(tmp_path: Path) -> None:
    log, run = tmp_path / "log", tmp_path / "run.replay.txt"
    run.write_text(replay_of_walk())
    walk, spiked = (NamedLevel("", "", "", parse_level(text), text) for text in (WALK, SPIKED))
    asked: list[dict[str, Any]] = [{"levels": [spiked, spiked]}, {"strict": True}, {}, {"levels": [walk, spiked]}]
    found = [next(iter(verify_plainly([run], resume=log, **options))) for options in asked]
    assert [getattr(result, "outcome", None) for result in found] == ["not run", "not run", "exit", "exit"]


def test_a_piece_for_another_machine_holds_every_file_that_it_takes_in(tmp_path: Path) -> None:
    (tmp_path / "a.tas").write_text("Read,part\nRead,missing\n")
    (tmp_path / "b.tas").write_text("Read,part\n")
    (tmp_path / "part.tas").write_text("  60,R\n")
    level = parse_level(WALK)
    found = list(chunks_in([tmp_path / "a.tas", tmp_path / "b.tas"]))
    here = [verify_chunk(chunk, VerifyOptions("plain", level)) for chunk in found]
    sent = pickle.dumps([self_contained(chunk, level) for chunk in found])
    for path in tmp_path.iterdir():
        path.unlink()
    assert [verify_chunk(chunk, VerifyOptions("plain", level)) for chunk in pickle.loads(sent)] == here
    assert [getattr(each, "outcome", None) for (each,) in here] == [None, "exit"]


def test_a_text_that_reads_what_was_not_put_inside_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.tas").write_text("Read,part\n")
    (tmp_path / "part.tas").write_text("  60,R\n")
    (chunk,) = chunks_in([tmp_path / "a.tas"])
    (result,) = verify_chunk(
        replace(chunk, beside={"another.tas": IncludedFile("x", "1")}), VerifyOptions("plain", parse_level(WALK))
    )
    assert isinstance(result, Unreadable)
    assert "was not read before" in result.message


def test_a_run_on_a_level_that_does_not_count_is_not_simulated(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def simulate(*_: object, **__: object) -> None:
        raise AssertionError("simulated")

    monkeypatch.setattr("ninja_game.runs.verify.run_in_slices", simulate)
    path = write_records(tmp_path / "a.txt", ("Walk", WALK, running(WALK_END)))
    for options in ({"strict": True}, {"levels": [NamedLevel("", "", "", parse_level(SPIKED), "b.txt")]}):
        (result,) = verify_plainly([path], **options)
        assert isinstance(result, Verdict)
        fields = result.as_json()
        digest = fields.pop("level_digest")
        assert fields == {
            "file": str(path), "record": 0, "name": "Walk", "author": "me", "level_name": "", "body": "circle",
            "rules": 1, "outcome": "not run", "end_tick": -1, "gold": 0, "score_ticks": None, "ticks": 0,
            "xy_sha256": "", "possible_by_keyboard": None, "in_time": None, "practice": False, "complete": True,
            "made": "", "assisted": None, "co_authors": "", "episode": "", "lifetime": 3600,
            "problems": [f"not run: its level is not one of those that count (level_digest {digest})"],
            "codes": ["other-level"],
        }  # fmt: skip
        assert result_from_data(json.loads(json.dumps(asdict(result)))) == result


def test_a_run_that_is_reported_as_not_run_never_passes_on_a_level_that_counts(tmp_path: Path) -> None:
    path = write_records(tmp_path / "a.txt", ("Walk", WALK, running(WALK_END)))
    (refused,) = verify_plainly([path], strict=True)
    assert isinstance(refused, Verdict)
    again = with_demands(replace(refused, problems=()), {refused.level_digest: "walk"}, only_these=True, strict=True)
    assert "outcome is not run, --strict expects exit" in map(str, again.problems)
    assert all(problem.hint for problem in again.problems)


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
def test_a_run_that_leaves_its_world_is_refused_by_name_and_stops_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(level: Level) -> Any:
        table = object_table(level)
        return table._replace(counts=[]) if any(values[1] == 301.0 for values in table.values) else table

    monkeypatch.setattr("ninja_game.backend.compiled.object_table", broken)
    away = WALK + "!0^115,301"
    runs = ("Walk", WALK, running(WALK_END)), ("Away", away, running(WALK_END)), ("Walk", WALK, running(WALK_END))
    path = write_records(tmp_path / "a.txt", *runs)
    one, two, three = verify_all([path], memory="compiled")
    assert isinstance(two, Unreadable)
    assert "a.txt: record 1: the run leads out of its world's arrays" in two.message
    assert [getattr(one, "good", None), getattr(three, "good", None)] == [True, True]


def allocate(mib: int) -> int:
    """Take so much memory."""
    return len(bytearray(mib << 20)) >> 20


@pytest.mark.skipif(sys.platform != "linux", reason="other systems have other limits")
def test_a_worker_process_has_limits_of_memory_and_time() -> None:
    import resource

    pool = Local(1, processes=True)
    results = dict(results_of(pool, allocate, [10, 3 * WORKER_BYTES >> 21, 20]))
    limits = [
        pool.submit(resource.getrlimit, getattr(resource, name)).result()[0] for name in ("RLIMIT_DATA", "RLIMIT_CPU")
    ]
    pool.close()
    assert isinstance(results.pop(3 * WORKER_BYTES >> 21), WorkerLostError)
    assert results == {10: 10, 20: 20}
    assert limits[0] == WORKER_BYTES
    assert JOB_SECONDS <= limits[1] < JOB_SECONDS + 60


@pytest.mark.parametrize(
    "answer, why",
    [
        ("[]", "0 answers to 2"), ("[[]]", "1 answers"), ("[[], []]", "0 results of 1"), ("7", "else than"),
        ("[7, 8]", "else than"),
        ('[[{"message": "a"}, {"message": "b"}], [{"message": "c"}]]', "2 results of 1"),
    ],
)  # fmt: skip
def test_an_answer_that_is_not_one_of_each_recording_is_refused(answer: str, why: str) -> None:
    chunks = [Chunk("a.txt", records=(LevelRecord("A", "", "", WALK, running(9)),)), Chunk("b.txt", text="?")]
    with pytest.raises(ClusterError, match=why):
        results_from_text(answer, chunks)


@pytest.mark.parametrize("field, value", [("outcome", "\x1b[2J"), ("score_ticks", 10**4000), ("ticks", -(2**60))])
def test_a_result_holds_only_what_a_verdict_can_say(archive: Path, field: str, value: object) -> None:
    verdict = next(verify_plainly([archive / "a.txt"]))
    with pytest.raises(ValueError, match=field):
        result_from_data(asdict(verdict) | {field: value})


def test_two_programs_do_not_write_one_log(tmp_path: Path) -> None:
    with CheckpointLog(tmp_path / "log"), pytest.raises(FileError, match="another program writes"):
        CheckpointLog(tmp_path / "log")


def test_a_short_file_that_begins_as_a_log_does_keeps_every_byte(tmp_path: Path) -> None:
    (tmp_path / "one.json").write_text("{")
    with pytest.raises(FormatError, match="not a checkpoint log"):
        CheckpointLog(tmp_path / "one.json")
    assert (tmp_path / "one.json").read_text() == "{"
