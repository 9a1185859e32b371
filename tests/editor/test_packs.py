"""Packs under edit: levels and episodes are moved in the index, comments stay; what is right is not done again."""

import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.editor import pack_steps, packs, ready_pack
from ninja_game.editor.pack_steps import Steps
from ninja_game.editor.ready_pack import Obstacles, missing_run, prepare_pack
from ninja_game.errors import NinjaGameError, PackError
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.pack import Pack, PackFiles
from ninja_game.levels.findings import level_finding
from ninja_game.runs.packs import lint, read_pack_certificate
from ninja_game.runs.problems import level_problems
from ninja_game.search.certificate import read_certificate
from ninja_game.search.task import Progress
from tests.support.own_pack import PACK

FIRST, LAST = "00-0-run-and-hop.txt", "01-2-no-hurry.txt"
RUN = "certificates/00-0-run-and-hop.exit.replay.txt"


def _quiet(_text: str, _share: float | None) -> None:
    """Nobody listens."""


@pytest.fixture(name="pack")
def copy_of_the_pack(tmp_path: Path) -> Path:
    return Path(shutil.copytree(PACK, tmp_path / "pack", ignore=shutil.ignore_patterns("gallery", "README.md")))


def accept_missing_gold(pack: Path) -> None:
    """Of all levels but the first: runs that a second of search would not find anyway are not searched."""
    for file in Pack(pack).levels:
        if file != FIRST:
            packs.accept(pack, file, "no-gold-run", "not here")


def layout(path: Path) -> dict[int, list[str]]:
    """The files of each episode, as their numbers."""
    pack = Pack(path)
    return {each.number: [file[:4] for file in each.files(pack.files.levels)] for each in pack.index.episodes}


def test_levels_are_moved_between_episodes_and_out_of_them(pack: Path) -> None:
    packs.place(pack, [LAST], 1, before="01-0-up-and-away.txt")
    packs.place(pack, [FIRST], 1)
    assert layout(pack) == {0: ["00-1", "00-2", "00-3", "00-4"], 1: ["01-2", "01-0", "01-1", "00-0"]}
    packs.place(pack, [FIRST], None)
    packs.place(pack, ["00-4-every-switch.txt"], None)
    assert layout(pack) == {0: ["00-1", "00-2", "00-3"], 1: ["01-2", "01-0", "01-1"]}
    assert (pack / "pack.toml").read_text("utf-8").startswith("# A pack for the tests, which stays")
    for file in (FIRST, "00-1-stone-to-stone.txt"):
        packs.place(pack, [file], 1)
    with pytest.raises(PackError, match="episode 2 is full"):
        packs.place(pack, ["00-2-wall-to-wall.txt"], 1)


def test_episodes_are_made_moved_renamed_and_removed(pack: Path) -> None:
    assert packs.new_episode(pack, "Late", 0) == 2
    assert packs.new_episode(pack, "Right", 1) == 10
    packs.move_episode(pack, 2, 0)
    assert layout(pack) == {0: [], 1: ["00-0", "00-1", "00-2", "00-3", "00-4"], 2: ["01-0", "01-1", "01-2"], 10: []}
    packs.move_episode(pack, 1, 10)
    packs.rename_episode(pack, 10, 'The "first"')
    assert [(each.number, each.name) for each in Pack(pack).index.episodes] == [
        (0, "Late"), (2, "Things that hum"), (10, 'The "first"'), (11, "Right"),
    ]  # fmt: skip
    packs.remove_episode(pack, 2)
    assert list(layout(pack)) == [0, 10, 11]
    assert len(Pack(pack).levels) == 8


def test_a_column_takes_ten_episodes(pack: Path) -> None:
    for _ in range(8):
        packs.new_episode(pack, "One more", 0)
    with pytest.raises(PackError, match="column 1 is full"):
        packs.new_episode(pack, "Too many", 0)


def test_a_pack_is_made_described_and_copied(pack: Path, tmp_path: Path) -> None:
    made = packs.new_pack(tmp_path, "Wände", "me")
    file = packs.new_level(made, "Erste", "me")
    packs.place(made, [file], 0)
    packs.describe(made, {"version": "2", "columns": ["Left"], "author": "you"})
    index = Pack(made).index
    assert (index.title, index.columns, layout(made)) == ("Wände by you, 2", ("Left",), {0: ["erst"]})
    copied = packs.copy_pack(Pack(pack), tmp_path, "Wände")
    assert copied.name == "wände-2"
    assert Pack(copied).files.names == Pack(pack).files.names
    linked = Pack(packs.copy_pack(Pack(Path(PackFiles(pack).link())), tmp_path, "test pack"))
    assert list(lint(linked)) == []
    for kept in (linked, Pack(pack)):
        assert read_certificate(kept.levels[FIRST], kept.files.path / RUN)
        assert "level-data:" in kept.files.text(RUN), "whole, where it is a file"
    assert packs.same_pack(linked, Pack(pack))
    with pytest.raises(NinjaGameError):
        packs.describe(made, {"name": ""})
    assert Pack(made).name == "Wände"


def test_a_dozen_steps_are_taken_back_and_folders_stay(pack: Path, tmp_path: Path) -> None:
    steps, folder = Steps(tmp_path), tmp_path / "levels"
    folder.mkdir()
    steps.run("Copy", lambda: packs.copy_pack(Pack(pack), folder, "copy"))
    assert (folder / "copy" / RUN).is_file()
    assert steps.undo() == "Copy"
    assert list(folder.iterdir()) == [], "no empty folder is left, but the one of all"
    steps.run("Nothing", lambda: packs.describe(pack, {"name": Pack(pack).name}))
    assert not steps
    for number in range(14):
        steps.run(str(number), lambda text=str(number): packs.describe(pack, {"version": text}))  # type: ignore[misc]
    assert [steps.undo() for _ in range(12)] == [str(number) for number in range(13, 1, -1)]
    assert Pack(pack).index.version == "1"
    with pytest.raises(NinjaGameError, match="nothing to undo"):
        steps.undo()


def test_steps_outlive_the_program_and_lead_nowhere_but_into_the_players_folder(pack: Path, tmp_path: Path) -> None:
    folder, kept = tmp_path / "levels", tmp_path / "editing" / "undo" / "packs.steps"
    made = packs.new_pack(folder, "Walls", "me")
    before = (made / "pack.toml").read_bytes()
    Steps(tmp_path).run("Name", lambda: packs.describe(made, {"name": "Wälle"}))
    named = (made / "pack.toml").read_bytes()
    Steps(tmp_path).run("Copy", lambda: packs.copy_pack(Pack(pack), folder, "copy"))
    Steps(tmp_path).run("Delete", lambda: packs.bin_pack(made, tmp_path / "deleted"))
    assert [step.name for step in Steps(tmp_path)] == ["Name", "Copy", "Delete"]
    assert [Steps(tmp_path).undo() for _ in "12"] == ["Delete", "Copy"]
    assert sorted(folder.iterdir()) == [made]
    assert (made / "pack.toml").read_bytes() == named
    assert Steps(tmp_path).undo() == "Name"
    assert (made / "pack.toml").read_bytes() == before
    steps = Steps(tmp_path)
    steps.run("Delete", lambda: packs.bin_pack(made, tmp_path / "deleted"))
    (tmp_path / "deleted" / "walls").rename(tmp_path / "gone")
    with pytest.raises(NinjaGameError, match="Delete: not undone, as walls was changed since"):
        Steps(tmp_path).undo()
    assert not Steps(tmp_path), "what is never possible again is not offered again"
    elsewhere = tmp_path / "home"
    Steps(elsewhere).run("Name", lambda: packs.describe(tmp_path / "gone", {"name": "Roofs"}))
    assert not Steps(elsewhere), "a pack elsewhere"
    victim = tmp_path / "victim.txt"
    victim.write_text("a", "utf-8")
    for odd in ("[", "[[1]]", '[["x", [["../..", "victim.txt", "b", "a"]], []]]', '[["x", [], [["../a", "b"]]]]'):
        kept.write_text(odd, "utf-8")
        assert not Steps(tmp_path)
    with patch("ninja_game.editor.pack_steps.UNDO_BYTES", 10):
        steps.run("Copy", lambda: packs.copy_pack(Pack(pack), folder, "copy"))
    assert not Steps(tmp_path), "too much for the disk"
    assert steps.undo() == "Copy"


def test_what_is_not_the_players_own_is_copied_and_a_received_pack_stays(pack: Path, tmp_path: Path) -> None:
    folder = tmp_path / "levels"
    own, goal = (packs.new_pack(folder, name, "me") for name in ("Own", "Goal"))
    (file,) = packs.bring([Pack(pack).levels[FIRST]], own, folder)
    assert FIRST in Pack(pack).levels, "from outside the folder: a copy"
    level = Pack(own).levels[file]
    assert packs.bring([level], own, folder) == [file], "it is there already"
    packs.bring([level], goal, folder)
    assert (len(Pack(own).levels), len(Pack(goal).levels)) == (0, 1)
    received = packs.copy_pack(Pack(goal), folder, "Received", received=True)
    packs.bring([*Pack(received).levels.values()], own, folder)
    assert (len(Pack(own).levels), len(Pack(received).levels)) == (1, 1), "from a received pack: a copy"
    with pytest.raises(NinjaGameError, match="was received, and stays"):
        packs.bring([*Pack(own).levels.values()], received, folder)
    assert len(Pack(own).levels) == 1


def test_levels_go_to_another_pack_with_their_certificates(pack: Path, tmp_path: Path) -> None:
    other = packs.new_pack(tmp_path, "Other", "me")
    level = Pack(pack).levels[LAST]
    assert packs.transfer(level, other, keep=True) == LAST
    assert LAST in Pack(pack).levels
    assert packs.transfer(level, other, keep=False) == "01-2-no-hurry-2.txt"
    assert LAST not in Pack(pack).levels
    assert Pack(pack).problems == []
    assert f"certificates/{LAST[:-4]}-2.exit.replay.txt" in Pack(other).files.names
    packs.rename_level(other / LAST, "Factory")
    copied = packs.duplicate(other, Pack(other).levels[LAST])
    assert [level.name for level in Pack(other).levels.values()] == ["No Hurry", "Factory", "Factory copy"]
    assert copied == "factory-copy.txt"
    packs.duplicate(other, Pack(other).levels[LAST])
    assert "Factory copy 2" in {level.name for level in Pack(other).levels.values()}, "no two have one name"


def test_a_pack_is_made_ready_and_only_what_changed_is_done_again(pack: Path, tmp_path: Path) -> None:
    certificate = pack / "certificates" / "00-0-run-and-hop.exit.replay.txt"
    other = pack / "certificates" / "00-1-stone-to-stone.exit.replay.txt"
    kept = other.stat().st_mtime_ns
    accept_missing_gold(pack)
    certificate.unlink()
    progress_lines: list[str] = []
    ready = prepare_pack(pack, seconds=1.0, jobs=1, say=lambda text, _: progress_lines.append(text))
    assert certificate.exists()
    assert other.stat().st_mtime_ns == kept
    assert "Measuring medal times: 8 of 8 levels" in progress_lines
    # Whether all gold is found in a second depends on the machine.
    findings = [finding for finding in ready.findings if finding.code != "no-gold-run"]
    assert (findings, ready.notes, ready.link[:6]) == ([], [], "#pack=")
    (tmp_path / "pack.zip").write_bytes(ready.zipped)
    assert PackFiles(tmp_path / "pack.zip").names == Pack(pack).files.names
    assert ready.zipped == Pack(pack).files.zipped()


def test_levels_that_take_the_packs_author_are_named(pack: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ready_pack, "compiled_available", lambda: False)
    author = Pack(pack).index.author
    packs.new_level(pack, "Brick", "")
    packs.new_level(pack, "Mortar", "me")
    notes = prepare_pack(pack, seconds=1.0, jobs=1, say=lambda *_: None).notes
    assert f"Without an author, so by the pack's, {author}: Brick" in notes


def test_the_time_that_is_left_goes_by_the_time_that_was_measured(pack: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two levels with two searches each, of 20 s as planned, of which the first takes half as long again."""
    first, second = "00-0-run-and-hop", "00-1-stone-to-stone"
    for file in Pack(pack).levels:
        if not file.startswith((first, second)):
            packs.accept(pack, file, "no-gold-run", "not here")
    for name in (first, second):
        (pack / f"certificates/{name}.exit.replay.txt").unlink()
    now, progress_lines = 0.0, list[tuple[str, float | None]]()

    def certify_all(
        levels: list[NamedLevel], *_: object, report: Callable[[str, Progress], object], **__: object
    ) -> Iterator[object]:
        nonlocal now
        for level in levels:
            for _turn in range(4):
                report(Path(level.file).stem, Progress())
                now += 15
            yield {}

    monkeypatch.setattr("ninja_game.search.certify.certify_all", certify_all)
    monkeypatch.setattr("ninja_game.search.solve.compile_solver", lambda: None)
    monkeypatch.setattr(ready_pack, "monotonic", lambda: now)
    ready_pack._certify(pack, {}, say=lambda text, share: progress_lines.append((text, share)), seconds=20.0, jobs=1)
    first, second = "level 1 of 2, Run and Hop (exit and all gold)", "level 2 of 2, Stone to Stone (exit and all gold)"
    assert [text for text, _ in progress_lines if "so far" in text] == [
        f"Certifying {first}: 0 s so far, about 80 s left",
        f"Certifying {first}: 15 s so far, about 65 s left",
        f"Certifying {first}: 30 s so far, about 50 s left",
        f"Certifying {first}: 45 s so far, about 43 s left",
        f"Certifying {second}: 0 s so far, about 53 s left",
        f"Certifying {second}: 15 s so far, about 32 s left",
        f"Certifying {second}: 30 s so far, about 12 s left",
        f"Certifying {second}: 45 s so far, nearly done",
    ]
    shares = [share for _, share in progress_lines if share is not None]
    assert shares == sorted(shares)


def test_what_follows_from_a_problem_is_no_problem_of_its_own(pack: Path) -> None:
    for name in ("Brick", "Mortar"):
        packs.new_level(pack, name, "me")
    shutil.copy(pack / LAST, pack / "twin.txt")
    lines = (pack / FIRST).read_text("utf-8").splitlines()
    picture = [line.replace("X", ".").replace("x", ".") if re.match(r" *\d+ \|", line) else line for line in lines]
    (pack / FIRST).write_text("\n".join(picture), "utf-8")
    (pack / RUN).unlink()
    level = Pack(pack).levels["brick.txt"].level
    obstacles = {(level, "exit"): level_finding("unreached-exit")}
    codes = {file: list[str]() for file in ("brick.txt", "mortar.txt", "twin.txt", FIRST)}
    for finding in ready_pack.problems_of_pack(Pack(pack), obstacles):
        codes.get(finding.file, []).append(finding.code)
    assert codes == {
        "brick.txt": ["single-level", "no-ninja"],
        "mortar.txt": ["single-level", "no-ninja"],
        "twin.txt": ["single-level", "same-content", "no-certificate"],
        FIRST: ["no-exit", "unseen-message"],
    }


def test_messages_that_are_never_shown_are_problems_of_the_pack_as_they_are_in_the_editor(pack: Path) -> None:
    says = f"after 1 s: {'Long ' * 20}| after 1 s: One | after 2 s: Two | lock: Three | trap: Four"
    text = (pack / FIRST).read_text("utf-8")
    (pack / FIRST).write_text(re.sub("(?m)^says: .*", f"says: {says}", text), "utf-8")
    named, run = Pack(pack).levels[FIRST], read_pack_certificate(Pack(pack), FIRST, "exit")
    assert run
    ours = [finding.odd for finding in lint(Pack(pack)) if finding.file == FIRST and finding.odd]
    theirs = level_problems(named.level, named.says, run.recording.inputs)
    assert ours == theirs
    assert [finding.code for finding in ours] == ["unseen-message", "unseen-message", "late-message"]
    (pack / RUN).unlink()
    assert "late-message" not in [finding.code for finding in lint(Pack(pack))], "no run is known"


def test_what_keeps_a_level_from_a_certificate_is_a_problem_of_the_pack(pack: Path) -> None:
    for file in pack.glob("0[01]-[0-9]-*.txt"):
        if file.name != FIRST:
            packs.place(pack, [file.name], None)
            file.unlink()
    text = (pack / FIRST).read_text("utf-8")
    (pack / FIRST).write_text(text.replace("ox...", "o....").replace("22 |##", "22 |x#"), "utf-8")
    shutil.copy(pack / RUN, pack / RUN.replace("exit", "gold"))
    obstacles: Obstacles = {}
    ready = prepare_pack(pack, seconds=4.0, jobs=1, say=_quiet, obstacles=obstacles)
    reason = "the search found no run to the exit: exit at 30,18 (object 6): the solver never touched its switch"
    assert [finding.text for finding in ready.findings if finding.code == "certificate"] == [reason], "not of gold too"
    level = Pack(pack).levels[FIRST].level
    assert list(obstacles) == [(level, "exit"), (level, "gold")]


@pytest.fixture
def searched(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of levels for which a search, in vain, has looked."""
    names = list[str]()

    def search(levels: list[NamedLevel], *_: object, **__: object) -> list[dict[str, object]]:
        names.extend(level.name for level in levels)
        return [{} for _ in levels]

    monkeypatch.setattr("ninja_game.search.certify.certify_all", search)
    return names


def test_what_was_searched_in_vain_or_is_accepted_is_not_searched_again(pack: Path, searched: list[str]) -> None:
    levels = Pack(pack).levels
    why = level_finding("gold-left", (2,), most=1, never="never gold")
    obstacles: Obstacles = {(named.level, "gold"): why for file, named in levels.items() if file != FIRST}
    packs.accept(pack, FIRST, "no-gold-run", "a joke")
    ready = prepare_pack(pack, seconds=1.0, jobs=1, say=_quiet, obstacles=obstacles)
    assert searched == []
    assert {finding.code for finding in ready.findings} == {"no-gold-run"}
    assert len(ready.problems) == len(levels) - 1
    assert ready.problems[0].text.startswith("the search found no run with all gold: 1 at most were collected at once")
    packs.take_back(pack, FIRST, "no-gold-run")
    assert "accept" not in (pack / "pack.toml").read_text("utf-8")
    prepare_pack(pack, seconds=1.0, jobs=1, say=_quiet, obstacles=obstacles)
    assert searched == ["Run and Hop"]


def test_what_is_looked_for_is_said(pack: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (pack / RUN).unlink()
    other = "01-0-up-and-away.txt"
    for file in Pack(pack).levels:
        if file not in (FIRST, other):
            packs.accept(pack, file, "no-gold-run", "a joke")

    def search(
        levels: list[NamedLevel], *_: object, report: Callable[[str, Progress], None], **__: object
    ) -> list[Any]:
        for each in levels:
            report(Path(each.file).stem, Progress(seconds=2.0))
        return [{} for _ in levels]

    monkeypatch.setattr("ninja_game.search.certify.certify_all", search)
    monkeypatch.setattr("ninja_game.search.solve.is_solver_compiled", lambda: False)
    progress_lines: list[str] = []
    prepare_pack(pack, seconds=1.0, jobs=1, say=lambda text, _: progress_lines.append(text))
    assert progress_lines[0].startswith(
        "Compiling the solver, the first time on a machine a minute or more. You can go on"
    )
    assert progress_lines[1] == "Starting the search", "compiled once, it takes its time too"
    assert progress_lines[2] == "Certifying level 1 of 2, Run and Hop (exit and all gold): 0 s so far, about 3 s left"
    assert {"Certifying: 1 of 2 levels done", "Certifying: 2 of 2 levels done"} < {*progress_lines}


def test_a_broken_certificate_is_a_missing_run_of_its_own_kind(pack: Path, searched: list[str]) -> None:
    for file in Pack(pack).levels:
        packs.accept(pack, file, "no-gold-run", "a joke")
    gold = RUN.replace("exit", "gold")
    shutil.copy(pack / RUN, pack / gold)
    level = Pack(pack).levels[FIRST].level
    obstacles: Obstacles = {
        (level, kind): level_finding("gold-left", (2,), most=1, never=kind) for kind in ("exit", "gold")
    }
    [broken] = [each for each in lint(Pack(pack)) if each.code == "certificate"]
    missing = missing_run(Pack(pack), broken)
    assert missing
    assert obstacles[missing].text.endswith("gold")
    packs.take_back(pack, FIRST, "no-gold-run")
    prepare_pack(pack, seconds=1.0, jobs=1, say=_quiet)
    assert searched == ["Run and Hop"]
    packs.accept(pack, gold, "certificate", "it stays so")
    prepare_pack(pack, seconds=1.0, jobs=1, say=_quiet)
    assert searched == ["Run and Hop"], "what is accepted is not searched again"


def test_the_command_makes_a_pack_ready(pack: Path, tmp_path: Path) -> None:
    accept_missing_gold(pack)
    (pack / FIRST).unlink()
    result = CliRunner().invoke(cli, ["levels", "pack", str(pack), "--seconds", "1"])
    assert result.exit_code == 1
    assert "of no level here" in result.output
    assert f"wrote {tmp_path / 'pack.zip'}\n#pack=" in result.output


def test_undo_leaves_alone_what_others_did_meanwhile(pack: Path, tmp_path: Path) -> None:
    steps, found, before = Steps(tmp_path), pack / RUN, (pack / "pack.toml").read_text("utf-8")

    def action() -> None:
        packs.place(pack, [FIRST], None)
        found.write_text("found meanwhile", "utf-8")

    steps.run("Take out", action)
    assert steps.undo() == "Take out"
    assert (pack / "pack.toml").read_text("utf-8") == before
    assert found.read_text("utf-8") == "found meanwhile"


def test_a_step_that_the_disk_refuses_to_undo_can_be_undone_later(
    pack: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps, other = Steps(tmp_path), packs.new_pack(tmp_path, "Other", "me")
    files = sorted((pack / "certificates").iterdir())
    steps.run("Move", lambda: packs.transfer(Pack(pack).levels[FIRST], other, keep=False))
    write, full = pack_steps.write_file, [True]

    def on_a_full_disk(folder: Path, name: str, text: bytes | str | None) -> None:
        if name == RUN and folder == pack and full:
            raise OSError(28, "No space left on device")
        write(folder, name, text)

    monkeypatch.setattr(pack_steps, "write_file", on_a_full_disk)
    with pytest.raises(OSError, match="No space"):
        steps.undo()
    full.clear()
    assert steps.undo() == "Move"
    assert sorted((pack / "certificates").iterdir()) == files
    assert FIRST in Pack(pack).levels
    assert not Pack(other).levels
