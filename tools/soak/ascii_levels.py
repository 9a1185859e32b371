"""Write and read again all reference levels as ASCII levels, then read mutated ones; prints counts.

    python3 tools/dev.py tool soak.ascii_levels [NUMBER OF MUTATIONS]

Without the reference data only the bundled levels are mutated.
"""

from __future__ import annotations

import random
import sys
import time
from collections import Counter

from ninja_game.errors import NinjaGameError
from ninja_game.formats.ascii.legend import SYMBOLS, TILE_CHARS
from ninja_game.formats.ascii.object_writer import same_record
from ninja_game.formats.ascii.reader import parse_ascii_level, write_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string, write_level_string
from ninja_game.levels.warnings import level_warnings
from tests.support.reference import fuzz, levels, random_runs, reference_folder, scenes
from tools import ROOT

ALPHABET = TILE_CHARS + "".join(symbol.char for symbol in SYMBOLS) + '0123456789.,;:|"\\\n -px?'


def round_trips() -> list[str]:
    """The ASCII texts of all reference levels; prints how many came back to the bit, and their N texts too."""
    texts: list[str] = []
    counts: Counter[str] = Counter()
    for name, rows in (("levels", levels()), ("scenes", scenes()), ("fuzz", fuzz()), ("random runs", random_runs())):
        for data in {row.data: None for row in rows}:
            level = parse_level_string(data)
            text = write_ascii_level(level)
            read = parse_ascii_level(text).level
            same = read.tiles == level.tiles and len(read.objects) == len(level.objects)
            same = same and all(map(same_record, read.objects, level.objects))
            counts[f"{name}: {'same' if same else 'DIFFERENT'}"] += 1
            counts[f"{name}: N text {'same' if write_level_string(read) == data else 'differs'}"] += 1
            texts.append(text)
    for what, count in counts.items():
        print(f"{count:6d}  {what}")
    return texts


def mutated(text: str, rng: random.Random) -> str:
    """The text with a few characters replaced, lines swapped, doubled or cut."""
    for _ in range(rng.randint(1, 5)):
        place = rng.randrange(len(text) + 1)
        text = text[:place] + "".join(rng.choices(ALPHABET, k=rng.randint(0, 4))) + text[place + rng.randint(0, 4) :]
    lines = text.split("\n")
    if rng.random() < 0.3:
        lines.insert(rng.randrange(len(lines)), rng.choice(lines))
    if rng.random() < 0.2:
        del lines[rng.randrange(len(lines))]
    return "\n".join(lines)


def mutations(texts: list[str], count: int) -> None:
    """Read mutated texts; anything but an error of ours ends the soak with a traceback."""
    rng = random.Random(1)
    counts: Counter[str] = Counter()
    slowest = 0.0
    for _ in range(count):
        text = mutated(rng.choice(texts), rng)
        start = time.perf_counter()
        try:
            level = parse_ascii_level(text, file="mutant.txt").level
            level_warnings(level)
            counts["read"] += 1
        except NinjaGameError as error:
            str(error)
            counts["refused"] += 1
        slowest = max(slowest, time.perf_counter() - start)
    print(f"{count:6d}  mutated: {dict(counts)}, slowest {slowest * 1000:.0f} ms")


if __name__ == "__main__":
    bundled = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "levels").glob("*.txt"))]
    mutations(bundled + (round_trips() if reference_folder() else []), int((sys.argv[1:] or ["10000"])[0]))
