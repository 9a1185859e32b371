"""Make every sound of the game, assets/sounds/*.wav, from the recipes below. Nothing is recorded.

    python3 tools/dev.py tool make_sounds

A recipe is a few tones and noises with envelopes; the same script always makes the same files. Loops (LOOPS) end as
they begin. Lengths follow the events (presentation.md §6), the sounds are our own.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from wave import open as wave_file

import numpy as np
from numpy.typing import NDArray

from tools import ROOT

FOLDER = ROOT / "assets" / "sounds"

# --- what sounds are made of: tones, noise, envelopes; arrays of float64, about -1 to 1 ---

RATE = 22_050
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


def at_level(wave: Wave, peak: float) -> Wave:
    """The wave made as loud as ``peak``, 0 to 1."""
    return np.asarray(wave * (peak / np.abs(wave).max()))


# --- what is heard ---

HOLLOW = (1.0, 0.0, 0.3, 0.0, 0.12)
BRIGHT = (1.0, 0.5, 0.35, 0.2, 0.15, 0.1)


def thud(seconds: float, frequency: float, seed: int, *, grit: float = 0.5) -> Wave:
    """Something soft hits something hard."""
    low = tone(glide(frequency * 1.8, frequency, seconds), seconds) * fade(seconds, half_life=seconds / 6)
    slap = noise(seconds, 80, 900, seed) * fade(seconds, attack=0.001, half_life=seconds / 12)
    return low + grit * slap


def blast(seconds: float, seed: int, *, depth: float = 70) -> Wave:
    """An explosion: a crack, a dark rumble, a falling tone."""
    rumble = noise(seconds, 30, 500, seed) * fade(seconds, attack=0.002, half_life=seconds / 4)
    crack = noise(seconds, 500, 6000, seed + 1) * fade(seconds, attack=0.001, half_life=seconds / 14)
    body = tone(glide(depth * 2.5, depth / 2, seconds), seconds) * fade(seconds, half_life=seconds / 4)
    return rumble + 0.6 * crack + 0.9 * body


def crackle(seconds: float, rate: float, seed: int) -> Wave:
    """Electric sparks: bursts of bright noise at random moments, ``rate`` a second, over a buzz."""
    rng = np.random.default_rng(seed)
    gates = rng.random(max(1, round(seconds * rate))) ** 3
    envelope = np.repeat(gates, int(np.ceil(seconds * RATE / len(gates))))[: round(seconds * RATE)]
    buzz = tone(110.0, seconds, overtones=BRIGHT, bend=1.5)
    return (noise(seconds, 1500, 8000, seed) + 0.35 * buzz) * envelope


def servo(seconds: float, start: float, end: float, seed: int) -> Wave:
    """A small motor moves something, and stops with a click."""
    motor = tone(glide(start, end, seconds), seconds, overtones=HOLLOW, bend=0.4)
    hiss = noise(seconds, 900, 4000, seed) * 0.25
    running = (motor + hiss) * swell(seconds, lambda s: np.asarray(np.where(s < 0.75, 1.0, (1 - s) * 4) * 0.6))
    return sum_of([running, later(thud(0.12, 160, seed + 1), seconds - 0.13)])


def hum(seconds: float, frequency: float, wobble: float, overtones: tuple[float, ...], bend: float) -> Wave:
    """A steady machine tone that loops: whole numbers of periods of tone and wobble."""
    whole = len(times(seconds)) / RATE
    cycles, slow = round(frequency * seconds) / whole, round(wobble * seconds) / whole
    steady = tone(cycles, seconds, overtones=overtones, bend=bend)
    return steady * (0.8 + 0.2 * np.sin(2 * np.pi * slow * times(seconds)))


def released(shape: Callable[[Wave], Wave]) -> Callable[[Wave], Wave]:
    """An envelope that dies away in its last eighth."""
    return lambda share: np.asarray(shape(share) * np.minimum(1.0, 8 * (1 - share)))


def turn(start: float, end: float, seconds: float, shape: Callable[[Wave], Wave]) -> Wave:
    """A machine that turns faster or slower, between two frequencies in Hz."""
    return tone(glide(start, end, seconds), seconds, overtones=BRIGHT) * swell(seconds, shape)


def whistle(start: float, end: float, seconds: float, half_life: float, *, bend: float = 0.0) -> Wave:
    """A tone that glides between two frequencies in Hz and dies away."""
    overtones = BRIGHT if bend else (1.0,)
    return tone(glide(start, end, seconds), seconds, overtones=overtones, bend=bend) * fade(
        seconds, half_life=half_life
    )


def gold() -> Wave:
    """Two small bells, a fifth apart."""
    bell = tone(1318.5, 0.6, overtones=(1.0, 0.0, 0.35, 0.0, 0.1)) * fade(0.6, half_life=0.07)
    second = tone(1975.5, 0.6, overtones=(1.0, 0.0, 0.3)) * fade(0.6, half_life=0.09)
    return sum_of([0.7 * bell, later(second, 0.06)])


def launch_pad() -> Wave:
    """A spring: a tone that shoots up and trembles."""
    up = glide(140, 880, 0.6) * (1 + 0.05 * np.sin(2 * np.pi * 24 * times(0.6)))
    return tone(up, 0.6, overtones=HOLLOW, bend=0.3) * fade(0.6, half_life=0.12)


def rocket_launch() -> Wave:
    """A rush of air that grows and goes."""
    rush = noise(0.9, 300, 3500, 31) * swell(0.9, lambda s: np.asarray(np.minimum(s * 8, 1) * (1 - s) ** 1.5))
    return rush + 0.5 * tone(glide(90, 260, 0.9), 0.9, overtones=BRIGHT) * fade(0.9, half_life=0.2)


def unlock() -> Wave:
    """Two clicks and a chord."""
    clicks = sum_of([thud(0.08, 420, 41), later(thud(0.08, 300, 42), 0.11)])
    chord = sum_of([tone(f, 0.7, overtones=HOLLOW) * fade(0.7, half_life=0.14) for f in (392.0, 523.25, 659.25)])
    return sum_of([0.8 * clicks, later(0.35 * chord, 0.2)])


RECIPES: dict[str, tuple[float, Callable[[], Wave]]] = {
    "jump": (0.30, lambda: tone(glide(210, 430, 0.18), 0.18, overtones=HOLLOW) * fade(0.18, half_life=0.05)),
    "land": (0.35, lambda: thud(0.09, 110, 1)),
    "skid": (0.30, lambda: noise(1.3, 700, 3200, 2)),
    "slide": (0.25, lambda: noise(1.3, 350, 1500, 3)),
    "death-explosive-1": (0.80, lambda: blast(0.34, 4)),
    "death-explosive-2": (0.80, lambda: blast(0.58, 6, depth=55)),
    "death-fall": (0.70, lambda: sum_of([thud(0.39, 75, 8, grit=1.0), later(thud(0.2, 120, 9), 0.07)])),
    "death-laser": (0.60, lambda: crackle(0.63, 60, 10) * fade(0.63, half_life=0.2)),
    "death-electric": (0.70, lambda: crackle(0.67, 40, 12) * fade(0.67, half_life=0.3)),
    "death-bullet-1": (0.70, lambda: thud(0.35, 140, 13, grit=1.4)),
    "death-bullet-2": (0.70, lambda: thud(0.35, 115, 14, grit=1.6)),
    "corpse-hard-1": (0.60, lambda: thud(0.25, 85, 15, grit=0.9)),
    "corpse-hard-2": (0.60, lambda: thud(0.25, 95, 16, grit=0.9)),
    "corpse-hard-3": (0.60, lambda: thud(0.25, 78, 17, grit=1.0)),
    "corpse-medium-1": (0.45, lambda: thud(0.18, 110, 18)),
    "corpse-medium-2": (0.45, lambda: thud(0.12, 125, 19)),
    "corpse-soft-1": (0.25, lambda: thud(0.12, 140, 20, grit=0.3)),
    "corpse-soft-2": (0.25, lambda: thud(0.15, 130, 21, grit=0.3)),
    "gold": (0.40, gold),
    "exit-open": (0.50, lambda: echo(tone(glide(523, 1046, 0.12), 0.12) * fade(0.12, half_life=0.06), 0.07, 0.5, 3)),
    "door-open": (0.30, lambda: servo(0.6, 180, 320, 22)),
    "door-close": (0.30, lambda: servo(0.7, 300, 150, 24)),
    "lock-open": (0.45, unlock),
    "trap-close": (0.55, lambda: sum_of([servo(0.4, 260, 90, 26), later(thud(0.4, 60, 27, grit=1.2), 0.33)])),
    "launch": (0.50, launch_pad),
    "mine": (0.90, lambda: blast(0.49, 28)),
    "rocket-launch": (0.50, rocket_launch),
    "rocket-flight": (0.30, lambda: noise(1.3, 120, 900, 32) + 0.3 * hum(1.3, 92, 9, BRIGHT, 0.0)),
    "rocket-explode": (0.85, lambda: blast(0.55, 33, depth=80)),
    "turret-lock": (0.35, lambda: echo(tone(988.0, 0.06) * fade(0.06, half_life=0.03), 0.11, 0.9, 3)),
    "turret-fire": (0.70, lambda: blast(0.31, 35, depth=160) + whistle(2200, 200, 0.31, 0.03)),
    "laser-charge": (0.35, lambda: turn(160, 940, 0.84, released(lambda s: s**1.5))),
    "laser-beam": (0.40, lambda: hum(1.5, 146, 12, BRIGHT, 0.8) + 0.25 * noise(1.5, 2000, 7000, 37)),
    "chaingun-charge": (0.35, lambda: turn(50, 190, 0.9, released(lambda s: 0.2 + 0.8 * s))),
    "chaingun-shot": (0.55, lambda: thud(0.12, 190, 38, grit=2.5)),
    "chaingun-off": (0.30, lambda: turn(190, 45, 0.7, lambda s: (1 - s) ** 1.2)),
    "chase": (0.45, lambda: whistle(300, 1200, 0.35, 0.12, bend=0.6)),
    "guard": (0.25, lambda: hum(0.33, 240, 6, HOLLOW, 0.9)),
    "menu-move": (0.15, lambda: tone(740.0, 0.04) * fade(0.04, half_life=0.012)),
    "menu-choose": (0.22, lambda: tone(glide(560, 840, 0.08), 0.08) * fade(0.08, half_life=0.03)),
    "passed": (0.45, lambda: sum_of([later(tone(f, 0.5, overtones=HOLLOW) * fade(0.5, half_life=0.12), 0.09 * k)
                                     for k, f in enumerate((523.25, 659.25, 783.99, 1046.5))])),
}  # fmt: skip
"""By file name: how loud (0 to 1), and the recipe."""

LOOPS = ("skid", "slide", "rocket-flight", "laser-beam", "guard")


def samples(name: str) -> bytes:
    """A sound as 16-bit samples, little-endian, one channel."""
    peak, recipe = RECIPES[name]
    return np.asarray(np.round(at_level(recipe(), peak) * 32767), "<i2").tobytes()


def write_sound(name: str, folder: Path) -> None:
    """One sound as a WAV file."""
    with wave_file(str(folder / f"{name}.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes(samples(name))


def main() -> None:
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in RECIPES:
        write_sound(name, FOLDER)
    total = sum(path.stat().st_size for path in FOLDER.glob("*.wav"))
    print(f"{len(RECIPES)} sounds, {total / 1024:.0f} KiB in {FOLDER.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
