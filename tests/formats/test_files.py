"""Any file of levels or recordings is recognised by its text, whatever it is called."""

import os
import time
from contextlib import suppress
from pathlib import Path

import pytest

from ninja_game.errors import DemoError, FileError, LevelError, NinjaGameError, ReplayError
from ninja_game.files.bundled import bundled_levels
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.load import load_levels, load_replays, parse_level
from ninja_game.formats.n14.level_file import LevelRecord, write_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.named_level import parse_levels
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import Replay, write_replay
from tests.support.special_files import needs_special_files

TEXT = "0" * 713 + "|5^60,540!0^396,300!11^708,540,396,540"
OTHER = "0" * 712 + "1|5^84,540"
LEVEL = parse_level_string(TEXT)
DEMO = "2:193"


def saved(folder: Path, text: str, name: str = "some file") -> Path:
    path = folder / name
    path.write_bytes(text.encode())
    return path


def test_ascii_levels(tmp_path: Path) -> None:
    path = saved(tmp_path, write_ascii_level(LEVEL, name="A hill, $5 #1 | b", author="us"))
    (level,) = load_levels(path)
    assert (level.name, level.author, level.level, level.form) == ("A hill, $5 #1 | b", "us", LEVEL, "ascii")


def test_level_files(tmp_path: Path) -> None:
    path = saved(tmp_path, f"free\n$a#us#x#{TEXT}#\n$b#us#y#{OTHER}#{DEMO}#\n")
    first, second = load_levels(str(path))
    assert (first.name, first.author, first.comment, first.level) == ("a", "us", "x", LEVEL)
    assert (second.record, second.line, second.file, second.form) == (1, 3, str(path), "file")


@pytest.mark.parametrize("text", [TEXT, TEXT + "\r\n", "\n" + TEXT[:400] + "\n" + TEXT[400:730] + "\r" + TEXT[730:]])
def test_in_game_strings_wrapped_or_not(tmp_path: Path, text: str) -> None:
    (level,) = load_levels(saved(tmp_path, text, "hill.level"))
    assert (level.name, level.level, level.form) == ("hill", LEVEL, "string")


def test_in_game_strings_one_a_line(tmp_path: Path) -> None:
    levels = load_levels(saved(tmp_path, f"{TEXT}\n\n{OTHER}\n"))
    assert [(level.record, level.line, level.level) for level in levels] == [
        (0, 1, LEVEL),
        (1, 3, parse_level_string(OTHER)),
    ]


def test_a_single_in_game_string_is_read_as_the_game_reads_it(tmp_path: Path) -> None:
    text = "0" * 275 + "|5^ 300,446!0^685 ,446"
    (level,) = load_levels(saved(tmp_path, text))
    assert level.level == parse_level_string(text)


def test_folders_are_searched_in_order_hidden_and_foreign_files_left_out(tmp_path: Path) -> None:
    for name in ("b.txt", "a.txt", "sub/c.level", ".hidden.txt", ".git/d.txt", "notes.md"):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        saved(path.parent, TEXT, path.name)
    assert [level.name for level in load_levels(tmp_path)] == ["a", "b", "c"]


def test_an_empty_folder_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(LevelError, match="no levels here"):
        load_levels(tmp_path)
    with pytest.raises(ReplayError, match="no recordings here"):
        load_replays(tmp_path)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "latin-1"])
def test_text_in_any_usual_encoding(tmp_path: Path, encoding: str) -> None:
    path = tmp_path / "levels"
    path.write_bytes(f"$né#us##{TEXT}#".encode(encoding))
    assert load_levels(path)[0].name == "né"


@pytest.mark.parametrize(
    "data, message",
    [
        (b"", "an empty file"),
        (b"\n \n", "an empty file"),
        (b"hello\nworld", r":1: not a level in any format.*found 'hello"),
        (b"| a | table |\n|---|---|\n", "not a level in any format"),
        (b"\x89PNG\r\n\x1a\n\0\0", "not a text file"),
        (b"$a#b#c##", ":1: record 0 has no level string"),
        (b"$###" + DEMO.encode() + b"#", "recordings without their levels"),
        (b"ninja-game level 1\nhello", "some"),
        (b"ninja-game replay 3\nhello", "not a header line"),
    ],
)
def test_what_is_not_a_level_is_refused_with_the_files_name(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "some.txt"
    path.write_bytes(data)
    with pytest.raises(NinjaGameError, match=message) as caught:
        load_levels(path)
    assert str(path) in str(caught.value)


def test_a_file_that_is_far_too_large_is_not_read(tmp_path: Path) -> None:
    path = tmp_path / "big"
    with path.open("wb") as file:
        os.truncate(file.fileno(), 70 * 2**20)
    with pytest.raises(FileError, match="too large"):
        load_levels(path)


# --- Recordings ---


def test_recordings_of_n(tmp_path: Path) -> None:
    records = [LevelRecord("a", "us", "x", TEXT, DEMO), LevelRecord("", "", "", TEXT, "3:0")]
    first, second = load_replays(saved(tmp_path, write_level_file(records)))
    assert (first.name, first.author, first.comment, first.level) == ("a", "us", "x", LEVEL)
    assert (first.ticks, first.replay.playback(5)) == (3, bytes([1, 12, 12, 0, 0]))
    assert (second.record, second.line, second.ticks, second.form) == (1, 2, 4, "file")
    assert first.level is second.level


def test_a_raw_level_in_a_recording_plays_as_the_game_reads_it(tmp_path: Path) -> None:
    text = "0" * 713 + "|5^ 300,446!0^685 ,446! 0^3,4"
    (recording,) = load_replays(saved(tmp_path, f"$###{text}#{DEMO}#"))
    assert recording.level == parse_level_string(text)


def test_recordings_without_level_need_one(tmp_path: Path) -> None:
    for text in (f"##{DEMO}#", DEMO + "\n"):
        path = saved(tmp_path, text)
        assert load_replays(path, level=LEVEL)[0].level is LEVEL
        with pytest.raises(ReplayError, match=":1: record 0 leaves its level out; give it with --level"):
            load_replays(path)


def test_replays_of_ours(tmp_path: Path) -> None:
    replay = Replay(bytes([2, 2, 14]), 7, "running", level=LEVEL, level_digest=level_digest(LEVEL), name="walk")
    (recording,) = load_replays(saved(tmp_path, write_replay(replay)))
    assert (recording.name, recording.level, recording.replay, recording.record) == ("walk", LEVEL, replay, 0)
    # Unlike in a demo nothing is repeated after the last input.
    assert (recording.ticks, recording.replay.playback(8)) == (8, bytes([2, 2, 14, 0, 0, 0, 0, 0]))


def test_a_replay_finds_its_level_below_its_own_folder(tmp_path: Path) -> None:
    (tmp_path / "levels").mkdir()
    saved(tmp_path / "levels", f"$a###{OTHER}#\n$b###{TEXT}#", "two.txt")
    replay = Replay(b"", 0, "running", level_path="levels/two.txt", level_record=1, level_digest=level_digest(LEVEL))
    path = saved(tmp_path, write_replay(replay))
    assert load_replays(path)[0].level == LEVEL
    assert load_levels(path)[0].level == LEVEL


def test_a_replay_without_its_level_is_of_the_game_s_own_level_that_it_names_by_its_digest(tmp_path: Path) -> None:
    own = load_levels(bundled_levels()[0])[0].level
    path = saved(tmp_path, write_replay(Replay(b"", 0, "running", level_digest=level_digest(own))))
    assert load_replays(path)[0].level == own


@pytest.mark.parametrize(
    "name",
    [
        *("../secret.txt", "/etc/passwd", "link/secret.txt", "../inside/../secret.txt"),
        pytest.param("pipe", marks=needs_special_files),
    ],
)
def test_a_replay_reads_nothing_but_files_of_its_own_folder(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "inside"
    folder.mkdir()
    (folder / "link").symlink_to(tmp_path)
    if name == "pipe":
        os.mkfifo(folder / name)
    saved(tmp_path, "the secret", "secret.txt")
    path = saved(folder, write_replay(Replay(b"", 0, "dead", level_path=name)))
    with pytest.raises(ReplayError, match="level is not here") as caught:
        load_replays(path)
    assert "the secret" not in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [TEXT, f"$a###{TEXT}#", f"free\n$a###{TEXT}#{DEMO}#", write_ascii_level(LEVEL),
     write_replay(Replay(b"", 0, "dead", level=LEVEL)), TEXT.replace("|", "\n|")],
    ids=["string", "level file", "recording", "ASCII", "replay", "wrapped"],
)  # fmt: skip
def test_a_text_of_any_format_is_a_level(text: str) -> None:
    assert parse_level(text) == LEVEL


def test_a_text_of_several_levels_gives_the_one_that_is_asked_for() -> None:
    assert parse_level(f"$a###{TEXT}#\n$b###{OTHER}#", 1) == parse_level_string(OTHER)
    with pytest.raises(LevelError, match="there is no record 2; expected 0 to 1"):
        parse_level(f"$a###{TEXT}#\n$b###{OTHER}#", 2)


@pytest.mark.parametrize("text", ["", "hello", "hello|12", "a | b", "x" * 800 + "|5^60,60", "|", "{}", "0" * 713])
def test_a_text_that_is_plainly_no_level_is_refused(text: str) -> None:
    with pytest.raises(LevelError, match=r"not a level|an empty file"):
        parse_level(text)


BULK = {
    "blank lines": "\n" * 2**21,
    "blanks": " " * 2**21,
    "lines of blanks": " \n" * 2**20,
    "comments": ";\n" * 2**19,
    "returns": "\r" * 2**21,
    "dollars": "$" * 2**20,
    "a level below blank lines": "\n" * 2**21 + TEXT,
}


@pytest.mark.parametrize("name", BULK)
def test_megabytes_of_nothing_take_no_time(name: str) -> None:
    for read in (parse_levels, parse_replays):
        started = time.process_time()
        with suppress(NinjaGameError):
            read(BULK[name])
        assert time.process_time() - started < 3


@pytest.mark.parametrize(
    "replay, message",
    [
        (Replay(b"", 0, "dead", level_path="nowhere.txt"), "the replay's level is not here; found 'nowhere.txt'; give"),
        (Replay(b"", 0, "dead", level_digest="0f" * 32), "is not here; found level-digest 0f0f0f0f0f0f"),
        (Replay(b"", 0, "dead", level_path="two.txt", level_record=2), "not in its file.*expected a record 2"),
        (Replay(b"", 0, "dead", level_path="two.txt", level_digest="0f" * 32), "not the level of this.*was changed"),
        (Replay(b"", 0, "dead", level_path="some file"), "a replay as the level of a replay"),
        (Replay(b"", 0, "dead", level_path="."), "is not here"),
        (Replay(b"", 0, "dead", level_path="\0"), "is not here"),
        (Replay(b"", 0, "dead", level_path="x" * 300), "is not here"),
    ],
)
def test_a_replay_without_its_level_says_so(tmp_path: Path, replay: Replay, message: str) -> None:
    saved(tmp_path, f"$a###{OTHER}#\n$b###{TEXT}#", "two.txt")
    path = saved(tmp_path, write_replay(replay))
    with pytest.raises(ReplayError, match=message) as caught:
        load_replays(path)
    assert str(caught.value).startswith(str(path))


def test_a_given_level_serves_a_replay_that_has_only_a_digest(tmp_path: Path) -> None:
    path = saved(tmp_path, write_replay(Replay(b"", 0, "dead", level_digest=level_digest(LEVEL))))
    assert load_replays(path, level=LEVEL)[0].level is LEVEL
    with pytest.raises(ReplayError, match="not the level of this replay"):
        load_replays(path, level=parse_level_string(OTHER))


@pytest.mark.parametrize(
    "text, error, message",
    [
        (f"$a###{TEXT}#\n$b###{TEXT}#{DEMO}#", ReplayError, ":1: record 0 has no demo; expected"),
        (f"$a###{TEXT}#34x:1|2#", ReplayError, ":1: record 0 has no demo; found '34x:1"),
        ("# Tidy\n\n$ tidy # all # of it # in order # at once\n", ReplayError, ":3: not a recording; found 'at once'"),
        (f"\n$a###{TEXT}#Aaaa!#", ReplayError, ":2: record 0 has no demo"),
        (f'\n$a###{TEXT}#A"""\x67#', DemoError, r":2: a character .* has here \(character 6 of the demo\)"),
        (TEXT, ReplayError, "no recording; found '0000"),
        (write_ascii_level(LEVEL), ReplayError, "no recording; found 'ninja-game level 1"),
        ("", ReplayError, "no recording"),
    ],
)
def test_what_is_not_a_recording_is_refused(
    tmp_path: Path, text: str, error: type[NinjaGameError], message: str
) -> None:
    path = saved(tmp_path, text)
    with pytest.raises(error, match=message) as caught:
        load_replays(path)
    assert str(path) in str(caught.value)


def test_texts_need_no_file() -> None:
    assert parse_levels(TEXT)[0].level == LEVEL
