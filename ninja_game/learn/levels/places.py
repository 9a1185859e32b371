"""Levels put in the place of others, in worlds that are open: how worlds play more levels than anybody could hold."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ninja_game.batch.batch import Indices
from ninja_game.sim.level import Level
from ninja_game.sim.memory.interface import Worlds
from ninja_game.sim.memory.plain import PlainWorlds, load_plain, tile_map
from ninja_game.sim.memory.schema import TileMap, World


def put_levels(worlds: Worlds, places: Indices, levels: Sequence[Level]) -> list[tuple[TileMap, World]]:
    """Put levels in the places of these numbers, and start the worlds of the same numbers in them.

    Gives each level with a new world in it, as plain objects. A level must not have more objects than the places.
    """
    if isinstance(worlds, PlainWorlds):
        for place, level in zip(places.tolist(), levels, strict=True):
            worlds.maps[place], worlds.fresh[place] = load_plain(level, worlds.box)
            worlds.worlds[place] = load_plain(level, worlds.box)[1]
        return [(worlds.maps[place], worlds.fresh[place]) for place in places.tolist()]
    from ninja_game.sim.memory.compiled import load_worlds
    from ninja_game.sim.memory.layout import bytes_of, plain_copy

    maps, fresh = load_worlds(worlds.kernel, levels, box=worlds.box)
    worlds.maps[places] = maps
    states, every = bytes_of(fresh), bytes_of(worlds.worlds)
    for rows in (places, worlds.count + places):  # behind the worlds lies a new one in each level
        every[rows] = 0
        every[rows, : states.shape[1]] = states
    worlds.records["event_count"][places] = 0
    return [(tile_map(level), plain_copy(fresh, k)) for k, level in enumerate(levels)]
