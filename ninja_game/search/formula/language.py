"""Goals and measures as short formulas, such as ``x > 400 and vy < 0``, for many worlds at once.

The grammar is Python's, but no formula is run as Python. A condition also has a margin, its distance from being false
(if negative: from being true), so that a search knows which of two worlds is nearer.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial, reduce
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import FormatError

FormulaValues = NDArray[np.float64]  # one number per world; 1 and 0 are true and false

Scope = Mapping[str, Callable[..., FormulaValues]]
"""The meaning of a formula's names in some worlds: functions of their arguments, which are numbers."""

UNTRUE = -1000.0  # the margin of a false fact such as ``dead``, which has no distance
FAR = " far"  # Suffix of a fact's name for its margin while it is false, below 0. Not every view has it.

MAX_LENGTH = 1000  # characters of a formula
DEEPEST = 40  # levels of brackets and operators in it

_FOREIGN = re.compile(r"[^\w\s.+\-*/<>=!(),]", re.ASCII)

COMPARISONS: dict[type[ast.cmpop], tuple[Callable[..., Any], Callable[[Any, Any], Any]]] = {
    ast.Lt: (np.less, lambda a, b: b - a),
    ast.LtE: (np.less_equal, lambda a, b: b - a),
    ast.Gt: (np.greater, lambda a, b: a - b),
    ast.GtE: (np.greater_equal, lambda a, b: a - b),
    ast.Eq: (np.equal, lambda a, b: -np.abs(a - b)),
    ast.NotEq: (np.not_equal, lambda a, b: np.abs(a - b)),
}
"""Comparisons and their margins."""

ARITHMETIC: dict[type[ast.operator], Callable[..., Any]] = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.divide
}  # fmt: skip

FUNCTIONS: dict[str, tuple[int, Callable[..., Any]]] = {
    "abs": (1, np.abs), "min": (2, np.minimum), "max": (2, np.maximum), "hypot": (2, np.hypot)
}  # fmt: skip
"""Functions of numbers, with the number of their arguments."""


class FormulaError(FormatError):
    """A formula that cannot be read. ``file``: its use, such as "goal", if known."""

    def __str__(self) -> str:
        """The text of other format errors, with the column in words."""
        place = ", ".join(filter(None, (self.file, f"column {self.column}" if self.column else "")))
        return str(FormatError(self.what, place, found=self.found, expected=self.expected, hint=self.hint))


@dataclass(frozen=True)
class Formula:
    """A parsed formula. ``truth``: it is true or false; otherwise it is a number, which is its margin, too.

    ``parts``: of one whose parts are joined by ``and``, each with its text.
    """

    value: Callable[[Scope], Any]
    margin: Callable[[Scope], Any]
    truth: bool = True
    parts: tuple[tuple[str, Formula], ...] = ()


def parse_truth(text: str, names: Mapping[str, int], facts: Sequence[str]) -> Formula:
    """Parse a formula that is true or false, such as a goal. Raises FormulaError.

    ``names``: the number of arguments of each name; ``facts``: the names that are true or false.
    """
    return _parse(text, names, facts, truth=True)


def parse_measure(text: str, names: Mapping[str, int], facts: Sequence[str]) -> Formula:
    """Parse a formula that is a number, such as a measure. Raises FormulaError."""
    return _parse(text, names, facts, truth=False)


def _parse(text: str, names: Mapping[str, int], facts: Sequence[str], *, truth: bool) -> Formula:
    if len(text) > MAX_LENGTH:
        raise FormulaError("a formula that is too long", found=f"{len(text)} characters", expected=str(MAX_LENGTH))
    if foreign := _FOREIGN.search(text):
        expected = "names, numbers, + - * / ( ) < <= > >= == !="
        raise FormulaError("a character that no formula has", "", 0, foreign.start() + 1, repr(foreign[0]), expected)
    start = len(text) - len(text.lstrip())
    try:
        with warnings.catch_warnings(action="ignore"):  # for "1and", which a later Python will refuse
            tree = ast.parse(re.sub(r"\s", " ", text.strip()), mode="eval").body
    except SyntaxError as error:
        column = min(start + (error.offset or MAX_LENGTH), len(text) + 1)
        found = repr(text[column - 1 :][:30]) if column <= len(text) else "the end"
        raise FormulaError("not a formula", "", 0, column, found, "one such as x > 400 and vy < 0") from None
    except (RecursionError, MemoryError):
        raise FormulaError("too many brackets in brackets", expected=f"at most {DEEPEST}") from None
    formula = _Reader(text, names, facts, start).formula(tree)
    if formula.truth != truth:
        what = "a number, neither true nor false" if truth else "true or false, no number"
        expected = "a comparison or a fact, such as x > 400" if truth else "a number, such as vx or distance(x, y)"
        raise FormulaError(what, found=repr(text[:60]), expected=expected)
    return formula


@dataclass
class _Reader:
    """Turns the parts of a syntax tree that formulas allow into formulas; ``start``: where the tree's text begins."""

    text: str
    names: Mapping[str, int]
    facts: Sequence[str]
    start: int
    depth: int = 0

    def error(self, node: ast.expr, what: str, expected: str, hint: str = "") -> FormulaError:
        column = self.start + node.col_offset + 1
        return FormulaError(what, "", 0, column, repr(self.source(node)[:30]), expected, hint)

    def source(self, node: ast.expr) -> str:
        return self.text[self.start + node.col_offset : self.start + (node.end_col_offset or 0)]

    def formula(self, node: ast.expr) -> Formula:
        """The formula of any part of the tree."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise self.error(node, "too many brackets in brackets", f"at most {DEEPEST}")
        try:
            match node:
                case ast.BoolOp(op, parts):
                    both, facts = isinstance(op, ast.And), [*map(self.truth, parts)]
                    named = tuple(zip(map(self.source, parts), facts, strict=True)) if both else ()
                    return replace(reduce(_AND if both else _OR, facts), parts=named)
                case ast.UnaryOp(ast.Not(), part):
                    fact = self.truth(part)
                    return Formula(lambda view: 1.0 - fact.value(view), lambda view: -fact.margin(view))
                case ast.UnaryOp(ast.USub(), part):
                    value = self.number(part)
                    return _number(lambda view: -value(view))
                case ast.Compare(first, signs, rest):
                    return self.comparison(node, [first, *rest], signs)
                case ast.BinOp(left, sign, right) if type(sign) in ARITHMETIC:
                    a, b = self.number(left), self.number(right)
                    do = ARITHMETIC[type(sign)]
                    return _number(lambda view: do(a(view), b(view)))
                case ast.Constant(int() | float() as value) if not isinstance(value, bool):
                    constant = np.float64(value if value < 10**308 else np.inf)
                    return _number(lambda _: constant)
                case ast.Name(name):
                    return self.named(node, name, [])
                case ast.Call(ast.Name(name), parts, []):
                    return self.named(node, name, parts)
        finally:
            self.depth -= 1
        raise self.error(node, "not a part of a formula", "names, numbers, + - * /, comparisons, and, or, not")

    def truth(self, node: ast.expr) -> Formula:
        """The formula of a part that must be true or false."""
        formula = self.formula(node)
        if not formula.truth:
            raise self.error(node, "a number beside 'and', 'or' or 'not'", "a comparison, such as x > 400")
        return formula

    def number(self, node: ast.expr) -> Callable[[Scope], Any]:
        """The value of a part that must be a number."""
        formula = self.formula(node)
        if formula.truth:
            raise self.error(node, "true or false where a number belongs", "numbers, such as x + 5")
        return formula.value

    def comparison(self, node: ast.expr, parts: Sequence[ast.expr], signs: Sequence[ast.cmpop]) -> Formula:
        """Read ``a < b``, and ``a < b < c`` with Python's meaning."""
        if not {*map(type, signs)} <= COMPARISONS.keys():
            raise self.error(node, "an unknown comparison", "< <= > >= == !=")
        pairs = zip(pairwise(map(self.number, parts)), signs, strict=True)
        return reduce(_AND, (_comparison(a, b, *COMPARISONS[type(sign)]) for (a, b), sign in pairs))

    def named(self, node: ast.expr, name: str, parts: Sequence[ast.expr]) -> Formula:
        count, function = FUNCTIONS.get(name, (self.names.get(name), None))
        if count is None:
            raise self.error(node, "an unknown name", ", ".join([*self.names, *FUNCTIONS]))
        if len(parts) != count:
            usage = f"{name}({', '.join(['number'] * count)})" if count else name
            raise self.error(node, f"'{name}' with {len(parts)} numbers", usage)
        numbers = [self.number(part) for part in parts]

        def value(view: Scope) -> Any:
            return (function or view[name])(*(number(view) for number in numbers))

        if name not in self.facts:
            return _number(value)

        def margin(view: Scope) -> Any:
            far = view[name + FAR](*(number(view) for number in numbers)) if name + FAR in view else UNTRUE
            return np.where(value(view) > 0, 0.0, far)

        return Formula(value, margin)


def _number(value: Callable[[Scope], Any]) -> Formula:
    return Formula(value, value, truth=False)


def _comparison(
    a: Callable[[Scope], Any], b: Callable[[Scope], Any], compare: Callable[..., Any], margin: Callable[[Any, Any], Any]
) -> Formula:
    return Formula(
        lambda view: np.asarray(compare(a(view), b(view)), np.float64), lambda view: margin(a(view), b(view))
    )


def _joined(join: Callable[..., Any], left: Formula, right: Formula) -> Formula:
    return Formula(
        lambda view: join(left.value(view), right.value(view)), lambda view: join(left.margin(view), right.margin(view))
    )


_AND, _OR = partial(_joined, np.minimum), partial(_joined, np.maximum)
