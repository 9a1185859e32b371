"""The figures of the reference with which levels are compared."""

from __future__ import annotations

from typing import NamedTuple


class Row(NamedTuple):
    """A figure: what it is called, and the reference's first quartile, median and third quartile."""

    title: str
    first: float
    median: float
    third: float

    def mark(self, value: float) -> str:
        """Whether a value is below or above the reference's quartiles."""
        return "-" if value < self.first else "+" if value > self.third else " "


ROWS = {
    "objects": Row("objects", 50, 66, 88),
    "gold": Row("gold", 24, 36, 49),
    "enemies": Row("enemies other than mines", 3, 5, 7),
    "mines": Row("mines", 0, 7, 21),
    "kinds": Row("kinds besides ninja and exit", 3, 4, 6),
    "solid": Row("solid share of the cells", 0.13, 0.224, 0.373),
    "shapes": Row("tiles with a shape", 20, 40, 72.25),
    "mirror": Row("cells equal to their left-right mirror", 0.736, 0.893, 0.997),
    "exit_s": Row("best run to the exit, s", 7.156, 11.363, 17.619),
    "gold_s": Row("best run with (nearly) all gold, s", 16.8, 22.913, 28.694),
}
"""The reference: 500 levels, the best recorded runs on them. "Solid" is what is not empty."""

DIFFICULTY = Row("difficulty", 2.71, 5.58, 9.9)
"""Of the best recorded runs on 334 levels of the reference; ``--reference`` measures it again, in a minute."""

KINDS_OF_REFERENCE = {
    "bounce block": 41, "launch pad": 30, "gauss turret": 36, "floor guard": 28, "drone": 64, "one-way platform": 12,
    "thwump": 21, "door": 52, "homing launcher": 20, "mine": 61,
}  # fmt: skip
"""In how many of a hundred levels of the reference a kind occurs."""
