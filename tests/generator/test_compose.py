"""Composed levels keep to the marks, have nothing odd, and come back from their text - before any solver sees them."""

from math import dist
from random import Random

import pytest

from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.generator.generate import plan_of
from ninja_game.generator.layouts import LAYOUTS, PLACE_NAMES
from ninja_game.generator.scene import RockBoard, Scene, box, disc, flood, object_places, path, polygon
from ninja_game.generator.shaping import shaped
from ninja_game.levels.lint import level_warnings
from ninja_game.runs.run import run_level
from ninja_game.sim.inputs import Input
from ninja_game.sim.kinds import LAUNCH_PAD, MINE, ONE_WAY
from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.sim.rules import TICKS_PER_SECOND
from tests.support.golden_generated import composed, plan_digest, read_generated
from tests.support.slow import the_rest_is_slow
from tools.measure.level_statistics import figures

MARKS = {
    "objects": (50, 110), "gold": (26, 60), "enemies": (3, 11), "mines": (0, 36), "solid": (0.13, 0.64),
    "shapes": (20, 190),
}  # fmt: skip
PLANS = list(LAYOUTS)


@pytest.mark.parametrize("plan", PLANS)
def test_a_plan_makes_what_it_made(plan: str) -> None:
    # After a change of the generator that is meant, `python3 tools/dev.py golden` writes the table again.
    assert plan_digest(plan) == read_generated()[plan]


@pytest.mark.parametrize("difficulty", the_rest_is_slow([10, 1], 1))
@pytest.mark.parametrize("plan", PLANS)
def test_a_level_of_every_plan_keeps_to_the_marks(plan: str, difficulty: int) -> None:
    level = composed(plan, difficulty).level
    measured = figures(level)
    for name, (least, most) in MARKS.items():
        assert least <= measured[name] <= most, name
    assert level_warnings(level) == []


@pytest.mark.parametrize("plan", PLANS)
def test_a_level_comes_back_from_its_text(plan: str) -> None:
    level = composed(plan, 10).level
    assert parse_ascii_level(write_ascii_level(level)).level == level


def test_scenes_have_fixtures_of_all_sorts() -> None:
    for kind in (LAUNCH_PAD, ONE_WAY):
        scenes = (composed(plan, hard) for hard in (10, 1, 3, 5, 7) for plan in PLANS)
        assert any(record.kind == kind for scene in scenes for record in scene.fixtures)


@pytest.mark.parametrize("plan", PLANS)
def test_gold_lies_in_groups_and_no_piece_is_on_another(plan: str) -> None:
    scene = composed(plan, 10)
    gold = [record.values[:2] for record in scene.gold]
    assert min(dist(a, b) for number, a in enumerate(gold) for b in gold[:number]) >= 11.5
    assert all(min(dist(piece, bait) for bait in scene.gold_middles) < 100 for piece in gold)
    assert len(scene.gold_middles) >= 3


@pytest.mark.parametrize("plan", PLANS)
def test_most_hazards_guard_something(plan: str) -> None:
    scene = composed(plan, 10)
    wanted = [*scene.gold_middles, *(place for record in scene.needed[1:] for place in object_places(record))]
    near = [
        min(dist(record.values[:2], point) for point in wanted) < 120 for group in scene.hazards for record in group
    ]
    assert sum(near) >= 0.3 * len(near)


@pytest.mark.parametrize("key", [0, Input.LEFT, Input.RIGHT])
@pytest.mark.parametrize("plan", PLANS[::3])
def test_nobody_dies_at_the_start(plan: str, key: int) -> None:
    inputs = bytes([key] * TICKS_PER_SECOND * (1 if key else 10))
    assert run_level(composed(plan, 10).level, inputs).outcome != "dead"


def test_no_ground_plan_comes_twice_in_eight_seeds() -> None:
    for first in (0, 7, 20261123):
        assert len({plan_of(seed, Random(seed)) for seed in range(first, first + 8)}) == 8
    assert plan_of("a word", Random(1)) in LAYOUTS


@pytest.mark.parametrize("flip", the_rest_is_slow([False, True], 1))
@pytest.mark.parametrize("plan", PLANS)
def test_a_plan_has_a_vault_with_one_way_in(plan: str, flip: bool) -> None:
    closed = 0
    for seed in range(8):
        board = RockBoard()
        LAYOUTS[plan](board, Random(seed))
        if flip:
            board.flip()
        bare = Scene(board, shaped(board.ink, even=board.even), board.vault_floor[0])
        inner = flood(board.vault_floor[0], bare.empty - set(board.gate))
        closed += (
            len(inner) <= 70 and len(bare.reachable) > 150 and board.vault_floor[len(board.vault_floor) // 2] in inner
        )
    assert closed >= 3


@pytest.mark.parametrize("plan", PLANS)
def test_mines_lie_on_the_rock(plan: str) -> None:
    scene = composed(plan, 10)
    faces = [face for chain in scene.surfaces for face in chain]
    places = [record.values[:2] for record in scene.objects if record.kind == MINE]
    on_rock = [place for place in places if all(dist(place, ring) > 2 for ring in scene.rings)]
    assert on_rock
    assert not [place for place in on_rock if min(dist(place, face.out_by(6.0)) for face in faces) >= 28]


def test_every_plan_has_names() -> None:
    assert PLACE_NAMES.keys() == LAYOUTS.keys()


def test_what_is_painted_alike_on_both_sides_has_mirrored_tiles() -> None:
    turned = str.maketrans("aswqdfreDFREghytGHYTjkiuJKIU][", "saqwfderFDERhgtyHGTYkjuiKJUI[]")
    board = RockBoard()
    board.dig(disc(9, 9, 6.3, 5.7), path(2.2, (5, 6), (14.3, 20.1)), polygon((12, 20), (16.5, 3.3), (21, 20)))
    board.rock(disc(11, 8.5, 2.3, 1.6), box(8, 15.4, 10.3, 18))
    tiles = shaped(board.ink, even=True)
    assert len(set(tiles.values())) > 12
    for column in range(1, COLUMNS + 1):
        for row in range(1, ROWS + 1):
            assert tiles.get((column, row), ".").translate(turned) == tiles.get((COLUMNS + 1 - column, row), ".")


def test_straight_sides_on_the_grid_become_full_tiles() -> None:
    board = RockBoard()
    board.dig(box(4, 5, 20, 12))
    assert set(shaped(board.ink, even=True).values()) == {"#"}
