"""`ninja-game info`: facts, warnings, a picture."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from ninja_game.cli.main import cli
from ninja_game.files.bundled import data_folder
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.levels.picture import level_picture
from tests.support.samples import NO_NINJA, SPIKED, WALK, running, write_records


def info(*words: str | Path) -> Result:
    """`ninja-game info WORDS…`."""
    return CliRunner().invoke(cli, ["info", *map(str, words)])


@pytest.fixture
def two(tmp_path: Path) -> Path:
    """A file of two records, the first with a recording."""
    return write_records(tmp_path / "two.txt", ("Walk", WALK, running(25)), ("[red]None", NO_NINJA, running(3)))


def test_several_levels_make_a_table(two: Path) -> None:
    result = info(two)
    assert result.exit_code == 0
    assert "Walk" in result.stdout
    assert "[red]None" in result.stdout, "names are not markup"
    assert "2 levels" in result.stdout


def test_one_level_is_shown_with_picture_and_counts(two: Path) -> None:
    result = info(two, "--record", "0")
    assert result.exit_code == 0
    assert "Walk by me" in result.stdout
    assert "@" in result.stdout
    assert "1 ninja, 1 exit, 1 gold" in result.stdout
    assert "recording: to tick 25 at most, 0.625 s" in result.stdout


def test_warnings_are_shown(two: Path) -> None:
    assert "warning: there is no ninja" in info(two, "--record", "1", "--no-picture").stdout


def test_json_is_one_object_a_level(two: Path) -> None:
    first, second = map(json.loads, info(two, "--json").stdout.splitlines())
    assert (first["record"], first["name"], first["objects"]["gold"], first["recording_ticks"]) == (0, "Walk", 1, 26)
    assert any("no ninja" in warning for warning in second["warnings"])


def test_a_broken_recording_hides_no_other(tmp_path: Path) -> None:
    source = tmp_path / "two.txt"
    source.write_text(f'$Walk###{WALK}#{running(25)}#\n$Odd###{WALK}#A"g#\n')
    first, second = map(json.loads, info(source, "--json").stdout.splitlines())
    assert (first["recording_ticks"], "recording_ticks" in second) == (26, False)


def test_level_without_recording_has_none(tmp_path: Path) -> None:
    source = write_records(tmp_path / "walk.txt", ("Walk", WALK, ""))
    assert "recording_ticks" not in json.loads(info(source, "--json").stdout)


def test_folder_is_read_file_by_file(tmp_path: Path) -> None:
    write_records(tmp_path / "a.txt", ("Walk", WALK, ""))
    write_records(tmp_path / "b.txt", ("Mine", SPIKED, ""))
    result = info(tmp_path)
    assert result.exit_code == 0
    assert [line.split()[:2] for line in result.stdout.splitlines()[1:3]] == [["a.txt", "Walk"], ["b.txt", "Mine"]]


def test_record_that_is_not_there_is_wrong_usage(two: Path) -> None:
    assert info(two, "--record", "7").exit_code == 2


def test_picture_shows_slopes_and_objects_in_their_cells() -> None:
    tiles = ["0"] * 713
    tiles[0] = "1"
    tiles[23] = "2"  # a slope, solid at the bottom left
    pads = "!2^60,96,0,-1!2^96,84,1,0"
    lines = level_picture(parse_level_string("".join(tiles) + "|5^36,60!0^756,564" + pads)).plain.splitlines()
    assert len(lines) == 27
    assert lines[0].split() == list("1" * 10 + "2" * 10 + "3" * 2)
    assert lines[1].split()[:11] == list("12345678901")
    assert {line[:2] for line in lines[3:26]} == {f"{row:2d}" for row in range(1, 24)}
    picture = [line[3:] for line in lines[2:]]
    assert {len(line) for line in picture} == {64}
    assert picture[1][1:5] == "██▙▖"
    assert picture[2][1] == "@"
    assert picture[23][61] == "o"
    assert picture[3][3] == "8", "a pad on the floor of its cell"
    assert picture[3][7] == "6", "a pad on a wall"


def test_drones_and_doors_are_counted_by_sort(tmp_path: Path) -> None:
    level = tmp_path / "a.nlevel"
    level.write_text(WALK + "!6^60,60,0,0,0,0!6^84,60,0,0,1,0!9^400,100,0,0,20,14,1,0,0!9^400,100,0,1,22,14,0,0,0")
    assert "1 zap drone, 1 laser drone, 1 locked door, 1 trap door" in info(level).stdout


def test_a_recording_without_its_level_is_shown_on_a_given_one(tmp_path: Path) -> None:
    demo, level = tmp_path / "demo.txt", tmp_path / "walk.nlevel"
    demo.write_text(f"$Walk####{running(25)}#")
    level.write_text(WALK)
    result = info(demo, "--level", level)
    assert result.exit_code == 0
    assert "recording: to tick 25" in result.stdout


def test_a_cut_demo_is_reported(tmp_path: Path) -> None:
    demo = tmp_path / "demo.txt"
    demo.write_text(f"$Walk###{WALK}#702:{'0|' * 98}0#")
    assert "truncated: 9 ticks of inputs are missing" in info(demo).stdout


def test_a_name_cannot_forge_rows_or_move_the_cursor(tmp_path: Path) -> None:
    source = tmp_path / "level.txt"
    source.write_text('ninja-game level 1\nname: "a\\nb\\u001b[2J"\n' + ("|" + "." * 31 + "|\n") * 23)
    shown = info(source).stdout
    assert "a b\\x1b[2J" in shown
    assert "\x1b" not in shown


def test_a_record_of_an_unknown_type_is_warned_of(tmp_path: Path) -> None:
    source = tmp_path / "level.txt"
    source.write_text(
        "ninja-game level 1\nname: x\n" + ("|" + "." * 31 + "|\n") * 23 + "ninja 5.5,5\nraw 99 1,2\nraw 99999999999 1\n"
    )
    result = info(source)
    assert result.exit_code == 0
    assert "warning: 2 records create nothing (unknown type), the first is '99'" in result.stdout


def test_levels_and_packs_are_read_without_numpy() -> None:
    """The page has none, and its import takes longer than all of `info`."""
    read = f"import ninja_game; print(len(ninja_game.load_levels({str(data_folder('levels'))!r})))"
    code = f"import sys; sys.modules['numpy'] = None; {read}"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert result.stdout == "100\n", result.stderr


def test_messages_are_shown_a_line_each_as_players_see_them(tmp_path: Path) -> None:
    level = (data_folder("levels") / "00-0-first-steps.txt").read_text("utf-8")
    long = f"at 12,5 3x1 for 9 s: {{retry}}:\\n{'far ' * 26}away"
    says = f"says: start: {{jump}} to the {{switch}} | gold 2: {{gold left}} left | {long}\n"
    path = tmp_path / "a.txt"
    path.write_text(re.sub(r"says: .*\n", lambda _: says, level), "utf-8")
    lines = info(path, "--no-picture").stdout.splitlines()
    shown = [line for line in lines if line.startswith("says")]
    assert shown[0] == "says, start: Z to the switch"
    assert shown[1] == f"says, gold 2: {json.loads(info(path, '--json').stdout)['objects']['gold']} left"
    assert "says, at 12,5 3x1 for 9 s: R: far far" in shown[2]
    assert "far away" in " ".join(lines)
    assert "..." not in " ".join(lines)
