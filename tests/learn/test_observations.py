"""Every part of an observation: in its space, the same bytes on both memories and in any company; what it says."""

from dataclasses import replace
from math import cos, sin
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from ninja_game import Level, parse_level
from ninja_game.backend.memories import compiled_available
from ninja_game.errors import ArgumentError
from ninja_game.learn.actions import DISCRETE_KEYS
from ninja_game.learn.observations.objects import OBJECT_COLUMNS, PLANES, LevelPlanes, NearObjects
from ninja_game.learn.observations.observation import PARTS, Observation
from ninja_game.learn.observations.part import Part
from ninja_game.learn.observations.pixels import SHADES, SOLID_SHADE, Pixels
from ninja_game.learn.observations.surroundings import LocalTiles, Rays
from ninja_game.learn.observations.vectors import EIGHT_WAYS, FIELDS, Guide, StateVector, TimeLeft
from ninja_game.learn.worlds import EnvWorlds
from ninja_game.sim.collision.rays import cast_ray
from ninja_game.sim.kinds import DOOR, GOLD
from ninja_game.sim.level import ObjectSpec
from tests.support.learning import FLOOR, LEVELS, playable_levels, random_actions, same
from tests.support.memories import BOTH

EVERY = [
    *(part(normalised=normalised) for part in PARTS.values() for normalised in (True, False)),
    LocalTiles(size=5, form="one-hot"),
    Pixels(width=60, height=40, view=240.0),
]
needs_numba = pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")


def seen(level: Level, part: Part, actions: list[int] = [], memory: str = "auto") -> Any:  # noqa: B006
    """What one world shows after some actions."""
    worlds = EnvWorlds(level, 1, observation=part, memory=memory)
    for action in actions:
        worlds.step(DISCRETE_KEYS[[action]])
    shown: Any = worlds.observations
    assert shown[0] in worlds.observation.space
    return shown[0]


@pytest.mark.parametrize("part", EVERY, ids=repr)
def test_a_part_stays_in_its_space_and_is_the_same_flat(part: Part) -> None:
    both = [part, "rays" if part.name == "time" else "time"]
    worlds = [EnvWorlds(LEVELS, 3, observation=both, flat=flat, time_limit=500) for flat in (False, True)]
    for each in worlds:
        each.reset(levels=[0, 1, 2])
    for row in random_actions(100, 3):
        for each in worlds:
            each.step(DISCRETE_KEYS[row], restart=each.ended())
        parts, flat = worlds[0].observations, worlds[1].observations
        assert isinstance(parts, dict)
        for index in range(3):
            assert {name: array[index] for name, array in parts.items()} in worlds[0].observation.space
        joined = np.hstack(
            [array.reshape(3, -1) for array in (parts[each.name] for each in worlds[0].observation.parts)],
            dtype=np.float32,
        )
        assert same(joined, flat)


@needs_numba
@settings(max_examples=25)
@given(level=playable_levels, choices=st.lists(st.integers(0, 5), min_size=1, max_size=30))
def test_every_part_is_the_same_bytes_on_both_memories_in_any_level(level: Level, choices: list[int]) -> None:
    plain, compiled = (
        EnvWorlds(level, 1, observation=[*PARTS], memory=memory, reward=[]) for memory in ("plain", "compiled")
    )
    for choice in choices:
        for worlds in (plain, compiled):
            worlds.step(DISCRETE_KEYS[[choice]], restart=worlds.ended())
        assert same(plain.observations, compiled.observations)
        assert plain.rewards.tobytes() == compiled.rewards.tobytes()
    assert {name: array[0] for name, array in plain.observations.items()} in plain.observation.space  # type: ignore[union-attr]


def test_the_state_vector_tells_the_ninja_and_its_goals() -> None:
    level = LEVELS[0]
    raw = dict(zip(FIELDS, seen(level, StateVector(normalised=False)).tolist(), strict=True))
    assert (raw["x"], raw["y"], raw["cell_x"], raw["cell_y"]) == (100.0, 566.0, 4.0, 14.0)
    assert (raw["exit_there"], raw["exit_open"], raw["exit_dx"], raw["switch_dx"]) == (1.0, 0.0, 60.0, 30.0)
    assert (raw["gold_there"], raw["gold_dx"], raw["falling"], raw["standing"]) == (1.0, 120.0, 0.0, 1.0)
    later = dict(zip(FIELDS, seen(level, StateVector(), [2, 2, 2, 2, 5]).tolist(), strict=True))
    assert later["exit_open"] == later["jump_held"] == later["jumping"] == 1.0
    assert later["switch_dx"] == later["switch_dy"] == 0.0
    assert later["vx"] > 0.0 > later["vy"]
    bare = dict(zip(FIELDS, seen(parse_level(FLOOR + "|5^100,566"), StateVector()).tolist(), strict=True))
    assert bare["exit_there"] == bare["gold_there"] == bare["exit_dx"] == bare["gold_dx"] == 0.0


def test_the_nearest_gold_is_the_nearest_that_is_left() -> None:
    level = parse_level(FLOOR + "|5^100,566!0^70,566!0^120,566!0^160,566!0^300,566")
    column = list(FIELDS).index("gold_dx")
    worlds = EnvWorlds(level, 1, observation=StateVector(normalised=False))
    left = {70.0, 120.0, 160.0, 300.0}
    for _ in range(40):
        worlds.step(DISCRETE_KEYS[[2]])
        x = float(worlds.world(0).ninja.x)
        left = {
            each for each in left if not worlds.world(0).objects[2 + sorted((70, 120, 160, 300)).index(int(each))].taken
        }
        nearest = min(left, key=lambda each: abs(each - x))
        shown: Any = worlds.observations
        assert shown[0, column] == np.float32(nearest - x)
    between = parse_level(FLOOR + "|5^100,566!0^160,566!0^70,566!0^130,566")
    assert seen(between, StateVector(normalised=False))[column] == -30.0, "the first of two as near"


def test_local_tiles_are_the_cells_round_the_ninja() -> None:
    level = parse_level("0" * 22 + "1" + "0" * 690 + "|5^36,36")
    assert seen(level, LocalTiles(size=3, form="one-hot")).argmax(2).tolist() == [[1, 1, 1], [1, 0, 0], [1, 0, 0]]
    walls = seen(level, LocalTiles(size=3, normalised=False))
    assert (walls < 0).tolist() == [[True] * 3, [True, False, False], [True, False, False]]
    assert np.allclose(walls[1], [-12, 12, 12], atol=3)
    assert np.allclose(walls[2], [-12, 12, 36], atol=3)
    wide = seen(level, LocalTiles(size=31, form="one-hot")).argmax(2)
    assert wide[:15].all()
    assert wide[:, :15].all()


def test_rays_end_at_walls_and_closed_doors() -> None:
    open_room = seen(parse_level(FLOOR + "|5^100,300"), Rays(4, reach=1000.0, normalised=False))
    assert np.allclose(open_room, [668, 276, 76, 276])
    door = parse_level(FLOOR + "|5^100,300!9^700,500,0,0,5,12,1,0,0")
    assert np.allclose(seen(door, Rays(4, reach=1000.0, normalised=False)), [44, 276, 76, 276])
    assert np.allclose(seen(door, Rays(4, reach=200.0)), [0.22, 1.0, 0.38, 1.0])


@settings(max_examples=100)
@given(level=playable_levels, actions=st.lists(st.integers(0, 5), max_size=8), way=st.floats(-30.0, 30.0))
def test_rays_are_those_of_the_world(level: Level, actions: list[int], way: float) -> None:
    doors = tuple(ObjectSpec(DOOR, (x, 300.0, 0.0, 0.0, float(x // 24), 12.0, 1.0, 0.0, 0.0)) for x in (60.0, 396.0))
    level = replace(level, objects=(*level.objects, *doors))
    worlds = EnvWorlds(level, 1, observation=Rays(32, reach=900.0, normalised=False), memory="plain")
    for action in actions:
        worlds.step(DISCRETE_KEYS[[action]])
    maps, w = worlds._worlds.maps, worlds.world(0)
    w.ninja.x, w.ninja.y = w.ninja.x + way, w.ninja.y - way
    worlds._observe(np.array([0]))
    for angle, shown in zip(np.arange(32) * np.pi / 16, np.asarray(worlds.observations)[0], strict=True):
        dx, dy = (round(f(float(angle)), 12) for f in (cos, sin))
        stopped, x, y = cast_ray(maps[0], w, w.ninja.x, w.ninja.y, dx, dy)
        length = (x - w.ninja.x) * dx + (y - w.ninja.y) * dy if stopped else 900.0
        assert shown == np.float32(min(max(length, 0.0), 900.0))


def test_near_objects_are_the_nearest_that_are_left_with_what_they_do() -> None:
    level = parse_level(FLOOR + "|5^100,566!0^120,566!8^400,100,1!11^700,566,650,566!2^100,400,0,-1")
    rows = seen(level, NearObjects(8, normalised=False))
    found = [dict(zip(OBJECT_COLUMNS, row.tolist(), strict=True)) for row in rows]
    names = [next((name for name in OBJECT_COLUMNS if each[name] == 1.0), "") for each in found]
    assert names == ["gold", "launch pad", "exit switch", "thwump", "exit", "", "", ""]
    assert (found[0]["dx"], found[1]["face_y"], found[3]["face_y"], found[3]["moment"]) == (20.0, -1.0, 1.0, 0.0)
    later = seen(level, NearObjects(1, normalised=False), [2, 2, 2, 2])
    assert later[0, OBJECT_COLUMNS.index("launch pad")] == 1.0
    only = seen(level, NearObjects(2, kinds=("thwump",)))
    assert only[:, OBJECT_COLUMNS.index("thwump")].tolist() == [1.0, 0.0]


def test_planes_show_what_is_there() -> None:
    level = parse_level("0" * 22 + "1" + "0" * 690 + "|5^36,36!0^60,36!0^756,564!11^160,300,400,300!12^45,40")
    planes = dict(zip(PLANES, seen(level, LevelPlanes(normalised=False)), strict=True))
    shown = {
        name: [(*map(int, at), int(plane[tuple(at)])) for at in np.argwhere(plane)] for name, plane in planes.items()
    }
    assert {name: found for name, found in shown.items() if found} == {
        "solid": [(22, 0, 255)], "gold": [(0, 1, 255), (22, 30, 255)], "exit": [(11, 5, 128)],
        "exit switch": [(11, 15, 255)], "mine": [(0, 0, 255)], "ninja": [(0, 0, 255)],
    }  # fmt: skip


@pytest.mark.parametrize("memory", BOTH)
def test_pixels_show_the_ninja_the_walls_and_a_closed_door(memory: str) -> None:
    level = parse_level(FLOOR + "|5^396,300!0^600,300!9^700,500,0,0,20,12,1,0,0")
    whole = seen(level, Pixels(99, 75), memory=memory)
    assert whole.dtype == np.uint8
    assert np.argwhere(whole == 255).mean(0).round().tolist() == [37, 49]
    assert (whole[:3] == SOLID_SHADE).all()
    assert whole[37, 74:76].min() > SHADES[GOLD] // 2
    assert whole[37, 62:64].max() >= SHADES[DOOR] // 2
    assert not whole[10:30, 3:-3].any()
    near = seen(level, Pixels(40, 20, view=240.0), memory=memory)
    assert np.argwhere(near == 255).mean(0).tolist() == pytest.approx([9.5, 19.5], abs=1.0)
    corner = seen(parse_level(FLOOR + "|5^36,36"), Pixels(40, 40, view=240.0), memory=memory)
    assert (corner[:18] == SOLID_SHADE).all()
    assert (corner[:, :18] == SOLID_SHADE).all()
    assert not corner[22:, 22:].any()


def test_pixels_show_a_beam_from_end_to_end() -> None:
    shown = seen(parse_level(FLOOR + "|5^300,300!6^500,100,0,0,1,0"), Pixels(99, 75), [0] * 11, memory="plain")
    beam = [(492 - 468 * share, 109 + 466 * share) for share in np.linspace(0, 1, 40)]
    assert all(shown[int(y / 8), int(x / 8)] for x, y in beam)


@pytest.mark.parametrize("memory", BOTH)
def test_the_time_left_goes_down_to_nothing(memory: str) -> None:
    worlds = EnvWorlds(LEVELS[0], 1, observation=TimeLeft(), time_limit=8, memory=memory)
    seen: Any = worlds.observations
    shown = [seen.item()]
    for _ in range(2):
        worlds.step(DISCRETE_KEYS[[1]])
        shown.append(seen.item())
    assert shown == [1.0, 0.5, 0.0]


def test_the_guide_points_to_the_exit() -> None:
    guide = seen(parse_level(FLOOR + "|5^100,300!11^160,300,700,300"), Guide(normalised=False))
    best = EIGHT_WAYS[int(guide[:8].argmax())]
    assert best == (1.0, 0.0)
    assert guide[8] > 0 > guide[12]
    assert guide[16] > 100


@pytest.mark.parametrize(
    "make",
    [
        lambda: LocalTiles(size=4), lambda: LocalTiles(size=33), lambda: LocalTiles(form="picture"), lambda: Rays(0),
        lambda: Rays(4, reach=0.0), lambda: NearObjects(0), lambda: NearObjects(kinds=("monster",)),
        lambda: NearObjects(kinds=()),
        lambda: Pixels(0), lambda: Pixels(84, 600), lambda: Pixels(view=20.0),
        lambda: Observation("sight"), lambda: Observation([]),
        lambda: Observation([Rays(4), Rays(8)]),
    ],
)  # fmt: skip
def test_parts_that_do_not_exist_are_refused(make: Any) -> None:
    with pytest.raises(ArgumentError, match="expected"):
        make()


@needs_numba
def test_the_guide_is_computed_in_double_precision_on_both_memories() -> None:
    """Near the exit, where ticks are few and their differences not exact in single precision."""
    plain, compiled = (EnvWorlds(LEVELS[0], 1, observation="guide", memory=memory) for memory in ("plain", "compiled"))
    for _ in range(12):
        for worlds in (plain, compiled):
            worlds.step(DISCRETE_KEYS[[2]])
        assert same(plain.observations, compiled.observations)
