"""What worlds hold of their levels; and levels put in the place of others, so that worlds play more than they hold."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ninja_game.batch.batch import Indices
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.level import Level
from ninja_game.sim.memory.interface import Worlds
from ninja_game.sim.memory.plain import PlainWorlds, load_plain
from ninja_game.sim.memory.schema import World


class NewObject(NamedTuple):
    """An object of a new world; ``partner``: of an exit the slot of its switch."""

    slot: int
    kind: int
    x: float
    y: float
    partner: int


class NewLevel(NamedTuple):
    """A level as it begins: its grid of tiles; its objects by slot, of which 0 is nobody; where the ninja is, px."""

    tiles: Sequence[int]
    objects: Sequence[NewObject]
    start: tuple[float, float]


def new_levels(worlds: Worlds, places: Iterable[int]) -> list[NewLevel]:
    """Levels of worlds by their numbers."""
    if isinstance(worlds, PlainWorlds):
        return [_new_level(worlds.maps[place].tiles, worlds.fresh[place]) for place in places]
    fresh = worlds.fresh
    every = [fresh["objects"][name] for name in ("kind", "x", "y", "partner")]
    tiles, used, ninja = worlds.maps["tiles"], fresh["slots_used"], fresh["ninja"]
    found = []
    for place in places:
        columns = [column[place, : used[place]].tolist() for column in every]
        objects = list(map(NewObject, range(len(columns[0])), *columns))
        found.append(NewLevel(tiles[place].tolist(), objects, (float(ninja["x"][place]), float(ninja["y"][place]))))
    return found


def _new_level(tiles: Sequence[int], w: World) -> NewLevel:
    slots = enumerate(w.objects[: w.slots_used])
    objects = [NewObject(k, o.kind, o.x, o.y, o.partner if o.kind == EXIT else 0) for k, o in slots]
    return NewLevel(tiles, objects, (w.ninja.x, w.ninja.y))


def put_levels(worlds: Worlds, places: Indices, levels: Sequence[Level]) -> None:
    """Put levels in the places of these numbers, and start the worlds of the same numbers in them.

    A level must not have more objects than the levels that the worlds were opened with.
    """
    if isinstance(worlds, PlainWorlds):
        for place, level in zip(places.tolist(), levels, strict=True):
            worlds.maps[place], worlds.fresh[place] = load_plain(level, worlds.box)
            worlds.worlds[place] = load_plain(level, worlds.box)[1]
        return
    from ninja_game.sim.memory.compiled import load_worlds
    from ninja_game.sim.memory.layout import bytes_of

    worlds.maps[places], fresh = load_worlds(worlds.kernel, levels, box=worlds.box)
    states, every = bytes_of(fresh), bytes_of(worlds.worlds)
    for rows in (places, worlds.count + places):  # behind the worlds lies a new one in each level
        every[rows] = 0
        every[rows, : states.shape[1]] = states
    worlds.records["event_count"][places] = 0
