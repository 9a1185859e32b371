"""Make every sound and all music of the game, assets/sounds, from the recipes in tools/sounds. Nothing is recorded.

    python3 tools/dev.py tool make_sounds

The same recipes always give the same sound. A file whose sound is as it was is left alone: its bytes hold chance.
"""

from io import BytesIO
from pathlib import Path

import numpy as np
import soundfile

from tools import ROOT
from tools.sounds.effects import RATE, RECIPES, Wave, at_level
from tools.sounds.music import TRACKS, music

FOLDER = ROOT / "assets" / "sounds"

SOUND_QUALITY, MUSIC_QUALITY = 0.5, 0.25  # of Vorbis, 0 to 1: about 80 and 55 kbit a second in mono


def made(name: str) -> Wave:
    """A single sound, as its recipe makes it: without a steady part, as loud as it says."""
    peak, recipe = RECIPES[name]
    wave = recipe()
    return at_level(wave - wave.mean(), peak)


def encoded(wave: Wave, quality: float) -> bytes:
    """A sound as Ogg Vorbis, mono."""
    out = BytesIO()
    with soundfile.SoundFile(out, "w", RATE, 1, format="OGG", subtype="VORBIS", compression_level=1 - quality) as file:
        file.write(wave)
    return out.getvalue()


def decoded(data: bytes) -> Wave:
    """The samples of a file, -1 to 1."""
    samples, _ = soundfile.read(BytesIO(data))
    return np.asarray(samples)


def write_sound(path: Path, wave: Wave, quality: float) -> None:
    """Write a file, unless the one that is there sounds the same."""
    data = encoded(wave, quality)
    if not path.exists() or not np.array_equal(decoded(path.read_bytes()), decoded(data)):
        path.write_bytes(data)


def main() -> None:
    (FOLDER / "music").mkdir(parents=True, exist_ok=True)
    for name in RECIPES:
        write_sound(FOLDER / f"{name}.ogg", made(name), SOUND_QUALITY)
    for track in TRACKS:
        write_sound(FOLDER / "music" / f"{track}.ogg", music(track), MUSIC_QUALITY)
    total = sum(path.stat().st_size for path in FOLDER.rglob("*.ogg"))
    print(f"{len(RECIPES)} sounds, {len(TRACKS)} layers of music, {total / 1024:.0f} KiB in {FOLDER.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
