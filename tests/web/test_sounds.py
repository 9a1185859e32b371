"""Sounds of a page: the browser decodes our files as we do; music comes from the host when it is wanted."""

import base64
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from tests.support.visitor import Visitor, eventually
from tools.sounds.effects import LOOPS
from tools.sounds.music import TRACKS

START = """
async (text) => {
  const { Sounds } = await import(app + "sound.js");
  window.sounds = new Sounds();
  sounds.unlock();
  return sounds.add(Uint8Array.from(atob(text), (char) => char.charCodeAt(0)));
}
"""
LENGTH = "() => sounds.length(0)"


@pytest.fixture(autouse=True)
def _silence(python: Any) -> Iterator[None]:
    """A sound device takes processor time until it is closed or stopped, silent or not."""
    yield
    python.evaluate("() => { window.sounds?.audio?.close(); host.sounds.audio?.suspend(); }")


@pytest.mark.parametrize("name", ["gold-1", "jump-2", "land-hard-3", "chase"])
def test_the_page_decodes_a_sound_as_we_do(name: str, root: Path, python: Any) -> None:
    path = root / "assets" / "sounds" / f"{name}.ogg"
    assert python.evaluate(START, base64.b64encode(path.read_bytes()).decode()) == 0
    eventually(python, lambda: python.evaluate(LENGTH), "the sound is not decoded")
    wanted, rate = soundfile.read(path)
    found = np.array(python.evaluate("() => Array.from(sounds.buffers[0].getChannelData(0))"))
    assert python.evaluate("() => sounds.buffers[0].sampleRate") == rate
    # Chromium leaves out some of the silence at the end of a short sound.
    assert len(wanted) - 128 <= len(found) <= len(wanted)
    assert np.abs(found - wanted[: len(found)]).max() <= 0.001


@pytest.mark.parametrize("name", [*LOOPS, *(f"music/{track}" for track in TRACKS)])
def test_a_loop_is_decoded_to_its_last_sample(name: str, root: Path, python: Any) -> None:
    path = root / "assets" / "sounds" / f"{name}.ogg"
    python.evaluate(START, base64.b64encode(path.read_bytes()).decode())
    eventually(python, lambda: python.evaluate(LENGTH), "the sound is not decoded")
    assert python.evaluate("() => sounds.buffers[0].length") == soundfile.info(path).frames


@pytest.mark.parametrize("data", [b"", b"RIFF" + bytes(60), b"Ogg"])
def test_the_page_refuses_what_is_not_a_sound(data: bytes, python: Any) -> None:
    assert python.evaluate(START, base64.b64encode(data).decode()) == -1


def test_nothing_can_be_heard_before_the_player_has_pressed_something(root: Path, python: Any) -> None:
    path = root / "assets" / "sounds" / "chase.ogg"
    python.evaluate(START.replace("sounds.unlock();", ""), base64.b64encode(path.read_bytes()).decode())
    eventually(python, lambda: python.evaluate("() => Boolean(sounds.buffers[0])"), "the sound is not decoded")
    assert python.evaluate(LENGTH) == 0
    python.evaluate("() => sounds.unlock()")
    assert python.evaluate(LENGTH) > 0


def test_a_damaged_sound_is_silent(python: Any) -> None:
    assert python.evaluate(START, base64.b64encode(b"OggS" + bytes(60)).decode()) == 0
    python.wait_for_timeout(100)
    assert python.evaluate(LENGTH) == 0
    python.evaluate("() => { sounds.play(0, 0, 0, 0); }")
    assert not python.evaluate("() => sounds.busy(0)")


def test_music_is_fetched_when_it_is_wanted(site: Path, python: Any) -> None:
    layers = sorted(path.name for path in (site / "music").glob("*.ogg"))
    assert layers
    python.evaluate("() => host.sounds.unlock()")
    number = python.evaluate(f"() => host.sound('/game/ninja_game/data/assets/sounds/music/{layers[0]}')")
    eventually(python, lambda: python.evaluate(f"() => host.sounds.length({number})"), "the music does not come")
    again = python.evaluate(f"() => host.sound('/game/ninja_game/data/assets/sounds/music/{layers[0]}')")
    assert again == number, "it is kept"
    ask = "() => host.sound('/game/ninja_game/data/assets/sounds/music/none.ogg')"
    missing = python.evaluate(ask)
    eventually(python, lambda: python.evaluate(ask) != missing, "what did not come is not asked for again")
    assert python.evaluate(f"() => host.sounds.length({missing})") == 0


def test_the_menu_has_its_music_once_something_was_pressed(new_visitor: Callable[..., Visitor]) -> None:
    visitor = new_visitor()
    visitor.visit()
    for again in (False, True):
        assert visitor.python("app.audio_output.soundtrack.playing") == ""
        visitor.press("ArrowDown")
        visitor.eventually("app.audio_output.soundtrack.playing == 'menu'")
        visitor.eventually("__import__('pygame').mixer.Channel(app.audio_output.soundtrack.first).get_busy()")
        if not again:
            # The second visit begins with the memory of the first one's start.
            visitor.page.evaluate("() => navigator.serviceWorker.ready.then(() => ninjaGame.kept)")
            visitor.visit()
            assert visitor.page.evaluate("ninjaGame.fromMemory")
    assert visitor.problems == []
