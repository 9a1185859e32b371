"""Composed levels keep to the marks, have nothing odd, and come back from their text - before any solver sees them."""

from __future__ import annotations

from random import Random

import pytest

from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.generator.compose import compose
from ninja_game.generator.layouts import LAYOUTS
from ninja_game.generator.naming import PLACES
from ninja_game.generator.scene import Board, Scene
from ninja_game.generator.shaping import STYLES, shaped
from ninja_game.levels.warnings import level_warnings
from ninja_game.sim.kinds import BOUNCE_BLOCK, LAUNCH_PAD, ONE_WAY
from ninja_game.sim.level import COLUMNS, ROWS
from tools.measure.level_figures import figures

MARKS = {
    "objects": (50, 88), "gold": (24, 49), "enemies": (3, 7), "mines": (0, 21), "solid": (0.13, 0.37),
    "shapes": (20, 73), "mirror": (0.73, 1.0),
}  # fmt: skip


def composed(layout: str, difficulty: int) -> Scene:
    """The first scene of a ground plan that is not thrown away."""
    for attempt in range(200):
        scene = compose(layout, Random(f"{layout}/{difficulty}/{attempt}"), difficulty)
        if scene is not None:
            return scene
    pytest.fail(f"no level of the plan {layout}")


@pytest.mark.parametrize("difficulty", [1, 10])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_level_of_every_plan_keeps_to_the_marks(layout: str, difficulty: int) -> None:
    level = composed(layout, difficulty).level
    measured = figures(level)
    for name, (least, most) in MARKS.items():
        assert least <= measured[name] <= most, name
    assert level_warnings(level) == []


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_level_comes_back_from_its_text(layout: str) -> None:
    level = composed(layout, 5).level
    assert parse_ascii_level(write_ascii_level(level)).level == level


def test_scenes_have_fixtures_of_all_sorts() -> None:
    kinds = {record.kind for layout in LAYOUTS for record in composed(layout, 5).fixtures}
    assert kinds >= {BOUNCE_BLOCK, LAUNCH_PAD, ONE_WAY}


def test_every_plan_has_names() -> None:
    assert PLACES.keys() == LAYOUTS.keys()


@pytest.mark.parametrize("style", STYLES)
def test_a_mirrored_board_has_mirrored_tiles(style: object) -> None:
    board = Board()
    for number, layout in enumerate(LAYOUTS.values()):
        layout(board, Random(number))
        tiles = shaped(board, style)  # type: ignore[arg-type]
        turned = str.maketrans("aswqdfreDFREghytGHYTjkiuJKIU", "saqwfderFDERhgtyHGTYkjuiKJUI")
        for column in range(1, COLUMNS + 1):
            for row in range(1, ROWS + 1):
                there = tiles.get((COLUMNS + 1 - column, row), ".")
                assert tiles.get((column, row), ".").translate(turned) == there
        board = Board()
