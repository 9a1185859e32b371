"""The music: for each column and the menu a loop in four layers, in notes that the ladder of gold has too.

A loop is eight bars. Everything is added round its end, echoes too, so that it has no seam.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from tools.sounds.effects import RATE, Wave, at_level, bell, fade, filtered, glide, noise, spaced, times, tone

SCALE = (0, 2, 4, 5, 7, 9, 11)  # semitones of a major scale; degree 0 is G
G = 98.0  # Hz

BARS, BEATS = 8, 4


class Bed(NamedTuple):
    """What makes the music of a place.

    ``tempo``: beats a minute; ``chords``: degree of the scale for each bar; ``motif``: the degree above the chord's
    root for each eighth of two bars, "." a rest; ``pulse``: eighths of a bar on which the low notes of danger come;
    ``bright``: Hz up to which its chords go.
    """

    tempo: int
    chords: tuple[int, ...]
    motif: str
    pulse: tuple[int, ...]
    bright: float
    seed: int


BEDS = {
    "menu": Bed(84, (4, 0, 3, 0, 4, 1, 3, 4), "0..4..2.7..4....", (0, 4), 2400, 1),
    "ground": Bed(96, (0, 3, 0, 4, 5, 3, 1, 4), "0.2.4..27.4.2...", (0, 3, 6), 2600, 2),
    "machines": Bed(108, (1, 1, 3, 4, 1, 1, 0, 4), "00.4.07.00.4.6.4", (0, 2, 3, 6), 3000, 3),
    "places": Bed(80, (3, 4, 3, 5, 3, 4, 1, 0), "4...7..9..6.....", (0, 5), 3600, 4),
    "trials": Bed(116, (5, 5, 3, 4, 5, 5, 1, 2), "0.70.4.20.70.9.7", (0, 3, 4, 6), 2800, 5),
    "hardest": Bed(126, (2, 2, 3, 2, 5, 3, 2, 1), "01.0.4.101.0.7.8", (0, 1, 3, 4, 6), 2600, 6),
}
"""By name: a calm D, a warm G, A that turns like a machine, a wide C, an E that drives, B with its dark second."""

LAYERS = ("base", "danger", "speed", "exit")
LOUDNESS = {"base": -22.5, "danger": -28.5, "speed": -28.0, "exit": -26.0}  # of each layer, LUFS


class Track:
    """A loop that is being written: sounds are added at a time, and go on at its beginning when they reach its end."""

    def __init__(self, bed: Bed) -> None:
        self.beat = 60 / bed.tempo
        self.wave = np.zeros(round(BARS * BEATS * self.beat * RATE))

    def add(self, sound: Wave, seconds: float, level: float) -> None:
        """Add a sound, not longer than the loop, that begins at a time."""
        start = round(seconds * RATE) % len(self.wave)
        first = sound[: len(self.wave) - start]
        self.wave[start : start + len(first)] += level * first
        self.wave[: len(sound) - len(first)] += level * sound[len(first) :]

    def eighths(self) -> list[tuple[int, int, float]]:
        """Bar, eighth within it and time in seconds of each."""
        return [(k // 8, k % 8, k * self.beat / 2) for k in range(BARS * 8)]


def pitch(degree: int, octave: int = 0) -> float:
    """The frequency of a degree of the scale, Hz."""
    return float(G * 2 ** (octave + degree // 7 + SCALE[degree % 7] / 12))


def pad(frequency: float, seconds: float, bright: float) -> Wave:
    """Strings, three a little out of tune, that come and go."""
    count = max(1, min(14, int(bright / frequency)))
    overtones = tuple(1 / k**1.4 for k in range(1, count + 1))
    voices = sum(tone(frequency * out, seconds, overtones=overtones) for out in (0.9965, 1.0, 1.0042))
    share = times(seconds) / seconds
    return np.asarray(voices * np.minimum(1, share * 4) ** 2 * np.minimum(1, (1 - share) * 3) ** 2)


def pluck(frequency: float, half_life: float, *, seconds: float = 1.2) -> Wave:
    """A string that is plucked: high partials die first."""
    partials = [
        tone(k * frequency, seconds) * fade(seconds, half_life=half_life / k**0.7) / k
        for k in range(1, 13)
        if k * frequency < 15_000
    ]
    return np.asarray(sum(partials))


def kick() -> Wave:
    return tone(glide(150, 46, 0.3), 0.3) * fade(0.3, attack=0.002, half_life=0.06)


def hat(seed: int, *, long: bool = False) -> Wave:
    seconds = 0.25 if long else 0.08
    return noise(seconds, 6500, 16_000, seed) * fade(seconds, attack=0.001, half_life=seconds / 7)


def base(bed: Bed) -> Wave:
    """Chords, a bass, a motif with much room."""
    track, melody = Track(bed), Track(bed)
    bar = BEATS * track.beat
    for number, chord in enumerate(bed.chords):
        for degree, octave in ((0, 1), (4, 1), (2, 2), (6, 2)):
            track.add(pad(pitch(chord + degree, octave), 1.25 * bar, bed.bright), number * bar, 0.09)
        for beat in (0.0, 2.5):
            track.add(pluck(pitch(chord, -1), 0.35), number * bar + beat * track.beat, 0.35)
    for number, eighth, time in track.eighths():
        note = bed.motif[number % 2 * 8 + eighth]
        if note != "." and number % 4 != 3:
            melody.add(pluck(pitch(bed.chords[number] + int(note), 2), 0.22), time, 0.2)
            melody.add(bell(pitch(bed.chords[number] + int(note), 3), 0.7, 0.12, air=0.5), time, 0.04)
    air = noise(len(track.wave) / RATE, 3000, 15_000, bed.seed) * (1 + np.sin(2 * np.pi * 4 * phase(track)))
    return np.asarray(
        track.wave + melody.wave + 0.7 * spaced(melody.wave + 0.4 * track.wave, 2.2, bed.seed) + 0.012 * air
    )


def phase(track: Track) -> Wave:
    """The share of the loop that has passed, for each sample."""
    return np.arange(len(track.wave)) / len(track.wave)


def danger(bed: Bed) -> Wave:
    """Low notes that pound, and a second that rubs."""
    track = Track(bed)
    for number, eighth, time in track.eighths():
        root = pitch(bed.chords[number], -1)
        if eighth in bed.pulse:
            track.add(pluck(root, 0.09, seconds=0.5), time, 0.5)
            track.add(kick(), time, 0.5 if eighth in (0, 4) else 0.25)
        if eighth == 0:
            rub = pad(root * 4, 1.1 * BEATS * track.beat, 900) + pad(
                root * 4 * 2 ** (1 / 12), 1.1 * BEATS * track.beat, 900
            )
            track.add(rub, time, 0.05)
    return filtered(track.wave, 35, 900) + 0.15 * spaced(track.wave, 0.9, bed.seed + 20)


def speed(bed: Bed) -> Wave:
    """A rhythm of sixteenths, and the chord broken into as many notes."""
    track, notes = Track(bed), Track(bed)
    arpeggio = (0, 4, 7, 9, 11, 9, 7, 4)
    for number, eighth, time in track.eighths():
        for half in (0, 1):
            moment = time + half * track.beat / 4
            accent = 1.0 if eighth % 2 == 0 and not half else 0.45
            track.add(hat(31 * eighth + half + bed.seed, long=eighth % 4 == 2 and not half), moment, 0.3 * accent)
            note = pitch(bed.chords[number] + arpeggio[(2 * eighth + half) % 8], 2)
            notes.add(pluck(note, 0.05, seconds=0.4), moment, 0.16 * accent)
        if eighth % 2 == 0:
            track.add(kick(), time, 0.35)
        if eighth in (2, 6):
            track.add(noise(0.2, 1200, 14_000, bed.seed + eighth) * fade(0.2, half_life=0.03), time, 0.3)
    return track.wave + notes.wave + 0.3 * spaced(notes.wave, 0.8, bed.seed + 40)


def way_out(bed: Bed) -> Wave:
    """Bells that climb the ladder of gold, and high strings."""
    track = Track(bed)
    climb = (0, 1, 2, 4, 5, 7, 8, 9)
    for number, eighth, time in track.eighths():
        if eighth in (0, 3, 6) or (number % 2 and eighth == 7):
            note = climb[(number * 3 + eighth // 3) % 8]
            track.add(bell(pitch(note, 3), 1.2, 0.25), time, 0.25)
        if eighth == 0:
            track.add(pad(pitch(bed.chords[number] + 4, 3), 1.2 * BEATS * track.beat, 6000), time, 0.03)
    return track.wave + 0.9 * spaced(track.wave, 2.0, bed.seed + 60, bright=14_000)


_MAKERS: dict[str, Callable[[Bed], Wave]] = {"base": base, "danger": danger, "speed": speed, "exit": way_out}

TRACKS = ("menu-base", *(f"{name}-{layer}" for name in BEDS if name != "menu" for layer in LAYERS))
"""The files of the music. A menu has neither danger nor an exit."""


def music(track: str) -> Wave:
    """A layer as loud as it is to be, without a steady part."""
    from pyloudnorm import Meter

    name, layer = track.split("-")
    wave = _MAKERS[layer](BEDS[name])
    wave = at_level(wave - wave.mean(), 0.5)
    return np.asarray(wave * 10 ** ((LOUDNESS[layer] - Meter(RATE).integrated_loudness(wave)) / 20))
