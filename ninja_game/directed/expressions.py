"""Goals and measures as short formulas, ``x > 400 and vy < 0``, read by us and never run as a program."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ninja_game.directed import formula
from ninja_game.directed.formula import COMPARISONS, FUNCTIONS, Formula, Numbers, View
from ninja_game.errors import FormatError

LONGEST = 1000
"""Characters of a formula."""
DEEPEST = 40
"""Brackets in brackets."""

_WORD = re.compile(r"\s*(?:([0-9]+(?:\.[0-9]*)?|\.[0-9]+)|([a-z_]+)|(<=|>=|==|!=|[-+*/<>(),]))", re.ASCII)


class FormulaError(FormatError):
    """A formula that cannot be read. ``file``: what it is for, such as "goal", if that is known."""

    def __str__(self) -> str:
        """As of other texts, with the column in words."""
        place = ", ".join(filter(None, (self.file, f"column {self.column}" if self.column else "")))
        return str(FormatError(self.what, place, found=self.found, expected=self.expected, hint=self.hint))


def parse_truth(text: str, names: Mapping[str, int], facts: Sequence[str]) -> Formula:
    """A formula that is true or false, such as a goal. Raises FormulaError.

    ``names``: how many numbers each name takes in brackets; ``facts``: those of them that are true or false.
    """
    return _parse(text, names, facts, truth=True)


def parse_number(text: str, names: Mapping[str, int], facts: Sequence[str]) -> Formula:
    """A formula that is a number, such as what is to be greatest. Raises FormulaError."""
    return _parse(text, names, facts, truth=False)


def _parse(text: str, names: Mapping[str, int], facts: Sequence[str], *, truth: bool) -> Formula:
    reader = _Reader(text, names, facts)
    found = reader.any_of()
    if reader.word:
        raise reader.error("something after the end", "and, or, a comparison or nothing")
    if found.truth != truth:
        what = "a number, neither true nor false" if truth else "true or false, no number"
        expected = "a comparison or a fact, such as x > 400" if truth else "a number, such as vx or distance(x, y)"
        raise FormulaError(what, found=repr(text[:60]), expected=expected)
    return found


class _Reader:
    """Reads a formula from left to right; each method one level of binding."""

    def __init__(self, text: str, names: Mapping[str, int], facts: Sequence[str]) -> None:
        if len(text) > LONGEST:
            raise FormulaError("a formula that is too long", found=f"{len(text)} characters", expected=str(LONGEST))
        self.text, self.names, self.facts = text, names, facts
        self.end = self.start = self.depth = 0
        self.word = self.kind = ""
        self.advance()

    def advance(self) -> str:
        """Go on to the next word; the one left behind."""
        old, rest = self.word, self.text[self.end :]
        self.start = self.end + len(rest) - len(rest.lstrip())
        match = _WORD.match(self.text, self.end)
        if match is None:
            if rest.strip():
                self.word = rest.strip()[0]
                raise self.error("a character that no formula has", "names, numbers, + - * / ( ) < <= > >= == !=")
            self.word = self.kind = ""
            return old
        self.end = match.end()
        self.word = match[match.lastindex or 0]
        self.kind = ("", "number", "name", "sign")[match.lastindex or 0]
        return old

    def error(self, what: str, expected: str, hint: str = "") -> FormulaError:
        """The error at the present word."""
        found = repr(self.word) if self.word else "the end"
        return FormulaError(what, column=self.start + 1, found=found, expected=expected, hint=hint)

    def take(self, word: str) -> None:
        """Go over a word that must be there."""
        if self.word != word:
            raise self.error("an unfinished formula", repr(word))
        self.advance()

    def any_of(self) -> Formula:
        """``a or b``."""
        return self.joined("or", self.all_of)

    def all_of(self) -> Formula:
        """``a and b``."""
        return self.joined("and", self.negation)

    def joined(self, word: str, part: Callable[[], Formula]) -> Formula:
        """Truths with a word between."""
        left = part()
        while self.word == word:
            self.truth_wanted(left)
            self.advance()
            right = part()
            self.truth_wanted(right)
            left = formula.joined(word, left, right)
        return left

    def truth_wanted(self, formula: Formula) -> None:
        """Raise FormulaError for a number."""
        if not formula.truth:
            raise self.error("a number beside 'and', 'or' or 'not'", "a comparison, such as x > 400")

    def negation(self) -> Formula:
        """``not a``."""
        if self.word != "not":
            return self.comparison()
        self.advance()
        self.deeper(1)
        part = self.negation()
        self.deeper(-1)
        self.truth_wanted(part)
        return formula.negation(part)

    def comparison(self) -> Formula:
        """``a < b``."""
        left = self.sum()
        if self.word not in COMPARISONS:
            return left
        self.number_wanted(left)
        sign = self.advance()
        right = self.sum()
        self.number_wanted(right)
        if self.word in COMPARISONS:
            raise self.error("two comparisons in a row", "and, or, nothing", "write x > 1 and x < 2")
        return formula.comparison(sign, left, right)

    def number_wanted(self, formula: Formula) -> None:
        """Raise FormulaError for a truth."""
        if formula.truth:
            raise self.error("a truth where a number belongs", "numbers, such as x + 5")

    def sum(self) -> Formula:
        """``a + b``."""
        return self.chain("+-", self.product)

    def product(self) -> Formula:
        """``a * b``."""
        return self.chain("*/", self.signed)

    def chain(self, signs: str, part: Callable[[], Formula]) -> Formula:
        """Numbers with signs between, from left to right."""
        left = part()
        while self.word and self.word in signs:
            self.number_wanted(left)
            sign = self.advance()
            right = part()
            self.number_wanted(right)
            left = formula.arithmetic(sign, left, right)
        return left

    def signed(self) -> Formula:
        """``-a``."""
        if self.word != "-":
            return self.atom()
        self.advance()
        self.deeper(1)
        part = self.signed()
        self.deeper(-1)
        self.number_wanted(part)
        return formula.number(self.text, lambda view: -part.value(view))

    def deeper(self, by: int) -> None:
        """Count what lies in what. Raises FormulaError for too much of it."""
        self.depth += by
        if self.depth > DEEPEST:
            raise self.error("too many brackets in brackets", f"at most {DEEPEST}")

    def atom(self) -> Formula:
        """A number, a name, a function or brackets."""
        if self.kind == "number":
            value = float(self.advance())
            return formula.number(self.text, lambda _: np.float64(value))
        if self.word == "(":
            self.advance()
            self.deeper(1)
            inner = self.any_of()
            self.deeper(-1)
            self.take(")")
            return inner
        if self.kind != "name" or self.word in {"and", "or", "not"}:
            raise self.error("an unfinished formula", "a number, a name or '('")
        return self.named()

    def named(self) -> Formula:
        """A name with its arguments."""
        name = self.word
        function = FUNCTIONS.get(name)
        count = function[0] if function else self.names.get(name)
        if count is None:
            raise self.error("an unknown name", ", ".join([*self.names, *FUNCTIONS]))
        self.advance()
        parts = self.arguments(name, count) if count else []

        def value(view: View) -> Numbers:
            do = function[1] if function else view[name]
            return do(*(part.value(view) for part in parts))

        return formula.fact(self.text, value) if name in self.facts else formula.number(self.text, value)

    def arguments(self, name: str, count: int) -> list[Formula]:
        """The numbers in the brackets behind a name."""
        if self.word != "(":
            raise self.error(f"'{name}' without its numbers", f"({', '.join('number' for _ in range(count))})")
        parts: list[Formula] = []
        self.deeper(1)
        for index in range(count):
            self.take("," if index else "(")
            parts.append(self.sum())
            self.number_wanted(parts[-1])
        self.deeper(-1)
        self.take(")")
        return parts
