"""Texts made odd, and readers tried on them: only errors of ours may come out, none after two seconds of work."""

from __future__ import annotations

import random
import re
import resource
import time
import traceback
from collections import Counter
from collections.abc import Callable

from ninja_game.errors import NinjaGameError

SLOW_S = 2.0
"""Seconds of processor time, as those of all limits here, so that a busy machine does not count."""

JUNK = [
    *"#$|^!,:*;&-A ",
    "\n",
    "\r\n",
    "\0",
    "\ufeff",
    "é",
    "\x96",
    "\x85",
    "\x1c",
    "\u2028",
    "\U0001f600",
    "\u0663",
    "\u00b2",
    "1_0",
    "NaN",
    "1e999",
    "-1e999",
    "0x7fffffff",
]
JUNK += ["1e-400", "9" * 400, "%24", "%zz", "&userdata=", "0" * 713, "ninja-game level 1\n", "ninja-game replay 2\n"]

EXTREMES = ("-1", "0", "33", "713", "65536", "4294967296", "-9223372036854775809", "1e308", "1e-320", "9" * 5000)
BULK: tuple[str, ...] = (
    *'\n ;01.:-$#|,A"\\[(',
    "!9^1,2,3,4,5,6,7,8,9",
    "\u0301",
    "\u202e",
    "\ud800",
    "R*9 ",
    "mine 5.5,5\n",
)
MOST = 150_000
"""Longest text: one that is read line by line in less than the time that counts as slow."""
_NUMBER = re.compile(r"[+-]?[0-9]+(?:\.[0-9]+)?")


def odd(text: str, other: str, rng: random.Random) -> str:
    """A text that is rebuilt, mutated, or both; ``other``: another one, to take parts from."""
    kind = rng.randrange(3)
    if kind:
        text = rebuilt(text, other, rng)
    return (text if kind == 1 else mutated(text, rng))[:MOST]


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
        most = min(2000, 1 + MOST // (1 + len(parts[place])))
        parts[place:place] = [parts[place]] * rng.choice((1, 2, most))
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


class Trial:
    """Tries readers and counts what they do; ``wrong``: foreign errors and slow readings, each is printed.

    ``slow``: seconds after which a reading is slow.
    """

    def __init__(self, slow: float = SLOW_S) -> None:
        self._slow = slow
        self.outcomes: Counter[str] = Counter()
        self.wrong = 0
        self.started = time.perf_counter()
        self.slowest = 0.0, "nothing"

    def read(self, name: str, case: str, reader: Callable[[], object]) -> None:
        """Let a reader read; ``case`` says how to make the text again."""
        started = time.process_time()
        try:
            reader()
            self.outcomes[f"{name}: read"] += 1
        except NinjaGameError as error:
            self.outcomes[f"{name}: refused"] += len(str(error)) > 0
        except Exception:  # noqa: BLE001 - foreign errors are what is searched
            self._tell(f"{name}: a foreign error, {case}\n{traceback.format_exc()}")
        taken = time.process_time() - started
        self.slowest = max(self.slowest, (taken, f"{name}, {case}"))
        if taken > self._slow:
            self._tell(f"{name}: {taken:.1f} s, {case}")

    def _tell(self, text: str) -> None:
        print(text, flush=True)
        self.wrong += 1

    def summary(self) -> int:
        """Print what was seen; the exit code."""
        for outcome, times in sorted(self.outcomes.items()):
            print(f"{times:8d}  {outcome}")
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(f"peak memory {peak:.0f} MiB, the slowest {self.slowest[0]:.2f} s ({self.slowest[1]})")
        took = time.perf_counter() - self.started
        print(f"{sum(self.outcomes.values())} texts in {took:.0f} s, {self.wrong} wrong")
        return 1 if self.wrong else 0
