"""The set of levels as a whole: what it uses, how it compares with the reference, how little levels repeat others."""

from __future__ import annotations

import time
from collections import Counter
from pathlib import Path
from statistics import median

import pytest

from ninja_game.files.user_folder import data_folder
from ninja_game.formats.pack.pack import Pack
from ninja_game.runs.archive import Totals, verify_all
from tests.support.memories import BOTH
from tools.measure.level_figures import KNOWN, alike, common_motifs
from tools.measure.level_statistics import MOST_SHARED, MOST_WITH_MOTIF, figures_of_set, missing, motif_text

OURS = Pack(data_folder("levels"))
LEVELS = {file: named.level for file, named in OURS.levels.items()}
FIGURES = figures_of_set(OURS)
COMPLETE = all(OURS.certificate(file, "exit") for file in LEVELS)
"""What is asked of the whole set is asked once every level is certified."""
LEVELS_IN_ALL, RICH = 100, 80
"""Levels of the set, and how many of them at least have a certificate with all gold."""
SECONDS = {"compiled": 25.0, "plain": 25.0}
"""How long verifying all certificates may take on one core; compiling is not counted."""


def test_set_is_complete_and_its_episodes_are_whole() -> None:
    assert len(LEVELS) == LEVELS_IN_ALL
    assert Counter(len(levels) for levels in OURS.episodes.values()) == {5: LEVELS_IN_ALL // 5}


def test_every_kind_with_every_variant_and_every_tile_is_used() -> None:
    assert not COMPLETE or missing(LEVELS) == ([], [])


def test_every_level_is_certified_and_most_with_all_gold() -> None:
    assert not COMPLETE or sum(OURS.certificate(file, "gold") is not None for file in LEVELS) >= RICH


@pytest.mark.parametrize("key", KNOWN)
def test_median_is_within_the_quartiles_of_the_reference(key: str) -> None:
    row = KNOWN[key]
    values = [figures[key] for figures in FIGURES.values() if key in figures]
    assert not COMPLETE or row.first <= median(values) <= row.third


def test_no_two_levels_share_more_than_half_their_solid_cells() -> None:
    assert not COMPLETE or alike(LEVELS, MOST_SHARED) == []


def test_no_motif_is_in_more_than_a_tenth_of_the_levels() -> None:
    found = common_motifs(LEVELS, MOST_WITH_MOTIF * len(LEVELS))
    assert not COMPLETE or [(motif_text(motif), files) for motif, files in found] == []


@pytest.mark.parametrize("memory", BOTH)
def test_certificates_are_verified_quickly(memory: str) -> None:
    folder = Path(OURS.files.place("certificates"))
    list(verify_all([next(folder.glob("*.replay.txt"))], memory=memory, jobs=1, processes=False))
    start = time.process_time()
    totals = Totals()
    for result in verify_all([folder], memory=memory, jobs=1, processes=False):
        totals.add(result)
    spent = time.process_time() - start
    assert (totals.failed, totals.unreadable, totals.outcomes["exit"]) == (0, 0, totals.recordings)
    assert spent < SECONDS[memory], f"{totals.recordings} certificates took {spent:.1f} s"


def test_difficulty_rises_over_the_columns() -> None:
    hard = {file: pars.difficulty for file, pars in OURS.pars.items() if pars.difficulty is not None}
    columns = [[value for file, value in hard.items() if file[0] == str(column)] for column in range(5)]
    assert not COMPLETE or [median(column) for column in columns] == sorted(map(median, columns))


def test_difficulty_rises_inside_the_episodes_that_do_not_teach() -> None:
    """From column 2 on: the last two levels of an episode are harder than its first two."""
    hard = {file[:4]: pars.difficulty or 0.0 for file, pars in OURS.pars.items()}
    for episode in {name[:2] for name in hard if name[0] in "234"}:
        first, last = (sum(hard[f"{episode}-{level}"] for level in pair) for pair in ((0, 1), (3, 4)))
        assert first < last, episode
