"""`ninja-game solve`, `improve` and `check`: files, exit codes, messages."""

import json
import os
from collections.abc import Iterator
from pathlib import Path
from unittest.mock import patch

import pytest
from click.testing import CliRunner, Result

from ninja_game.backend.memories import compiled_available
from ninja_game.cli import progress
from ninja_game.cli.main import cli
from ninja_game.cli.progress import progress_text
from ninja_game.files.user_folder import free_path
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import parse_replay
from ninja_game.runs.run import run_level
from ninja_game.runtime import cores
from ninja_game.search.certificate import named_replay, save_replay, verified_run
from tests.support.samples import NO_NINJA, SPIKED, WALK, WALK_END, running, write_records

if not compiled_available():
    pytest.skip("Numba is not installed", allow_module_level=True)

LEDGE = "0" * 23 * 8 + ("0" * 20 + "111") * 2 + "0" * 23 * 21 + "|5^100,566!11^300,566,228,494"
CLOSED_IN = "0" * 23 * 5 + "1" * 23 + "0" * 23 * 25 + "|5^60,566!11^400,566,330,566"
TICKS = "100000"  # of a search: enough for each of these levels

WALLED_GOLD = "0" * 23 * 20 + "1" * 23 + "0" * 23 * 10 + "|5^60,566!11^400,566,330,566!0^90,566!0^700,300"


def command(*words: str | Path) -> Result:
    """`ninja-game WORDS…`."""
    return CliRunner().invoke(cli, [*map(str, words)])


def level_file(folder: Path, text: str, name: str = "level.txt") -> Path:
    """A file with one in-game string."""
    path = folder / name
    path.write_text(text + "\n", "utf-8")
    return path


@pytest.mark.skipif(not hasattr(os, "sched_getaffinity"), reason="this system has no affinity")
def test_threads_default_to_the_cores_that_this_process_may_use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {3})
    assert cores() == 1


def test_solve_writes_a_replay_that_passes(tmp_path: Path) -> None:
    out = tmp_path / "out.replay.txt"
    result = command("solve", level_file(tmp_path, WALK), "--ticks", TICKS, "--jobs", "1", "-o", out)
    assert result.exit_code == 0
    assert f"{WALK_END} ticks" in result.stdout
    replay = parse_replay(out.read_text("utf-8"))
    run = run_level(parse_level_string(WALK), replay.inputs, memory="plain")
    assert (run.outcome, run.end_tick) == ("exit", WALK_END)


@pytest.mark.parametrize("command_name", ["solve", "improve"])
def test_source_is_not_written_over(command_name: str, tmp_path: Path) -> None:
    source = write_records(tmp_path / "demos.txt", ("Walk", WALK, running(WALK_END)))
    before = source.read_bytes()
    for out in (source, "/dev/null"):
        result = command(command_name, source, "-o", out)
        assert result.exit_code == 2
        assert "read by the same command" in result.stderr or "only a regular file" in result.stderr
    assert source.read_bytes() == before


def test_solve_says_when_it_found_nothing(tmp_path: Path) -> None:
    out = tmp_path / "out.replay.txt"
    result = command("solve", level_file(tmp_path, CLOSED_IN), "--ticks", TICKS, "--jobs", "1", "-o", out)
    assert result.exit_code == 1
    assert "no run to the exit found: exit" in result.stdout
    assert not out.exists()


def test_solve_names_the_gold_that_it_never_got(tmp_path: Path) -> None:
    file = level_file(tmp_path, WALLED_GOLD)
    # As the help writes it; in small letters, too.
    words = ("--gold", "ALL", "--ticks", TICKS, "--jobs", "1", "-o", tmp_path / "out.replay.txt")
    result = command("solve", file, *words)
    assert result.exit_code == 1
    assert "no run with 2 gold to the exit found: 1 at most were collected at once" in result.stdout
    assert "never gold at 29,12 (700,300px, object 3)" in result.stdout


def test_improve_shortens_a_recording(tmp_path: Path) -> None:
    slow = write_records(tmp_path / "slow.txt", ("Slow", WALK, f"40:{'0|' * 2}{'35791394|' * 4}"))
    out = tmp_path / "out.replay.txt"
    result = command("improve", slow, "--ticks", TICKS, "--jobs", "1", "-o", out)
    assert result.exit_code == 0, result.stderr
    assert "14 ticks shorter" in result.stdout
    assert "same route as before: --against FILE" in result.stdout
    assert parse_replay(out.read_text("utf-8")).final_tick == WALK_END


@pytest.mark.parametrize("mine", [f"40:{'0|' * 2}{'35791394|' * 4}", running(9)], ids=["slow", "cut"])
def test_improve_shortens_the_routes_of_other_runs_too_and_names_their_players(tmp_path: Path, mine: str) -> None:
    slow = write_records(tmp_path / "slow.txt", ("Slow", WALK, mine))
    fast = write_records(tmp_path / "fast.txt", ("Fast", WALK, running(WALK_END + 1)), ("Other", LEDGE, running(9)))
    out = tmp_path / "out.replay.txt"
    words = "improve", slow, "--ticks", "1", "--jobs", "1", "-o"
    with_others = command(*words, out, "--against", fast)
    assert (with_others.exit_code, "same route" in with_others.stdout) == (0, False)
    replay = parse_replay(out.read_text("utf-8"))
    assert (replay.final_tick, replay.co_authors) == (WALK_END, ("unknown (fast.txt)",))
    other = write_records(tmp_path / "other.txt", ("Other", LEDGE, running(9)))
    for name, words_of_error in ((other, "no run of Slow with its body"), (slow, "no other run of Slow")):
        refused = command(*words, out, "--against", name)
        assert (refused.exit_code, words_of_error in refused.stderr) == (2, True)
    kept = command(*words, fast, "--against", fast)
    assert (kept.exit_code, "fast.txt" in kept.stderr, len(load_replays(fast))) == (2, True, 2)


def test_improve_says_where_no_way_leads_to_the_exit(tmp_path: Path) -> None:
    dead = write_records(tmp_path / "dead.txt", ("Dead", SPIKED, running(60)))
    result = command("improve", dead, "--seconds", "1", "--jobs", "1", "-o", tmp_path / "out.txt")
    assert result.exit_code == 1
    assert "dead in tick 15: mine 1" in result.stdout
    assert "no way to the exit found from there" in result.stdout
    assert not (tmp_path / "out.txt").exists()


@pytest.mark.parametrize("demo", [running(9), f"40:{'0|' * 2}{'17895697|' * 4}"], ids=["cut", "the other way"])
def test_improve_leads_a_run_that_ends_before_the_exit_there(tmp_path: Path, demo: str) -> None:
    short = write_records(tmp_path / "short.txt", ("Short", WALK, demo))
    out = tmp_path / "out.replay.txt"
    result = command("improve", short, "--ticks", TICKS, "--jobs", "1", "-o", out)
    assert result.exit_code == 0, result.output
    replay = parse_replay(out.read_text("utf-8"))
    assert (replay.outcome, replay.final_tick <= WALK_END + 20) == ("exit", True)
    assert (replay.made.searches, replay.made.begun_by) == (("improve",), "unknown (short.txt)")
    copy, log = out.with_name("copy.replay.txt"), tmp_path / "night.log"
    copy.write_bytes(out.read_bytes())
    words = "improve", short, "--ticks", "1", "--jobs", "1", "--against", copy, "--resume", log, "-o", out
    with patch("ninja_game.search.formula.methods.to_exit", side_effect=AssertionError):
        assert command(*words).exit_code == 0, "goes on from its best run, also beside the same one"


def test_improve_goes_on_from_its_best_run_and_says_so_in_its_log(tmp_path: Path) -> None:
    slow = write_records(tmp_path / "slow.txt", ("Slow", WALK, f"40:{'0|' * 2}{'35791394|' * 4}"))
    out, log = tmp_path / "out.replay.txt", tmp_path / "night.log"
    words = "improve", slow, "--jobs", "1", "--resume", log, "-o", out
    assert command(*words, "--ticks", TICKS).exit_code == 0
    again = command(*words, "--ticks", "1")
    assert again.exit_code == 0, again.output
    assert parse_replay(out.read_text("utf-8")).final_tick == WALK_END
    head, *lines = log.read_text().splitlines()
    assert head == "# seconds spent, and what improve found"
    found = [line.split(" s  ")[1] for line in lines]
    assert found.count("begins") == found.count("ended") == 2
    second = found[found.index("ended") + 1 :]
    assert second[:2] == ["begins", f"{WALK_END + 14} ticks (0.925 s)"]
    assert second[2] == f"{WALK_END} ticks (0.575 s)", "at once, without searching for it again"
    log.write_text(log.read_text() + "       90 s  ended\n")
    late = command(*words, "--seconds", "60")
    assert late.exit_code == 0
    assert "      90 s  begins" in log.read_text(), "the time of all of them"


@pytest.mark.parametrize("text", ["my notes\n", "", "# seconds spent, and what improve found\nmine\n"])
def test_a_file_that_is_not_a_log_of_improve_stays_as_it_is(tmp_path: Path, text: str) -> None:
    slow = write_records(tmp_path / "slow.txt", ("Slow", WALK, running(24)))
    log = tmp_path / "night.log"
    log.write_text(text)
    result = command("improve", slow, "--ticks", "1", "--jobs", "1", "--resume", log, "-o", tmp_path / "out.txt")
    assert (result.exit_code, log.read_text()) == (2, text)
    assert "not the log of a search" in result.stderr
    kept = command("improve", slow, "--ticks", "1", "--resume", slow, "-o", tmp_path / "out.txt")
    assert (kept.exit_code, "slow.txt" in kept.stderr) == (2, True)


def test_check_certifies_and_keeps_replays(tmp_path: Path) -> None:
    level_file(tmp_path, WALK, "good.txt")
    level_file(tmp_path, CLOSED_IN, "shut.txt")
    runs = tmp_path / "runs"
    result = command("check", tmp_path, "--ticks", TICKS, "--jobs", "1", "--replays", runs, "--json")
    assert result.exit_code == 1
    good, shut = (json.loads(line) for line in result.stdout.splitlines())
    assert (good["solvable"], good["runs"]["exit"]["ticks"]) == (True, WALK_END)
    assert (shut["solvable"], shut["runs"]["exit"]) == (None, None)
    assert [path.name for path in runs.iterdir()] == ["good.exit.replay.txt"]
    result = command("check", tmp_path / "good.txt", "--ticks", TICKS, "--jobs", "1")
    assert result.exit_code == 0
    assert "solvable best   0.575 s" in result.stdout


def check_both(level: Path, runs: Path, *words: str) -> str:
    """What `ninja-game check --gold both` says of a level whose runs are kept; all goals must be met."""
    result = command("check", level, "--gold", "both", "--ticks", TICKS, "--jobs", "1", "--replays", runs, *words)
    assert result.exit_code == 0, result.output
    return result.stdout


def test_runs_that_are_kept_are_not_searched_again(tmp_path: Path) -> None:
    level, runs = level_file(tmp_path, WALK + "!0^60,566"), tmp_path / "runs"
    assert check_both(level, runs).count("found") == 2
    files = sorted(runs.iterdir())
    assert [path.name for path in files] == ["level.exit.replay.txt", "level.gold.replay.txt"]
    before = [path.read_bytes() for path in files]
    report_text = check_both(level, runs)
    assert report_text.count("gold  kept") == 2
    assert [path.read_bytes() for path in files] == before


def test_a_run_that_is_kept_is_shortened_where_that_is_asked_for(tmp_path: Path) -> None:
    level, runs = level_file(tmp_path, WALK), tmp_path / "runs"
    slow = named_replay(verified_run(parse_level_string(WALK), bytes([0] * 20 + [2] * 60)), "check")
    runs.mkdir()
    save_replay(runs / "level.exit.replay.txt", slow)
    report_text = command("check", level, "--replays", runs).stdout
    assert f"{WALK_END + 20} ticks" in report_text
    report_text = command("check", level, "--ticks", TICKS, "--jobs", "1", "--replays", runs, "--improve").stdout
    assert f"{WALK_END} ticks" in report_text
    assert "shortened" in report_text
    assert load_replays(runs / "level.exit.replay.txt")[0].ticks == WALK_END + 1


def test_runs_are_searched_again_after_a_change_of_the_level(tmp_path: Path) -> None:
    """A wall in the way makes the old run useless; a piece of gold elsewhere leaves it as good as it was."""
    level, runs = level_file(tmp_path, LEDGE), tmp_path / "runs"
    check_both(level, runs)
    level_file(tmp_path, LEDGE + "!0^700,40")
    result = command("check", level, "--ticks", "20000", "--jobs", "1", "--replays", runs)
    assert "kept" in result.stdout
    (kept,) = load_levels(runs / "level.exit.replay.txt")
    assert len(kept.level.objects) == len(parse_level_string(LEDGE).objects) + 1
    level_file(tmp_path, LEDGE.replace("5^100,566", "5^60,566"))
    assert "found" in check_both(level, runs)


def test_a_damaged_replay_is_named_and_not_replaced(tmp_path: Path) -> None:
    runs = tmp_path / "runs"
    runs.mkdir()
    (runs / "level.exit.replay.txt").write_text("noise")
    result = command("check", level_file(tmp_path, WALK), "--replays", runs)
    assert result.exit_code == 2
    assert "level.exit.replay.txt" in result.stderr
    assert (runs / "level.exit.replay.txt").read_text() == "noise"


def test_missing_gold_is_reported_and_does_not_fail_the_check(tmp_path: Path) -> None:
    level = level_file(tmp_path, WALLED_GOLD)
    result = command("check", level, "--gold", "both", "--ticks", TICKS, "--jobs", "1", "--json")
    assert result.exit_code == 0
    assert json.loads(result.stdout)["runs"]["gold"] is None
    result = command("check", level, "--gold", "both", "--ticks", TICKS, "--jobs", "1")
    assert (
        "all gold no run found: 1 at most were collected at once, never gold at 29,12 (700,300px, object 3)"
        in result.stdout
    )
    assert command("check", level, "--gold", "all", "--ticks", TICKS, "--jobs", "1").exit_code == 1


def test_the_first_run_will_do_where_that_is_asked_for(tmp_path: Path) -> None:
    """Otherwise this many ticks would take an hour."""
    result = command("check", level_file(tmp_path, LEDGE), "--first", "--ticks", str(10**10), "--jobs", "1")
    assert result.exit_code == 0


def test_check_gives_every_certificate_a_name_of_its_own(tmp_path: Path) -> None:
    for folder, name in (("a", "x.txt"), ("b", "x.txt"), ("c", "X.txt")):
        (tmp_path / folder).mkdir()
        level_file(tmp_path / folder, WALK, name)
    command(
        "check", *(tmp_path / part for part in "abc"), "--ticks", TICKS, "--jobs", "1", "--replays", tmp_path / "out"
    )
    names = ["X-3.exit.replay.txt", "x-2.exit.replay.txt", "x.exit.replay.txt"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == names


@pytest.mark.parametrize(
    "words, message",
    [
        (["improve", "level.txt"], "Missing option '-o'"),
        (["solve", "level.txt", "--gold", "some", "-o", "x"], "'some' is neither 'all' nor a whole number"),
        (["solve", "level.txt", "--gold", "7", "-o", "x"], "the level holds 1 pieces of gold"),
        (["solve", "two.txt", "-o", "x"], "holds 2 levels; choose one with --record, 0 to 1"),
        (["solve", "two.txt", "--record", "9", "-o", "x"], "there is no record 9"),
        (["solve", "empty.txt", "-o", "x"], "no ninja"),
        (["solve", "missing.txt", "-o", "x"], "missing.txt: there is no such file"),
        (["solve", "noise.txt", "-o", "x"], "not a level in any format"),
        (["improve", "level.txt", "-o", "x"], "no recording"),
        (["improve", "two.txt", "-o", "x"], "holds 2 recordings; choose one with --record, 0 to 1"),
        (["check", "noise.txt"], "not a level in any format"),
    ],
)
def test_bad_requests_are_explained(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], message: str
) -> None:
    monkeypatch.chdir(tmp_path)
    level_file(tmp_path, WALK)
    level_file(tmp_path, NO_NINJA, "empty.txt")
    level_file(tmp_path, "noise", "noise.txt")
    write_records(tmp_path / "two.txt", ("A", WALK, running(25)), ("B", WALK, running(25)))
    result = command(*words)
    assert result.exit_code == 2
    assert message in " ".join(result.stderr.split())


def test_a_run_without_a_name_is_called_after_its_level(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert free_path(Path(), "hill", ".replay.txt") == Path("hill.replay.txt")
    Path("hill.replay.txt").touch()
    assert free_path(Path(), "hill", ".replay.txt") == Path("hill-2.replay.txt")


def test_a_certificate_names_its_level_and_who_made_it(tmp_path: Path) -> None:
    level = tmp_path / "walk.txt"
    level.write_text(write_ascii_level(parse_level_string(WALK), name="A walk", author="Ann"))
    assert command("check", level, "--ticks", TICKS, "--jobs", "1", "--replays", tmp_path / "out").exit_code == 0
    (found,) = load_levels(tmp_path / "out" / "walk.exit.replay.txt")
    assert (found.name, found.author) == ("A walk", "Ann")


def test_a_locked_door_that_the_run_does_not_open_is_reported(tmp_path: Path) -> None:
    level = level_file(tmp_path, WALK + "!9^400,100,0,0,20,14,1,0,0")
    result = command("check", level, "--ticks", TICKS, "--jobs", "1")
    assert "warning: locked door at 20,14 (object 3): it is never needed: the certified run passes" in result.stdout
    opened = level_file(tmp_path, WALK + "!9^120,566,0,0,20,14,1,0,0")
    assert "never needed" not in command("check", opened, "--ticks", TICKS, "--jobs", "1").stdout


def test_a_level_without_a_ninja_is_an_error_of_check_and_the_others_are_checked(tmp_path: Path) -> None:
    folder = tmp_path / "levels"
    folder.mkdir()
    level_file(folder, NO_NINJA, "a.txt")
    level_file(folder, WALK, "b.txt")
    result = command("check", folder, "--ticks", TICKS, "--jobs", "1")
    assert result.exit_code == 2
    assert f"{folder / 'a.txt'}:1: this level cannot be played: it has no ninja" in result.stderr
    assert "2 levels, 1 solvable, 0 not solved in the time, 1 cannot be played" in result.stdout


def test_improving_keeps_name_and_author_and_says_when_nothing_was_found(tmp_path: Path) -> None:
    path = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(WALK_END)))
    out = tmp_path / "out.replay.txt"
    result = command("improve", path, "--ticks", TICKS, "--jobs", "1", "-o", out)
    assert result.exit_code == 0, result.stderr
    assert "no shorter run was found" in result.stdout
    replay = parse_replay(out.read_text())
    about = replay.name, replay.author, replay.level_author, replay.final_tick
    assert about == ("Walk", "", "me", WALK_END), "a record of N names who made the level"


def test_the_line_of_progress_fits_eighty_columns() -> None:
    from ninja_game.search.task import Progress

    text = progress_text(Progress(best=99_999, ticks=10**11, seconds=9_999.0, doing="shortening"))
    assert len(text) <= 70, "a clock stands before it"
    assert text.split()[:2] == ["shortening", "best"]


def test_progress_is_reported_now_and_then_where_nobody_watches(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "LONG", 0.001)
    monkeypatch.setattr(progress, "_EVERY", 0.001)
    reports = []

    def items() -> Iterator[int]:
        for item in range(2):
            # The first item may be the long one: it is reported before it is there.
            seen = ""
            while f"s: {item} run{'s' * (item != 1)} done\n" not in seen:
                seen += capsys.readouterr().err
            reports.append(item)
            yield item

    assert list(progress.with_progress(items(), "run")) == reports == [0, 1]
