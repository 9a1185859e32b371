"""Sounds for a page, a quarter as large: the difference of each sample to the one before in four bits (IMA ADPCM).

The form: ``MAGIC``, then as little-endian uint32 the samples a second and their count, a byte for the first step, then
two samples a byte, the first one low. sound.js reads it.
"""

from __future__ import annotations

import io
import struct
import wave
from array import array

from ninja_game.errors import FileError

MAGIC = b"NGS1"
HEADER = struct.Struct("<4sIIB")

STEPS = tuple(min(32767, round(7 * 1.1**k)) for k in range(89))
"""How far one step goes, of 32767: of the usual table, to within a rounding."""
CHANGES = (-1, -1, -1, -1, 2, 4, 6, 8)
"""How the place in ``STEPS`` changes after so many quarters of a step."""

CLEAREST = 50
"""How many times stronger than its noise a sound is at least (17 dB)."""


def compressed(data: bytes, file: str = "") -> bytes:
    """The sound of a WAV file of 16 bits, mono; the file itself where too much would be lost.

    Raises FileError for anything else.
    """
    try:
        with wave.open(io.BytesIO(data)) as sound:
            form = sound.getnchannels(), sound.getsampwidth()
            rate, frames = sound.getframerate(), sound.readframes(sound.getnframes())
    except (wave.Error, EOFError) as error:
        raise FileError(f"this is not a WAV file: {error}", file) from None
    if form != (1, 2):
        raise FileError("a sound is mono, of 16 bits", file, found=f"{form[0]} channels of {8 * form[1]} bits")
    samples = array("h", frames)
    first = _first_step(samples)
    nibbles = _nibbles(samples, first)
    packed = bytes(low | high << 4 for low, high in zip(nibbles[::2], [*nibbles[1::2], 0], strict=False))
    small = HEADER.pack(MAGIC, rate, len(samples), first) + packed
    lost = sum((one - two) ** 2 for one, two in zip(samples, decoded(small)[1], strict=True))
    return small if lost * CLEAREST <= sum(sample * sample for sample in samples) else data


def _first_step(samples: array[int]) -> int:
    """The place of the step with which the sound is to begin: about as far as its first samples lie apart."""
    start = max((abs(b - a) for a, b in zip([0, *samples[:16]], samples[:16], strict=False)), default=0)
    return next((place for place, step in enumerate(STEPS) if 2 * step >= start), len(STEPS) - 1)


def _nibbles(samples: array[int], place: int) -> list[int]:
    """Four bits a sample: a sign and the quarters of a step, with which ``decoded`` comes closest."""
    value, found = 0, []
    for sample in samples:
        step, difference = STEPS[place], sample - value
        quarters = min(7, abs(difference) * 4 // step)
        moved = step * (2 * quarters + 1) // 8
        value = max(-32768, min(32767, value - moved if difference < 0 else value + moved))
        place = max(0, min(len(STEPS) - 1, place + CHANGES[quarters]))
        found.append(quarters | (8 if difference < 0 else 0))
    return found


def decoded(data: bytes) -> tuple[int, array[int]]:
    """Samples a second and the samples of what ``compressed`` gave: what sound.js makes of it."""
    _, rate, count, place = HEADER.unpack_from(data)
    value, samples = 0, array("h")
    for number in range(count):
        nibble = data[HEADER.size + number // 2] >> 4 * (number % 2) & 15
        moved = STEPS[place] * (2 * (nibble & 7) + 1) // 8
        value = max(-32768, min(32767, value - moved if nibble & 8 else value + moved))
        place = max(0, min(len(STEPS) - 1, place + CHANGES[nibble & 7]))
        samples.append(value)
    return rate, samples
