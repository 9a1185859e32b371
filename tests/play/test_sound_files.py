"""The files of sounds are what the recipes make, and keep the limits that docs/sound.md names."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from tools.make_sounds import SOUND_QUALITY, decoded, encoded, made
from tools.sounds.effects import LOOPS, RECIPES
from tools.sounds.synthesis import RATE


@pytest.fixture
def folder(root: Path) -> Path:
    return root / "assets" / "sounds"


@pytest.mark.parametrize("name", RECIPES)
def test_file_is_what_the_script_makes(folder: Path, name: str) -> None:
    """Regenerate with `python3 tools/dev.py tool make_sounds`."""
    found, wanted = decoded((folder / f"{name}.ogg").read_bytes()), decoded(encoded(made(name), SOUND_QUALITY))
    assert len(found) == len(wanted)
    # Other builds of NumPy and Vorbis may round differently.
    assert np.abs(found - wanted).max() <= 0.02


@pytest.mark.parametrize("name", sorted(set(RECIPES) - set(LOOPS)))
def test_other_sounds_than_loops_die_away_before_they_end(folder: Path, name: str) -> None:
    heard = np.abs(decoded((folder / f"{name}.ogg").read_bytes()))
    assert heard[-RATE // 100 :].max() <= 0.3 * heard.max()


def test_no_two_sounds_are_the_same(folder: Path) -> None:
    sounds = {path.stem: decoded(path.read_bytes()) for path in folder.glob("*.ogg")}
    for one, two in combinations(sorted(sounds), 2):
        length = min(len(sounds[one]), len(sounds[two]))
        a, b = sounds[one][:length], sounds[two][:length]
        assert abs(a @ b) < 0.98 * np.sqrt((a @ a) * (b @ b)), (one, two)
