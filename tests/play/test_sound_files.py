"""The files of sounds are what the recipes make, and keep the limits that docs/sound.md names."""

from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest

from ninja_game.ui.audio.music import LAYERS_OF
from tools.make_sounds import MUSIC_QUALITY, SOUND_QUALITY, decoded, encoded, made
from tools.measure.sound_levels import HEADING, PAGE, WARNINGS, headroom, likeness, measured, samples
from tools.sounds.effects import LOOPS, RATE, RECIPES
from tools.sounds.music import LOUDNESS, TRACKS, music


@pytest.mark.parametrize("name", RECIPES)
def test_file_is_what_the_script_makes(name: str) -> None:
    """Regenerate with `python3 tools/dev.py tool make_sounds`."""
    found, wanted = samples(name), decoded(encoded(made(name), SOUND_QUALITY))
    assert len(found) == len(wanted)
    # Other builds of NumPy and Vorbis may round differently.
    assert np.abs(found - wanted).max() <= 0.02


@pytest.mark.slow
@pytest.mark.parametrize("track", TRACKS)
def test_music_is_what_the_script_makes(track: str) -> None:
    """Regenerate with `python3 tools/dev.py tool make_sounds`."""
    wanted = decoded(encoded(music(track), MUSIC_QUALITY))
    assert len(samples(track)) == len(wanted)
    assert np.abs(samples(track) - wanted).max() <= 0.02


@pytest.mark.parametrize("name", sorted(set(RECIPES) - set(LOOPS)))
def test_other_sounds_than_loops_die_away_before_they_end(name: str) -> None:
    heard = np.abs(samples(name))
    assert heard[-RATE // 100 :].max() <= 0.3 * heard.max()


@pytest.mark.slow
@pytest.mark.parametrize("name", [*RECIPES, *TRACKS])
def test_a_file_keeps_the_limits(name: str) -> None:
    found = measured(name)
    assert found.peak < -1
    assert found.steady < 0.001
    assert found.seam <= 1
    assert -45 < found.loudness < -14


@pytest.mark.slow
def test_every_family_of_sounds_has_bright_ones() -> None:
    """Up to 16 kHz where it fits: dull thuds, and bells of a low pitch, end before."""
    dull = {name for name in RECIPES if measured(name).edge < 16_000}
    families = {name.rstrip("-0123456789") for name in RECIPES}
    assert {name.rstrip("-0123456789") for name in set(RECIPES) - dull} >= families - {"guard", "passed", "exit-open"}
    assert min(measured(name).edge for name in RECIPES if name.startswith(("step", "jump", "land", "wall"))) > 16_000


@pytest.mark.slow
def test_no_two_sounds_are_the_same() -> None:
    for one, two in combinations(sorted(RECIPES), 2):
        assert likeness(one, two) < 0.95, (one, two)


def test_hits_are_louder_the_harder_they_are() -> None:
    hard, medium, soft = (measured(f"land-{name}-1").loudness for name in ("hard", "medium", "soft"))
    assert hard > medium + 3 > soft + 6


def test_gold_climbs() -> None:
    def pitch(name: str) -> int:
        return int(np.abs(np.fft.rfft(samples(name), RATE)).argmax())

    rungs = [pitch(f"gold-{number}") for number in range(1, 13)]
    assert all(1.09 < two / one < 1.21 for one, two in pairwise(rungs))


@pytest.mark.parametrize("name", LAYERS_OF)
def test_layers_of_a_music_are_as_long_and_as_loud_as_they_are_to_be(name: str) -> None:
    found = [samples(f"{name}-{layer}") for layer in LAYERS_OF[name]]
    assert len({len(wave) for wave in found}) == 1
    assert 15 <= len(found[0]) / RATE <= 25
    assert np.abs(sum(found)).max() < 1
    for layer in LAYERS_OF[name]:
        assert abs(measured(f"{name}-{layer}").loudness - LOUDNESS[layer]) < 0.5


@pytest.mark.parametrize("warning", WARNINGS)
@pytest.mark.parametrize("name", LAYERS_OF)
def test_no_music_hides_a_warning(warning: str, name: str) -> None:
    assert headroom(warning, name) >= 6


def test_all_files_together_are_small(root: Path) -> None:
    assert sum(path.stat().st_size for path in (root / "assets" / "sounds").rglob("*.ogg")) <= 4_000_000


@pytest.mark.slow
def test_the_page_has_what_is_measured() -> None:
    """Regenerate with `python3 tools/dev.py tool measure.sound_levels --write`."""
    table = PAGE.read_text("utf-8").split(HEADING)[1]
    lines = [line for line in table.split("How far")[0].splitlines() if line.startswith("| ")]
    rows = {line.split("|")[1].strip(): line for line in lines}
    for name in (*RECIPES, *TRACKS):
        assert float(rows[name].split("|")[2]) == pytest.approx(measured(name).loudness, abs=0.2)
