"""The level larger than its part of the window: drawn at that size, moved, and it goes along with the ninja."""

import numpy as np
import pygame
import pytest

from ninja_game.sim.grid import Point
from ninja_game.ui.canvas import MAX_SCALE
from tests.support.tas_driver import TasDriver


def on_screen(at: TasDriver, place: Point) -> Point:
    """Where a place of the level is; logical px of the TAS editor."""
    canvas, level = at.screen.theme.canvas, at.screen.level
    left, top = canvas.rect(*level.area).topleft
    x, y = level.picture.canvas.point(*place)
    return canvas.logical((x + left, y + top))


def ninja_place(at: TasDriver) -> Point:
    x, y = at.session.timeline.positions[at.editor.cursor]
    return float(x), float(y)


def test_the_wheel_zooms_at_the_pointer_and_all_can_be_shown_again(at: TasDriver) -> None:
    level = at.screen.level
    whole = level.picture.canvas.scale
    under = (300.0, 330.0)
    pointer = on_screen(at, under)
    cursor = at.editor.cursor
    for _ in range(4):
        at.wheel(1, *pointer)
        assert on_screen(at, under) == pytest.approx(pointer, abs=1.6)
    assert level.picture.canvas.scale == pytest.approx(whole * 1.25**4)
    assert at.editor.cursor == cursor
    at.wheel(40, *pointer)
    assert level.picture.canvas.scale == pytest.approx(MAX_SCALE)
    at.press("0")
    assert level.picture.canvas.scale == whole
    at.wheel(3, *pointer)
    at.event(pygame.MOUSEBUTTONDOWN, *pointer, button=2)
    at.event(pygame.MOUSEBUTTONUP, *pointer, button=2)
    assert level.picture.canvas.scale == whole
    at.wheel(-3, *pointer)
    assert level.picture.camera.zoom == 1.0


def test_a_click_in_the_larger_level_goes_to_the_tick_that_is_there(at: TasDriver) -> None:
    positions = at.session.timeline.positions
    tick = 100
    at.wheel(5, *on_screen(at, tuple(positions[tick])))
    at.mouse(*on_screen(at, tuple(positions[tick])))
    assert np.hypot(*(positions[at.editor.cursor] - positions[tick])) < 1


def test_it_is_drawn_at_its_size_wherever_it_was_moved_to(at: TasDriver) -> None:
    """What was moved, played and edited looks as what is drawn at once."""
    level = at.screen.level
    camera, picture = level.picture.camera, level.picture
    at.editor.go(60)
    at.frames()
    at.wheel(5, *on_screen(at, ninja_place(at)))
    x, y = on_screen(at, ninja_place(at))
    before = camera.centre
    at.drag((x, y), (x - 40, y - 30), (x - 41, y - 30), button=3)
    assert camera.centre != before
    assert at.top() is at.screen, "a drag watches nothing"
    at.event(pygame.MOUSEMOTION, 3, 3)
    for _ in range(30):
        at.press("period")
    kept = picture.surface.copy()
    place = camera.centre
    camera.centre = place[0] + 9, place[1]
    at.frames()
    assert pygame.image.tobytes(kept, "RGB") != pygame.image.tobytes(picture.surface, "RGB")
    camera.centre = place
    at.frames()
    assert pygame.image.tobytes(kept, "RGB") == pygame.image.tobytes(picture.surface, "RGB")


def test_only_the_button_that_grabbed_the_level_lets_it_go(at: TasDriver) -> None:
    found = at.screen.level.picture.run.objects[0]
    x, y = on_screen(at, (found.x, found.y))
    at.mouse(x, y, click=False)
    assert at.screen.level.pointed is not None
    at.event(pygame.MOUSEBUTTONDOWN, x, y, button=3)
    at.wheel(1, x, y)
    at.event(pygame.MOUSEBUTTONUP, x, y, button=1)
    assert at.screen.level._pointer.is_busy
    assert at.top() is at.screen, "nothing is asked"
    at.event(pygame.MOUSEBUTTONUP, x, y, button=3)
    assert at.top() is not at.screen, "a formula to watch it"


def test_it_goes_along_with_the_ninja(at: TasDriver) -> None:
    level = at.screen.level
    at.editor.go(0)
    at.frames()
    at.wheel(7, *on_screen(at, ninja_place(at)))
    seen = pygame.Rect((0, 0), level.picture.surface.get_size())
    at.press("space")
    for _ in range(60):
        at.frames(3)
        assert seen.collidepoint(level.picture.canvas.point(*ninja_place(at)))
    at.press("space")
    for tick in (150, 20, 200):
        at.editor.go(tick)
        at.frames()
        assert seen.collidepoint(level.picture.canvas.point(*ninja_place(at)))


def test_ctrl_and_the_wheel_go_tick_by_tick(at: TasDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    at.editor.go(50)
    monkeypatch.setattr(pygame.key, "get_mods", lambda: pygame.KMOD_LCTRL)
    at.wheel(-2, 100, 100)
    assert at.editor.cursor == 52
    assert at.screen.level.picture.camera.zoom == 1.0
