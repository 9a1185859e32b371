"""What a board remembers: nothing is done twice, nothing that came with the runs is believed, no page is other."""

import json
import os
import shutil
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest
from click.testing import CliRunner

from ninja_game.board import collect, copies, judge, memo, runs as board_runs
from ninja_game.board.collect import RunFolder, Submission, SubmittedFile
from ninja_game.board.memo import Memo
from ninja_game.cli.main import cli
from ninja_game.files.tree import Tree
from ninja_game.formats.pack.pars import Pars, write_pars
from ninja_game.runs import archive
from ninja_game.runs.archive import verify_all
from ninja_game.runs.chunks import Chunk
from ninja_game.runs.run import run_level
from ninja_game.runs.workers import WorkerLostError
from tests.support.board import DIGEST, board, put, slow_walk
from tests.support.forgeries import WALKING, record, replay
from tests.support.samples import WALK_END


@pytest.fixture
def simulated(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The files that are simulated."""
    found: list[str] = []

    def noted(chunk: Chunk) -> Chunk:
        found.append(chunk.file)
        return chunk

    def noting(paths: Any, *, chunks: Any, **about: Any) -> Any:
        return verify_all(paths, chunks=map(noted, chunks), **about)

    monkeypatch.setattr(judge, "verify_all", noting)
    return found


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The files that are written below the pages, and the replays."""
    found: list[str] = []
    write = Tree.write

    def noting(self: Tree, name: str, content: bytes | str) -> None:
        found.append(name)
        write(self, name, content)

    monkeypatch.setattr(Tree, "write", noting)
    return found


def test_only_what_is_new_is_simulated_and_written(
    tmp_path: Path, levels: Path, runs: Path, simulated: list[str], drawn: list[str]
) -> None:
    site = str(tmp_path / "site")
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bad.txt", replay(author="Ann", gold=77))
    first = board(runs, levels, "--site", site)
    assert simulated == ["ann.txt", "bad.txt"]
    simulated.clear()
    drawn.clear()
    assert board(runs, levels, "--site", site) == first
    assert simulated == []
    assert not [name for name in drawn if "/levels/" in name or "/pictures/" in name or name.startswith("replays/")]
    put(runs, "bea.txt", slow_walk(author="Bea"))
    board(runs, levels, "--site", site)
    assert simulated == ["bea.txt"]
    assert len([name for name in drawn if name.startswith("replays/")]) == 3, (
        "the run, its page, and that of the first, with splits now"
    )
    assert len([name for name in drawn if name.startswith("board/levels/")]) == 2
    simulated.clear()
    board(runs, levels / "00-0-level.txt", "--site", site)
    assert simulated == ["ann.txt", "bad.txt", "bea.txt"], "other levels count"
    simulated.clear()
    board(runs, levels / "00-0-level.txt", "--site", site, "--again")
    assert simulated == ["ann.txt", "bad.txt", "bea.txt"]


def test_a_file_that_lies_there_as_before_is_not_read(
    levels: Path, runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its size and times tell; one that was written a moment ago is read again, since it may change unseen."""
    read: list[str] = []
    file = RunFolder.file

    def noting(self: RunFolder, name: str) -> SubmittedFile:
        read.append(name)
        return file(self, name)

    monkeypatch.setattr(RunFolder, "file", noting)
    path = put(runs, "ann.txt", replay(author="Ann"))
    monkeypatch.setattr(collect, "SETTLED", 10**18)
    board(runs, levels)
    board(runs, levels)
    assert read == ["ann.txt"] * 2
    monkeypatch.setattr(collect, "SETTLED", 0)
    board(runs, levels)
    assert read == ["ann.txt"] * 3, "no stamp was noted yet"
    board(runs, levels)
    assert read == ["ann.txt"] * 3
    times = path.stat()
    path.write_text(replay(author="Bea"), "utf-8")
    os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    assert times.st_size == path.stat().st_size
    board(runs, levels)
    assert read == ["ann.txt"] * 4


def test_a_lost_worker_is_not_remembered(levels: Path, runs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    with monkeypatch.context() as patch:
        died = WorkerLostError("the worker died again and again")
        patch.setattr(archive, "_verify", lambda asked, job: died)
        assert "unreadable: ann.txt: the worker died again and again" in board(runs, levels)
    assert board(runs, levels).startswith("1 run by 1 player")


def tree(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.*") if path.is_file()}


def test_pages_are_the_same_as_made_again(tmp_path: Path, levels: Path, runs: Path) -> None:
    """Runs come, change and go; whatever was remembered, the pages are those of a board that remembers nothing."""
    some = {
        "ann.txt": replay(author="Ann"), "bea.txt": slow_walk(40, author="Bea"),
        "cid.txt": replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Cid"), "dan.txt": replay(author="Dan"),
        "bad.txt": "nothing",
    }  # fmt: skip
    for step in (["ann.txt"], ["bea.txt", "bad.txt"], ["cid.txt", "dan.txt"], ["-bea.txt"], ["-ann.txt"], ["bea.txt"]):
        for name in step:
            put(runs, name, some[name]) if name in some else (runs / name[1:]).unlink()
        printed = board(runs, levels, "--site", str(tmp_path / "site"))
        shutil.rmtree(tmp_path / "again", ignore_errors=True)
        assert board(runs, levels, "--site", str(tmp_path / "again"), "--again") == printed
        assert tree(tmp_path / "site") == tree(tmp_path / "again"), step


def test_other_par_times_are_other_medals_on_all_pages(tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    with_medal = []
    for exit_tick, medal in ((WALK_END, b'"medal author"'), (1, b'"medal bronze"')):
        (levels / "pars.toml").write_text(write_pars({"00-0-level.txt": Pars(DIGEST[:16], "", exit_tick)}), "utf-8")
        board(runs, levels, "--site", str(tmp_path / "site"))
        with_medal.append([name for name, page in tree(tmp_path / "site").items() if medal in page])
    assert with_medal[0] == with_medal[1]
    assert f"board/levels/{DIGEST[:16]}-runs.html" in with_medal[0]


def test_the_command_after_the_first_compares_nothing(
    tmp_path: Path, levels: Path, runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All runs have one moment, and near copies lie between others; one more run is compared alone."""
    compared, simulated = (Mock(side_effect=getattr(copies, name)) for name in ("near_to_another", "run_level"))
    monkeypatch.setattr(copies, "near_to_another", compared)
    monkeypatch.setattr(copies, "run_level", simulated)
    data, site = tmp_path / "board.json", tmp_path / "site"
    put(runs, "a.txt", slow_walk(40, author="Ann"))
    put(runs, "b.txt", replay(bytes(40) + WALKING[:-8] + b"\0" + WALKING, author="Bob"))
    put(runs, "c.txt", replay(bytes(2) + WALKING[:5] + b"\0" * 30 + WALKING, author="Cid"))
    put(runs, "d.txt", slow_walk(41, author="Dan"))
    printed = []
    for _ in range(3):
        report = board(runs, levels, "--json", str(data), "--site", str(site))
        printed.append((report, data.read_text("utf-8"), tree(site)))
        assert (compared.call_count, simulated.call_count) == (4, 4)
    assert printed[0] == printed[1] == printed[2]
    assert printed[0][2][f"board/levels/{DIGEST[:16]}-runs.html"].count(b", of the same moment") == 2
    put(runs, "e.txt", slow_walk(42, author="Eve"))
    board(runs, levels, "--json", str(data), "--site", str(site))
    assert (compared.call_count, simulated.call_count) == (5, 9), "and the earlier ones are what it is compared with"


def test_the_path_of_a_run_with_splits_is_not_simulated_again(
    tmp_path: Path, levels: Path, runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its own page shows the path of the level's page."""
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bea.txt", slow_walk(author="Bea"))
    board(runs, levels, "--site", str(tmp_path / "first"))
    simulated = Mock(side_effect=run_level)
    monkeypatch.setattr(board_runs, "run_level", simulated)
    board(runs, levels, "--site", str(tmp_path / "second"))
    assert tree(tmp_path / "second") == tree(tmp_path / "first")
    assert simulated.call_count == 0


def test_a_file_with_many_records_is_read_once_for_all_their_pages(
    tmp_path: Path, levels: Path, runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "all.txt", "".join(record(bytes(wait) + WALKING) for wait in range(5)))
    board(runs, levels)
    parsed, recordings = list[str](), RunFolder.recordings

    def noting(self: RunFolder, file: SubmittedFile) -> list[Submission]:
        parsed.append(file.name)
        return recordings(self, file)

    monkeypatch.setattr(RunFolder, "recordings", noting)
    board(runs, levels, "--site", str(tmp_path / "site"))
    assert parsed == ["all.txt"]


def test_a_page_that_somebody_changed_is_written_again(tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    board(runs, levels, "--site", str(tmp_path / "site"))
    before = tree(tmp_path / "site")
    for path in (tmp_path / "site").rglob("*.*"):
        if path.is_file() and path.name[0] != ".":
            times = path.stat()
            path.write_bytes(path.read_bytes()[::-1])
            os.utime(path, ns=(times.st_atime_ns, times.st_mtime_ns))
    board(runs, levels, "--site", str(tmp_path / "site"))
    assert tree(tmp_path / "site") == before


@pytest.mark.parametrize("words", [[], ["--again"]])
def test_a_run_that_is_withdrawn_leaves_no_file(words: list[str], tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bea.txt", slow_walk(author="Bea"))
    other = put(tmp_path, "site/replays/0123456789abcdef.txt", "of the gallery")
    board(runs, levels, "--site", str(tmp_path / "site"))
    (runs / "bea.txt").unlink()
    board(runs, levels, "--site", str(tmp_path / "site"), *words)
    assert sorted(path.suffix for path in (tmp_path / "site" / "replays").iterdir()) == [".html", ".txt", ".txt"]
    assert other.exists()


def test_what_comes_with_the_runs_is_not_remembered(
    tmp_path: Path, levels: Path, runs: Path, board_cache: Path, simulated: list[str]
) -> None:
    """Memos, checkpoint logs and ledgers beside the runs, in the pages, or in the current folder judge nothing."""
    put(runs, "ann.txt", slow_walk(author="Ann"))
    board(runs, levels)
    (known,) = board_cache.glob("runs-*.json")
    forged = known.read_text("utf-8").replace(f": {3600 + 80 - WALK_END - 5}", ": 99999")
    assert forged != known.read_text("utf-8")
    shutil.rmtree(board_cache)
    simulated.clear()
    for folder in (runs, runs / ".cache", runs / "cache", tmp_path / "site" / "board", tmp_path / "site"):
        put(folder, known.name, forged)
    put(tmp_path, "site/board/.ninja-game-pages", "made by ninja-game\n")
    put(runs, "board.json", json.dumps({"version": 2, "runs": [], "rejected": []}))
    assert board(runs, levels, "--site", str(tmp_path / "site")).startswith("1 run by 1 player")
    assert simulated == ["ann.txt"]
    assert "99999" not in "".join(
        text.decode("utf-8", "replace") for text in tree(tmp_path / "site").values() if b"<html" in text
    )


@pytest.mark.parametrize("place", ["runs", "runs/deep", ".", "site", "site/board/deep"])
def test_a_cache_folder_among_the_runs_or_pages_is_refused(
    place: str, tmp_path: Path, levels: Path, runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    folder = Path(place) if place == "." else tmp_path / place
    monkeypatch.setattr("ninja_game.cli.board_ranking.cache_folder", lambda: folder)
    site = tmp_path / "site"
    site.mkdir()
    result = CliRunner().invoke(cli, ["board", str(runs), "--levels", str(levels), "--site", str(site)])
    assert (result.exit_code, "choose another one" in result.output) == (2, True), result.output


@pytest.mark.parametrize("text", ["", "[]", "{", '"x"', "\0", "[" * 99_999])
def test_a_broken_memo_is_an_empty_one(text: str, tmp_path: Path) -> None:
    path = put(tmp_path, "memo.json", text)
    found = Memo(path)
    assert found.recall("key") is None
    found.note("key", [1])
    found.save()
    assert Memo(path).recall("key") == [1]


BROKEN = [7, "x", None, {}, [], [7], [{}], [{"record": 0, "kind": ""}], [{"record": 0, "kind": "odd", "level": DIGEST}],
          [{"record": 0, "kind": "refused", "why": []}], [{"record": 0, "kind": "refused", "odd": 1}]]  # fmt: skip
"""Entries of a memo; or, as a list, the rows of an entry that is whole else."""


@pytest.mark.parametrize("broken", BROKEN)
def test_a_broken_row_of_a_memo_is_none(
    broken: Any, tmp_path: Path, levels: Path, runs: Path, board_cache: Path, simulated: list[str]
) -> None:
    site = tmp_path / "site"
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "bea.txt", slow_walk(author="Bea"))
    printed = board(runs, levels, "--site", str(site))
    other = put(tmp_path, "other.txt", "of somebody")
    for path in board_cache.iterdir():
        names = {"../other.txt": broken, "": broken, "\0": broken, "/": broken, "board/../../other.txt": broken}
        entries = json.loads(path.read_text("utf-8"))
        for name, entry in entries.items():
            entries[name] = entry | {"rows": broken} if isinstance(entry, dict) and isinstance(broken, list) else broken
        path.write_text(json.dumps(entries | names), "utf-8")
    simulated.clear()
    assert board(runs, levels, "--site", str(site)) == printed
    assert simulated == ["ann.txt", "bea.txt"]
    assert other.exists()


def test_all_code_of_the_program_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memo, "__file__", str(put(tmp_path, "board/memo.py", "")))
    met = set()
    for name in ("runs/verify.py", "formats/n14/demo.py", "web/pages/style.css", "__init__.py"):
        put(tmp_path, name, "x = 1")
        met.add(memo.program.__wrapped__())
    assert len(met) == 4


def test_other_rules_of_the_world_are_other_runs(
    tmp_path: Path, levels: Path, runs: Path, simulated: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    board(runs, levels)
    monkeypatch.setattr(judge, "program", lambda: "another")
    board(runs, levels)
    assert simulated == ["ann.txt", "ann.txt"]


def test_a_course_that_goes_takes_its_features_with_it() -> None:
    common = copies.Common()
    for has in (True, False):
        common.mark([1.5], 8, has=has)
        assert common.counts([1.5], 9).tolist() == [0] * 8 + [has]
