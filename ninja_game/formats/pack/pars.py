"""Par times of levels, derived from their certificates, and the table that holds them (docs/making-levels.md)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, inf
from typing import Any

from ninja_game.errors import PackError
from ninja_game.files.untrusted import parse_toml

MARGINS = {"author": 0.05, "gold": 0.225, "silver": 0.6}
"""Shares by which a run may be longer than the certificate, by medal, the best first, in a level without risks.

Source: people's best runs are 5 % longer than tool-assisted ones (median of 218 levels), and at most 22.5 % longer on
19 of 20 levels. Silver is chosen, not measured: for a player who has just understood the level.
"""

MEDALS = (*MARGINS, "bronze")  # the best first; bronze is for every pass

MARGIN_GROWTH = 0.25
"""Growth of a margin per point of difficulty, as a share of it: careful play takes longer. Chosen, not tuned."""

DIFFICULTY_GRADES = {1.5: "easy", 4.0: "medium", 8.0: "hard", 15.0: "very hard", inf: "extreme"}
"""Words for difficulties below a number, for players."""

_PAR_STEP = 4  # pars are rounded up to multiples of this many ticks: a tenth of a second

DIGEST_DIGITS = 16  # digits of a digest in the table

_HEADER = "# Made by `ninja-game levels pars` from the levels and their certificates: exit and gold in ticks.\n\n"


def grade_of(difficulty: float) -> str:
    """A difficulty in a word.

    >>> [grade_of(points) for points in (0.2, 0.8, 5.0, 40.0)]
    ['easy', 'easy', 'hard', 'extreme']
    """
    return next(word for below, word in DIFFICULTY_GRADES.items() if difficulty < below)


@dataclass(frozen=True)
class Pars:
    """Measurements of a level's certificates.

    ``level``, ``run``: digests of the level and of its run to the exit, the sources of the rest. ``exit``: the tick of
    that run's exit contact; ``gold``: the same in the run with all gold, None without one. ``difficulty``: as in
    ``ninja_game.batch.difficulty``.
    """

    level: str
    run: str
    exit: int
    gold: int | None = None
    difficulty: float | None = None

    @property
    def grade(self) -> str:
        """The difficulty in a word, "" if it is unknown."""
        return "" if self.difficulty is None else grade_of(self.difficulty)

    def par(self, medal: str) -> int:
        """The last tick of an exit contact that still earns a medal with a margin, which difficulty widens.

        >>> [Pars("", "", 400, difficulty=points).par("gold") for points in (None, 0.0, 4.0)]
        [492, 492, 580]
        """
        margin = MARGINS[medal] * (1 + MARGIN_GROWTH * (self.difficulty or 0.0))
        return _PAR_STEP * ceil(round(self.exit * (1 + margin) / _PAR_STEP, 6))

    def medal(self, tick: int) -> str:
        """The best medal for an exit contact in ``tick``."""
        return next((medal for medal in MARGINS if tick <= self.par(medal)), MEDALS[-1])

    def next_medal(self, tick: int) -> str:
        """The medal better than that for an exit contact in ``tick``, "" for the best."""
        return next((medal for medal in reversed(MARGINS) if tick > self.par(medal)), "")


def parse_pars(text: str, *, file: str = "") -> dict[str, Pars]:
    """Read the table of a pack, by level file. Raises PackError."""
    try:
        tables = parse_toml(text)
    except ValueError as error:
        raise PackError(f"no TOML: {error}", file) from None
    pars = {}
    for name, table in tables.items():
        if not isinstance(table, dict) or not _is_complete(table):
            raise PackError(f"the pars of {name!r}", file, hint="`ninja-game levels pars` makes the table again")
        pars[name] = Pars(**table)
    return pars


def _is_complete(table: Mapping[str, Any]) -> bool:
    kinds = {"level": str, "run": str, "exit": int, "gold": int, "difficulty": float}
    typed = all(type(value) is kinds.get(key) for key, value in table.items())
    numbers = [value for value in table.values() if not isinstance(value, str)]
    return typed and {"level", "run", "exit"} <= table.keys() and all(0 <= value < 1e6 for value in numbers)


def write_pars(pars: Mapping[str, Pars]) -> str:
    """Write the table as TOML, one line per level file, in their order."""
    lines = []
    for name in sorted(pars):
        entry = pars[name]
        values = [f'level = "{entry.level}"', f'run = "{entry.run}"', f"exit = {entry.exit}"]
        values += [f"gold = {entry.gold}"] if entry.gold is not None else []
        values += [f"difficulty = {entry.difficulty:.2f}"] if entry.difficulty is not None else []
        lines.append(f"{_key(name)} = {{ {', '.join(values)} }}\n")
    return _HEADER + "".join(lines)


def _key(name: str) -> str:
    escaped = "".join(f"\\u{ord(char):04x}" if ord(char) < 32 or ord(char) == 127 else char for char in name)
    return '"' + escaped.replace('"', '\\"') + '"'
