"""Feed mutated levels, demos, replays, traces and names to all readers: only errors of ours, none after over a second.

    python3 tools/dev.py tool soak.formats [--count 1000000] [--seed 1] [--reference]

Exit code 0: nothing found; 1: something was, printed with the text that made it.
"""

from __future__ import annotations

import argparse
import io
import random
import re
import resource
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator

from ninja_game.errors import NinjaGameError
from ninja_game.files.shown_text import file_stem, shown_text
from ninja_game.formats.ascii.reader import parse_ascii_level, write_ascii_level
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.legacy_demo import write_legacy_demo
from ninja_game.formats.n14.level_file import read_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.named_level import parse_levels
from ninja_game.formats.numbers import format_exact, parse_number
from ninja_game.formats.recording import parse_replays, record_of
from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
from ninja_game.levels.warnings import level_warnings
from ninja_game.runs.run import trace_level
from ninja_game.runs.trace_files import FiledTrace, read_csv, write_csv
from tools import ROOT

SLOW_S = 1.0

DEMO = "902:35791394|35791394|115483170|107374182|17895697|0"
LEVEL = (
    ("1" * 23 + ("0" * 20 + ":13") * 29 + "1" * 23)
    + "|5^60,540!0^396,300!1^204,180!2^60,564,0.707106781186547,-0.707106781186547!3^588,108!4^252,570,1"
    + "!6^252,132,0,1,0,2!7^348,372,3!8^444,84,1!9^468,348,0,0,20,14,1,-1,0!10^636,60!11^708,516,84,60"
    + "!12^300,561!0^408.15,NaN"
)
JUNK = [
    *"#$|^!,:*;&-A ",
    "\n",
    "\r\n",
    "\0",
    "\ufeff",
    "é",
    "\x96",
    "\U0001f600",
    "NaN",
    "1e999",
    "-1e999",
    "0x7fffffff",
]
JUNK += ["1e-400", "9" * 400, "%24", "%zz", "&userdata=", "0" * 713, "ninja-game level 1\n", "ninja-game replay 2\n"]

EXTREMES = ("-1", "0", "33", "713", "65536", "4294967296", "-9223372036854775809", "1e308", "1e-320", "9" * 5000)
BULK: tuple[str, ...] = (*"\n ;0$#|", "!9^1,2,3,4,5,6,7,8,9", "\u0301", "\u202e", "\ud800", "R*9 ", "mine 5.5,5\n")
MOST = 150_000
"""Longest text: one that is read line by line in less than the time that counts as slow."""
_NUMBER = re.compile(r"[+-]?[0-9]+(?:\.[0-9]+)?")


def read_level(text: str) -> None:
    """An in-game string: read, digest, warnings, and writing in both forms."""
    level = parse_level_string(text)
    level_digest(level)
    level_warnings(level)
    write_ascii_level(level)
    write_level_string(level, exact=True)


def read_demo(text: str) -> None:
    """A demo, 4-bit or legacy: read, played back, written."""
    demo = parse_demo(text)
    demo.playback(1000)
    write_demo(demo)


def read_ascii(text: str) -> None:
    """An ASCII level: what is read is the same when it is written and read again."""
    read = parse_ascii_level(text)
    again = parse_ascii_level(write_ascii_level(read.level, name=read.name, author=read.author, comment=read.comment))
    if level_digest(again.level) != level_digest(read.level) or (again.name, again.author) != (read.name, read.author):
        raise AssertionError("an ASCII level changes when it is written and read")


def read_recordings(text: str) -> None:
    """Recordings of any format, each as a record of N too."""
    for recording in parse_replays(text):
        record_of(recording)


def show(text: str) -> None:
    """A name: shown in one line, and in a file's name."""
    shown = shown_text(text)
    if not shown.isprintable() or len(shown) > 2100 or len(file_stem(text).encode()) > 200:
        raise AssertionError("a name that cannot be shown")


READERS: dict[str, Callable[[str], object]] = {
    "level string": read_level,
    "level file": read_level_file,
    "ASCII level": read_ascii,
    "demo": read_demo,
    "replay": parse_replay,
    "any levels": parse_levels,
    "any recordings": read_recordings,
    "trace table": lambda text: list(read_csv(text.splitlines(keepends=True))),
    "name": show,
    "number": lambda text: format_exact(parse_number(text[:60])),
}


def seeds(*, reference: bool) -> list[str]:
    """Texts of all formats; with ``reference`` also those of ``../shared/n14``."""
    level = parse_level_string(LEVEL)
    demo = parse_demo(DEMO)
    replay = Replay(demo.inputs[:60], 99, "dead", 3, "0f" * 32, level=level, name="walk")
    trace = io.StringIO()
    write_csv([FiledTrace(0, "walk", trace_level(level, demo.inputs[:20], memory="plain"))], trace)
    texts = [
        LEVEL,
        DEMO,
        write_legacy_demo(demo),
        f"free text\n$a hill#us#x#{LEVEL}#\n-- ep01 --\n$###{LEVEL}#{DEMO}#\n",
        f"free text\n&userdata=\n$a+hill%21#us#x#{LEVEL}#\n$###{LEVEL[:300]}\n{LEVEL[300:]}#{DEMO}",
        f"##{DEMO}#",
        write_ascii_level(level, name="A hill", author="us", legend=True),
        write_replay(replay),
        " -0x1.5e+2",
        trace.getvalue(),
        *[path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("levels/*.txt"))],
        *[path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("levels/certificates/*.txt"))],
    ]
    if reference:
        from tests.support import reference as data

        texts += [f"$###{run.data}#{run.demo}#" for run in data.random_runs()[::10]]
        texts += [scene.data for scene in data.scenes()[::5]]
    return texts


def taken_by(text: str) -> list[str]:
    """The readers that take a text as it is."""
    names = []
    for name, reader in READERS.items():
        try:
            reader(text)
            names.append(name)
        except NinjaGameError:
            continue
    return names


def rebuilt(text: str, other: str, rng: random.Random) -> str:
    """A text with its structure changed: its numbers, lines, fields, its end; or joined with another text."""
    kind = rng.randrange(7)
    if kind == 0:
        share = rng.choice((0.001, 0.02, 0.3))
        return _NUMBER.sub(lambda match: rng.choice(EXTREMES) if rng.random() < share else str(match[0]), text)
    if kind == 1:
        return text[: rng.randrange(len(text) + 1)] + other[rng.randrange(len(other) + 1) :]
    if kind == 2:
        return text[: rng.randrange(len(text) + 1)]
    if kind == 3:
        place = rng.randrange(len(text) + 1)
        return text[:place] + rng.choice(BULK) * rng.choice((100, 3000, 50_000)) + text[place:]
    divider = rng.choice(("\n", "\n", "#", "$", "!", ",", "^", "|", " ", ":"))
    parts = text.split(divider)
    place = rng.randrange(len(parts))
    if kind == 4:
        parts[place : place + rng.choice((1, 1, 3))] = []
    elif kind == 5:
        parts[place:place] = [parts[place]] * rng.choice((1, 2, 2000))
    else:
        there = rng.randrange(len(parts))
        parts[place], parts[there] = parts[there], rng.choice((parts[place], rng.choice(other.split(divider))))
    return divider.join(parts)


def mutated(text: str, rng: random.Random) -> str:
    """A text with one to twelve pieces taken out, put in, doubled, moved or changed."""
    for _ in range(rng.choice((1, 1, 2, 3, 12))):
        start = rng.randrange(len(text) + 1)
        end = min(len(text), start + rng.choice((0, 1, 1, 2, 5, 40, 800)))
        piece = text[start:end]
        kind = rng.randrange(7)
        if kind == 0:
            piece = ""
        elif kind == 1:
            piece += rng.choice(JUNK)
        elif kind == 2:
            piece = rng.choice(JUNK)
        elif kind == 3:
            piece *= rng.choice((2, 2, 3, 50))
        elif kind == 4:
            piece = "".join(chr(max(0, ord(char) + rng.choice((-1, 1, 32, -32)))) for char in piece)
        elif kind == 5:
            piece = "".join(rng.sample(piece, len(piece)))
        else:
            piece = "".join(rng.choice("0123456789.,-^!|:#$ RLJ*") for _ in range(rng.randrange(6)))
        text = text[:start] + piece + text[end:]
    return text


def found(count: int, rng: random.Random, texts: list[str], outcomes: Counter[str]) -> Iterator[str]:
    """What is wrong: a report for each foreign error and each slow reading."""
    everywhere = list(READERS)
    fitting: dict[str, list[str]] = {name: [] for name in everywhere}
    for text in texts:
        for name in taken_by(text):
            fitting[name].append(text)
    for number in range(count):
        name = everywhere[number % len(everywhere)]
        # Now and then a text of another format.
        text = rng.choice(texts if rng.random() < 0.1 else fitting[name])
        if number // len(everywhere) % 2:
            text = rebuilt(text, rng.choice(texts), rng)[:MOST]
        if not number // len(everywhere) % 3:
            text = mutated(text, rng)
        started = time.perf_counter()
        try:
            READERS[name](text)
            outcomes[f"{name}: read"] += 1
        except NinjaGameError as error:
            outcomes[f"{name}: refused"] += 1
            str(error)
        except Exception:  # noqa: BLE001 - foreign errors are what is searched
            yield f"{name}: a foreign error\n{traceback.format_exc()}\n{text!r}"
        taken = time.perf_counter() - started
        if taken > SLOW_S:
            yield f"{name}: {taken:.1f} s\n{text!r}"


def main() -> int:
    """Fuzz, print what was found and a summary."""
    parser = argparse.ArgumentParser(description="Feed mutated levels, demos and replays to all readers.")
    parser.add_argument("--count", type=int, default=100_000, help="how many texts (default 100000)")
    parser.add_argument("--seed", type=int, default=1, help="of the random numbers (default 1)")
    parser.add_argument("--reference", action="store_true", help="mutate texts of ../shared/n14 too")
    options = parser.parse_args()
    outcomes: Counter[str] = Counter()
    wrong = 0
    started = time.perf_counter()
    for report in found(options.count, random.Random(options.seed), seeds(reference=options.reference), outcomes):
        print(report)
        wrong += 1
        if wrong >= 20:
            break
    for outcome, times in sorted(outcomes.items()):
        print(f"{times:8d}  {outcome}")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"peak memory {peak:.0f} MiB")
    print(f"{sum(outcomes.values())} texts in {time.perf_counter() - started:.0f} s, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
