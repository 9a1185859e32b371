"""Keys are places, pads have names, several inputs mean one action, and no stick flutters."""

from pathlib import Path

import pygame
import pytest

from ninja_game.play.app import build_app
from ninja_game.ui.audio.player import AudioOutput
from ninja_game.ui.input.bindings import ACTIONS, MENU_KEYS, Bindings
from ninja_game.ui.input.gamepad import FULL_AXIS, Gamepads, pad_label
from ninja_game.ui.input.keys import SCANCODES, key_label, key_name, learn_label, scancode_named


@pytest.fixture
def bindings() -> Bindings:
    pygame.display.init()
    pygame.display.set_mode((10, 10))
    return Bindings()


def key(name: str, kind: int = pygame.KEYDOWN, *, layout: int = 0) -> pygame.Event:
    return pygame.Event(kind, key=layout, scancode=SCANCODES[name], mod=0, unicode="")


def axis(value: float, number: int = pygame.CONTROLLER_AXIS_LEFTX, pad: int = 5) -> pygame.Event:
    return pygame.Event(pygame.CONTROLLERAXISMOTION, instance_id=pad, axis=number, value=round(value * FULL_AXIS))


def test_names_of_keys_and_scancodes_belong_together() -> None:
    assert all(scancode_named(key_name(code)) == code for code in SCANCODES.values())
    assert scancode_named("scancode-300") == 300
    assert scancode_named("no such key") is None
    assert scancode_named("scancode-512") is None


def test_pads_that_are_there_at_the_start_are_opened(monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[int] = []
    monkeypatch.setattr(pygame.joystick, "get_count", lambda: 2)
    monkeypatch.setattr(Gamepads, "_add", lambda _, number: opened.append(number))
    Gamepads()
    assert opened == [0, 1]


def test_keys_that_do_not_exist_leave_the_defaults_and_are_named(tmp_path: Path) -> None:
    (tmp_path / "settings.toml").write_text('[keys]\njump = ["scancode-512", "scancode-999"]\nleft = ["odd", "q"]\n')
    app = build_app(tmp_path, audio_output=AudioOutput())
    assert app.controls.keys["jump"] == ACTIONS["jump"].keys
    assert app.controls.keys["left"] == ("q",)
    assert app.controls.poll() == 0
    assert "no key is called odd, scancode-512, scancode-999" in app.notice
    app.player.close()


def test_every_default_and_menu_key_exists() -> None:
    names = {name for action in ACTIONS.values() for name in action.keys} | set(MENU_KEYS)
    assert names <= set(SCANCODES)


def test_binding_is_a_place_whatever_the_layout_prints_there(bindings: Bindings) -> None:
    # On a French keyboard the place of A types Q.
    press = key("a", layout=pygame.K_q)
    assert "left" in bindings.decode(press).pressed
    learn_label(press)
    assert key_label("a") == "Q"
    learn_label(key("a", layout=pygame.K_a))
    assert key_label("a") == "A"


def test_one_key_may_mean_several_actions(bindings: Bindings) -> None:
    assert set(bindings.decode(key("period")).pressed) == {"step", "frame_forward"}
    assert set(bindings.decode(key("period", pygame.KEYUP)).released) == {"step", "frame_forward"}


def test_changed_action_loses_its_defaults_and_others_stay(bindings: Bindings) -> None:
    bindings.bind({"jump": ("x", "kp_plus", "unknown")}, {})
    assert "jump" in bindings.decode(key("x")).pressed
    assert "jump" in bindings.decode(key("kp_plus")).pressed
    assert "jump" not in bindings.decode(key("z")).pressed
    assert "left" in bindings.decode(key("left")).pressed
    assert bindings.name("jump") == "X"


def test_menu_keys_cannot_be_taken_away(bindings: Bindings) -> None:
    bindings.bind(dict.fromkeys(ACTIONS, ()), dict.fromkeys(ACTIONS, ()))
    assert bindings.decode(key("return")).menu == "confirm"
    assert bindings.decode(key("up")).menu == "up"
    assert bindings.name("jump") == "(no key)"


def test_stick_presses_beyond_the_dead_zone_and_does_not_flutter(bindings: Bindings) -> None:
    assert bindings.decode(axis(-0.3)).pressed == ()
    assert "left" in bindings.decode(axis(-0.4)).pressed
    assert bindings.poll() == 1
    assert bindings.decode(axis(-0.32)).released == ()
    assert "left" in bindings.decode(axis(-0.2)).released
    assert bindings.poll() == 0


def test_stick_thrown_across_releases_one_side_and_presses_the_other() -> None:
    pads = Gamepads()
    pads.changes(axis(-1.0))
    assert sorted(pads.changes(axis(1.0))) == [("leftx+", True), ("leftx-", False)]


def test_event_is_decoded_into_all_its_meanings(bindings: Bindings) -> None:
    event = bindings.decode(pygame.Event(pygame.CONTROLLERBUTTONDOWN, instance_id=5, button=pygame.CONTROLLER_BUTTON_A))
    assert set(event.pressed) == {"jump", "confirm"}
    assert event.menu == "confirm"
    assert event.source == ("pad", "a")
    assert not event.released


def test_pad_that_is_pulled_out_lets_go_of_everything(bindings: Bindings) -> None:
    bindings.decode(axis(1.0))
    assert bindings.poll() == 2
    assert "right" in bindings.decode(pygame.Event(pygame.JOYDEVICEREMOVED, instance_id=5)).released
    assert bindings.poll() == 0


def test_hats_and_axes_of_unknown_pads_work_too(bindings: Bindings) -> None:
    hat = pygame.Event(pygame.JOYHATMOTION, instance_id=9, hat=0, value=(-1, 0))
    assert "left" in bindings.decode(hat).pressed
    assert "right" in bindings.decode(pygame.Event(pygame.JOYAXISMOTION, instance_id=9, axis=0, value=0.9)).pressed
    assert "jump" in bindings.decode(pygame.Event(pygame.JOYBUTTONDOWN, instance_id=9, button=0)).pressed


@pytest.mark.parametrize("name, bit", [("z", 4), ("space", 4), ("left", 1), ("right", 2)])
@pytest.mark.parametrize("late", [0.0, 0.1])
def test_tap_between_two_ticks_still_counts_once(
    bindings: Bindings, monkeypatch: pytest.MonkeyPatch, name: str, bit: int, late: float
) -> None:
    """Also in slow motion, where a tick takes 100 ms."""
    now = 5.0
    monkeypatch.setattr("ninja_game.ui.input.bindings.monotonic", lambda: now)
    bindings.decode(key(name))
    bindings.decode(key(name, pygame.KEYUP))
    now += late
    assert bindings.poll() == bit
    assert bindings.poll() == 0


def test_second_jump_key_is_a_new_press(bindings: Bindings, monkeypatch: pytest.MonkeyPatch) -> None:
    polled = []
    for names in ({"z"}, {"z", "right"}, {"z", "up", "right"}, {"z", "up"}, {"up"}, {"up", "z"}):
        state = tuple(any(code == SCANCODES[name] for name in names) for code in range(512))
        monkeypatch.setattr(pygame.key, "get_pressed", lambda state=state: state)
        polled.append(bindings.poll())
    assert polled == [4, 6, 2, 4, 4, 0]


def test_what_a_key_that_jumps_has_just_chosen_is_no_jump(bindings: Bindings, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, expected in (("space", 4), ("z", 0), ("return", 0)):
        state = tuple(code == SCANCODES[name] for code in range(512))
        monkeypatch.setattr(pygame.key, "get_pressed", lambda state=state: state)
        assert bindings.choosing() == expected
    monkeypatch.setattr(pygame.key, "get_pressed", lambda: (False,) * 512)
    bindings.decode(pygame.Event(pygame.CONTROLLERBUTTONDOWN, instance_id=5, button=pygame.CONTROLLER_BUTTON_A))
    assert bindings.choosing() == 4


def test_labels_follow_the_device_used_last(bindings: Bindings) -> None:
    bindings.decode(axis(1.0))
    assert bindings.name("jump") == "A"
    bindings.decode(key("z"))
    assert bindings.name("jump") == "Z"


def test_the_two_directions_of_an_axis_have_names_of_their_own() -> None:
    assert [pad_label(name) for name in ("axis-0-", "axis-0+", "button-3")] == ["Axis 0-", "Axis 0+", "Button 3"]
