"""The check values that the specification prints (world.md §9, ninja.md §11)."""

import pytest

from ninja_game.backend.plain import load_plain
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim.collision.box import collide_box
from ninja_game.sim.collision.circle import collide_circle
from ninja_game.sim.collision.rays import ray_tiles, sees
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bits
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.simulation import Simulation

EMPTY = "0" * 713


def world_with(tile: int, x: float, y: float) -> tuple[TileMap, World]:
    """A world that is empty but for one tile in cell (10, 9), with the ninja at (x, y)."""
    index = 9 * 23 + 8
    tiles = EMPTY[:index] + chr(48 + tile) + EMPTY[index + 1 :]
    return load_plain(parse_level_string(f"{tiles}|5^{x},{y}"), box=False)


CIRCLES = [
    (1, (250.3, 209.1), (250.3, 206.0)),
    (1, (233.6, 209.4), (233.0385416392625, 208.82099606548945)),
    (2, (250.3, 221.7), (255.07106781186548, 216.92893218813452)),
    (2, (242.5, 208.25), (243.07002779922757, 206.4829138223945)),
    (6, (245.2, 225.9), (251.61257448063176, 222.5231655660503)),
    (10, (260.3, 214.6), (261.2268772281694, 213.4402619903693)),
    (14, (247.1, 228.4), (250.31213595499958, 221.97572809000084)),
    (18, (266.2, 223.3), (268.3521359549996, 218.99572809000085)),
    (22, (253.6, 233.2), (258.54427190999917, 230.72786404500042)),
    (26, (258.3, 210.9), (259.7724487070749, 209.70801771332037)),
    (30, (230.5, 225.25), (230.3943573558544, 225.21941923458942)),
]


@pytest.mark.parametrize("tile, start, end", CIRCLES)
def test_circle_ends_where_the_page_says(tile: int, start: tuple[float, float], end: tuple[float, float]) -> None:
    tiles, w = world_with(tile, 100, 100)
    w.ninja.x, w.ninja.y = start
    collide_circle(tiles, w)
    assert (w.ninja.x, w.ninja.y) == end


BOXES = [
    (14, 3.0, (249.3, 232.6), (251.08, 229.04)),
    (7, 2.5, (256.1, 232.2), (254.42500443646315, 230.515999083971)),
    (10, 3.0, (241.25, 236.5), (237.0, 236.5)),
]


@pytest.mark.parametrize("tile, half, start, end", BOXES)
def test_box_ends_where_the_page_says(
    tile: int, half: float, start: tuple[float, float], end: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ninja_game.sim.collision.box.BOX_HALF", half)
    tiles, w = world_with(tile, 100, 100)
    w.ninja.x, w.ninja.y = start
    collide_box(tiles, w)
    assert (w.ninja.x, w.ninja.y) == end


RAYS = [
    ((100, 100), (200, 180), 0, (695.0, 576.0)),
    ((24, 24), (48, 48), 0, (576.0000000000002, 576.0000000000002)),
    ((300, 200), (250, 230), 2, (252.5, 228.5)),
    ((300, 190), (250, 230), 6, (246.7029337206817, 232.63765302345465)),
    ((258, 218), (300, 200), 10, (216.36246338036733, 235.84465855127115)),
    ((300, 236), (200, 230), 14, (250.0, 233.0)),
    ((300, 236), (200, 200), 22, (24.0, 136.64000000000001)),
    ((100, 222), (300, 230), 31, (252.0, 228.07999999999998)),
]


@pytest.mark.parametrize("start, through, tile, stop", RAYS)
def test_ray_stops_where_the_page_says(
    start: tuple[int, int], through: tuple[int, int], tile: int, stop: tuple[float, float]
) -> None:
    tiles, w = world_with(tile, 50, 50)
    assert ray_tiles(tiles, w, *start, *through) == (True, *stop)


@pytest.mark.parametrize(
    "ninja, answer", [((180.5, 231.2), (True, 171.02582457413837, 228.0)), ((380.5, 231.2), (False, 240.0, 228.0))]
)
def test_sight_is_blocked_by_what_is_nearer(ninja: tuple[float, float], answer: tuple[bool, float, float]) -> None:
    tiles, w = world_with(1, *ninja)
    assert sees(tiles, w, 100, 228, 400, 228) == answer


def test_a_ray_without_length_sees_nothing() -> None:
    tiles, w = world_with(0, 50, 50)
    assert not ray_tiles(tiles, w, 50, 50, 50, 50)[0]


def keys(*spans: tuple[int, int]) -> list[int]:
    """Inputs from (number of ticks, keys) spans; jump is pressed in the tick in which it goes down."""
    return list(with_press_bits(down for ticks, down in spans for _ in range(ticks)))


def places(level: str, inputs: list[int], x_y_state_of: list[int]) -> dict[int, tuple[float, float, str]]:
    """Where the ninja is after some ticks of a run."""
    run = Simulation(parse_level_string(level))
    found = {}
    for tick, down in enumerate(inputs):
        run.step_keys(down)
        if tick in x_y_state_of:
            found[tick] = (run.ninja.x, run.ninja.y, run.ninja.state)
    return found


def test_running_and_jumping_table() -> None:
    expected = {
        0: (100.0, 566.0, "running"),
        1: (100.14850000000001, 566.0, "running"),
        2: (100.44401500000004, 566.0, "running"),
        10: (107.92730757419442, 566.0, "running"),
        29: (158.9550544815997, 566.0, "running"),
        30: (162.82050393678392, 563.0, "jumping"),
        31: (166.79579889741632, 560.055, "jumping"),
        39: (200.68202397157827, 538.4101412548424, "jumping"),
        40: (205.16970373186268, 535.936039842294, "falling"),
        60: (301.59796220906964, 520.9266885864918, "falling"),
        80: (399.49438264784385, 563.2783547863675, "falling"),
        81: (404.36993882136585, 566.0, "skidding"),
        88: (430.34648716713286, 566.0, "skidding"),
    }
    inputs = keys((30, KEY_RIGHT), (10, KEY_RIGHT + JUMP_HELD), (40, KEY_RIGHT), (10, 0))
    assert places(f"{EMPTY}|5^100,566", inputs, list(expected)) == expected


def test_wall_slide_and_hop_table() -> None:
    expected = {
        0: (480.0, 300.15, "falling"),
        16: (492.81376145009125, 321.7706421751315, "falling"),
        17: (494.0, 324.25293575338026, "sliding"),
        18: (494.0, 326.8604063958465, "sliding"),
        31: (494.0, 349.0353712501329, "sliding"),
        32: (493.0, 348.8055180891995, "jumping"),
        33: (492.01, 347.3455180891995, "jumping"),
        37: (489.12816434110016, 341.89757784959954, "falling"),
        50: (489.80538641914865, 339.2052335846571, "falling"),
        57: (488.5677668534171, 347.982611687835, "falling"),
    }
    inputs = keys(
        (32, KEY_RIGHT), (5, KEY_RIGHT + JUMP_HELD), (10, KEY_RIGHT), (3, KEY_LEFT), (4, KEY_LEFT + JUMP_HELD), (10, 0)
    )
    level = "0" * 460 + "1" * 23 + "0" * 230
    assert places(f"{level}|5^480,300", inputs, list(expected)) == expected
