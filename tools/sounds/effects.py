"""The recipe of every single sound and loop, and what they are made of: tones, noise, envelopes.

Lengths follow the events (presentation.md §6), the sounds are our own. Waves are arrays of float64, about -1 to 1, RATE
samples a second.
"""

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

RATE = 44_100  # samples a second

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


HOLLOW = (1.0, 0.0, 0.3, 0.0, 0.12)
BRIGHT = (1.0, 0.5, 0.35, 0.2, 0.15, 0.1, 0.08, 0.07, 0.06, 0.05, 0.05, 0.04)

LADDER = (784.0, 880.0, 987.8, 1174.7, 1318.5, 1568.0, 1760.0, 1975.5, 2349.3, 2637.0, 3136.0, 3520.0)
"""Pitches of the gold in a row, Hz: the pentatonic scale of G, whose notes every music has."""


def thud(seconds: float, frequency: float, seed: int, *, grit: float = 0.5, edge: float = 0.12) -> Wave:
    """Something soft hits something hard; ``edge``: how much of it is a bright click."""
    low = tone(glide(frequency * 1.8, frequency, seconds), seconds) * fade(seconds, half_life=seconds / 6)
    slap = noise(seconds, 80, 900, seed) * fade(seconds, attack=0.001, half_life=seconds / 12)
    click = noise(seconds, 2500, 16_000, seed + 500) * fade(seconds, attack=0.0005, half_life=min(0.012, seconds / 10))
    return low + grit * slap + edge * click


def blast(seconds: float, seed: int, *, depth: float = 70) -> Wave:
    """An explosion: a crack, a dark rumble, a falling tone, debris."""
    rumble = noise(seconds, 30, 500, seed) * fade(seconds, attack=0.002, half_life=seconds / 4)
    crack = noise(seconds, 500, 14_000, seed + 1) * fade(seconds, attack=0.001, half_life=seconds / 14)
    debris = crackle(seconds, 90, seed + 2) * fade(seconds, attack=0.03, half_life=seconds / 6)
    body = tone(glide(depth * 2.5, depth / 2, seconds), seconds) * fade(seconds, half_life=seconds / 4)
    return rumble + 0.7 * crack + 0.08 * debris + 0.9 * body


def crackle(seconds: float, rate: float, seed: int) -> Wave:
    """Electric sparks: bursts of bright noise at random moments, ``rate`` a second, over a buzz."""
    rng = np.random.default_rng(seed)
    gates = rng.random(max(1, round(seconds * rate))) ** 3
    envelope = np.interp(times(seconds), np.arange(len(gates)) / rate, gates)
    buzz = tone(110.0, seconds, overtones=BRIGHT, bend=1.5)
    return (noise(seconds, 1500, 15_000, seed) + 0.35 * buzz) * envelope


def servo(seconds: float, start: float, end: float, seed: int) -> Wave:
    """A small motor moves something, and stops with a click."""
    motor = tone(glide(start, end, seconds), seconds, overtones=HOLLOW, bend=0.4)
    hiss = noise(seconds, 900, 10_000, seed) * 0.25
    running = (motor + hiss) * swell(seconds, lambda s: np.asarray(np.where(s < 0.75, 1.0, (1 - s) * 4) * 0.6))
    return sum_of([running, later(thud(0.12, 160, seed + 1, edge=0.3), seconds - 0.13)])


def hum(seconds: float, frequency: float, wobble: float, overtones: tuple[float, ...], bend: float) -> Wave:
    """A steady machine tone that loops: whole numbers of periods of tone and wobble."""
    whole = len(times(seconds)) / RATE
    cycles, slow = round(frequency * seconds) / whole, round(wobble * seconds) / whole
    steady = tone(cycles, seconds, overtones=overtones, bend=bend)
    return steady * (0.8 + 0.2 * np.sin(2 * np.pi * slow * times(seconds)))


def scrape(low: float, high: float, seed: int) -> Wave:
    """Something rubs along a surface; it loops. A coarse part, a fine one, both uneven."""
    seconds = 1.6
    t = times(seconds) * 2 * np.pi / seconds
    rng = np.random.default_rng(seed)
    uneven = 1 + sum(rng.uniform(0.05, 0.2) * np.sin(k * t + rng.uniform(0, 6)) for k in (3, 5, 7, 11, 16))
    return (noise(seconds, low, high, seed) + 0.25 * noise(seconds, 2 * high, 14_000, seed + 300)) * uneven


def released(shape: Callable[[Wave], Wave]) -> Callable[[Wave], Wave]:
    """An envelope that dies away in its last eighth."""
    return lambda share: np.asarray(shape(share) * np.minimum(1.0, 8 * (1 - share)))


def turn(start: float, end: float, seconds: float, shape: Callable[[Wave], Wave]) -> Wave:
    """A machine that turns faster or slower, between two frequencies in Hz."""
    gears = noise(seconds, 2500, 14_000, round(start)) * (0.6 + 0.4 * tone(glide(start / 4, end / 4, seconds), seconds))
    return (tone(glide(start, end, seconds), seconds, overtones=BRIGHT) + 0.12 * gears) * swell(seconds, shape)


def whistle(start: float, end: float, seconds: float, half_life: float, *, bend: float = 0.0) -> Wave:
    """A tone that glides between two frequencies in Hz and dies away."""
    overtones = BRIGHT if bend else (1.0,)
    wave = tone(glide(start, end, seconds), seconds, overtones=overtones, bend=bend)
    return wave * fade(seconds, half_life=half_life)


def bell(frequency: float, seconds: float, half_life: float, *, air: float = 1.0) -> Wave:
    """A small bell: partials that are no harmonics, the high ones die first."""
    partials = ((1.0, 1.0), (2.0, 0.35), (2.76, 0.22), (4.07, 0.14), (5.4, 0.1), (6.8, 0.06))
    return sum_of(
        [
            strength * tone(frequency * ratio, seconds) * fade(seconds, attack=0.002, half_life=half_life / ratio**0.6)
            for ratio, strength in partials
            if ratio * frequency < 17_000
        ]
        + [0.12 * air * noise(seconds, 6000, 16_000, round(frequency)) * fade(seconds, attack=0.001, half_life=0.012)]
    )


def gold(pitch: float) -> Wave:
    """Two small bells, a fifth apart."""
    return sum_of([0.7 * bell(pitch, 0.6, 0.08), later(0.8 * bell(1.5 * pitch, 0.6, 0.11, air=0.4), 0.055)])


def step(variant: int) -> Wave:
    """A foot is put down: a heel, then the sole, which rubs a little."""
    heel = thud(0.07, 150 + 14 * (variant % 3), 60 + variant, grit=0.7, edge=0.35)
    sole = noise(0.06, 1800, 13_000, 70 + variant) * fade(0.06, attack=0.006, half_life=0.009)
    return sum_of([heel, later((0.35 + 0.06 * variant) * sole, 0.012 + 0.004 * (variant % 4))])


def jump(variant: int, *, wall: bool = False) -> Wave:
    """A push off, a tone that rises, cloth in the air."""
    bottom = (200, 212, 190, 206)[variant]
    rise = tone(glide(bottom, bottom * 2.05, 0.2), 0.2, overtones=HOLLOW) * fade(0.2, half_life=0.05)
    seed = (90 if wall else 80) + variant
    cloth = noise(0.22, 1500, 12_000, seed) * swell(0.22, lambda s: np.asarray(np.sin(np.pi * s**0.6) ** 2 * (1 - s)))
    push = thud(0.1, 175 if wall else 130, seed + 20, edge=0.4 if wall else 0.15)
    return sum_of([(0.7 if wall else 1.0) * rise, (0.24 + 0.03 * variant) * cloth, (0.9 if wall else 0.35) * push])


def land(strength: int, variant: int) -> Wave:
    """Feet hit the floor. ``strength``: 0 soft, 1 medium, 2 hard."""
    seconds, pitch = (0.09, 0.14, 0.24)[strength], (150, 112, 82)[strength]
    seed = 110 + 10 * strength + variant
    feet = thud(seconds, pitch + 6 * variant, seed, grit=0.5 + 0.2 * strength, edge=0.15 + 0.1 * strength)
    other = thud(seconds * 0.8, pitch * 1.15, seed + 4, grit=0.6, edge=0.25)
    dust = noise(seconds, 2500, 14_000, seed + 7) * fade(seconds, attack=0.012, half_life=seconds / 8)
    return sum_of([feet, later(0.5 * other, 0.012 + 0.006 * variant), 0.08 * (1 + strength) * dust])


def launch_pad() -> Wave:
    """A spring: a tone that shoots up and trembles."""
    up = glide(140, 880, 0.6) * (1 + 0.05 * np.sin(2 * np.pi * 24 * times(0.6)))
    spring = tone(up, 0.6, overtones=(*HOLLOW, 0.0, 0.08, 0.0, 0.06), bend=0.5) * fade(0.6, half_life=0.12)
    return sum_of([spring, 0.4 * thud(0.15, 120, 39, edge=0.6), 0.15 * noise(0.4, 3000, 15_000, 40) * fade(0.4)])


def rocket_launch() -> Wave:
    """A rush of air that grows and goes."""
    rush = noise(0.9, 300, 3500, 31) + 0.35 * noise(0.9, 4000, 16_000, 32)
    rush *= swell(0.9, lambda s: np.asarray(np.minimum(s * 8, 1) * (1 - s) ** 1.5))
    return rush + 0.5 * tone(glide(90, 260, 0.9), 0.9, overtones=BRIGHT) * fade(0.9, half_life=0.2)


def shot(variant: int) -> Wave:
    """A turret's gun: a crack, and the bullet that leaves."""
    return blast(0.31, 35 + 100 * variant, depth=160 - 20 * variant) + whistle(2200 - 300 * variant, 200, 0.31, 0.03)


def unlock() -> Wave:
    """Two clicks and a chord."""
    clicks = sum_of([thud(0.08, 420, 41, edge=0.5), later(thud(0.08, 300, 42, edge=0.5), 0.11)])
    chord = sum_of([bell(f, 0.7, 0.14, air=0.3) for f in (392.0, 493.9, 587.3)])
    return sum_of([0.8 * clicks, later(0.35 * chord, 0.2)])


def exit_open() -> Wave:
    """A door of light: a run of bells upwards that rings on."""
    run = [later(0.8**k * bell(f, 0.7, 0.12, air=0.6), 0.06 * k) for k, f in enumerate((587.3, 784.0, 1174.7, 1568.0))]
    return sum_of([*run, 0.25 * noise(0.8, 5000, 15_000, 43) * swell(0.8, lambda s: np.asarray(s * (1 - s) ** 2))])


def medal() -> Wave:
    """A stamp: a heavy blow, metal that rings, a shimmer."""
    blow = thud(0.35, 70, 44, grit=1.2, edge=0.8)
    ring = sum_of([bell(f, 1.1, 0.22) for f in (587.3, 880.0, 1174.7)])
    shimmer = noise(1.1, 7000, 16_000, 45) * swell(1.1, lambda s: np.asarray(np.minimum(8 * s, 1) * (1 - s) ** 3))
    return sum_of([blow, later(0.3 * ring, 0.03), later(0.15 * shimmer, 0.05)])


def passed() -> Wave:
    """A chord, note after note."""
    notes = (392.0, 493.9, 587.3, 784.0, 1174.7)
    return sum_of([
        later(tone(f, 0.9, overtones=HOLLOW) * fade(0.9, half_life=0.14) + 0.4 * bell(2 * f, 0.9, 0.12), 0.09 * k)
        for k, f in enumerate(notes)
    ])  # fmt: skip


Recipes = dict[str, tuple[float, Callable[[], Wave]]]


def several(name: str, peak: float, recipes: list[Callable[[], Wave]]) -> Recipes:
    """Variants of a sound, named "name-1" and so on."""
    return {f"{name}-{k}": (peak, recipe) for k, recipe in enumerate(recipes, start=1)}


RECIPES: Recipes = {
    **several("step", 0.16, [partial(step, k) for k in range(5)]),
    **several("jump", 0.30, [partial(jump, k) for k in range(4)]),
    **several("wall-jump", 0.34, [partial(jump, k, wall=True) for k in range(4)]),
    **several("land-soft", 0.20, [partial(land, 0, k) for k in range(3)]),
    **several("land-medium", 0.36, [partial(land, 1, k) for k in range(3)]),
    **several("land-hard", 0.55, [partial(land, 2, k) for k in range(3)]),
    **several("skid", 0.30, [partial(scrape, 700 + 60 * k, 3200, 130 + k) for k in range(3)]),
    **several("slide", 0.25, [partial(scrape, 350 + 40 * k, 1500 + 150 * k, 140 + k) for k in range(3)]),
    **several("gold", 0.40, [partial(gold, pitch) for pitch in LADDER]),
    **several("death-explosive", 0.80, [lambda: blast(0.34, 4), lambda: blast(0.58, 6, depth=55)]),
    "death-fall": (0.70, lambda: sum_of([thud(0.39, 75, 8, grit=1.0, edge=0.5), later(thud(0.2, 120, 9), 0.07)])),
    "death-laser": (0.60, lambda: crackle(0.63, 60, 10) * fade(0.63, half_life=0.2)),
    "death-electric": (0.70, lambda: crackle(0.67, 40, 12) * fade(0.67, half_life=0.3)),
    **several("death-bullet", 0.70, [partial(thud, 0.35, 140, 13, grit=1.4, edge=0.9),
                                     partial(thud, 0.35, 115, 14, grit=1.6, edge=0.9)]),
    **several("corpse-hard", 0.60, [partial(thud, 0.25, pitch, 15 + k, grit=0.9, edge=0.3)
                                    for k, pitch in enumerate((85, 95, 78))]),
    **several("corpse-medium", 0.45, [partial(thud, 0.18, 110, 18), partial(thud, 0.12, 125, 19)]),
    **several("corpse-soft", 0.25, [partial(thud, 0.12, 140, 20, grit=0.3), partial(thud, 0.15, 130, 21, grit=0.3)]),
    "exit-open": (0.50, exit_open),
    "door-open": (0.30, lambda: servo(0.6, 180, 320, 22)),
    "door-close": (0.30, lambda: servo(0.7, 300, 150, 24)),
    "lock-open": (0.45, unlock),
    "trap-close": (0.55, lambda: sum_of([servo(0.4, 260, 90, 26), later(thud(0.4, 60, 27, grit=1.2, edge=0.6), 0.33)])),
    "launch": (0.50, launch_pad),
    **several("mine", 0.85, [partial(blast, 0.49, 28), partial(blast, 0.55, 128, depth=62)]),
    "rocket-launch": (0.60, rocket_launch),
    "rocket-flight": (0.56, lambda: noise(1.3, 150, 1600, 32) + 0.2 * noise(1.3, 2500, 14_000, 33)
                      + 0.3 * hum(1.3, 92, 9, BRIGHT, 0.0)),
    **several("rocket-explode", 0.85, [partial(blast, 0.55, 33, depth=80), partial(blast, 0.62, 133, depth=66)]),
    "turret-lock": (0.35, lambda: echo(bell(988.0, 0.09, 0.03), 0.11, 0.9, 3)),
    **several("turret-fire", 0.70, [partial(shot, k) for k in range(2)]),
    "laser-charge": (0.35, lambda: turn(160, 940, 0.84, released(lambda s: s**1.5))),
    "laser-beam": (0.32, lambda: hum(1.5, 146, 12, BRIGHT, 0.8) + 0.3 * noise(1.5, 2000, 15_000, 37)),
    "chaingun-charge": (0.35, lambda: turn(50, 190, 0.9, released(lambda s: 0.2 + 0.8 * s))),
    **several("chaingun-shot", 0.55, [partial(thud, 0.12, pitch, 38 + pitch, grit=2.5, edge=1.5)
                                      for pitch in (190, 182, 201)]),
    "chaingun-off": (0.30, lambda: turn(190, 45, 0.7, lambda s: (1 - s) ** 1.2)),
    "chase": (0.45, lambda: whistle(300, 1200, 0.35, 0.12, bend=0.6)),
    "guard": (0.18, lambda: hum(1.0, 240, 6, (*HOLLOW, 0.0, 0.06, 0.0, 0.04), 0.9)
              + 0.05 * noise(1.0, 3000, 14_000, 46)),
    "menu-move": (0.15, lambda: bell(740.0, 0.05, 0.012, air=0.5)),
    "menu-choose": (0.22, lambda: tone(glide(560, 840, 0.09), 0.09, overtones=HOLLOW) * fade(0.09, half_life=0.03)
                    + 0.1 * noise(0.09, 5000, 15_000, 47) * fade(0.09, half_life=0.01)),
    "passed": (0.45, passed),
    "medal": (0.60, medal),
}  # fmt: skip
"""By file name: how loud (its peak, 0 to 1), and the recipe."""

LOOPS = ("rocket-flight", "laser-beam", "guard", *(f"{name}-{k}" for name in ("skid", "slide") for k in (1, 2, 3)))
"""Those that end as they begin."""
