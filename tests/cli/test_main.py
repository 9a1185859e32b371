"""The program as a whole: exit codes, one-line errors, no traceback, a quick `--help`."""

import os
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from ninja_game.cli.commands import COMMANDS
from ninja_game.cli.main import cli
from ninja_game.errors import LevelError, NinjaGameError
from ninja_game.files.bundled import bundled_levels, data_folder
from ninja_game.signals import Terminated
from tests.support.samples import WALK, replay_of_walk, running, write_records

RUN = "levels/certificates/00-0-first-steps.exit.replay.txt"


def ninja_game(*words: str | Path) -> subprocess.CompletedProcess[str]:
    """The program as a user starts it."""
    command = [sys.executable, "-m", "ninja_game", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def failing(monkeypatch: pytest.MonkeyPatch, error: BaseException) -> tuple[int, str]:
    """Exit code and stderr of the program when a command raises ``error``."""

    @click.command()
    def command() -> None:
        raise error

    monkeypatch.setattr(type(cli), "get_command", lambda *_: command)
    result = CliRunner().invoke(cli, ["any"])
    assert result.stdout == ""
    return result.exit_code, result.stderr


def test_help_lists_every_command() -> None:
    result = ninja_game("--help")
    assert result.returncode == 0
    assert all(f"\n  {name} " in result.stdout for name in COMMANDS)


@pytest.mark.parametrize(
    "words, most, without",
    [
        ("--help", 170, "numpy numba pygame rich sqlite3"),
        ("info levels/00-0-first-steps.txt", 330, "numpy numba pygame"),
        ("play --frames 1", 530, "numpy numba rich"),
        ("edit --frames 1", 520, "numpy numba rich"),
        ("lab --frames 1", 490, "numpy numba rich"),
        (f"tas {RUN} --frames 1", 1140, "rich PIL"),
    ],
)
def test_a_start_imports_only_what_it_needs(words: str, most: int, without: str) -> None:
    """Modules are counted, since time depends on the machine; what it takes is in docs/performance.md."""
    code = "import atexit, sys, ninja_game.cli.main as m; atexit.register(lambda: print(*sys.modules)); m.main()"
    printed = subprocess.check_output([sys.executable, "-c", code, *words.split()], text=True)
    loaded = printed.splitlines()[-1].split()
    assert "click" in loaded
    assert set(loaded).isdisjoint(without.split())
    assert len(loaded) <= most


def test_the_first_picture_comes_before_the_command_line_is_loaded() -> None:
    code = "import sys, pygame; pygame.display.flip = lambda: sys.exit(print(*sys.modules))\n"
    code += "import ninja_game.__main__ as m; m.main()"
    printed = subprocess.check_output([sys.executable, "-c", code, "play"], text=True)
    loaded = printed.splitlines()[-1].split()
    assert set(loaded).isdisjoint(("click", "ninja_game.cli", "ninja_game.simulation"))
    assert len(loaded) <= 230


def test_no_command_shows_help_and_is_wrong_usage() -> None:
    result = ninja_game()
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr.startswith("Usage: ninja-game")


def test_unknown_command_is_wrong_usage() -> None:
    result = ninja_game("fly")
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr == "ninja-game: No such command 'fly'.\nTry 'ninja-game --help'.\n"


def test_a_mistyped_command_is_recognised() -> None:
    result = CliRunner().invoke(cli, ["chekc"])
    assert result.exit_code == 2
    assert result.stderr.startswith("ninja-game: No such command 'chekc'; did you mean 'check'?\n")


def test_every_line_of_a_message_says_whose_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    code, text = failing(monkeypatch, NinjaGameError("first\nsecond \x1b[2J"))
    assert (code, text) == (2, "ninja-game: first\nninja-game: second \\x1b[2J\n")


def test_a_fault_of_ours_is_no_failed_run(monkeypatch: pytest.MonkeyPatch) -> None:
    code, text = failing(monkeypatch, ZeroDivisionError("oops"))
    assert code == 3
    assert "ZeroDivisionError: oops" in text
    assert text.splitlines()[-1].startswith("ninja-game: this is a fault of ninja-game")


HUGE = "9" * 5000


@pytest.mark.parametrize(
    "words",
    [
        ("solve", "LEVEL", "--gold", HUGE, "-o", "x"),
        ("solve", "LEVEL", "--smooth", "1" + "0" * 20, "-o", "x"),
        ("solve", "LEVEL", "--seed", HUGE, "-o", "x"),
        ("solve", "LEVEL", "--jobs", "1" + "0" * 9, "-o", "x"),
        ("solve", "LEVEL", "--seconds", "nan", "-o", "x"),
        ("check", "LEVEL", "--ticks", HUGE),
        ("trace", "LEVEL", "--ticks", "1" + "0" * 12),
        ("trace", "LEVEL", "--after", "1" + "0" * 12),
        ("info", "LEVEL", "--record", HUGE),
        ("play", "LEVEL", "--size", f"{HUGE}x{HUGE}"),
        ("play", "LEVEL", "--frames", HUGE),
        ("play", "LEVEL", "--record", HUGE),
        ("verify", "LEVEL", "--jobs", HUGE),
    ],
    ids=lambda words: " ".join(words[::2])[:20],
)
def test_numbers_without_measure_are_wrong_usage(words: tuple[str, ...]) -> None:
    level = str(bundled_levels()[0])
    result = CliRunner().invoke(cli, [level if word == "LEVEL" else word for word in words])
    assert result.exit_code == 2, result.output
    assert "Traceback" not in result.stderr


def test_the_names_of_our_levels_stand_for_their_files_and_are_completed() -> None:
    result = CliRunner().invoke(cli, ["info", "00-0-first-steps"])
    assert result.exit_code == 0
    assert str(bundled_levels()[0]) in result.stdout.replace("\n", "")
    assert "the game's own levels: 00-0-first-steps, " in CliRunner().invoke(cli, ["solve", "0"]).stderr
    assert "levels: 00-0-first-steps, " in CliRunner().invoke(cli, ["solve", "first-steps"]).stderr
    asked = {"_NINJA_GAME_COMPLETE": "bash_complete", "COMP_WORDS": "ninja-game info 00-", "COMP_CWORD": "2"}
    completed = subprocess.run(
        [sys.executable, "-m", "ninja_game"], env=os.environ | asked, capture_output=True, text=True, check=False
    )
    assert "plain,00-0-first-steps" in completed.stdout
    words = [sys.executable, "-m", "ninja_game", "info", "no-such-level"]
    given = subprocess.run(words, env=os.environ | asked, capture_output=True, text=True, check=False)
    assert given.returncode == 2, "the words of completion stand for those of the command"


def test_bad_input_names_the_place(monkeypatch: pytest.MonkeyPatch) -> None:
    error = LevelError("unknown tile", file="a.txt", line=7, column=3, found="'?'")
    assert failing(monkeypatch, error) == (2, "ninja-game: a.txt:7:3: unknown tile; found '?'\n")


def test_missing_file_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    error = FileNotFoundError(2, "No such file or directory", "gone.txt")
    assert failing(monkeypatch, error) == (2, "ninja-game: gone.txt: No such file or directory\n")


def test_interrupt_ends_quietly(monkeypatch: pytest.MonkeyPatch) -> None:
    code, text = failing(monkeypatch, KeyboardInterrupt())
    assert (code, text.strip()) == (130, "ninja-game: interrupted")


@pytest.mark.parametrize("signal, code", [(KeyboardInterrupt(), 130), (Terminated(), 143)])
def test_a_signal_that_python_turns_into_another_error_is_still_one(
    signal: BaseException, code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    error = RuntimeError("Error calling __set_name__")
    error.__cause__ = signal
    assert failing(monkeypatch, error)[0] == code


def test_reader_that_leaves_early_is_no_error() -> None:
    for words in (["link", "00-0-first-steps"], ["info", str(data_folder("levels"))]):
        reader, writer = os.pipe()
        os.close(reader)
        command = [sys.executable, "-m", "ninja_game", *words]
        result = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
        os.close(writer)
        assert (result.returncode, result.stderr) == (141, "")


@pytest.mark.parametrize(
    "words",
    [
        "verify run.txt --level level.txt --report level.txt",
        "verify run.txt --report named.txt --resume log",
        "verify run.txt --report log --resume log",
        "improve run.txt --level level.txt --ticks 1 -o level.txt",
        "search bare.txt --from 0 --to 9 --goal x>110 --level level.txt --seconds 0.5 -o level.txt",
        "record run.txt -o named.txt --force",
        "convert bare.txt level.txt --level level.txt --force --to replay",
        "splits run.txt --picture named.txt",
        "compare run.txt run.txt --picture named.txt",
        "play level.txt --frames 1 --screenshot level.txt",
    ],
)
def test_no_command_replaces_a_file_that_it_has_read(
    words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    write_records(Path("level.txt"), ("Walk", WALK, ""))
    Path("named.txt").write_bytes(Path("level.txt").read_bytes())
    Path("run.txt").write_text(replay_of_walk(level=None, level_path="named.txt"))
    Path("bare.txt").write_text(running(60))
    Path("log").touch()
    before = {path: path.read_bytes() for path in tmp_path.glob("*.txt")}
    result = CliRunner().invoke(cli, words.split())
    assert result.exit_code == 2, result.output
    assert "read by the same command" in result.stderr or "expected a name that ends in .png" in result.stderr
    assert {path: path.read_bytes() for path in tmp_path.glob("*.txt")} == before


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_click_completes_for(shell: str) -> None:
    environment = os.environ | {"_NINJA_GAME_COMPLETE": f"{shell}_source"}
    command = [sys.executable, "-m", "ninja_game"]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert "_NINJA_GAME_COMPLETE" in result.stdout
