"""Pictures by layers: what stays where it is, drawn once, under what moves, is the picture drawn whole in order."""

from __future__ import annotations

from inspect import signature
from typing import Any

import numpy as np
import pytest

from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.observations.pixels import EVERYWHERE, Pixels, draw_objects, observe_pixels, paint
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.rules import RADIUS
from tests.support.crowded import crowded_level
from tests.support.learning import LEVELS, random_actions

CROWDED = [crowded_level(seed) for seed in range(4)]
SHAPES = [(66, 50), (100, 6), (6, 90)]
"""The world's, and such that a pixel is much wider than high, or much higher than wide."""


def whole_picture(worlds: EnvWorlds, index: int) -> Any:
    """A world's picture, all of it drawn in the order of the slots."""
    names = list(signature(observe_pixels).parameters)[8:]
    t = dict(zip(names, worlds._writers[0][1][2:], strict=True))
    level, w = int(worlds.levels_now[index]), worlds.world(index)
    width, height = t["width"], t["height"]
    size = width * height
    out = np.array(t["pictures"][level * size : (level + 1) * size], t["layers"].dtype)[np.newaxis].copy()
    frame = width, 0.0, 0.0, t["pixel_x"], t["pixel_y"], 0, width - 1, 0, height - 1
    look = tuple(t[name] for name in ("slots", "sizes", "boxes", "shades", "moves", "xs", "ys"))
    first, last = t["bounds"][2 * level : 2 * level + 2]
    draw_objects(w, out, 0, 0, frame, int(first), int(last), look, EVERYWHERE, True, t["whole"])
    paint(out, 0, 0, frame, w.ninja.x, w.ninja.y, RADIUS, RADIUS, True, t["ninja_shade"], t["whole"])
    return out.reshape(height, width)


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
