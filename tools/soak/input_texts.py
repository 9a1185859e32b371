"""Feed mutated inputs that people write to the bench: only errors of ours, none after over a second, in little memory.

    python3 tools/dev.py tool soak.input_texts [--count 100000] [--seed 1]

Replays with comments, blocks, names of ticks and other files in them, loose ones, lines of CelesteTAS and libTAS, files
of branches, journals. Exit code 0: nothing found; 1: something was, printed with the seed that makes it.
"""

from __future__ import annotations

import argparse
import random
import resource
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import write_replay
from ninja_game.formats.tas_lines import write_celeste, write_libtas
from ninja_game.tas.files import branches_path, inputs_of_text, open_run, replay_of_take, runs_beside
from ninja_game.tas.journal import FOLDER, recovered
from ninja_game.tas.session import Session
from tests.support.bench_edits import edit_at_random
from tests.support.samples import WALK, loose_replay, replay_of_walk
from tools.soak.odd_texts import Trial, odd

SLOW_S = 1.0
MOST_MIB = 500

INPUTS = """\
#start R*3 ; three to the right
(R*2 RJ)*3 (L*4 (. LJ!)*2
RJ-*2)*2 #über-allem .*5 R!
include part.inputs.txt
#end LRJ*7"""
PART = "; another file\n#part (R*30 .)*2\ninclude more/deep.inputs.txt"
CELESTE = """\
# a comment
#start
  30,R,J
   2,R
Repeat 4
   1,L
  12
EndRepeat
Read,part.inputs.txt
***
#end
   7,L,R"""
LIBTAS = "|Kff53:ffe1|\n|Kff53|M0:0:A:.....:0|\n|K|\n|K7a:ff51|\n" * 5
LEVEL = parse_level_string(WALK)


def seeds(folder: Path) -> dict[str, str]:
    """A sound text for each file that is mutated."""
    (folder / "more").mkdir()
    (folder / "more" / "deep.inputs.txt").write_text("R*2", "utf-8")
    (folder / "part.inputs.txt").write_text(PART, "utf-8")
    texts = {
        "written.replay.txt": loose_replay(WALK, *INPUTS.splitlines(), headers="name: mine\nauthor: me\n; words\n"),
        "strict.replay.txt": replay_of_walk(),
        "part.inputs.txt": PART,
        "a.tas": CELESTE,
        "a.libtas.txt": LIBTAS,
        "pasted": INPUTS.replace("include part.inputs.txt", ""),
    }
    for name, text in texts.items():
        (folder / name).write_text(text, "utf-8")
    session = Session(open_run(folder / "strict.replay.txt"), folder, memory="plain")
    chance = random.Random(1)
    for _ in range(40):
        edit_at_random(session, chance)
    session.journal.close(keep=True)
    (journal,) = (folder / FOLDER).glob("*.jsonl")
    texts["journal"] = journal.read_text("utf-8")
    journal.unlink()
    session.save(folder / "kept.replay.txt")
    texts["branches"] = branches_path(folder / "kept.replay.txt").read_text("utf-8")
    return texts


def open_and_write(path: Path) -> None:
    """A run as the bench opens it: beside itself, and in all notations that can say it."""
    opened = open_run(path, level=LEVEL)
    runs_beside(path, opened.recording)
    if len(opened.take) > 5000:
        return
    if len(opened.take):
        write_replay(replay_of_take(opened.recording, opened.take))
    notations: list[Callable[[bytes], str]] = [partial(write_celeste, markers=opened.take.markers), write_libtas]
    for write in notations:
        with suppress(NinjaGameError):
            write(opened.take.inputs)


def look(name: str, text: str, folder: Path) -> None:
    """Put a text where it is read, and read it."""
    data = text.encode("utf-8", "surrogatepass")
    if name == "pasted":
        inputs_of_text(text, "the clipboard")
    elif name == "journal":
        (folder / FOLDER / "odd.jsonl").write_bytes(data)
        for found in recovered(folder):
            Session(found.opened, folder, memory="plain").recover(found)
    elif name == "branches":
        branches_path(folder / "kept.replay.txt").write_bytes(data)
        open_run(folder / "kept.replay.txt")
    else:
        (folder / name).write_bytes(data)
        open_and_write(folder / ("written.replay.txt" if name == "part.inputs.txt" else name))


def soak(count: int, seed: int, report: Callable[[str], object] = print) -> Trial:
    """Read so many odd texts."""
    trial = Trial(slow=SLOW_S)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        texts = seeds(folder)
        names = list(texts)
        for number in range(seed, seed + count):
            rng = random.Random(number)
            name = names[number % len(names)]
            mutated = odd(texts[name], texts[rng.choice(names)], rng)
            trial.read(name, f"seed {number}", partial(look, name, mutated, folder))
            if name.startswith(("part", "written")):
                (folder / name).write_text(texts[name], "utf-8")
            if trial.wrong >= 20:
                break
            if number % 10_000 == 0:
                report(f"{number} texts, {trial.wrong} wrong")
    return trial


def main() -> int:
    """Read odd texts, print what was found and a summary."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", maxsplit=1)[0])
    parser.add_argument("--count", type=int, default=100_000, help="how many texts (default 100000)")
    parser.add_argument("--seed", type=int, default=1, help="of the first text (default 1)")
    options = parser.parse_args()
    wrong = soak(options.count, options.seed).summary()
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return int(bool(wrong) or peak > MOST_MIB)


if __name__ == "__main__":
    sys.exit(main())
