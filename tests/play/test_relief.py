"""Tiles look like bodies, with edges light above and dark below, and throw a shadow; not so in plain palettes."""

from itertools import pairwise
from pathlib import Path

import pygame
import pytest

from ninja_game.formats.load import load_levels
from ninja_game.sim.level import Level
from ninja_game.ui.theme import MOODS, PALETTES
from ninja_game.view.sprites.thumbnail import thumbnail

SHELF = "ninja-game level 1\nname: Shelf\n" + "\n".join(
    f"|{'.@'[row == 5]}{'.' * 9}{('#' if row == 11 else '.') * 10}{'.' * 11}|" for row in range(23)
)
STEP = "ninja-game level 1\nname: Step\n" + "\n".join(
    f"|{'.@'[row == 5]}{'.' * 14}{'.#'[row >= 10] * 16}|" if row < 15 else f"|{'#' * 31}|" for row in range(23)
)
WIDTH = 792


@pytest.fixture
def shelf(tmp_path: Path) -> Level:
    file = tmp_path / "shelf.txt"
    file.write_text(SHELF, "utf-8")
    return load_levels(file)[0].level


def column(level: Level, palette: str) -> list[pygame.Color]:
    """Colours from above the shelf to below it, in its middle: it lies from 288 to 312 px."""
    picture = thumbnail(level, PALETTES[palette], WIDTH)
    return [picture.get_at((372, y)) for y in range(280, 330)]


@pytest.mark.parametrize("palette", [name for name, each in PALETTES.items() if each.scenery])
def test_edges_are_light_above_and_dark_below_and_a_shadow_falls(shelf: Level, palette: str) -> None:
    def light(colour: pygame.Color) -> int:
        return sum(colour[:3])

    colours = column(shelf, palette)
    upper, middle, lower = (light(colours[y - 280]) for y in (288, 300, 311))
    assert upper > middle > lower
    shadow, far = (light(colours[y - 280]) for y in (314, 329))
    assert shadow < far


@pytest.mark.parametrize("palette", [name for name, each in PALETTES.items() if each.scenery])
def test_light_below_the_ground_fades_without_an_edge(tmp_path: Path, palette: str) -> None:
    """Nothing is seen in the middle of a wall: neither a step's side drawn on into it, nor where the light ends."""
    file = tmp_path / "step.txt"
    file.write_text(STEP, "utf-8")
    picture = thumbnail(load_levels(file)[0].level, PALETTES[palette], WIDTH)
    # The floor is at 384 px, the step's side at 384 px from the left.
    rows = [[picture.get_at((x, 400)) for x in range(300, 460)], [picture.get_at((336, y)) for y in range(392, 440)]]
    for row in rows:
        assert max(abs(a[k] - b[k]) for a, b in pairwise(row) for k in range(3)) <= 6, "the rock's own marks included"


@pytest.mark.parametrize("palette", [each.name for each in MOODS])
def test_rock_of_a_mood_is_marked_and_never_much(tmp_path: Path, palette: str) -> None:
    file = tmp_path / "step.txt"
    file.write_text(STEP, "utf-8")
    picture = thumbnail(load_levels(file)[0].level, PALETTES[palette], WIDTH)
    rock = [picture.get_at((x, y)) for x in range(60, 740, 7) for y in range(450, 560, 7)]
    spread = [max(colour[k] for colour in rock) - min(colour[k] for colour in rock) for k in range(3)]
    assert 8 <= max(spread) <= 20


def test_plain_palettes_are_flat(shelf: Level) -> None:
    inside = column(shelf, "contrast")[8:32]
    assert len({tuple(each) for each in inside}) == 1
