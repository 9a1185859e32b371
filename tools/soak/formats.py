"""Feed mutated levels, demos and replays to all readers: only errors of ours may come out, none after over a second.

    python3 tools/dev.py tool soak.formats [--count 100000] [--seed 1] [--reference]

Exit code 0: nothing found; 1: something was, printed with the text that made it.
"""

from __future__ import annotations

import argparse
import random
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator

from ninja_game.errors import NinjaGameError
from ninja_game.formats.ascii.reader import parse_ascii_level, write_ascii_level
from ninja_game.formats.n14.demo import parse_demo, write_demo
from ninja_game.formats.n14.legacy_demo import write_legacy_demo
from ninja_game.formats.n14.level_file import read_level_file
from ninja_game.formats.n14.level_string import level_digest, parse_level_string, write_level_string
from ninja_game.formats.named_level import parse_levels
from ninja_game.formats.numbers import format_exact, parse_number
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import Replay, parse_replay, write_replay
from ninja_game.levels.warnings import level_warnings
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


READERS: dict[str, Callable[[str], object]] = {
    "level string": read_level,
    "level file": read_level_file,
    "ASCII level": parse_ascii_level,
    "demo": read_demo,
    "replay": parse_replay,
    "any levels": parse_levels,
    "any recordings": parse_replays,
    "number": lambda text: format_exact(parse_number(text[:60])),
}


def seeds(*, reference: bool) -> list[str]:
    """Texts of all formats; with ``reference`` also those of ``../shared/n14``."""
    level = parse_level_string(LEVEL)
    demo = parse_demo(DEMO)
    replay = Replay(demo.inputs[:60], 99, "dead", 3, "0f" * 32, level=level, name="walk")
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
        *[path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("levels/*.txt"))],
        *[path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("tests/replays/*.txt"))],
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
        text = mutated(rng.choice(texts if rng.random() < 0.1 else fitting[name]), rng)
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
    print(f"{sum(outcomes.values())} texts in {time.perf_counter() - started:.0f} s, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
