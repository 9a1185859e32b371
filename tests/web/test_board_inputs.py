"""What a folder of runs may not do to a board: start a command, change its dates, pass a run on as one's own."""

import hashlib
import json
import os
import random
import re
import shutil
import subprocess
import zlib
from dataclasses import replace
from functools import partial
from itertools import takewhile
from pathlib import Path
from unittest.mock import Mock

import pytest
from click.testing import CliRunner

from ninja_game.board.copies import ALIGNED, SHIFTED, Course, Courses, course_of, edit_distance, near_to_another
from ninja_game.board.judge import judge
from ninja_game.board.players import Players, folded
from ninja_game.cli.main import cli
from ninja_game.files.bundled import bundled_replays, data_folder
from ninja_game.formats.lines import MAX_NAME
from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import write_replay
from ninja_game.levels.published import published_levels
from ninja_game.runs.run import record_replay, run_level
from ninja_game.web.board.pages import check_site
from tests.support import near_copies
from tests.support.board import DIGEST, put, slow_walk
from tests.support.forgeries import WALKING, record, replay
from tests.support.reference import require_reference
from tests.test_entry_points import PACKAGE, readers

JSON = "board.json"


def board(folder: Path, pack: Path, *words: str) -> tuple[int, str]:
    """Exit code and output of a command on the board."""
    result = CliRunner().invoke(cli, ["board", str(folder), "--levels", str(pack), "--jobs", "1", *words])
    return result.exit_code, result.output


def rows(path: Path, part: str = "runs") -> dict[str, dict[str, object]]:
    """The rows of a board's data by file."""
    return {row["file"]: row for row in json.loads(path.read_text("utf-8"))[part]}


def backdated(path: Path, date: str, *files: str) -> None:
    """Move files of a ledger to a date."""
    data = json.loads(path.read_text("utf-8"))
    for row in (*data["runs"], *data["rejected"]):
        if row["file"] in files:
            row["added"] = date
    path.write_text(json.dumps(data), "utf-8")


# --- commands of a repository ---


def bare_repository(folder: Path, mark: Path) -> None:
    """Plain files that are a repository, in which a look at the history fetches by a command of its own."""
    body = b"tree %s\nauthor a <a> 1 +0000\ncommitter a <a> 1 +0000\n\nx\n" % (b"1" * 40)
    stored = b"commit %d\0" % len(body) + body
    name = hashlib.sha1(stored, usedforsecurity=False).hexdigest()
    put(folder, "HEAD", f"{name}\n")
    put(folder, "refs/heads/main", f"{name}\n")
    (folder / "objects" / name[:2]).mkdir(parents=True)
    (folder / "objects" / name[:2] / name[2:]).write_bytes(zlib.compress(stored))
    upload = f'[remote "x"]\n\turl = {folder}\n\tpromisor = true\n\tuploadpack = touch {mark};\n'
    extension = "[extensions]\n\tpartialClone = x\n"
    put(folder, "config", f"[core]\n\trepositoryformatversion = 1\n\tbare = true\n{extension}{upload}")


@pytest.mark.skipif(not shutil.which("git"), reason="git is not here")
@pytest.mark.parametrize("inside", ["", ".git"])
def test_a_repository_in_the_folder_starts_no_command(inside: str, tmp_path: Path, levels: Path, runs: Path) -> None:
    mark = tmp_path / "touched"
    put(runs, "ann.txt", replay(author="Ann"))
    bare_repository(runs / inside, mark)
    code, text = board(runs, levels, "--check", str(empty_ledger(tmp_path)))
    assert (code, mark.exists()) == (0, False), text
    # The trap is one: git falls into it.
    words = ["git", "-C", str(runs), "-c", "safe.directory=*", "log", "--name-only"]
    env = os.environ | {"GIT_CONFIG_GLOBAL": os.devnull}
    subprocess.run(words, capture_output=True, check=False, timeout=60, env=env)
    assert mark.exists()


def test_no_name_outside_the_folder_is_reported(tmp_path: Path, levels: Path, runs: Path) -> None:
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside" / "secret-name.txt").write_text("x")
    (runs / "inner").symlink_to(tmp_path / "outside")
    (runs / "one.txt").symlink_to(tmp_path / "outside" / "secret-name.txt")
    _, reported = board(runs, levels, "--json", str(tmp_path / "board.json"))
    assert "secret-name" not in reported + (tmp_path / "board.json").read_text("utf-8")
    assert "inner: a link; put the file itself here" in reported
    assert "one.txt: a link; put the file itself here" in reported


def test_the_board_asks_no_other_program() -> None:
    found = set().union(*(readers(path.read_text("utf-8")) for path in PACKAGE.glob("**/board/*.py")))
    assert "read_utf8" in found
    assert not [name for name in found if re.match(r"subprocess|os\.(popen|system|exec|spawn)", name)]


# --- the ledger ---


def empty_ledger(folder: Path) -> Path:
    return put(folder, "empty.json", '{"version": 2, "runs": [], "rejected": []}')


def test_a_run_keeps_the_date_at_which_the_board_took_it_in(tmp_path: Path, levels: Path, runs: Path) -> None:
    data = tmp_path / JSON
    put(runs, "bea.txt", slow_walk(author="Bea"))
    board(runs, levels, "--json", str(data))
    backdated(data, "2026-01-31T12:00:00Z", "bea.txt")
    put(runs, "ann.txt", slow_walk(9, author="Ann"), day=1)
    board(runs, levels, "--json", str(data))
    found = rows(data)
    assert found["bea.txt"]["added"] == "2026-01-31T12:00:00Z"
    assert str(found["ann.txt"]["added"]) > "2026-02"
    # What is another run in the same file is a new one.
    put(runs, "bea.txt", slow_walk(3, author="Bea"))
    board(runs, levels, "--json", str(data))
    assert str(rows(data)["bea.txt"]["added"]) > "2026-02"


def test_a_bad_moment_loses_no_date(tmp_path: Path, levels: Path, runs: Path) -> None:
    data, date = tmp_path / JSON, "2026-01-31T12:00:00Z"
    good = {"ann.txt": replay(author="Ann"), "bea.txt": record(WALKING + b"\2") + record(b"\0" * 9 + WALKING)}
    bad = {"ann.txt": replay(author="Ann", gold=77), "bea.txt": "\0"}
    for step in (good, bad, bad, good):
        for name, text in step.items():
            put(runs, name, text)
        board(runs, levels, "--json", str(data))
        if step is good:
            found = json.loads(data.read_text("utf-8"))
            dates = {(row["file"], row["record"]): row["added"] for row in found["runs"] + found["rejected"]}
            backdated(data, date, *good)
    assert dates == {("ann.txt", 0): date, ("bea.txt", 0): date, ("bea.txt", 1): date}


def test_the_first_one_in_the_ledger_owns_the_run(tmp_path: Path, levels: Path, runs: Path) -> None:
    data = tmp_path / JSON
    put(runs, "zoe.txt", slow_walk(author="Zoe"), day=900)
    board(runs, levels, "--json", str(data))
    backdated(data, "2026-01-31T12:00:00Z", "zoe.txt")
    put(runs, "a-thief.txt", slow_walk(author="Thief"), day=1)
    code, text = board(runs, levels, "--check", str(data))
    assert (code, text.splitlines()[0]) == (1, "copy: a-thief.txt: a copy of the run by Zoe in zoe.txt")
    board(runs, levels, "--json", str(data))
    assert list(rows(data)) == ["zoe.txt"]
    assert board(runs, levels, "--check", str(data))[1].startswith("nothing has changed")


@pytest.mark.parametrize("steps", [("-ann.txt", "zoe.txt"), ("-ann.txt zoe.txt",), ("zoe.txt", "-ann.txt")])
def test_a_withdrawn_run_stays_its_players(steps: tuple[str, ...], tmp_path: Path, levels: Path, runs: Path) -> None:
    data = tmp_path / JSON
    put(runs, "ann.txt", slow_walk(author="Ann"))
    board(runs, levels, "--json", str(data))
    backdated(data, date := "2026-01-31T12:00:00Z", "ann.txt")
    for step in steps:
        for name in step.split():
            (runs / name[1:]).unlink() if name[0] == "-" else put(runs, name, slow_walk(author="Zoe"))
        _, text = board(runs, levels, "--json", str(data))
        assert rows(data).keys() <= {"ann.txt"}
    assert "copy: zoe.txt: a copy of an earlier run by Ann, which was withdrawn or does not count any more" in text
    again = data.read_text("utf-8")
    board(runs, levels, "--json", str(data))
    assert data.read_text("utf-8") == again
    assert board(runs, levels, "--check", str(data))[1].startswith("nothing has changed")
    put(runs, "ann/again.txt", slow_walk(author="ANN"))
    board(runs, levels, "--json", str(data))
    assert [(row["player"], row["added"]) for row in rows(data).values()] == [("ANN", date)], "hers, as of then"
    assert board(runs, levels, "--check", str(data))[1].startswith("nothing has changed")
    assert json.loads(data.read_text("utf-8"))["withdrawn"] == []


def test_without_a_ledger_nobody_is_called_a_copier(levels: Path, runs: Path) -> None:
    put(runs, "zoe.txt", slow_walk(author="Zoe"), day=1)
    put(runs, "ann.txt", slow_walk(author="Ann"), day=9)
    found = judge(runs, published_levels(levels), jobs=1)
    assert [(run.player, run.added) for run in found.runs] == [("Ann", "")]
    assert [each.why for each in found.rejected] == ["the same run as ann.txt"]


ROW: dict[str, object] = {
    "file": "ann.txt", "record": 0, "player": "Ann", "level": "0", "level_name": "Walk", "tick": 1, "gold": 0,
    "score": 1, "way": "0", "added": "",
}  # fmt: skip
BROKEN: dict[str, dict[str, object]] = {
    "a date in a hundred thousand years": {"added": "99999-01-01T00:00:00Z"},
    "a date that is still to come": {"added": "9999-01-01T00:00:00Z"},
    "a year without its zeros": {"added": "1-01-01T00:00:00Z"},
    "no date": {"added": "@99999999999999"},
    "a day that does not exist": {"added": "2026-02-30T00:00:00Z"},
    "a number for a date": {"added": 99999999999999},
    "a huge record": {"record": 1e400},
    "a part of a record": {"record": 0.5},
    "a truth for a record": {"record": True},
    "no file": {"file": None},
    "a list for a way": {"way": []},
    "a number for whose it nearly is": {"near": 3},
    "a number for why it waits": {"untrusted": 3},
    "a word for a truth": {"confirmed": "yes"},
}


@pytest.mark.parametrize("broken", BROKEN)
@pytest.mark.parametrize("option", ["--check", "--json"])
def test_a_broken_ledger_is_named_and_stays(broken: str, option: str, tmp_path: Path, levels: Path, runs: Path) -> None:
    text = json.dumps({"version": 2, "runs": [ROW | {"file": "first.txt"}, ROW | BROKEN[broken]], "rejected": []})
    data = put(tmp_path, JSON, text)
    put(runs, "ann.txt", replay(author="Ann"))
    code, printed = board(runs, levels, option, str(data), "--site", str(tmp_path / "site"))
    assert (code, "row 2 of 'runs'" in printed) == (2, True), printed
    assert data.read_text("utf-8") == text


@pytest.mark.parametrize(
    "text",
    [
        '{"version": 1, "runs": [], "rejected": []}',
        "",
        '{"version": 2, "runs": {}}',
        "[1]",
        '{"version": 2, "runs": "", "rejected": []}',
        '{"version": 2, "runs": [], "rejected": {}}',
        '{"version": 2, "runs": [], "rejected": [], "withdrawn": [{"level": 3}]}',
    ],
)
def test_another_file_is_not_taken_for_a_ledger(text: str, tmp_path: Path, levels: Path, runs: Path) -> None:
    data = put(tmp_path, JSON, text)
    assert board(runs, levels, "--json", str(data))[0] == 2
    assert data.read_text("utf-8") == text


def test_one_odd_file_does_not_stop_the_others(tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.txt", replay(author="Ann"))
    put(runs, "far.txt", replay(author="Far")).touch()
    os.utime(runs / "far.txt", (2**40, 2**40))
    put(runs, "records.txt", record(bytes(11) + WALKING) + "$x#y#z#nothing#23:0#\n" + record())
    put(runs, "tas.tas", "   1,R\n")
    put(runs, "a\nb.txt", slow_walk(8, author="Odd"))
    code, _ = board(runs, levels, "--site", str(tmp_path / "site"), "--json", str(tmp_path / JSON))
    assert code == 0
    assert {"ann.txt", "a\nb.txt"} <= set(rows(tmp_path / JSON))


def test_a_name_of_letters_that_stand_for_many_is_cut(tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.txt", replay(author="\ufdfa" * MAX_NAME))
    code, text = board(runs, levels, "--site", str(tmp_path / "site"))
    (shared,) = (tmp_path / "site" / "replays").glob("*.txt")
    (run,) = load_replays(shared)
    assert (code, len(run.author)) == (0, MAX_NAME), text


@pytest.mark.parametrize("odd", ["[made:  from a run by Ann]", "odd"])
def test_a_run_that_cannot_be_written_stops_no_page(
    odd: str, tmp_path: Path, levels: Path, runs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(runs, "ann.txt", slow_walk(author="Ann"))
    put(runs, "bea.txt", record().replace("#test#", f"#{odd}#"))
    if odd == "odd":
        unwritten = Provenance(edits=3, begun_by="B" * 1500)
        monkeypatch.setattr("ninja_game.formats.recording.without_provenance", lambda comment: (comment, unwritten, ()))
    code, text = board(runs, levels, "--site", str(tmp_path / "site"))
    assert (code, "unreadable: bea.txt: not how a run is made" in text) == (0, odd == "odd"), text
    assert (tmp_path / "site" / "board" / "index.html").exists()


def test_a_record_without_a_level_counts_where_one_level_does(tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.txt", record(level=""))
    found = judge(runs, published_levels(levels / "00-0-level.txt"), jobs=1)
    assert [run.player for run in found.runs] == ["unknown (ann.txt)"]


def test_a_run_of_six_lines_asks_for_no_second_of_work(tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.txt", f"ninja-game replay 3\nlevel-digest: {DIGEST}\nfinal-tick: 999999\ninputs:\n  .\n")
    put(runs, "bea.txt", record(bytes(3700) + WALKING))
    found = judge(runs, published_levels(levels), jobs=1)
    reported = [(each.kind, each.why) for each in found.rejected]
    assert [kind for kind, _ in reported] == ["unreadable", "refused"], reported
    assert re.search(r"ticks of 1. each, not over after [789],\d{3}; .* after its end$", reported[0][1]), reported
    assert "it takes longer than the level gives" in reported[1][1], reported


def test_inputs_alone_take_in_no_other_file(tmp_path: Path, levels: Path, runs: Path) -> None:
    put(runs, "ann.tas", "Read,part.txt\n   1,R\n")
    found = judge(runs, published_levels(levels / "00-0-level.txt"), jobs=1)
    assert [each.why for each in found.rejected] == ["inputs without a level; send a replay, or a record of N"]


# --- where the pages go ---


@pytest.mark.parametrize("out", [".", "replays/..", "replays", "replays/deep", "link", "replays/.", "around"])
def test_the_pages_are_not_written_into_the_runs(out: str, tmp_path: Path, levels: Path) -> None:
    folder = tmp_path / "replays"
    put(folder, "ann.txt", replay(author="Ann"))
    (tmp_path / "link").symlink_to(tmp_path)
    (tmp_path / "around").mkdir()
    (tmp_path / "around" / "board").symlink_to(folder)
    before = sorted(tmp_path.rglob("*"))
    code, text = board(folder, levels, "--site", str(tmp_path / out))
    assert (code, "choose another folder for the pages" in text) == (2, True), text
    assert sorted(tmp_path.rglob("*")) == before


def test_a_ledger_is_not_written_where_it_would_be_a_run(tmp_path: Path, levels: Path) -> None:
    put(tmp_path, "runs/ann.txt", replay(author="Ann"))
    code, text = board(tmp_path / "runs", levels, "--json", str(tmp_path / "runs" / "new.txt"))
    assert (code, "the board would be read as a run" in text) == (2, True), text
    assert not (tmp_path / "runs" / "new.txt").exists()


def test_runs_that_lie_below_old_pages_are_safe(tmp_path: Path) -> None:
    (tmp_path / "board" / "levels").mkdir(parents=True)
    with pytest.raises(Exception, match="the runs are read there"):
        check_site(tmp_path, tmp_path / "board" / "levels")
    check_site(tmp_path, tmp_path / "elsewhere")


# --- whose a run is ---


@pytest.mark.parametrize(
    "name", ["ann", "ANN", "A\u200bnn", "\uff21\uff4e\uff4e", " Ann\t", "An\u2060n", "Ann\ufe0f", "Ann\U0001d159"]
)
def test_a_name_is_one_player_however_it_is_typed(name: str) -> None:
    players = Players()
    assert players.meet("Ann") == ("Ann", "")
    assert players.meet(name) == ("Ann", "")


@pytest.mark.parametrize("name", ["\u0410nn", "\u0391nn", "\u00c1nn", "\u1d00nn", "Ann\u0489"])
def test_a_name_that_looks_like_another_is_reported_and_not_merged(name: str) -> None:
    players = Players()
    players.meet("Ann")
    player, remark = players.meet(name)
    assert (player, "looks like Ann" in remark) == (name, True)
    assert folded(player) != folded("Ann")


SCRIPTS = {
    "P\u0430ul": True, "J\u0585hn": True, "\u13abohn": True, "\u2ca2aul": True, "\ua4d0ob": True,
    "\ua4ee\ua4e0\ua4e0": True, "\u13a2\u13aa\u13da": True,
    "Paul \u0418\u0432\u0430\u043d": False, "\u02bbOkina": False, "Ken\u592a\u90ce": False, "\u00aann": False,
}  # fmt: skip


@pytest.mark.parametrize("name, reported", SCRIPTS.items())
def test_words_of_mixed_scripts_are_reported(name: str, reported: bool) -> None:
    assert bool(Players().meet(name)[1]) == reported


def test_names_without_a_letter_that_is_seen_are_unnamed() -> None:
    assert Players().meet("\u200b\u3164")[0] == "unnamed"


def test_players_are_shown_as_they_came_first(tmp_path: Path, levels: Path, runs: Path) -> None:
    data = tmp_path / JSON
    put(runs, "z.txt", slow_walk(author="Ann"))
    board(runs, levels, "--json", str(data))
    backdated(data, "2026-01-31T12:00:00Z", "z.txt")
    put(runs, "a.txt", slow_walk(9, author="ANN"))
    put(runs, "b.txt", slow_walk(5, author="aNN"))
    put(runs, "c.txt", slow_walk(14, author="\u0410nn"))
    _, text = board(runs, levels, "--check", str(data))
    assert "new: a.txt: Ann passes" in text
    assert "copy: b.txt: the same run as z.txt" in text
    assert "the player's name looks like Ann and is another one" in text


# --- near copies ---


def certificate() -> tuple[Path, bytes, str]:
    """A certificate of ours with its inputs, and the same with one key changed early that passes in another way."""
    for path in (each for each in bundled_replays() if ".exit." in each.name):
        (found,) = load_replays(path)
        inputs = found.inputs
        for tick in range(5, len(inputs) // 5):
            changed = inputs[:tick] + bytes([inputs[tick] & 12]) + inputs[tick + 1 :]
            run = record_replay(found.level, changed, body="circle", name="x", author="Mallory")
            first = record_replay(found.level, inputs, name="x", author="Ann")
            if changed != inputs and run.outcome == "exit" and run.digest != first.digest:
                return path, inputs, write_replay(run)
    raise AssertionError


@pytest.mark.slow
def test_one_key_changed_in_one_tick_is_reported(tmp_path: Path) -> None:
    shown = published_levels(data_folder("levels"))
    path, _, text = certificate()
    put(tmp_path, "runs/ann.txt", path.read_text("utf-8").replace("author:", "author: Ann #"))
    put(tmp_path, "runs/mallory.txt", text)
    found = judge(tmp_path / "runs", shown, jobs=1)
    remarks = " ".join(run.remark for run in found.runs)
    assert len(found.runs) == 2
    assert re.search(r"\d+ of (its |the )?\d+ .* run by Ann .*in ann.txt", remarks)


def test_a_near_copy_makes_no_next_one_a_players_own(tmp_path: Path) -> None:
    path = next(path for path in bundled_replays() if path.name.startswith("30-0") and ".exit." in path.name)
    (recording,) = load_replays(path)
    inputs = recording.inputs
    ways = {run_level(recording.level, inputs).places: inputs}
    for kind in ("keys changed in a tick", "ticks added or left out"):
        few = takewhile(lambda each: each[0] <= 10, near_copies.edited(recording, kind))
        ways |= {run.places: changed for _, changed, run in few}
    first, *changed, last = ways.values()
    sent = [("Ann", first), ("Eve", changed[0]), ("Eve", changed[1]), ("Ann", last)]
    for number, (author, inputs) in enumerate(sent):
        put(tmp_path, f"runs/{number}.txt", write_replay(record_replay(recording.level, inputs, author=author)))
    found = judge(tmp_path / "runs", published_levels(data_folder("levels")), jobs=1)
    assert [(run.player, bool(run.remark)) for run in found.runs] == [
        ("Ann", False), ("Eve", True), ("Eve", True), ("Ann", False),
    ]  # fmt: skip


def test_an_own_detour_first_makes_no_near_copy_an_own_run(tmp_path: Path) -> None:
    """Eve's first run, there and back and then Ann's inputs, is near to no other; her second is Ann's with a change."""
    (recording,) = load_replays(next(path for path in bundled_replays() if path.name.startswith("00-2")))
    inputs = recording.inputs
    detour = bytes([2] * 40 + [0] * 30 + [1] * 40 + [0] * 40)
    course = run_level(recording.level, inputs).places
    edits = near_copies.edited(recording, "keys changed in a tick")
    changed = next(changed for _, changed, run in edits if run.places != course)
    for number, (author, keys) in enumerate([("Ann", inputs), ("Eve", detour + inputs), ("Eve", changed)]):
        put(tmp_path, f"runs/{number}.txt", write_replay(record_replay(recording.level, keys, author=author)))
    found = judge(tmp_path / "runs", published_levels(data_folder("levels")), jobs=1)
    assert [(run.player, bool(run.remark)) for run in found.runs] == [("Ann", False), ("Eve", False), ("Eve", True)]


def test_a_table_of_edits_and_honest_pairs_is_as_the_page_says() -> None:
    require_reference()
    pairs, _ = near_copies.honest_pairs(60)
    course = near_copies.course_of_row
    assert sum(near_copies.near_ones(course(other), [course(one)]) != [] for one, other in pairs) <= 1
    paths = near_copies.every_nth([path for path in bundled_replays() if ".exit." in path.name], 5)
    chosen = [recording for path in paths for recording in load_replays(path)]
    for recording in chosen:
        few = takewhile(lambda each: each[0] <= 5, near_copies.noticed(recording, "ticks added or left out"))
        assert all(seen for _, seen in few), recording.name
    many = [list(near_copies.noticed(recording, "keys changed in a tick")) for recording in chosen]
    assert sum(seen for changes in many for _, seen in changes) >= 0.9 * sum(map(len, many)), many


def test_an_edit_distance_is_that_of_the_table() -> None:
    def table(ours: bytes, theirs: bytes) -> int:
        row = list(range(len(theirs) + 1))
        for number, mine in enumerate(ours, 1):
            new = [number]
            for place, other in enumerate(theirs, 1):
                new.append(min(row[place] + 1, new[-1] + 1, row[place - 1] + (mine != other)))
            row = new
        return row[-1]

    for seed in range(200):
        rng = random.Random(seed)
        ours, theirs = (bytes(rng.choices(range(3), k=rng.randrange(40))) for _ in range(2))
        assert edit_distance(ours, theirs) == table(ours, theirs)


def test_few_of_many_runs_are_aligned(monkeypatch: pytest.MonkeyPatch) -> None:
    (recording,) = load_replays(bundled_replays()[0])
    inputs = recording.inputs
    course = course_of(inputs, run_level(recording.level, inputs))
    aligned = Mock(return_value=10**6)
    monkeypatch.setattr("ninja_game.board.copies.edit_distance", aligned)
    other = replace(course, presses=frozenset(), places=frozenset())
    assert near_copies.near_ones(course, [other] * 500) == []
    assert aligned.call_count == ALIGNED


def test_runs_by_two_in_turn_are_compared_once_and_the_fastest_only() -> None:
    """Each of them is nearer than all before it; and of many only the fastest are compared."""
    course = Course(b"", frozenset(range(9)), frozenset(), frozenset(map(float, range(1000))))
    players = ["Bea" if number % 2 else "Ann" for number in range(200)]
    for most, nearest in ((1000, 199), (9, 8)):
        courses = Courses(most)
        for number in range(200):
            places = frozenset(map(float, range(750 + number)))
            courses.add(number, number, partial(replace, course, places=places))
        assert near_to_another("Ann", course, courses, players, 0) is None
        near = near_to_another("Cid", course, courses, players, 200)
        assert near is not None
        remark = f"{750 + nearest} of the 1000 places on its way, and 0 of 0 presses and releases, are those of"
        assert (near.numbers[0], *near[1:]) == (nearest, remark, False)


def test_a_slower_run_leaves_for_a_faster_one_with_all_that_it_shares() -> None:
    courses, one = Courses(1), Course(b"", frozenset(range(9)), frozenset(range(16)), frozenset({1.0}))
    other = replace(one, presses=frozenset(range(80, 96)), places=frozenset({2.0}))
    for number, (tick, each) in enumerate([(30, one), (40, other), (20, other)]):
        courses.add(number, tick, partial(replace, each))
    assert courses.numbers.tolist() == [2]
    every = courses.numbers >= 0
    assert courses.near(replace(one, presses=frozenset()))(every).numbers == []
    moved = replace(one, presses=frozenset(each + 8 * SHIFTED for each in other.presses))
    assert courses.near(moved)(every) == (
        [2],
        "0 of the 1 places on its way, and 16 of 16 presses and releases, are those of",
        True,
    )
    beyond = replace(one, presses=frozenset(each + 8 for each in moved.presses))
    assert courses.near(beyond)(every).numbers == []


def test_a_folder_may_have_the_name_of_the_command_below(
    levels: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put(tmp_path / "ask", "a.txt", slow_walk(author="Ann"))
    monkeypatch.chdir(tmp_path)
    code, text = board(Path("ask"), levels)
    assert (code, "board ask --help" in text) == (2, True), text
    result = CliRunner().invoke(cli, ["board", "./ask", "--levels", str(levels), "--jobs", "1"])
    assert result.exit_code == 0, result.output
    assert "1 run" in result.output
