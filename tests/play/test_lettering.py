"""The game's own letters: every one can be drawn, lies where its width says, and is kept."""

from __future__ import annotations

import pygame
import pytest

from ninja_game.play.ui.canvas import Canvas
from ninja_game.play.ui.glyphs import GLYPHS
from ninja_game.play.ui.lettering import Lettering
from ninja_game.play.ui.stroke_font import StrokeFont, strokes


@pytest.fixture(autouse=True)
def _fonts() -> None:
    pygame.font.init()


def test_all_of_ascii_is_there() -> None:
    assert {chr(code) for code in range(32, 127)} <= set(GLYPHS)


@pytest.mark.parametrize("character", sorted(set(GLYPHS) - {" "}))
@pytest.mark.parametrize("bold", [False, True])
def test_a_letter_leaves_ink_inside_its_sheet(character: str, *, bold: bool) -> None:
    picture = StrokeFont(40, bold=bold).render(f"I{character}I", "black")
    ink = picture.get_bounding_rect(min_alpha=128)
    assert ink.width > 2
    assert ink.left >= 1
    assert ink.right <= picture.get_width()
    assert ink.bottom < picture.get_height(), "descenders are not cut"


def test_strokes_stay_near_their_width() -> None:
    for character, (width, _) in GLYPHS.items():
        for line in strokes(character):
            assert all(-1 <= x <= width + 1 and -1 <= y <= 9.3 for x, y in line), character


def test_width_grows_with_the_text_and_digits_are_alike() -> None:
    font = StrokeFont(20, bold=False)
    assert font.width("") == 0
    assert font.width("nin") < font.width("ninja")
    assert len({font.width(f"1{digit}.000") for digit in "012356789"}) == 1


def test_characters_without_a_glyph_fall_back() -> None:
    assert StrokeFont(20, bold=False).render("Žluťoučký", "black").get_bounding_rect().width > 60


def test_text_is_aligned_and_kept() -> None:
    lettering = Lettering(Canvas((1584, 1200)))
    surface = pygame.Surface((1584, 1200))
    left = lettering.draw(surface, "score", 100, 50, 10, "white")
    right = lettering.draw(surface, "score", 100, 50, 10, "white", align="right")
    centre = lettering.draw(None, "score", 100, 50, 10, "white", align="centre")
    assert left.left == 200
    assert right.right == 200
    assert abs(centre.centerx - 200) <= 1
    assert lettering.rendered("score", 10, "white") is lettering.rendered("score", 10, "white")
