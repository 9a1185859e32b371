"""Every palette can be read, and in the safe ones danger can be told without colour."""

from __future__ import annotations

import pygame
import pytest

from ninja_game.play.ui.palette import PALETTES, ROLES, Palette
from ninja_game.play.view.sprites.registry import DRAWINGS
from ninja_game.play.view.sprites.sprite_book import SpriteBook
from ninja_game.player.settings import PALETTES as OFFERED

STATES: dict[str, tuple[object, ...]] = {
    "mine": (), "turret": (0,), "thwump": (0, 0), "guard": (0, 0), "drone": (0, 0, 0, 0),
}  # fmt: skip
"""What is dangerous, at rest."""


def luminance(colour: pygame.Color) -> float:
    parts = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour[:3]]
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]


def contrast(a: pygame.Color, b: pygame.Color) -> float:
    """WCAG's contrast ratio, 1…21."""
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def test_the_settings_offer_these_palettes() -> None:
    assert tuple(PALETTES) == OFFERED


@pytest.mark.parametrize("palette", PALETTES.values(), ids=lambda palette: palette.name)
def test_text_and_ninja_stand_out(palette: Palette) -> None:
    assert contrast(palette.text, palette.panel) >= 7
    assert contrast(palette.text, palette.background) >= 7
    assert contrast(palette.faint, palette.panel) >= 4
    assert contrast(palette.on_tile, palette.tile) >= 3.2
    assert contrast(palette.ninja, palette.background) >= 7
    assert contrast(palette.tile, palette.background) >= 1.7
    for role in ("accent", "good", "bad", "mine", "weapon", "laser"):
        assert contrast(getattr(palette, role), palette.background) >= 2, role


@pytest.mark.parametrize("palette", PALETTES.values(), ids=lambda palette: palette.name)
@pytest.mark.parametrize("name", STATES)
def test_safe_palettes_mark_danger_by_shape(palette: Palette, name: str) -> None:
    """In one ink the drawing with marks differs from the drawing without."""
    if not palette.shapes:
        return
    ink = {role: pygame.Color("black") for role in ROLES}
    plain = SpriteBook(4.0, Palette("plain", shapes=False, **ink)).sprite((name, 0, 8, *STATES[name])).surface
    marked = SpriteBook(4.0, Palette("marked", shapes=True, **ink)).sprite((name, 0, 8, *STATES[name])).surface
    assert pygame.mask.from_surface(plain).count() != pygame.mask.from_surface(marked).count()


@pytest.mark.parametrize("palette", PALETTES.values(), ids=lambda palette: palette.name)
def test_every_drawing_can_be_made(palette: Palette) -> None:
    examples: dict[str, tuple[object, ...]] = STATES | {
        "gold": (), "one-way": (), "exit": (5,), "switch": (1,), "door": (2, 0), "door switch": (1, 0), "pad": (3,),
        "launcher": (2,), "crosshair": (3,), "streak": (2,), "lightning": (1,), "block": (1,), "barrel": (1, 4),
        "eye": (2,), "rocket": (1,), "flame": (3,), "burst": (4,), "puff": ("dust", 3, 1), "fireball": (2, 1),
        "burst star": (3,), "muzzle": (1,),
    }  # fmt: skip
    assert set(examples) == set(DRAWINGS)
    book = SpriteBook(2.0, palette)
    for name, parameters in examples.items():
        for turn in (0, 45):
            assert pygame.mask.from_surface(book.sprite((name, turn, 8, *parameters)).surface).count() > 0, name
