"""The categories of a board (``board.toml``): what counts, and what ranks it."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ninja_game.board.runs import ASSISTED, PLAYED, Run
from ninja_game.errors import FormatError
from ninja_game.files.reading import read_utf8
from ninja_game.files.untrusted import parse_toml
from ninja_game.formats.run_time import seconds_text
from ninja_game.search.formula.language import Formula, FormulaError, FormulaValues, parse_measure, parse_truth
from ninja_game.sim.rules import TICKS_PER_SECOND

RUN_NUMBERS: dict[str, Callable[[Run], float]] = {
    "ticks": lambda run: run.tick, "gold": lambda run: run.gold, "score": lambda run: run.score,
    "all_gold": lambda run: run.entry.all_gold, "jumps": lambda run: run.jumps, "presses": lambda run: run.presses,
}  # fmt: skip
"""The values of a run for formulas: ticks to the exit, gold, score (ticks), gold of the level, jumps, keys pressed."""

_MAX_BYTES = 2**20  # size of a ``board.toml``
MAX_CATEGORIES = 12
MAX_RANKS = 4  # most formulas that rank a category
_MAX_NAME = 40
_FAR_TICKS = 5 * TICKS_PER_SECOND

_KEYS: Mapping[str, type] = {"name": str, "rank": list, "when": str, "episodes": bool}
_WORSE = {
    "ticks": "slower", "gold": "more gold", "-gold": "less gold", "-score": "lower score", "jumps": "more jumps",
    "presses": "more presses",
}  # fmt: skip
"""The words for a run that is worse by a formula."""
_ARGUMENTS = dict.fromkeys(RUN_NUMBERS, 0)


@dataclass(frozen=True)
class Category:
    """Runs for which ``when`` holds (all, if it is ""), by the numbers ``rank``, the least first.

    ``episodes``: the first number is added up over the levels of an episode.
    """

    name: str
    rank: tuple[str, ...]
    when: str = ""
    episodes: bool = False
    _numbers: tuple[Formula, ...] = field(init=False, repr=False, compare=False)
    _truth: Formula = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Read the formulas. Raises FormulaError."""
        object.__setattr__(self, "_numbers", tuple(parse_measure(number, _ARGUMENTS, ()) for number in self.rank))
        object.__setattr__(self, "_truth", parse_truth(self.when or "0 == 0", _ARGUMENTS, ()))

    def values(self, runs: Sequence[Run]) -> list[tuple[float, ...] | None]:
        """The numbers that rank each run, the smaller the better; None for a run outside of the category."""
        view = {name: _given(np.array([value(run) for run in runs], np.float64)) for name, value in RUN_NUMBERS.items()}
        with np.errstate(all="ignore"):
            columns = [np.broadcast_to(number.value(view), len(runs)) for number in (self._truth, *self._numbers)]
        table = np.stack(columns, axis=1)
        counts = np.isfinite(table).all(axis=1) & (table[:, 0] > 0)
        return [tuple(row[1:]) if good else None for row, good in zip(table.tolist(), counts.tolist(), strict=True)]

    @cached_property
    def greatest_first(self) -> bool:
        """Whether a greater value is better: its first formula begins with a minus."""
        return bool(re.fullmatch("-[^-+]+", self.rank[0].strip()))

    @property
    def _shown(self) -> str:
        """The first formula, without the minus of ``greatest_first``."""
        return self.rank[0].strip()[self.greatest_first :].strip()

    @property
    def unit(self) -> str:
        """The heading of the first number's column."""
        return {"ticks": "Time", "score": "Score"}.get(self._shown, "Value")

    def text(self, value: float) -> str:
        """The first number, as people read it."""
        return self.difference(-value if self.greatest_first else value)

    def measured(self, value: float) -> str:
        """The first number with its unit.

        >>> HIGHEST.measured(-3657), Category("Fewest keys", ("presses",)).measured(1)
        ('91.425 points', '1 press')
        """
        counts = {"Time": "s", "Score": "points"}.get(self.unit, self._shown if self._shown in RUN_NUMBERS else "")
        text = f"{self.text(value)} {counts}".rstrip()
        return {"1 presses": "1 press", "1 jumps": "1 jump"}.get(text, text)

    def decided_by(self, values: Sequence[float], best: Sequence[float]) -> str:
        """The criterion that decides against a run with the best first number.

        >>> FASTEST.decided_by((40, -3), (40, -5))
        'same time, less gold'
        >>> Category("A", ("gold", "presses + jumps")).decided_by((0, 3), (0, 2))
        'same value, by presses + jumps'
        """
        rank = next(rank.strip() for rank, ours, theirs in zip(self.rank, values, best, strict=True) if ours != theirs)
        return f"same {self.unit.lower()}, " + _WORSE.get(rank, f"by {rank}")

    def difference(self, amount: float) -> str:
        """The improvement of a first number, as people read it."""
        if self.unit == "Value":
            return f"{amount:g}"
        return ("-" if amount < 0 else "") + seconds_text(round(abs(amount)))

    def is_far(self, value: float, first: float) -> bool:
        """Whether a time is so far behind the first that its run had another aim, such as gold.

        >>> FASTEST.is_far(900, 344), FASTEST.is_far(60, 23), HIGHEST.is_far(900, 344)
        (True, False, False)
        """
        return self.unit == "Time" and value > max(2 * first, first + _FAR_TICKS)

    def gain(self, amount: float) -> str:
        """The improvement over the record before, or the deciding criterion if the first numbers are equal.

        >>> FASTEST.gain(5), FASTEST.gain(0)
        ('0.125', 'gold')
        """
        return self.difference(amount) if amount else ", ".join(rank.strip(" -") for rank in self.rank[1:])


def _given(values: FormulaValues) -> Callable[[], FormulaValues]:
    return lambda: values


FASTEST = Category("Fastest", ("ticks", "-gold"), episodes=True)
HIGHEST = Category("Highest score", ("-score", "ticks"))
DEFAULT_CATEGORIES = (FASTEST, HIGHEST)
"""The default categories: the time to the exit, and the score with gold (game.md §1.3)."""


class BoardRules(NamedTuple):
    """The rules of a board, from its ``board.toml``: which runs it ranks, and by what."""

    categories: tuple[Category, ...] = DEFAULT_CATEGORIES
    name: str = ""  #: name of the board, "" for none
    unknown: str = PLAYED  #: the ladder of runs that do not say how they were made


def read_rules(path: Path) -> BoardRules:
    """The rules in a text. Raises FormatError with the place and the problem, FileError, OSError."""
    file = str(path)
    text = read_utf8(path, _MAX_BYTES)
    try:
        table = parse_toml(text)
    except ValueError as error:
        raise FormatError(f"no TOML: {error}", file) from None
    others = dict(table)
    title = others.pop("name", "")
    unknown = others.pop("unknown", PLAYED)
    tables = others.pop("category", None)
    if not isinstance(title, str) or len(title) > _MAX_NAME:
        raise FormatError("not the name of a board", file, expected=f"a text of at most {_MAX_NAME} characters")
    if unknown not in (PLAYED, ASSISTED):
        found, expected = ascii(unknown)[:60], f'"{PLAYED}" or "{ASSISTED}"'
        raise FormatError("'unknown' is no ladder", file, found=found, expected=expected)
    if tables is None and table and not others:
        return BoardRules(DEFAULT_CATEGORIES, title.strip(), unknown)
    if others or not isinstance(tables, list) or not 1 <= len(tables) <= MAX_CATEGORIES:
        expected = f"1 to {MAX_CATEGORIES} tables [[category]], a name, unknown"
        raise FormatError("no categories of a board", file, expected=expected)
    categories = tuple(_category(category, f"{file}: category {number}") for number, category in enumerate(tables, 1))
    names = [category.name.casefold() for category in categories]
    if len(set(names)) < len(names):
        raise FormatError("two categories have one name", file, found=next(n for n in names if names.count(n) > 1))
    return BoardRules(categories, title.strip(), unknown)


def _category(table: Any, place: str) -> Category:
    """A category from its table. Raises FormatError."""
    if not isinstance(table, dict) or not {"name", "rank"} <= set(table) <= set(_KEYS):
        text = ", ".join(map(str, table))[:60] if isinstance(table, dict) else ascii(table)[:60]
        raise FormatError("not the keys of a category", place, found=text, expected="name, rank; also when, episodes")
    for key, value in table.items():
        if not isinstance(value, _KEYS[key]):
            raise FormatError(f"{key!r} is of the wrong type", place, expected=_KEYS[key].__name__)
    name, rank = table["name"], table["rank"]
    if not name.strip() or len(name) > _MAX_NAME:
        raise FormatError("a name that is empty or too long", place, expected=f"1 to {_MAX_NAME} characters")
    if not 1 <= len(rank) <= MAX_RANKS or not all(isinstance(part, str) for part in rank):
        raise FormatError(
            "'rank' is no list of formulas", place, expected=f'1 to {MAX_RANKS}, such as ["gold", "ticks"]'
        )
    try:
        return Category(name.strip(), tuple(rank), table.get("when", ""), table.get("episodes", False))
    except FormulaError as error:
        error.file = place
        raise
