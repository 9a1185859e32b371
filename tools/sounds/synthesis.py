"""What sounds are made of: tones, noise, envelopes. Arrays of float64, about -1 to 1, RATE samples a second."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

RATE = 44_100
"""Samples a second."""

Wave = NDArray[np.float64]


def times(seconds: float) -> Wave:
    """The time of each sample, in seconds."""
    return np.arange(round(seconds * RATE)) / RATE


def glide(start: float, end: float, seconds: float) -> Wave:
    """A frequency in Hz that goes from one to the other by equal musical steps."""
    share = np.linspace(0.0, 1.0, round(seconds * RATE))
    return np.asarray(start * (end / start) ** share)


def tone(frequency: Wave | float, seconds: float, *, overtones: tuple[float, ...] = (1.0,), bend: float = 0.0) -> Wave:
    """A tone; ``overtones``: strengths of the harmonics; ``bend``: frequency modulation by an octave-higher tone."""
    steps = np.broadcast_to(np.asarray(frequency, np.float64), times(seconds).shape)
    phase = 2 * np.pi * np.cumsum(steps) / RATE
    phase = phase + bend * np.sin(2 * phase)
    return sum_of([strength * np.sin((k + 1) * phase) for k, strength in enumerate(overtones)])


def noise(seconds: float, low: float, high: float, seed: int) -> Wave:
    """Noise between two frequencies in Hz with soft edges. Its end fits its beginning, so that it can loop."""
    count = round(seconds * RATE)
    rng = np.random.default_rng(seed)
    frequencies = np.fft.rfftfreq(count, 1 / RATE)
    band = 1 / (1 + (low / np.maximum(frequencies, 1.0)) ** 4) / (1 + (frequencies / high) ** 4)
    spectrum = band * np.exp(2j * np.pi * rng.random(len(frequencies)))
    spectrum[0] = 0
    wave = np.fft.irfft(spectrum, count)
    return np.asarray(wave / np.abs(wave).max())


def fade(seconds: float, *, attack: float = 0.003, half_life: float = 0.1) -> Wave:
    """An envelope: a quick rise of ``attack`` s, then half as loud after each ``half_life`` s, silent at the end."""
    t = times(seconds)
    rise = np.minimum(t / attack, 1.0)
    tail = np.minimum((seconds - t) / min(0.02, seconds / 4), 1.0)
    return np.asarray(rise * 0.5 ** (np.maximum(t - attack, 0) / half_life) * tail)


def swell(seconds: float, shape: Callable[[Wave], Wave]) -> Wave:
    """An envelope by a function of the share of the time that has passed, 0 to 1, with soft ends."""
    share = times(seconds) / seconds
    ends = np.minimum(np.minimum(share, 1 - share) * seconds / 0.008, 1.0)
    return np.asarray(shape(share) * ends)


def sum_of(waves: list[Wave]) -> Wave:
    """All of them at once; shorter ones end earlier."""
    total = np.zeros(max(map(len, waves)))
    for wave in waves:
        total[: len(wave)] += wave
    return total


def later(wave: Wave, seconds: float) -> Wave:
    """The same after a pause."""
    return np.concatenate([np.zeros(round(seconds * RATE)), wave])


def echo(wave: Wave, seconds: float, strength: float, times_heard: int) -> Wave:
    """The wave with some fainter repetitions."""
    return sum_of([later(wave * strength**k, k * seconds) for k in range(times_heard + 1)])


def filtered(wave: Wave, low: float, high: float) -> Wave:
    """What of a wave lies between two frequencies in Hz, with soft edges; nothing at 0 Hz. A loop stays a loop."""
    spectrum = np.fft.rfft(wave)
    frequencies = np.fft.rfftfreq(len(wave), 1 / RATE)
    edge = np.maximum(frequencies, 1e-3)
    spectrum *= 1 / np.sqrt(1 + (low / edge) ** 4) / np.sqrt(1 + (frequencies / high) ** 4)
    return np.asarray(np.fft.irfft(spectrum, len(wave)))


def at_level(wave: Wave, peak: float) -> Wave:
    """The wave made as loud as ``peak``, 0 to 1."""
    return np.asarray(wave * (peak / np.abs(wave).max()))


def spaced(wave: Wave, seconds: float, seed: int, *, bright: float = 7000.0) -> Wave:
    """A loop in a room: echoes that die away in ``seconds``, without the sound itself; its end fits its beginning."""
    t = np.arange(len(wave)) / RATE
    rng = np.random.default_rng(seed)
    response = rng.standard_normal(len(wave)) * 0.001 ** (t / seconds) * np.minimum(t / 0.02, 1)
    room = np.fft.irfft(np.fft.rfft(wave) * np.fft.rfft(response), len(wave))
    return filtered(np.asarray(room / np.sqrt(np.sum(response**2))), 150.0, bright)
