"""Files of the editor: nothing lost on the way, comments kept, nobody's file replaced, drafts found after a crash."""

import json
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

from ninja_game.document import History, OccupiedError, digest_of_file
from ninja_game.editor.draft import Draft
from ninja_game.editor.files import (
    LEVELS_WITH_UNDO,
    UNDO,
    UNDO_BYTES,
    Autosave,
    ascii_text,
    draft_of,
    draft_of_text,
    keep_history,
    kept_history,
    lost_drafts,
    new_source,
    open_source,
    reads_as,
    save,
    updated_text,
)
from ninja_game.editor.motion import Motion
from ninja_game.editor.stamp import Selection, Stamp, everything, moved, removed, with_stamp
from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.bundled import bundled_levels
from ninja_game.files.user_folder import EDITING, free_path
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.named_level import parse_levels
from ninja_game.sim.kinds import GOLD, MINE, NINJA
from ninja_game.sim.level import Level, ObjectSpec
from tests.support.reference import levels, scenes

HAND_WRITTEN = """; A cave that somebody drew.
ninja-game level 1
; who made it
author: somebody
name: Cave

; the picture
|###############################|
|u                             i|
|                               |
|    Z                          |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|                               |
|           ooo                 |
|                               |
|  @..........x.............X...|
|###############################|
|###############################|
|###############################|
; what is special

gold 12,9.5 13,9.5      ; two in the air
; the drone is the last but one on purpose
zap drone 5,4 surface-cw right ; it goes round
mine 300,241px
; the end
"""


def hand_written(folder: Path, text: str = HAND_WRITTEN) -> Path:
    path = folder / "cave.txt"
    path.write_text(text, "utf-8")
    return path


def same(a: Level, b: Level) -> bool:
    return level_digest(a) == level_digest(b) and repr(a.objects) == repr(b.objects) and a.tiles == b.tiles


def through_the_model(level: Level) -> Level:
    """A level opened, moved there and back, undone, and written."""
    history = History(Draft(level, "a name"))
    history.change(moved(history.draft, everything(history.draft), Motion(dx=24.0))[0])
    history.change(removed(history.draft, everything(history.draft)))
    while history.undo():
        pass
    return parse_levels(ascii_text(history.draft))[0].level


@pytest.mark.slow
def test_reference_levels_and_scenes_come_back_to_the_bit() -> None:
    for data in [*(row.data for row in levels()), *(row.data for row in scenes())]:
        level = parse_level_string(data)
        assert same(through_the_model(level), level), data


@pytest.mark.parametrize("path", bundled_levels(), ids=lambda path: path.stem)
def test_our_levels_come_back_with_every_letter(path: Path, tmp_path: Path) -> None:
    copy = tmp_path / path.name
    copy.write_bytes(path.read_bytes())
    source = open_source(copy)
    assert save(source, source.draft, copy) is source
    assert copy.read_bytes() == path.read_bytes()
    elsewhere = save(source, source.draft, tmp_path / "other.txt").path
    assert elsewhere
    assert same(load_levels(elsewhere)[0].level, source.draft.level)
    history = History(source.draft)
    history.change(with_stamp(source.draft, Stamp({(30, 2): 5}, (ObjectSpec(GOLD, (700.0, 61.5)),))))
    save(source, history.draft, copy)
    assert same(load_levels(copy)[0].level, history.draft.level)
    kept = [line for line in path.read_text("utf-8").splitlines() if line not in copy.read_text("utf-8").splitlines()]
    assert len(kept) <= 2
    history.undo()
    save(open_source(copy), history.draft, copy)
    assert same(load_levels(copy)[0].level, source.draft.level)


def lost_lines(before: str, after: str) -> list[str]:
    lines = after.split("\n")
    return [line for line in before.split("\n") if line not in lines]


def test_comments_order_and_blanks_of_a_hand_written_level_stay(tmp_path: Path) -> None:
    source = open_source(hand_written(tmp_path))
    draft = source.draft
    more = with_stamp(draft, Stamp({(9, 9): 1}, (ObjectSpec(MINE, (500.0, 100.0)),)))
    text = updated_text(HAND_WRITTEN, draft, more)
    assert reads_as(text, more)
    assert not lost_lines(HAND_WRITTEN, text)
    assert "mine 500,100px" in text
    assert text.count("|        #                      |") == 1
    renamed = replace(more, name="Hollow", comment="wet")
    text = updated_text(HAND_WRITTEN, draft, renamed)
    assert lost_lines(HAND_WRITTEN, text) == ["name: Cave"]
    assert "name: Hollow\ncomment: wet\n" in text


def test_a_line_loses_only_what_was_deleted(tmp_path: Path) -> None:
    source = open_source(hand_written(tmp_path))
    draft = source.draft
    number = next(k for k, record in enumerate(draft.objects) if record.values[1] == 24.0 * 9.5 + 12.0)
    less = removed(draft, Selection(parts=frozenset({(number, 0)})))
    text = updated_text(HAND_WRITTEN, draft, less)
    assert "gold 13,9.5  ; two in the air" in text
    assert lost_lines(HAND_WRITTEN, text) == ["gold 12,9.5 13,9.5      ; two in the air"]
    swapped = draft.with_objects(tuple(reversed(draft.objects)))
    text = updated_text(HAND_WRITTEN, draft, swapped)
    assert reads_as(text, swapped)
    assert not [line for line in HAND_WRITTEN.split("\n") if line.startswith(";") and line not in text]


def test_line_ends_of_windows_stay(tmp_path: Path) -> None:
    path = tmp_path / "cave.txt"
    path.write_bytes(HAND_WRITTEN.replace("\n", "\r\n").encode())
    source = open_source(path)
    save(source, source.draft.with_tiles({(9, 9): 1}), path)
    assert path.read_bytes().count(b"\n") == path.read_bytes().count(b"\r\n") > 30


def test_nobodys_file_is_replaced_without_asking(tmp_path: Path) -> None:
    path = hand_written(tmp_path)
    source = open_source(path)
    draft = source.draft.with_tiles({(9, 9): 1})
    path.write_text(HAND_WRITTEN.replace("somebody", "me"), "utf-8")
    with pytest.raises(OccupiedError, match=r"another program has changed cave.txt"):
        save(source, draft, path)
    other = tmp_path / "other.txt"
    other.write_text("mine")
    with pytest.raises(OccupiedError, match=r"a file named other.txt already exists"):
        save(source, draft, other)
    assert other.read_text() == "mine"
    source = save(source, draft, path, replacing=True)
    again = draft.with_tiles({(9, 9): 0})
    assert same(load_levels(save(source, again, path).path or "")[0].level, again.level)


def test_a_level_of_n_is_saved_as_a_file_of_ours(tmp_path: Path) -> None:
    path = tmp_path / "some.nlevel"
    level = with_stamp(Draft(Level()), Stamp({(3, 3): 9}, (ObjectSpec(NINJA, (36.0, 36.0)),))).level
    path.write_text(f"{write_level_string(level)}\n{write_level_string(Level(objects=level.objects))}\n")
    source = open_source(path, 0)
    assert source.path is None
    assert open_source(path, 1).draft.tile((3, 3)) == 0
    saved = save(source, source.draft, free_path(tmp_path, "some", ".txt"))
    assert saved.path == tmp_path / "some.txt"
    assert free_path(tmp_path, "some", ".txt") == tmp_path / "some-2.txt"
    assert same(open_source(saved.path).draft.level, level)
    with pytest.raises(LevelError, match="there is no record 2"):
        open_source(path, 2)


def test_strings_of_n_go_out_and_in(tmp_path: Path) -> None:
    draft = open_source(hand_written(tmp_path)).draft
    text = write_level_string(draft.level, exact=True)
    back = draft_of_text(f"  {text}\r\n\0", new_source("me").draft)
    assert same(back.level, draft.level)
    assert back.author == "me"
    with pytest.raises(NinjaGameError):
        draft_of_text("hello", draft)


# --- autosave ---


def test_an_autosave_is_found_only_after_its_editor_has_died(tmp_path: Path) -> None:
    path = hand_written(tmp_path)
    source = open_source(path)
    draft = source.draft.with_tiles({(9, 9): 1})
    autosave = Autosave(tmp_path)
    autosave.poll(History(source.draft), source)
    assert not (tmp_path / EDITING).exists()
    autosave.poll(History(draft), source)
    autosave.job.finish()
    assert not autosave.problem
    assert not list(lost_drafts(tmp_path))
    autosave.close(keep=True)
    found = list(lost_drafts(tmp_path))
    assert [one.draft for one in found] == [draft]
    assert found[0].source == source
    path.write_text(HAND_WRITTEN.replace("somebody", "me"), "utf-8")
    later = next(iter(lost_drafts(tmp_path)))
    with pytest.raises(OccupiedError):
        save(later.source, later.draft, path)
    found[0].forget()
    assert not list((tmp_path / EDITING).iterdir())


def kept(folder: Path, path: Path | str, digest: str, name: str = "a") -> None:
    """An autosave that names a path, whoever wrote it."""
    (folder / EDITING).mkdir(exist_ok=True)
    level = ascii_text(new_source().draft.with_tiles({(9, 9): 1}))
    (folder / EDITING / f"{name}.json").write_text(json.dumps({"path": str(path), "digest": digest, "level": level}))


def test_an_autosave_knows_no_file_but_a_level_that_is_there(tmp_path: Path) -> None:
    other = tmp_path / "profile"
    other.write_text("# what every machine has, of a known digest\n")
    (tmp_path / "dangling").symlink_to(tmp_path / "nothing")
    for path in (tmp_path / "missing", other, tmp_path / "dangling", tmp_path, "/dev/null", "a\0b"):
        kept(tmp_path, path, digest_of_file(other))
        (found,) = lost_drafts(tmp_path)
        assert found.source.path is None
    path = hand_written(tmp_path)
    kept(tmp_path, path, "0" * 64)
    (found,) = lost_drafts(tmp_path)
    assert found.source.path == path
    with pytest.raises(OccupiedError, match="another program has changed"):
        save(found.source, found.draft, path)


def test_a_file_that_has_gone_meanwhile_is_not_made_again_without_asking(tmp_path: Path) -> None:
    path = hand_written(tmp_path)
    source = open_source(path)
    path.unlink()
    with pytest.raises(OccupiedError, match=r"another program has removed cave\.txt"):
        save(source, source.draft.with_tiles({(9, 9): 1}), path)
    assert save(source, source.draft, path, replacing=True).path == path
    link = tmp_path / "link.txt"
    link.symlink_to(tmp_path / "nothing")
    with pytest.raises(OccupiedError, match=r"a file named link\.txt already exists"):
        save(new_source(), source.draft, link)


def test_an_autosave_names_its_file_wherever_the_next_editor_starts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    hand_written(tmp_path)
    monkeypatch.chdir(tmp_path)
    source = open_source(Path("cave.txt"))
    autosave = Autosave(tmp_path)
    autosave.flush(History(source.draft.with_tiles({(9, 9): 1})), source)
    autosave.close(keep=True)
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    hand_written(tmp_path / "elsewhere")
    assert [found.source.path for found in lost_drafts(tmp_path)] == [tmp_path / "cave.txt"]


def test_an_autosave_goes_when_the_draft_is_saved_or_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.editor.files._SPACING", 0.0)
    source = new_source()
    draft = source.draft.with_tiles({(9, 9): 1})
    autosave = Autosave(tmp_path)
    autosave.poll(History(draft), source)
    autosave.job.finish()
    assert list((tmp_path / EDITING).glob("*.json"))
    autosave.poll(History(draft), save(source, draft, tmp_path / "a.txt"))
    autosave.job.finish()
    assert not list((tmp_path / EDITING).glob("*.json"))
    autosave.poll(History(draft.with_tiles({(1, 1): 1})), source)
    autosave.close()
    assert not list((tmp_path / EDITING).iterdir())


def test_a_damaged_autosave_and_a_folder_that_cannot_be_written_stop_nothing(tmp_path: Path) -> None:
    (tmp_path / EDITING).mkdir()
    for number, text in enumerate(("", "{}", "[1]", "[" * 100_000, '{"path": 3, "level": "x", "digest": ""}')):
        (tmp_path / EDITING / f"{number}.json").write_text(text)
    assert not list(lost_drafts(tmp_path))
    blocked = tmp_path / "file"
    blocked.write_text("")
    autosave = Autosave(blocked)
    autosave.poll(History(new_source().draft.with_tiles({(9, 9): 1})), new_source())
    autosave.job.finish()
    assert "cannot be kept safe" in autosave.problem
    autosave.close()


def test_the_newest_histories_are_kept_by_content_and_damaged_ones_are_new(tmp_path: Path) -> None:
    drafts = [Draft(Level(), f"{number}") for number in range(4)]
    history = History(drafts[2], drafts[:2], drafts[3:])
    for number in range(LEVELS_WITH_UNDO + 5):
        keep_history(tmp_path, f"{number}", history)
    files = list((tmp_path / EDITING / UNDO).iterdir())
    assert len(files) == LEVELS_WITH_UNDO
    assert not kept_history(tmp_path, "0", drafts[2]).can_undo
    again = kept_history(tmp_path, "54", drafts[2])
    assert again.draft == drafts[2]
    assert again.steps(9) == history.steps(9)
    texts: list[object] = [
        None,
        "",
        "[" * 99,
        [[], [], []],
        [[[[0], [], *"nacts"]], [], []],
        [[[*Draft(Level(), says="?").as_json()]], [], []],
    ]
    for damaged in (text if isinstance(text, str) else json.dumps(text) for text in texts):
        for file in files:
            file.write_text(damaged)
        assert kept_history(tmp_path, "54", drafts[0]).steps(9) == ([], [])


def test_the_history_of_a_crowded_level_is_kept_up_to_a_size(tmp_path: Path) -> None:
    crowd = tuple(ObjectSpec(GOLD, (24.0 * k % 700, 24.0)) for k in range(5000))
    drafts = [Draft(Level(objects=crowd), f"{number}") for number in range(100)]
    keep_history(tmp_path, "crowd", History(drafts[-1], drafts[:-1]))
    (file,) = (tmp_path / EDITING / UNDO).iterdir()
    assert file.stat().st_size < 2 * UNDO_BYTES
    assert kept_history(tmp_path, "crowd", drafts[-1]).steps(1) == ([drafts[-2]], [])


KILLED = """
import sys, time
from pathlib import Path
from ninja_game.document import History
from ninja_game.editor.files import Autosave
from ninja_game.editor.files import new_source
source = new_source()
autosave = Autosave(Path(sys.argv[1]))
for number in range(34 * 34):
    autosave.poll(History(source.draft.with_tiles({(1, 1): number // 34, (2, 1): number % 34, (3, 1): 1})), source)
    print(number, flush=True)
    time.sleep(0.05)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_after_kill_9_at_most_two_seconds_are_lost(tmp_path: Path, root: Path) -> None:
    command = [sys.executable, "-c", KILLED, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, cwd=root, text=True) as child:
        assert child.stdout
        while not list((tmp_path / EDITING).glob("*.json")):
            assert child.poll() is None
            child.stdout.readline()
        time.sleep(1.0)
        child.kill()
        child.wait()
        last = int(child.stdout.read().split()[-1])
    draft = next(iter(lost_drafts(tmp_path))).draft
    assert 0 <= last - (34 * draft.tile((1, 1)) + draft.tile((2, 1))) <= 2.0 / 0.05


def test_a_draft_says_what_its_file_said() -> None:
    named = load_levels(bundled_levels()[0])[0]
    draft = draft_of(named)
    for each in ("name", "author", "comment", "teaches", "says"):
        assert getattr(draft, each) == getattr(named, each)


def test_what_a_level_teaches_is_written_read_and_kept_beside_the_rest(tmp_path: Path) -> None:
    source = open_source(hand_written(tmp_path))
    path = hand_written(tmp_path)
    saved = save(source, replace(source.draft, teaches="Jump off a slope: it throws you"), path)
    assert path.read_text("utf-8") == HAND_WRITTEN.replace(
        "name: Cave\n", "name: Cave\nteaches: Jump off a slope: it throws you\n"
    )
    assert open_source(path).draft == saved.draft
    save(saved, replace(saved.draft, teaches="", comment="a line"), path)
    assert open_source(path).draft == replace(source.draft, comment="a line")
