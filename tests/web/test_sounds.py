"""Sounds of a page: a quarter as large, nearly as clear, and read by sound.js as by us."""

from __future__ import annotations

import base64
import io
import wave
from array import array
from pathlib import Path
from typing import Any

import pytest

from ninja_game.errors import FileError
from ninja_game.web.sounds import CLEAREST, MAGIC, compressed, decoded

SAMPLES = """
async (text) => {
  const { decoded } = await import("./sound.js");
  const sound = decoded(Uint8Array.from(atob(text), (char) => char.charCodeAt(0)));
  return sound && [sound.rate, Array.from(sound.samples, (sample) => Math.round(sample * 32768))];
}
"""


@pytest.fixture(scope="module")
def sounds(root: Path) -> dict[str, bytes]:
    """Our WAV files."""
    return {path.stem: path.read_bytes() for path in sorted((root / "assets" / "sounds").glob("*.wav"))}


def samples_of(data: bytes) -> array[int]:
    with wave.open(io.BytesIO(data)) as sound:
        return array("h", sound.readframes(sound.getnframes()))


def test_our_sounds_are_small_and_clear(sounds: dict[str, bytes]) -> None:
    small = {name: compressed(data) for name, data in sounds.items()}
    packed = {name for name, data in small.items() if data.startswith(MAGIC)}
    assert len(packed) >= len(sounds) - 3
    assert sum(map(len, small.values())) < 0.35 * sum(map(len, sounds.values()))
    for name in packed:
        before, (rate, after) = samples_of(sounds[name]), decoded(small[name])
        assert rate == 22_050
        noise = sum((one - two) ** 2 for one, two in zip(before, after, strict=True))
        assert noise * CLEAREST <= sum(sample * sample for sample in before), name


@pytest.mark.parametrize("data", [b"", b"RIFF", b"no sound at all"])
def test_what_is_no_sound_is_refused(data: bytes) -> None:
    with pytest.raises(FileError, match="WAV"):
        compressed(data, "x.wav")


def test_a_sound_in_stereo_is_refused() -> None:
    out = io.BytesIO()
    with wave.open(out, "wb") as sound:
        sound.setparams((2, 2, 22_050, 1, "NONE", ""))
        sound.writeframes(bytes(4))
    with pytest.raises(FileError, match="mono"):
        compressed(out.getvalue(), "x.wav")


@pytest.mark.parametrize("name", ["gold", "jump", "land", "chase"])
def test_the_page_reads_a_sound_as_we_do(name: str, sounds: dict[str, bytes], python: Any) -> None:
    small = compressed(sounds[name])
    expected = decoded(small) if small.startswith(MAGIC) else (22_050, samples_of(sounds[name]))
    rate, samples = python.evaluate(SAMPLES, base64.b64encode(small).decode())
    assert (rate, samples) == (expected[0], expected[1].tolist())


def test_the_page_refuses_what_is_no_sound(python: Any) -> None:
    assert python.evaluate(SAMPLES, base64.b64encode(b"RIFX" + bytes(60)).decode()) is None
