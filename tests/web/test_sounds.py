"""Sounds of a page: the browser decodes our files as we do; music comes from the host when it is wanted."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

from tests.support.visitor import eventually

START = """
async (text) => {
  const { Sounds } = await import("./sound.js");
  window.sounds = new Sounds();
  return sounds.add(Uint8Array.from(atob(text), (char) => char.charCodeAt(0)));
}
"""
LENGTH = "() => sounds.length(0)"


@pytest.mark.parametrize("name", ["gold-1", "jump-2", "land-hard-3", "chase"])
def test_the_page_decodes_a_sound_as_we_do(name: str, root: Path, python: Any) -> None:
    path = root / "assets" / "sounds" / f"{name}.ogg"
    assert python.evaluate(START, base64.b64encode(path.read_bytes()).decode()) == 0
    eventually(python, lambda: python.evaluate(LENGTH), "the sound is not decoded")
    wanted, rate = soundfile.read(path)
    assert python.evaluate(LENGTH) == pytest.approx(len(wanted) / rate)
    assert python.evaluate("() => sounds.buffers[0].sampleRate") == rate
    found = np.array(python.evaluate("() => Array.from(sounds.buffers[0].getChannelData(0))"))
    assert np.abs(found - wanted)[256:].max() <= 0.001


def test_a_loop_has_no_seam_where_the_browser_has_dropped_samples(root: Path, python: Any) -> None:
    path = root / "assets" / "sounds" / "laser-beam.ogg"
    python.evaluate(START, base64.b64encode(path.read_bytes()).decode())
    eventually(python, lambda: python.evaluate(LENGTH), "the sound is not decoded")
    python.evaluate("() => { sounds.mend(0); sounds.mend(0); }")
    found = np.array(python.evaluate("() => Array.from(sounds.buffers[0].getChannelData(0))"))
    looped = np.concatenate([found[-2000:], found[1024:3000]])
    steps = np.abs(np.diff(looped))
    assert steps[1990:2010].max() <= np.abs(np.diff(soundfile.read(path)[0])).max()


@pytest.mark.parametrize("data", [b"", b"RIFF" + bytes(60), b"Ogg"])
def test_the_page_refuses_what_is_no_sound(data: bytes, python: Any) -> None:
    assert python.evaluate(START, base64.b64encode(data).decode()) == -1


def test_a_damaged_sound_is_silent(python: Any) -> None:
    assert python.evaluate(START, base64.b64encode(b"OggS" + bytes(60)).decode()) == 0
    python.wait_for_timeout(100)
    assert python.evaluate(LENGTH) == 0
    python.evaluate("() => { sounds.unlock(); sounds.play(0, 0, 0, 0); }")
    assert not python.evaluate("() => sounds.busy(0)")


def test_music_is_fetched_when_it_is_wanted(site: Path, python: Any) -> None:
    layers = sorted(path.name for path in (site / "music").glob("*.ogg"))
    assert layers
    number = python.evaluate(f"() => host.sound('/game/ninja_game/data/assets/sounds/music/{layers[0]}')")
    eventually(python, lambda: python.evaluate(f"() => host.length({number})"), "the music does not come")
    missing = python.evaluate("() => host.sound('/game/ninja_game/data/assets/sounds/music/none.ogg')")
    python.wait_for_timeout(100)
    assert python.evaluate(f"() => host.length({missing})") == 0
