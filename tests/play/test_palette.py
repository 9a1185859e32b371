"""Every palette can be read, and the safe ones show danger without colour too."""

import pygame
import pytest

from ninja_game.player.settings import BY_COLUMN, Settings
from ninja_game.ui.scenery import SCENERIES
from ninja_game.ui.theme import MOODS, NINJA_COLOURS, PALETTES, ROLES, Palette, palette_named
from ninja_game.view.effects import particles
from ninja_game.view.hud import trough
from ninja_game.view.ninja.figure import edge_of
from ninja_game.view.sprites import moving_sprites as moving, static_sprites as static
from ninja_game.view.sprites.drawing import Drawing, SpriteBook, SpriteKey

AT_REST = (
    static.mine(),
    static.turret_base(0),
    moving.thwump(0, 0),
    moving.floor_guard(0, 0),
    moving.drone(0, 0, 0, 0),
)
"""What is dangerous, at rest."""


def contrast(ink: pygame.Color, ground: pygame.Color) -> float:
    """The contrast of two colours, 1 to 21 (WCAG 2.2, contrast ratio).

    >>> round(contrast(pygame.Color("white"), pygame.Color("black")))
    21
    """
    high, low = sorted((_luminance(ink), _luminance(ground)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def _luminance(colour: pygame.Color) -> float:
    """Relative luminance, 0 to 1 (WCAG 2.2)."""
    parts = [part / 255 for part in (colour.r, colour.g, colour.b)]
    red, green, blue = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def test_settings_accept_every_palette_and_an_unknown_one_is_the_default() -> None:
    for name in (BY_COLUMN, *PALETTES):
        assert Settings().changed(palette=name).palette == name
    assert palette_named(BY_COLUMN) is palette_named("of-another-version") is MOODS[0]


def test_each_column_has_its_own_mood_and_a_chosen_palette_stays() -> None:
    assert [palette_named(BY_COLUMN, column) for column in range(10)] == [*MOODS, *MOODS]
    assert palette_named("dark", 0) is palette_named("dark", 3) is PALETTES["dark"]
    assert len({mood.scenery for mood in MOODS}) == len(MOODS)
    assert {each.scenery for each in PALETTES.values()} == {*SCENERIES, ""}


@pytest.mark.parametrize("palette", PALETTES.values(), ids=lambda palette: palette.name)
def test_time_bar_stands_out_full_and_empty(palette: Palette) -> None:
    for colour in (palette.bar_full, palette.bar_empty):
        assert contrast(colour, trough(palette)) >= 4.5
        assert contrast(colour, palette.tile) >= 2


@pytest.mark.parametrize("palette", PALETTES.values(), ids=lambda palette: palette.name)
def test_text_and_ninja_stand_out(palette: Palette) -> None:
    assert contrast(palette.text, palette.panel) >= 7
    assert contrast(palette.text, palette.background) >= 7
    assert contrast(palette.faint, palette.panel) >= 4.5
    assert contrast(palette.accent, palette.panel) >= 4.5
    assert contrast(palette.on_tile, palette.tile) >= 3.2
    assert contrast(palette.ninja, palette.background) >= 7
    assert contrast(palette.tile, palette.background) >= 1.7
    for colour in (palette.ninja, *filter(None, map(pygame.Color, NINJA_COLOURS[1:]))):
        # Whatever lies behind: one of the two is far from it.
        assert contrast(edge_of(colour), colour) >= 3
    for role in ("accent", "good", "bad", "mine", "weapon", "laser"):
        assert contrast(getattr(palette, role), palette.background) >= 2, role


SAFE = [palette for palette in PALETTES.values() if palette.danger_by_shape]


@pytest.mark.parametrize("palette", SAFE, ids=lambda palette: palette.name)
@pytest.mark.parametrize("key", AT_REST)
def test_safe_palettes_mark_danger_by_shape(palette: Palette, key: SpriteKey) -> None:
    """In one ink the drawing with marks differs from the drawing without."""
    ink = {role: pygame.Color("black") for role in ROLES}
    plain = SpriteBook(4.0, Palette("plain", danger_by_shape=False, scenery="", mood=None, **ink)).sprite(key).surface
    marked = SpriteBook(4.0, Palette("marked", danger_by_shape=True, scenery="", mood=None, **ink)).sprite(key).surface
    assert pygame.mask.from_surface(plain).count() != pygame.mask.from_surface(marked).count()


@pytest.mark.parametrize("palette", PALETTES.values(), ids=lambda palette: palette.name)
def test_one_way_is_solid_where_it_carries_and_no_spikes_where_it_lets_through(palette: Palette) -> None:
    scale = 4
    bar, ax, ay = SpriteBook(scale, palette).sprite(static.one_way())
    alpha = {y: [bar.get_at((ax + scale * x, ay + scale * y)).a for x in range(-11, 12)] for y in (-10, -6, 6)}
    assert min(alpha[-10]) == 255, "what one stands on"
    assert max(alpha[-6]) < 128, "mines are solid, this is not"
    assert max(alpha[6]) == 0, "nothing points out of it"
    assert contrast(palette.switch, palette.background) >= 1.9


@pytest.mark.parametrize("palette", PALETTES.values(), ids=lambda palette: palette.name)
def test_every_drawing_can_be_made(palette: Palette) -> None:
    examples = (
        *AT_REST, static.gold(), static.one_way(), static.exit_door(5), static.exit_switch(1), static.door(2, 0),
        static.door_switch(1, 0), static.launch_pad(3), static.launcher_base(2), static.crosshair(3),
        static.gold_streak(2), static.lightning(1), moving.bounce_block(1), moving.barrel(1, 4), moving.eye(2),
        moving.rocket(1), moving.flame(3), moving.impact_burst(4), particles.puff("dust", 3, 1),
        particles.fireball(2, 1), particles.burst_star(3), particles.muzzle(1),
    )  # fmt: skip
    all_drawings = {
        value for module in (static, moving, particles) for value in vars(module).values() if isinstance(value, Drawing)
    }
    assert {key.drawing for key in examples} == all_drawings
    book = SpriteBook(2.0, palette)
    for key in examples:
        for turn in (0, 45):
            assert pygame.mask.from_surface(book.sprite(key.turned(turn)).surface).count() > 0, key
