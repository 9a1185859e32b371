"""A gamepad at the TAS editor, by the events that SDL makes of it: taking over, playing, stepping."""

import pygame
import pytest

from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.ui.input.bindings import Bindings
from ninja_game.ui.input.gamepad import BUTTONS, FULL_AXIS
from tests.support.menu_driver import ScriptedKeys
from tests.support.tas_driver import TasDriver

PAD, PLAIN = 77, 78


@pytest.fixture(autouse=True)
def keys_of_the_devices(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is held is read from the devices."""
    monkeypatch.setattr(ScriptedKeys, "poll", Bindings.poll)


def button(at: TasDriver, name: str, *, down: bool = True) -> None:
    kind = pygame.CONTROLLERBUTTONDOWN if down else pygame.CONTROLLERBUTTONUP
    pygame.event.post(pygame.Event(kind, instance_id=PAD, button=BUTTONS.index(name)))
    at.frames()


def press(at: TasDriver, name: str) -> None:
    button(at, name)
    button(at, name, down=False)


def stick(at: TasDriver, value: float) -> None:
    pygame.event.post(
        pygame.Event(pygame.CONTROLLERAXISMOTION, instance_id=PAD, axis=0, value=round(value * FULL_AXIS))
    )
    at.frames()


def test_a_pad_takes_over_plays_stands_still_and_ends(at: TasDriver) -> None:
    at.editor.go(60)
    before, taken = at.editor.track, at.screen.level.take_over
    press(at, "start")
    at.frames(5)
    assert (taken.on, taken.waiting, at.editor.cursor) == (True, True, 60)
    stick(at, -1.0)
    at.frames(9)
    stick(at, 0.0)
    button(at, "dpad-right")
    button(at, "a")
    at.frames(8)
    button(at, "a", down=False)
    button(at, "dpad-right", down=False)
    at.frames(5)
    press(at, "start")
    assert taken.still
    stopped = at.editor.cursor
    at.frames(10)
    assert at.editor.cursor == stopped
    button(at, "dpad-left")
    press(at, "rightshoulder")
    assert at.editor.cursor == stopped + 1
    button(at, "dpad-left", down=False)
    press(at, "leftshoulder")
    assert at.editor.cursor == stopped
    press(at, "b")
    assert not taken.on
    played = at.keys_down(61, stopped + 2)
    assert played[:9] == [KEY_LEFT] * 9
    assert {key & (KEY_RIGHT | JUMP_HELD) for key in played} >= {0, KEY_RIGHT, KEY_RIGHT | JUMP_HELD}
    assert played[-1] == KEY_LEFT, "the tick that was stepped"
    assert at.shown_digest() == at.straight_digest(at.editor.cursor)
    press(at, "x")
    assert at.editor.track == before, "all of it is one edit"


def test_a_key_without_a_scancode_repeats_until_it_is_released(at: TasDriver) -> None:
    for kind, frames in ((pygame.KEYDOWN, 20), (pygame.KEYUP, 1)):
        pygame.event.post(pygame.Event(kind, key=pygame.K_PERIOD, mod=0, unicode=""))
        at.frames(frames)
    stepped = at.editor.cursor
    at.frames(20)
    assert (stepped > 2, at.editor.cursor) == (True, stepped)


def test_a_stick_that_is_held_already_does_not_begin(at: TasDriver) -> None:
    stick(at, 1.0)
    press(at, "start")
    at.frames(5)
    assert at.screen.level.take_over.waiting
    for value in (0.0, 1.0):
        stick(at, value)
    at.frames(3)
    assert at.editor.track.keys_at(2) == KEY_RIGHT


def test_a_pad_that_goes_away_lets_go_of_its_keys(at: TasDriver) -> None:
    at.editor.go(30)
    press(at, "start")
    stick(at, 1.0)
    at.frames(4)
    pygame.event.post(pygame.Event(pygame.JOYDEVICEREMOVED, instance_id=PAD))
    at.frames(6)
    assert at.editor.track.keys_at(33) == KEY_RIGHT
    assert at.editor.track.keys_at(at.editor.cursor) == 0


def test_a_plain_joystick_plays_too(at: TasDriver) -> None:
    at.editor.go(10)
    at.press("return")
    pygame.event.post(pygame.Event(pygame.JOYHATMOTION, instance_id=PLAIN, hat=0, value=(1, 0)))
    at.frames(6)
    pygame.event.post(pygame.Event(pygame.JOYBUTTONDOWN, instance_id=PLAIN, button=0))
    at.frames(3)
    pygame.event.post(pygame.Event(pygame.JOYBUTTONDOWN, instance_id=PLAIN, button=1))
    at.frames()
    assert not at.screen.level.take_over.on
    assert at.editor.track.keys_at(13) == KEY_RIGHT
    assert at.editor.track.keys_at(at.editor.cursor) & 7 == KEY_RIGHT | JUMP_HELD


def test_a_pad_steps_and_plays_a_run(at: TasDriver) -> None:
    track = at.editor.track
    at.editor.go(10)
    press(at, "rightshoulder")
    assert at.editor.cursor == 11
    button(at, "leftshoulder")
    at.frames(20)
    button(at, "leftshoulder", down=False)
    stepped = at.editor.cursor
    assert stepped < 9, "held, it repeats"
    at.frames(10)
    assert at.editor.cursor == stepped
    press(at, "y")
    at.frames(10)
    assert at.editor.cursor > stepped + 5
    press(at, "y")
    for name in ("a", "b", "dpad-left", "back", "leftstick"):
        press(at, name)
    assert at.editor.track == track, "no other button edits"
