"""What is watched: formulas with their values, and how these are written."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np

from ninja_game.errors import NinjaGameError
from ninja_game.search.formula.language import Numbers
from ninja_game.tas.watch import Watch, parse_watch

USUAL = ("speed", "vx", "vy")
"""What is watched where nothing else is wanted."""
LANES = 4
"""Values whose plot is shown at once."""


@dataclass(eq=False)
class Watched:
    """A value that is watched. ``plotted``: its plot is shown; ``number``: of its colour."""

    watch: Watch
    number: int
    plotted: bool = True
    values: Numbers = field(default_factory=lambda: np.zeros(0))


def watched_values(texts: Sequence[str]) -> Iterator[Watched]:
    """Formulas as they were kept; those that cannot be read are left out."""
    for number, text in enumerate(texts):
        with suppress(NinjaGameError):
            yield Watched(parse_watch(text), number, plotted=number < LANES)


def shown_value(each: Watched, tick: int) -> str:
    """A value at a tick, as the list has it."""
    value = float(each.values[tick]) if tick < len(each.values) else np.nan
    if not np.isfinite(value):
        return "-"
    if each.watch.formula.truth:
        return "yes" if value > 0 else "no"
    return f"{value:.6g}"
