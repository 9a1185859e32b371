"""Pictures by layers: what stays where it is, drawn once, under what moves, is the picture drawn whole in order."""

from typing import Any

import numpy as np
import pytest

from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.observations.pixels import EVERYWHERE, Pixels, draw_objects, paint
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.rules import RADIUS
from tests.support.crowded import crowded_level
from tests.support.learning import LEVELS, random_actions

CROWDED = [crowded_level(seed) for seed in range(4)]
SHAPES = [(66, 50), (100, 6), (6, 90)]
"""The world's, and such that a pixel is much wider than high, or much higher than wide."""


def whole_picture(worlds: EnvWorlds, index: int) -> Any:
    """A world's picture, all of it drawn in the order of the slots."""
    tiles, view, _, bounds, things = worlds._writers[0][1][2:]
    level, w, frame = int(worlds.levels_now[index]), worlds.world(index), view.frame
    height = frame.high + 1
    size = frame.width * height
    picture = np.array(tiles[level * size : (level + 1) * size], np.asarray(worlds.observations).dtype)
    first, last = bounds[2 * level : 2 * level + 2]
    draw_objects(w, picture, frame, things, int(first), int(last), EVERYWHERE, True)
    paint(picture, frame, w.ninja.x, w.ninja.y, RADIUS, RADIUS, True, view.ninja_shade)
    return picture.reshape(height, frame.width)


@pytest.mark.parametrize("normalised", [False, True])
@pytest.mark.parametrize("levels", [LEVELS, CROWDED], ids=["few", "crowded"])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_layers_make_the_whole_picture(levels: Any, shape: tuple[int, int], normalised: bool) -> None:
    part = Pixels(*shape, normalised=normalised)
    worlds = EnvWorlds(levels, len(levels), observation=part, memory="plain", time_limit=120)
    worlds.reset(levels=list(range(len(levels))))
    for row in random_actions(40, len(levels)):
        worlds.step(DISCRETE_KEYS[row], restart=worlds.ended())
        for index in range(len(levels)):
            seen: Any = worlds.observations
            assert np.array_equal(seen[index], whole_picture(worlds, index))
