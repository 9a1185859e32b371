"""The game's own letters: every one can be drawn, lies where its width says, and is kept."""

import time

import pygame
import pytest

from ninja_game.ui.canvas import Canvas
from ninja_game.ui.lettering import GLYPHS, Lettering, StrokeFont, glyph_of
from ninja_game.ui.theme import CLASSIC, Theme, wrapped


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


@pytest.mark.parametrize("text", ["\u034f", "\ufe0f\ufe0f", "e\u034f", "\u3164", "\U000e0100"])
def test_a_name_of_characters_without_width_is_drawn(text: str) -> None:
    assert Lettering(Canvas((792, 600))).rendered(text, 12, "white").get_height()


def test_strokes_stay_near_their_width() -> None:
    for character in [*GLYPHS, *"áèîõüçŠůŘÿĄłÅØßìĐħ"]:
        letter = glyph_of(character)
        if letter is not None:
            points = [point for line in letter.lines for point in line]
            assert all(-1.4 <= x <= letter.width + 1.4 and -1 <= y <= 9.3 for x, y in points), character


def test_width_grows_with_the_text_and_digits_are_alike() -> None:
    font = StrokeFont(20, bold=False)
    assert font.width("") == 0
    assert font.width("nin") < font.width("ninja")
    assert len({font.width(f"1{digit}.000") for digit in "012356789"}) == 1


def test_letters_with_accents_are_composed_of_strokes() -> None:
    font = StrokeFont(40, bold=False)
    for accented, plain in zip("Žluťoučký", "Zlutoucky", strict=True):
        assert glyph_of(accented) is not None
        assert font.width(accented) == font.width(plain)
        differs = pygame.image.tobytes(font.render(accented, "black"), "RGBA") != pygame.image.tobytes(
            font.render(plain, "black"), "RGBA"
        )
        assert differs == (accented != plain)


def test_text_with_an_unknown_character_is_all_in_one_lettering() -> None:
    font = StrokeFont(20, bold=False)
    assert glyph_of("日") is None
    whole = font.render("Level 日", "black")
    assert whole.get_width() == font.width("Level 日")
    start = pygame.Rect(0, 0, font.width("Level"), whole.get_height())
    own = font.render("Level", "black")
    assert pygame.image.tobytes(whole.subsurface(start.clip(whole.get_rect())), "RGBA") != pygame.image.tobytes(
        own, "RGBA"
    )


def test_space_between_small_letters_is_even() -> None:
    """Letters are placed on quarters of a px: the same pair is never a whole px closer than elsewhere."""
    font = StrokeFont(8.3, bold=False)
    step = sum(font._advance(letter) for letter in map(glyph_of, "l ") if letter)
    row = font.render("l " * 20, "black")
    ink = [sum(row.get_at((x, y)).a for y in range(row.get_height())) for x in range(row.get_width())]
    offsets = []
    for k in range(20):
        columns = range(max(0, round((k - 0.4) * step) + 1), round((k + 0.6) * step) + 1)
        offsets.append(sum(x * ink[x] for x in columns) / sum(ink[x] for x in columns) - k * step)
    assert max(offsets) - min(offsets) < 0.5


def test_long_text_is_fitted_in_no_time() -> None:
    theme = Theme(CLASSIC, Canvas((792, 600)))
    start = time.process_time()
    for _ in range(20):
        shown = theme.fit("m" * 100_000, 200, 12)
    assert time.process_time() - start < 1
    assert shown.endswith("...")
    assert theme.width(shown, 12) <= 200 < theme.width("m" + shown, 12)
    assert theme.fit("short", 200, 12) == "short"


def test_no_word_is_left_alone_on_a_line() -> None:
    theme = Theme(CLASSIC, Canvas((792, 600)))
    text = "A laser drone that sees you stops and charges, then burns along that line for two seconds."
    lines = wrapped(theme, text, 504, 12.5)
    widths = [theme.width(line, 12.5) for line in lines]
    assert " ".join(lines) == text
    assert len(lines) == 2
    assert min(widths) > 0.6 * max(widths)


@pytest.mark.parametrize("name", ["\0", "\ud800", "\U0001f98a", "\x1b[2J", "i" * 100_000])
def test_any_name_can_be_drawn(name: str) -> None:
    theme = Theme(CLASSIC, Canvas((792, 600)))
    started = time.process_time()
    shown = theme.fit(name, 200, 12)
    assert theme.width(shown, 12) <= 200
    assert Lettering(theme.canvas).rendered(name, 12, "black").get_width() < 5000
    assert wrapped(theme, f"{name} " * 3, 100, 12)
    assert time.process_time() - started < 2


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


def test_bold_letters_have_thicker_strokes() -> None:
    plain, bold = (pygame.mask.from_surface(StrokeFont(30, bold=b).render("Il", "black")) for b in (False, True))
    assert bold.count() > 1.25 * plain.count()


def test_two_things_in_one_line_stand_apart() -> None:
    lettering = Lettering(Canvas((792, 600)))
    together, apart = (lettering.width(text, 10) for text in ("gold time", "gold    time"))
    assert apart > together + 10
    assert lettering.width("gold  time", 10) == together, "other blanks in a row are one"
