"""The page's side of the shim: keys, mouse, wheel, gamepads and focus as pygame's events, the pace, sound."""

import json
from typing import Any

import pygame
import pytest

from ninja_game.ui.input.keys import SCANCODES, key_name
from tests.support.visitor import eventually

EVENTS = """
import json, pygame
from pygame.event import DEVICES
NUMBERS = {name: value for name, value in vars(pygame.constants).items() if type(value) is int}
NAMES = {value: name for name, value in NUMBERS.items() if not name.startswith("KMOD")}
def events():
    found = [(NAMES[event.type], {k: v for k, v in vars(event).items() if k != "type"}) for event in pygame.event.get()]
    held = [code for code, down in enumerate(DEVICES.keys) if down]
    return json.dumps([found, held, DEVICES.modifiers, DEVICES.mouse])
from pygame.host import LINK
import js
LINK.page = js.host
pygame.display.set_mode()
"""

PACE = """
import json, os
os.environ["NINJA_GAME_HOME"] = "/player-of-the-pace"
import boot, js
def pace(rate, limit, seconds):
    boot.start(js.host)
    app, passed = boot.app(), []
    app.change_settings(frame_limit=limit)
    app.advance, app.draw, boot.LONG = passed.append, int, 1e9
    start = boot._Game.last
    for number in range(1, round(rate * seconds) + 1):
        # Displays are not quite even.
        boot.turn(start + 1000 * number / rate + (0.4 if number % 2 else -0.4))
    return json.dumps(passed)
"""


LATE = """
import json, os
os.environ["NINJA_GAME_HOME"] = "/player-of-the-late"
import boot, js
boot.start(js.host)
done = []
boot.app().advance, boot.app().draw = lambda ms: done.append("time"), lambda: done.append("picture")
for boot.LONG_TURN in (-1, -1, -1, 1e9):
    boot.turn(boot._Game.last)
json.dumps(done)
"""

HEAVY = """
import pygame
screen = pygame.display.set_mode()
screen.fill("#000000")
pygame.display.flip()
layers = [pygame.Surface((50, 50)) for _ in range(5)]
for layer in layers:
    layer.fill("#ff0000")
    screen.blit(layer, (0, 0))
js.host.patience = -1
pygame.display.flip()
"""

IN_TURNS = """
(heavy) => {
  const red = () => canvas.getContext("2d").getImageData(9, 9, 1, 1).data[0];
  python.runPython(heavy);
  const seen = [red()];
  while (host.painter.goOn(-1)) seen.push(red());
  host.patience = Infinity;
  return seen;
}
"""

DOT = """
import os, tempfile
from ninja_game.ui.lettering import StrokeFont
import pygame
screen = pygame.display.set_mode()
screen.fill("#000000")
screen.blit(StrokeFont(100, bold=False).render("i", "#ffffff"), (0, 0))
pygame.display.flip()
"""

INK = """
(dot) => {
  python.runPython(dot);
  const data = canvas.getContext("2d").getImageData(0, 0, 40, 110).data;
  const row = (y) => data.slice(160 * y, 160 * (y + 1)).some((value, at) => at % 4 === 0 && value > 128);
  return [...Array(110).keys()].map((y) => (row(y) ? "#" : " ")).join("").trim().split(/ +/).length;
}
"""


@pytest.fixture(scope="module")
def page(python: Any) -> Any:
    """A page whose events are read."""
    python.evaluate("text => { python.runPython(text); }", EVENTS)
    python.bring_to_front()
    return python


@pytest.fixture
def events(page: Any) -> Any:
    """What happened since the test began, or since the last call."""

    def read() -> Any:
        return json.loads(page.evaluate("() => python.globals.get('events')()"))

    page.evaluate("() => host.input.focus(false)")
    page.mouse.move(5, 5)
    read()
    return read


@pytest.mark.slow
def test_keys_are_pressed_held_and_released(page: Any, events: Any) -> None:
    page.keyboard.down("ArrowLeft")
    page.keyboard.down("Shift")
    pressed, held, modifiers, _ = events()
    left, shift = SCANCODES["left"], SCANCODES["lshift"]
    assert [(name, fields["key"], fields["scancode"]) for name, fields in pressed] == [
        ("KEYDOWN", pygame.K_LEFT, left), ("KEYDOWN", pygame.K_LSHIFT, shift),
    ]  # fmt: skip
    assert held == [left, shift]
    assert modifiers & pygame.KMOD_SHIFT
    page.keyboard.up("ArrowLeft")
    page.keyboard.up("Shift")
    released, held, modifiers, _ = events()
    assert [name for name, _ in released] == ["KEYUP", "KEYUP"]
    assert (held, modifiers) == ([], 0)


@pytest.mark.parametrize(
    "code, name",
    [
        ("KeyA", "a"), ("KeyZ", "z"), ("Digit1", "1"), ("Digit0", "0"), ("Numpad1", "kp_1"), ("Numpad0", "kp_0"),
        ("F1", "f1"), ("F12", "f12"), ("Enter", "return"), ("Space", "space"), ("Backquote", "grave"),
        ("ControlRight", "rctrl"), ("MetaLeft", "lgui"), ("IntlBackslash", "nonusbackslash"), ("PageDown", "pagedown"),
    ],
)  # fmt: skip
def test_places_on_the_keyboard_have_the_names_of_the_settings(code: str, name: str, page: Any, events: Any) -> None:
    page.evaluate("code => { host.input.key(code, true); host.input.key(code, false); }", code)
    (down, up), *_ = events()
    assert down[0] == "KEYDOWN"
    assert up[0] == "KEYUP"
    assert SCANCODES[name] == down[1]["scancode"] == up[1]["scancode"]


def test_every_key_of_the_page_has_a_name(page: Any) -> None:
    codes = page.evaluate("async () => { const { codeOf } = await import(app + 'input.js');"
                          " return [...Array(512).keys()].filter((number) => codeOf(number)); }")  # fmt: skip
    assert len(codes) > 90
    assert not [code for code in codes if key_name(code).startswith("scancode")]


def test_characters_come_only_while_text_is_typed(page: Any, events: Any) -> None:
    page.keyboard.press("x")
    assert [name for name, _ in events()[0]] == ["KEYDOWN", "KEYUP"]
    page.evaluate("() => { host.input.typing = true; }")
    page.keyboard.press("Q")
    page.evaluate("() => { host.input.typing = false; }")
    found = events()[0]
    assert [name for name, _ in found] == ["KEYDOWN", "TEXTINPUT", "KEYUP"]
    assert found[1][1] == {"text": "Q"}


def test_the_mouse_is_followed_in_px_of_the_canvas(page: Any, events: Any) -> None:
    page.mouse.move(100, 50)
    page.mouse.move(120, 60)
    page.mouse.down()
    page.mouse.up()
    page.mouse.wheel(0, 100)
    found, *_, place = events()
    assert [name for name, _ in found] == ["MOUSEMOTION", "MOUSEBUTTONDOWN", "MOUSEBUTTONUP", "MOUSEWHEEL"]
    assert found[0][1] == {"pos": [120, 60], "rel": [115, 55], "buttons": [0, 0, 0], "touch": False}
    assert found[1][1] == {"pos": [120, 60], "button": 1, "touch": False}
    assert found[3][1]["y"] == -1
    assert place == [120, 60]


def test_what_is_held_is_released_when_the_page_loses_the_focus(page: Any, events: Any) -> None:
    page.keyboard.down("KeyD")
    page.evaluate("() => dispatchEvent(new Event('blur'))")
    found, held, *_ = events()
    assert [name for name, _ in found] == ["KEYDOWN", "KEYUP", "WINDOWFOCUSLOST"]
    assert held == []
    page.keyboard.up("KeyD")


def test_a_gamepad_speaks_as_sdl_has_it(page: Any, events: Any) -> None:
    page.evaluate("""() => {
      const buttons = Array.from({ length: 17 }, () => ({ pressed: false, value: 0 }));
      window.pad = { index: 0, mapping: "standard", buttons, axes: [0, 0, 0, 0] };
      navigator.getGamepads = () => [window.pad];
      host.input.addPad(window.pad);
    }""")
    assert events()[0] == [["JOYDEVICEADDED", {"device_index": 0}]]
    page.evaluate("() => { pad.buttons[7].value = 1; pad.buttons[12].pressed = true; pad.axes[0] = -0.5; }")
    assert events()[0] == [
        ["CONTROLLERAXISMOTION", {"instance_id": 0, "axis": pygame.CONTROLLER_AXIS_TRIGGERRIGHT, "value": 32767}],
        ["CONTROLLERBUTTONDOWN", {"instance_id": 0, "button": pygame.CONTROLLER_BUTTON_DPAD_UP}],
        ["CONTROLLERAXISMOTION", {"instance_id": 0, "axis": pygame.CONTROLLER_AXIS_LEFTX, "value": -16383}],
    ]
    page.evaluate("() => { host.input.removePad(pad); navigator.getGamepads = () => []; }")
    assert events()[0] == [["JOYDEVICEREMOVED", {"instance_id": 0}]]


@pytest.mark.parametrize("rate", [59.94, 60, 120, 144, 240])
@pytest.mark.parametrize("limit", [0, 30, 60])
def test_the_pace_is_right_on_every_display(rate: float, limit: int, page: Any) -> None:
    page.evaluate("text => { python.runPython(text); }", PACE)
    passed = json.loads(page.evaluate("([rate, limit]) => python.globals.get('pace')(rate, limit, 10)", [rate, limit]))
    # No time is lost or gained, whatever the display.
    assert abs(sum(passed) - 10_000) <= 40
    pictures = min(rate, limit or rate) * 10
    assert pictures * 0.98 <= len(passed) <= pictures + 2
    assert max(passed) <= 2.1 * 1000 / min(rate, limit or rate)


UNLOCKED = """
async (active) => {
  const { Sounds } = await import(app + "sound.js");
  const sounds = new Sounds();
  Object.defineProperty(navigator, "userActivation", { value: { hasBeenActive: active }, configurable: true });
  sounds.unlock();
  delete navigator.userActivation;
  await sounds.audio?.close();
  return sounds.audio !== null;
}
"""


def test_the_sound_device_waits_for_a_press_that_the_browser_counts(page: Any) -> None:
    """Escape and the start of a touch are none: a device made then is refused, with a warning."""
    assert [page.evaluate(UNLOCKED, active) for active in (False, True)] == [False, True]


def test_a_sound_is_heard_as_long_as_it_lasts(page: Any) -> None:
    page.keyboard.press("x")
    page.evaluate(
        """text => { python.runPython(text); }""",
        """
import pygame
pygame.mixer.set_num_channels(8)
pygame.mixer.set_reserved(2)
SOUND = pygame.mixer.Sound("/game/ninja_game/data/assets/sounds/jump-1.ogg")
""",
    )
    eventually(page, lambda: page.evaluate("() => python.runPython('SOUND.get_length()')"), "the sound is not decoded")
    page.evaluate(
        """text => { python.runPython(text); }""",
        """
CHANNEL = SOUND.play()
LOOP = pygame.mixer.Channel(0)
LOOP.play(SOUND, loops=-1, fade_ms=10)
LOOP.set_volume(0.5)
assert CHANNEL.number == 2 and CHANNEL.get_busy() and LOOP.get_busy() and LOOP.sound is SOUND
""",
    )
    busy = "() => python.runPython('[CHANNEL.get_busy(), LOOP.get_busy()]').toJs()"
    eventually(page, lambda: page.evaluate(busy) == [False, True], "the sound does not end, or the loop does")
    page.evaluate("() => { python.runPython('pygame.mixer.stop()'); }")
    assert page.evaluate(busy) == [False, False]


@pytest.mark.slow
def test_a_turn_that_takes_long_leaves_its_picture_to_the_next(page: Any) -> None:
    """Two in a row never do."""
    done = json.loads(page.evaluate("text => python.runPython(text)", LATE))
    assert done == ["time", "picture", "time", "picture"]


@pytest.mark.slow
def test_what_is_not_seen_yet_is_painted_over_some_turns(page: Any) -> None:
    """And what is seen at once, at the end."""
    seen = page.evaluate(IN_TURNS, HEAVY)
    assert len(seen) > 4
    assert seen == [0] * (len(seen) - 1) + [255]


@pytest.mark.slow
def test_a_letter_has_its_dot(page: Any) -> None:
    """As a line of no length it would not be painted."""
    assert page.evaluate(INK, DOT) == 2
