"""Names that untrusted files have, and names of files, reach a terminal as printable characters."""

import os
import re
import select
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from ninja_game.backend.memories import compiled_available
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records
from tests.support.warm_start import WarmStart

pty = pytest.importorskip("pty", reason="there are no pseudo-terminals")

NAME = "a\x1b]0;owned\x07\x9b2J\u202e\x1b[8m"  # a record's name; it holds no line end
HOSTILE = f"{NAME}\rb"  # a name of a file or a replay

OWN = re.compile(r"\r?\n|\t|\x1b\[[0-9;]*m|\r|\x1b\[(?:\?25[hl]|1A|2K)")
"""What our own output does on a terminal; the names must not, so `\\x1b[8m` is looked for apart."""

COMMANDS = {
    "info": "info LEVEL RECORDS REPLAY",
    "info of one": "info LEVEL",
    "verify": "verify RECORDS --memory plain",
    "trace": "trace RECORDS --memory plain --ticks 2",
    "trace against": "trace RECORDS --memory plain --against REPLAY",
    "trace digests": "trace RECORDS --memory plain --digests --ticks 2",
    "splits": "splits RECORDS",
    "splits as csv": "splits RECORDS --format csv",
    "compare": "compare RECORDS REPLAY",
    "compare as csv": "compare RECORDS REPLAY --format csv",
    "record": "record RECORDS",
    "record again": "record REPLAY --force",
    "film": "film REPLAY --to 2 --size 132x100",
    "link": "link REPLAY",
    "convert": "convert RECORDS - --to file",
    "convert to a level": "convert LEVEL -",
    "board": "board .",
    "lint": "levels lint .",
    "pars": "levels pars .",
    "wrong file": "verify BROKEN",
    "no file": "verify NOTHING",
    "check": "check LEVEL RECORDS --first --seconds 1 --jobs 1",
    "solve": "solve LEVEL --first --seconds 1 --jobs 1",
}
BYTES = {"trace", "splits as csv", "compare as csv", "convert", "convert to a level"}
"""What these write on standard output is for programs: every byte of it, where it is not a terminal."""

COMPILED = {"check", "solve"}

PROGRAM = "from ninja_game.__main__ import main; main()"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of hostile files."""
    folder = tmp_path_factory.mktemp("names")
    write_records(folder / f"records {HOSTILE}\n.txt", (NAME, WALK, running(WALK_END)))
    (folder / f"replay {HOSTILE}\n.replay.txt").write_text(replay_of_walk(name=HOSTILE, author=HOSTILE))
    (folder / f"level {HOSTILE}\n.txt").write_text(f"${NAME}#{NAME}#{NAME}#{WALK}#\n")
    (folder / f"broken {HOSTILE}\n.txt").write_text(HOSTILE)
    return folder


def words_of(name: str, folder: Path) -> list[str]:
    """The words of a command."""
    files = {
        "LEVEL": f"level {HOSTILE}\n.txt", "RECORDS": f"records {HOSTILE}\n.txt", "BROKEN": f"broken {HOSTILE}\n.txt",
        "REPLAY": f"replay {HOSTILE}\n.replay.txt", "NOTHING": f"nothing {HOSTILE}\n.txt",
    }  # fmt: skip
    if name in COMPILED and not compiled_available():
        pytest.skip("Numba is not installed")
    return [files.get(word, word) for word in COMMANDS[name].split()]


def on_a_terminal(start: WarmStart, code: str, words: list[str], folder: Path) -> str:
    """What a program writes to a terminal."""
    ours, its = pty.openpty()
    with ThreadPoolExecutor() as beside:
        program = beside.submit(start.run, code, words, folder, terminal=os.ttyname(its))
        text, ended = b"", False
        while not ended:
            ended = program.done()
            while select.select([ours], [], [], 0.02)[0]:
                text += os.read(ours, 65536)
    os.close(its)
    os.close(ours)
    assert program.result().code != 3, text
    assert b"Traceback" not in text
    return text.decode()


@pytest.mark.parametrize("name", COMMANDS)
def test_no_name_steers_a_terminal(name: str, folder: Path, warm_start: WarmStart) -> None:
    text = on_a_terminal(warm_start, PROGRAM, words_of(name, folder), folder)
    assert text
    assert [each for each in OWN.sub("", text) if not each.isprintable()] == []
    assert "\x1b[8m" not in text
    if name not in BYTES:
        assert not re.search("\r(?!\n)b", text)


@pytest.mark.parametrize("name", COMMANDS)
def test_no_name_steers_what_shows_a_file_later(name: str, folder: Path, warm_start: WarmStart) -> None:
    done = warm_start.run(PROGRAM, words_of(name, folder), folder)
    assert done.code != 3, done.errors
    assert "Traceback" not in done.errors
    shown = done.errors + ("" if name in BYTES else done.out)
    assert [each for each in shown if not each.isprintable() and each != "\n"] == []
    if name in {"trace", "convert"}:
        assert NAME in done.out


def test_a_program_that_prints_in_a_new_way_is_held_by_the_terminal(warm_start: WarmStart) -> None:
    code = f"from ninja_game.cli.terminal import *; guard_terminal(); print({HOSTILE!r}); sys.stderr.write({HOSTILE!r})"
    shown = on_a_terminal(warm_start, code, [], Path.cwd())
    assert shown == "a\\x1b]0;owned\\x07\\x9b2J\\u202e\x1b[8m b\r\na\\x1b]0;owned\\x07\\x9b2J\\u202e\x1b[8m\rb"
