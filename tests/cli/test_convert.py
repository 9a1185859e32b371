"""`ninja-game convert`: there and back gives the same levels."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from ninja_game.cli.main import cli
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.runs.verify import verify_recording
from tests.support.forgeries import WALKING, record
from tests.support.samples import SPIKED, WALK, WALK_END, running, write_records

TINY = "\n".join(
    ["ninja-game level 1", "name: Tiny", "author: me", "; a note", *["|" + "." * 31 + "|"] * 22, "|@" + "." * 30 + "|",
     "mine 5.5,7 ; watch out", ""]
)  # fmt: skip


def convert(*words: str | Path) -> Result:
    """`ninja-game convert WORDS…`."""
    return CliRunner().invoke(cli, ["convert", *map(str, words)])


def test_string_becomes_ascii_and_comes_back_equal(tmp_path: Path) -> None:
    source, picture, back = tmp_path / "walk.nlevel", tmp_path / "walk.txt", tmp_path / "back.nlevel"
    source.write_text(WALK + "\n")
    assert convert(source, picture).exit_code == 0
    assert load_levels(picture)[0].ascii
    assert convert(picture, back).exit_code == 0
    assert back.read_text() == WALK + "\n"


def test_file_of_many_becomes_a_folder_and_comes_back_equal(tmp_path: Path) -> None:
    source, folder, back = tmp_path / "many.txt", tmp_path / "many", tmp_path / "back.txt"
    write_records(source, ("Walk / run", WALK, ""), ("", SPIKED, ""))
    assert convert(source, folder).exit_code == 0
    assert [path.name for path in sorted(folder.iterdir())] == ["000-walk-run.txt", "001.txt"]
    assert convert(folder, back).exit_code == 0
    assert [level.level for level in load_levels(back)] == [level.level for level in load_levels(source)]
    assert load_levels(back)[0].name == "Walk / run"


def test_terminal_is_a_target(tmp_path: Path) -> None:
    source = write_records(tmp_path / "walk.txt", ("Walk", WALK, ""))
    result = convert(source, "-", "--legend")
    assert result.exit_code == 0
    assert "name: Walk" in result.stdout
    assert "LEGEND" in result.stdout
    assert convert(source, "-", "--to", "string").stdout == WALK + "\n"


@pytest.mark.parametrize("form", ["ascii", "string", "file"])
def test_form_can_be_chosen(form: str, tmp_path: Path) -> None:
    source = write_records(tmp_path / "walk.txt", ("Walk", WALK, ""))
    assert convert(source, tmp_path / "out", "--to", form).exit_code == 0
    assert load_levels(tmp_path / "out")[0].form == form


def test_many_levels_do_not_overwrite_one_file(tmp_path: Path) -> None:
    source = write_records(tmp_path / "many.txt", ("a", WALK, ""), ("b", SPIKED, ""))
    target = tmp_path / "one.txt"
    target.write_text("mine")
    result = convert(source, target)
    assert result.exit_code == 2
    assert result.stderr.startswith(f"ninja-game: {target}: 2 levels do not fit into one file")
    assert target.read_text() == "mine"


@pytest.mark.parametrize("text", ["", "hello\nworld\n", "ninja-game level 1\n|??|\n", "$a#b#"])
def test_unreadable_input_names_the_file(text: str, tmp_path: Path) -> None:
    source = tmp_path / "odd.txt"
    source.write_text(text)
    result = convert(source, tmp_path / "out")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(f"ninja-game: {source}")
    assert not (tmp_path / "out").exists()


def test_missing_input_is_wrong_usage(tmp_path: Path) -> None:
    result = convert(tmp_path / "gone.txt", "-")
    assert result.exit_code == 2
    assert "gone.txt" in result.stderr


def test_a_recording_of_n_becomes_a_replay_and_comes_back(tmp_path: Path) -> None:
    source = write_records(tmp_path / "tas.txt", ("Walk", WALK, running(60)))
    replay, back = tmp_path / "tas.replay.txt", tmp_path / "back.demo"
    assert convert(source, replay).exit_code == 0
    (recording,) = load_replays(replay)
    assert recording.replay
    assert (recording.name, recording.replay.outcome, recording.replay.final_tick) == ("Walk", "exit", WALK_END)
    assert verify_recording(recording).good
    assert convert(replay, back).exit_code == 0
    assert verify_recording(load_replays(back)[0]).end_tick == WALK_END
    assert load_levels(back)[0].level == load_levels(source)[0].level


@pytest.mark.parametrize("name", ["run.replay.txt", "run.inputs.txt"])
def test_the_maker_of_a_level_does_not_become_the_player_of_a_run(name: str, tmp_path: Path) -> None:
    """A record of N has one name, its level's maker's."""
    source = write_records(tmp_path / "tas.txt", ("Walk", WALK, running(60)))
    (before,) = load_replays(source)
    assert before.author
    assert convert(source, tmp_path / name).exit_code == 0
    (after,) = load_replays(tmp_path / name)
    assert (after.author, after.replay.level_author) == ("", before.author)


def test_a_run_that_goes_on_keeps_its_length_there_and_back(tmp_path: Path) -> None:
    source = write_records(tmp_path / "tas.txt", ("Walk", WALK, running(20)))
    first, second = tmp_path / "first.replay.txt", tmp_path / "second.replay.txt"
    assert convert(source, first).exit_code == 0
    assert convert(first, tmp_path / "back.demo").exit_code == 0
    assert convert(tmp_path / "back.demo", second).exit_code == 0
    assert first.read_text() == second.read_text()


def test_a_replay_edited_by_hand_is_recorded_again(tmp_path: Path) -> None:
    source = write_records(tmp_path / "tas.txt", ("Walk", WALK, running(60)))
    edited, new = tmp_path / "edited.replay.txt", tmp_path / "new.replay.txt"
    assert convert(source, edited).exit_code == 0
    text = edited.read_text().replace(f"final-tick: {WALK_END}", "final-tick: 500").replace("  R*", "  .*10 R*")
    edited.write_text(text)
    assert not verify_recording(load_replays(edited)[0]).good
    assert convert(edited, new).exit_code == 0
    (recording,) = load_replays(new)
    assert recording.replay
    assert recording.replay.final_tick == WALK_END + 10
    assert verify_recording(recording).good


def test_many_recordings_become_a_folder_of_replays(tmp_path: Path) -> None:
    source = write_records(tmp_path / "two.txt", ("A", WALK, running(60)), ("B", WALK, running(30)))
    assert convert(source, tmp_path / "out", "--to", "replay").exit_code == 0
    assert [path.name for path in sorted((tmp_path / "out").iterdir())] == ["000-a.replay.txt", "001-b.replay.txt"]
    result = convert(source, tmp_path / "out.replay.txt")
    assert "2 recordings do not fit into one file" in result.stderr


def test_recordings_of_several_files_keep_whose_they_were_in_their_names(tmp_path: Path) -> None:
    runs = tmp_path / "runs"
    runs.mkdir()
    for name in ("ann.speedrun", "bob"):
        write_records(runs / f"{name}.txt", ("Walk", WALK, running(60)), ("Walk", WALK, running(30)))
    assert convert(runs, tmp_path / "out", "--to", "replay").exit_code == 0
    assert [path.name for path in sorted((tmp_path / "out").iterdir())] == [
        "000-ann.speedrun-walk.replay.txt", "001-ann.speedrun-walk.replay.txt",
        "002-bob-walk.replay.txt", "003-bob-walk.replay.txt",
    ]  # fmt: skip


def test_recordings_are_kept_by_a_level_file_and_reported_where_they_are_not(tmp_path: Path) -> None:
    source = write_records(tmp_path / "two.txt", ("A", WALK, running(60)), ("B", SPIKED, ""))
    assert convert(source, tmp_path / "copy.txt", "--to", "file").stderr == ""
    assert (tmp_path / "copy.txt").read_text() == source.read_text()
    result = convert(source, tmp_path / "levels")
    assert "left out: the recordings (--to replay or --to file keeps them)" in result.stderr


def test_a_recording_without_its_level_takes_one(tmp_path: Path) -> None:
    source, level = tmp_path / "demo.txt", tmp_path / "walk.nlevel"
    source.write_text(f"$Walk####{running(60)}#\n")
    level.write_text(WALK)
    assert convert(source, tmp_path / "a.replay.txt").exit_code == 2
    assert convert(source, tmp_path / "a.replay.txt", "--level", level).exit_code == 0
    assert verify_recording(load_replays(tmp_path / "a.replay.txt")[0]).outcome == "exit"
    assert convert(source, tmp_path / "a.demo", "--level", level).exit_code == 0
    assert load_levels(tmp_path / "a.demo")[0].level == load_levels(level)[0].level
    assert convert(source, tmp_path / "a", "--level", level, "--to", "ascii").exit_code == 2


def test_input_is_never_replaced_and_other_files_only_by_force(tmp_path: Path) -> None:
    source, target = tmp_path / "mine.txt", tmp_path / "theirs.txt"
    source.write_text(TINY)
    target.write_text("theirs")
    for words in ((), ("--force",)):
        result = convert(source, source, *words)
        assert (result.exit_code, "the output is the input" in result.stderr) == (2, True)
    assert "already exists; --force replaces it" in convert(source, target).stderr
    assert (source.read_text(), target.read_text()) == (TINY, "theirs")
    assert convert(source, target, "--force").exit_code == 0
    assert target.read_text().startswith("$Tiny#me##")


def test_what_the_other_format_cannot_hold_is_reported(tmp_path: Path) -> None:
    source = tmp_path / "mine.txt"
    source.write_text(TINY)
    assert (
        convert(source, tmp_path / "a.nlevel").stderr
        == "left out: names, authors and comments of levels, comment lines\n"
    )
    assert convert(source, tmp_path / "a.txt", "--to", "file").stderr == "left out: comment lines\n"
    assert convert(tmp_path / "a.txt", tmp_path / "b.txt").stderr == ""


def test_what_a_level_teaches_is_kept_in_readable_levels_and_missed_in_those_of_n(tmp_path: Path) -> None:
    source = tmp_path / "mine.txt"
    source.write_text(TINY.replace("author: me\n", "author: me\nteaches: patience\n"))
    assert convert(source, tmp_path / "b.txt", "--to", "ascii").stderr == "left out: comment lines\n"
    assert "\nteaches: patience\n" in (tmp_path / "b.txt").read_text()
    assert (
        convert(tmp_path / "b.txt", tmp_path / "a.txt", "--to", "file").stderr
        == "left out: what levels teach and say\n"
    )
    source.write_text(TINY.replace("mine 5.5,7 ; watch out", "mine 1.15,7px"))
    assert "the last bit of some numbers" in convert(source, tmp_path / "c.txt").stderr


def test_several_files_make_a_pack(tmp_path: Path) -> None:
    first, second, pack = tmp_path / "a.txt", tmp_path / "b.txt", tmp_path / "pack.txt"
    first.write_text(TINY)
    second.write_text(TINY.replace("Tiny", "Other"))
    assert convert(first, second, pack).exit_code == 0
    assert [level.name for level in load_levels(pack)] == ["Tiny", "Other"]


def test_a_missing_folder_is_named_without_temporary_names(tmp_path: Path) -> None:
    source = write_records(tmp_path / "walk.txt", ("Walk", WALK, ""))
    target = tmp_path / "gone" / "out.txt"
    assert convert(source, target).stderr == f"ninja-game: {target}: No such file or directory\n"


def test_who_made_a_demo_can_be_said(tmp_path: Path) -> None:
    """Of those that do not say it alone; the maker of the level stays that."""
    source = tmp_path / "demo.txt"
    source.write_text(record(WALKING), "utf-8")
    maker = load_replays(source)[0].level_author
    assert convert(source, tmp_path / "one.replay.txt", "--author", "\udce4 Ann\n").exit_code == 0
    (run,) = load_replays(tmp_path / "one.replay.txt")
    assert (run.player, run.level_author) == ("\\udce4 Ann", maker)
    assert verify_recording(run).problems == ()
    assert convert(tmp_path / "one.replay.txt", tmp_path / "two.replay.txt", "--author", "Bob").exit_code == 0
    assert load_replays(tmp_path / "two.replay.txt")[0].player == run.player
    result = convert(source, tmp_path / "three.demo", "--author", "Ann")
    assert (result.exit_code, "--author is for recordings: add --to replay" in result.stderr) == (2, True)
