"""Environments for the tests: small levels with something of everything, random keys that stay down for a while."""

import numpy as np
from hypothesis import strategies as st
from numpy.typing import NDArray

from ninja_game import parse_level
from ninja_game.learn.observations.observation import Observed
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import Level, ObjectSpec
from tests.support.strategies import odd_levels

FLOOR = "0" * 713
LEVELS = [
    parse_level(FLOOR + "|5^100,566!11^160,564,130,564!6^300,564,0,1,0,2!0^220,566!0^240,566"),
    parse_level(FLOOR + "|5^100,566!12^150,566!1^60,500!8^400,100,1!3^500,300!10^600,200!6^300,300,0,0,2,0"),
    parse_level(FLOOR + "|5^700,300!2^700,560,0,-1!4^200,564,0!" + "!".join(f"0^{x},566" for x in range(30, 760, 12))),
]
"""A short way to the exit; a mine, a block, a thwump, a turret, a launcher and a drone; a pad, a guard gold."""


playable_levels = st.one_of(
    st.builds(
        lambda level, x, y, empty: Level(
            (0,) * 713 if empty else level.tiles, (*level.objects, ObjectSpec(NINJA, (float(x), float(y))))
        ),
        odd_levels, st.integers(30, 760), st.integers(30, 570), st.booleans(),
    ),
    st.sampled_from(LEVELS),
)  # fmt: skip
"""Levels with a ninja somewhere, with odd tiles and objects as a rule."""


def random_actions(steps: int, count: int, seed: int = 3, choices: int = 6) -> NDArray[np.int64]:
    """Actions (steps, count), each taken for some steps."""
    drawn = np.random.default_rng(seed).integers(0, choices, (steps // 4 + 1, count))
    return np.repeat(drawn, 4, axis=0)[:steps]


def same(one: Observed, other: Observed) -> bool:
    """Whether observations are the same bytes."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
    assert not isinstance(one, dict)
    assert not isinstance(other, dict)
    return one.dtype == other.dtype and one.tobytes() == other.tobytes()
