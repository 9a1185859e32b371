"""Measure every sound and all music: loudness, peaks, steady parts, seams, spectrum, and whether music hides a warning.

    python3 tools/dev.py tool measure.sound_levels --write

``--write`` puts the tables into docs/sound.md. What the limits are, tests/play/test_sound_files.py knows.
"""

import sys
import warnings
from collections.abc import Iterator
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from ninja_game.player.settings import Settings
from ninja_game.ui.audio.music import LAYERS_OF
from ninja_game.ui.audio.player import LOUDEST
from tools import ROOT
from tools.make_sounds import FOLDER, decoded
from tools.sounds.effects import LOOPS, RATE, RECIPES, Wave
from tools.sounds.music import TRACKS

PAGE = ROOT / "docs" / "sound.md"
HEADING = "## Measured\n"

WARNINGS = ("rocket-launch", "rocket-flight", "laser-charge", "chase", "turret-lock")  # sounds that say: get away


class Measured(NamedTuple):
    """What is measured of a file. ``seam``: the step from a loop's end to its beginning, a share of its largest one.

    ``loudness``: LUFS, of at least 0.4 s; ``peak``: dBTP; ``steady``: mean; ``high``: dB of what is above 8 kHz,
    of the whole; ``edge``: Hz up to which the spectrum is within 60 dB of its highest point.
    """

    loudness: float
    peak: float
    steady: float
    seam: float
    high: float
    edge: float


def level(power: float) -> float:
    """A power in dB."""
    return float(10 * np.log10(max(power, 1e-20)))


@cache
def samples(name: str) -> Wave:
    """The samples of a sound, or of a layer of music."""
    folder = FOLDER / "music" if name in TRACKS else FOLDER
    return decoded((folder / f"{name}.ogg").read_bytes())


def measured(name: str) -> Measured:
    """What is measured of a file."""
    from pyloudnorm import Meter
    from scipy.signal import resample_poly, welch

    wave = samples(name)
    long = np.pad(wave, (0, max(0, round(0.45 * RATE) - len(wave))))
    frequencies, density = welch(wave, RATE, nperseg=min(4096, len(wave)))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a silent block is no news
        loudness = Meter(RATE).integrated_loudness(long)
    return Measured(
        loudness,
        level(np.abs(resample_poly(wave, 4, 1)).max() ** 2),
        abs(float(wave.mean())),
        abs(float(wave[0] - wave[-1])) / float(np.abs(np.diff(wave)).max()) if name in (*LOOPS, *TRACKS) else 0.0,
        level(density[frequencies > 8000].sum() / density.sum()),
        float(frequencies[density > density.max() / 1e6].max()),
    )


def likeness(one: str, two: str) -> float:
    """How alike two sounds are, from 0 to 1: the same."""
    length = min(len(samples(one)), len(samples(two)))
    a, b = samples(one)[:length], samples(two)[:length]
    return float(abs(a @ b) / np.sqrt((a @ a) * (b @ b)))


def headroom(warning: str, music: str) -> float:
    """How far a warning stands above a music with all its layers, dB, at the volumes that are set at first.

    Compared is the power in the bands, third octaves, that hold 90 % of the warning's: its loudest tenth of a second,
    and what the music has in a tenth of a second at most, but for one in twenty.
    """
    first = Settings()
    both = sum(samples(f"{music}-{layer}") for layer in LAYERS_OF[music])
    heard = np.asarray(both) * (first.music_volume / LOUDEST)
    own, other = _bands(samples(warning)), _bands(heard)
    loudest = own[:, own.sum(axis=0).argmax()]
    order = np.argsort(loudest)[::-1]
    held = order[: 1 + int(np.searchsorted(np.cumsum(loudest[order]), 0.9 * loudest.sum()))]
    return level(loudest[held].sum()) - level(float(np.percentile(other[held].sum(axis=0), 95)))


def _bands(wave: Wave) -> Wave:
    """Power by third octave and tenth of a second."""
    from scipy.signal import stft

    count = RATE // 10
    frequencies, _, spectrum = stft(np.pad(wave, count), RATE, nperseg=count, noverlap=count // 2, padded=False)
    edges = 50 * 2 ** (np.arange(28) / 3)
    place = np.digitize(frequencies, edges)
    power = np.abs(spectrum) ** 2
    return np.array([power[place == number].sum(axis=0) for number in range(len(edges) + 1)])


def tables() -> Iterator[str]:
    """The tables of docs/sound.md, line by line."""
    yield "| file | LUFS | peak, dBTP | steady part | seam | above 8 kHz, dB | up to, kHz |"
    yield "|---|---|---|---|---|---|---|"
    for name in (*RECIPES, *TRACKS):
        found = measured(name)
        seam = f"{found.seam:.2f}" if name in (*LOOPS, *TRACKS) else ""
        yield (
            f"| {name} | {found.loudness:.1f} | {found.peak:.1f} | {found.steady:.5f} | {seam} | {found.high:.0f} "
            f"| {found.edge / 1000:.1f} |"
        )
    yield ""
    yield "How far each warning stands above each music with all its layers, dB, at the volumes set at first:"
    yield ""
    yield f"| warning | {' | '.join(LAYERS_OF)} |"
    yield "|---|" + "---|" * len(LAYERS_OF)
    for warning in WARNINGS:
        yield f"| {warning} | {' | '.join(f'{headroom(warning, music):.0f}' for music in LAYERS_OF)} |"
    yield ""
    alike = max((likeness(one, two), one, two) for one, two in combinations(sorted(RECIPES), 2))
    size = sum(path.stat().st_size for path in FOLDER.rglob("*.ogg"))
    yield f"The two sounds most alike are {alike[1]} and {alike[2]}: {alike[0]:.2f}, where 1 is the same."
    yield f"All files together: {size / 1e6:.2f} MB."


def main() -> None:
    text = "\n".join(tables()) + "\n"
    print(text)
    if "--write" in sys.argv[1:]:
        before = PAGE.read_text("utf-8").split(HEADING)[0]
        PAGE.write_text(f"{before}{HEADING}\n{text}", "utf-8")


if __name__ == "__main__":
    main()
