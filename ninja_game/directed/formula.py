"""What a formula such as ``x > 400 and vy < 0`` says of many worlds at once.

A truth has a margin too: how far it is from false (or from true, negative), so that a search knows what is nearer.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
"""One number a world; 1 and 0 are true and false."""

View = Mapping[str, Callable[..., Numbers]]
"""What the names of a formula mean in some worlds: functions of their arguments, which are numbers."""

UNTRUE = -1000.0
"""The margin of a fact that is not so, such as ``dead``: nothing is near to it."""


@dataclass(frozen=True)
class Formula:
    """A formula that was read. ``truth``: whether it is true or false, not a number."""

    text: str
    truth: bool
    value: Callable[[View], Numbers]
    margin: Callable[[View], Numbers]


COMPARISONS: dict[str, tuple[Callable[..., Any], Callable[[Any, Any], Any]]] = {
    "<": (np.less, lambda a, b: b - a),
    "<=": (np.less_equal, lambda a, b: b - a),
    ">": (np.greater, lambda a, b: a - b),
    ">=": (np.greater_equal, lambda a, b: a - b),
    "==": (np.equal, lambda a, b: -np.abs(a - b)),
    "!=": (np.not_equal, lambda a, b: np.abs(a - b)),
}
"""What comparisons say, and their margins."""

ARITHMETIC: dict[str, Callable[..., Any]] = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide}

FUNCTIONS: dict[str, tuple[int, Callable[..., Any]]] = {
    "abs": (1, np.abs), "min": (2, np.minimum), "max": (2, np.maximum), "hypot": (2, np.hypot)
}  # fmt: skip
"""Functions of numbers, with how many arguments they take."""


def number(text: str, value: Callable[[View], Any]) -> Formula:
    """A number; its margin is itself."""
    return Formula(text, False, value, value)


def arithmetic(sign: str, left: Formula, right: Formula) -> Formula:
    """``left sign right`` of numbers."""
    do = ARITHMETIC[sign]
    return number(left.text, lambda view: do(left.value(view), right.value(view)))


def comparison(sign: str, left: Formula, right: Formula) -> Formula:
    """``left sign right``: a truth."""
    compare, margin = COMPARISONS[sign]

    def value(view: View) -> Numbers:
        return np.asarray(compare(left.value(view), right.value(view)), np.float64)

    return Formula(left.text, True, value, lambda view: margin(left.value(view), right.value(view)))


def negation(part: Formula) -> Formula:
    """``not part``."""
    return Formula(part.text, True, lambda view: 1.0 - part.value(view), lambda view: -part.margin(view))


def fact(text: str, value: Callable[[View], Any]) -> Formula:
    """Something that is so or not."""
    return Formula(text, True, value, lambda view: np.where(value(view) > 0, 0.0, UNTRUE))


JOINS: dict[str, Any] = {"and": np.minimum, "or": np.maximum}


def joined(word: str, left: Formula, right: Formula) -> Formula:
    """``left and right``, ``left or right``."""
    join = JOINS[word]
    return Formula(
        left.text, True,
        lambda view: join(left.value(view), right.value(view)),
        lambda view: join(left.margin(view), right.margin(view)),
    )  # fmt: skip
