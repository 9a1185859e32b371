"""The set of levels as a whole: what it uses, how it compares with the reference, how little levels repeat others."""

import time
from collections import Counter
from functools import cache
from itertools import accumulate
from pathlib import Path
from statistics import median

import pytest

from ninja_game.files.bundled import data_folder
from ninja_game.formats.pack.pack import Pack
from ninja_game.runs.archive import Totals, verify_all
from ninja_game.runs.packs import lint
from ninja_game.runs.run import run_level
from ninja_game.sim.rules import TICKS_PER_SECOND
from tests.support.memories import BOTH
from tools.measure.level_statistics import (
    KNOWN,
    MAX_SHARED,
    MAX_WITH_MOTIF,
    alike,
    common_motifs,
    figures_of_set,
    missing,
    motif_text,
    variants,
)

OURS = Pack(data_folder("levels"))
LEVELS = {file: named.level for file, named in OURS.levels.items()}
LEVELS_IN_ALL = 100
FIRST = sorted(LEVELS)[:20]  # the levels that teach, in their order
LACKING = {
    "even-gold": "03-3 11-2 11-3 12-2 20-1 20-3 22-0 23-2 31-1 33-0 43-1 43-3",
    "even-mines": "03-3 11-2 12-2 20-1 20-3 22-0 31-1 33-0 33-1 41-4 43-1 43-3",
    "far-hazards": "01-1 02-0 20-1 23-0 30-1",
    "safe-gold": "01-0 01-1 01-3 03-1",
    "same-bay": "02-0 02-4 03-3 12-1 13-3 23-3 33-0 33-2 43-0 43-4",
    "unused-space": "00-3 02-1",
}
"""What some levels still lack (docs/good-levels.md), by their places: a shorter table is a better set."""
STEP = 1.0  # so much harder, as measured, may a level of these be than the hardest before it
GOLD_SECONDS = 28.0  # the median of the certificates with all gold, at most
KILLERS = (
    "mine",
    "zap drone",
    "floor guard",
    "thwump",
    "gauss turret",
    "laser drone",
    "chaingun drone",
    "homing launcher",
)
"""What kills, in the words of `teaches`."""
SECONDS = {"compiled": 25.0, "plain": 25.0}
"""How long verifying all certificates may take on one core; compiling is not counted."""


@cache
def figures_of_ours() -> dict[str, dict[str, float]]:
    """Of each level; they take seconds, which only who needs them has to wait."""
    return figures_of_set(OURS)


def test_set_is_complete_and_its_episodes_are_whole() -> None:
    assert len(LEVELS) == LEVELS_IN_ALL
    assert Counter(len(levels) for levels in OURS.episodes.values()) == {5: LEVELS_IN_ALL // 5}


def test_every_kind_with_every_variant_and_every_tile_is_used() -> None:
    assert missing(LEVELS) == ([], [])


def test_every_level_is_certified_to_the_exit_and_with_all_gold() -> None:
    assert [file for file in LEVELS for kind in ("exit", "gold") if not OURS.certificate(file, kind)] == []
    assert median(figures["gold_s"] for figures in figures_of_ours().values()) <= GOLD_SECONDS


def test_levels_have_what_good_levels_must_have_but_for_those_that_are_known() -> None:
    found: dict[str, list[str]] = {}
    for finding in lint(OURS, with_design=True):
        found.setdefault(finding.code, []).append(finding.file[:4])
    assert {code: " ".join(sorted(files)) for code, files in found.items()} == LACKING


@pytest.mark.parametrize("file", LEVELS)
def test_who_stands_still_is_alive_after_ten_seconds(file: str) -> None:
    assert run_level(LEVELS[file], bytes(10 * TICKS_PER_SECOND)).outcome == "running"


def test_nothing_kills_before_its_lesson() -> None:
    """In the two columns that teach; the first five levels have no enemy at all."""
    taught = ""
    for file, named in sorted(OURS.levels.items()):
        if file[0] in "01":
            assert named.teaches, file
            taught += named.teaches
            seen = set().union(*map(variants, named.level.objects))
            assert [kind for kind in KILLERS if kind in seen and kind not in taught] == [], file
            assert file[:2] != "00" or not seen & set(KILLERS), file


def test_first_twenty_levels_rise_by_one_step_at_most() -> None:
    """No level is more than a step above the hardest before it, and each episode is harder than the one before."""
    found = [OURS.pars[file].difficulty for file in FIRST]
    hard = [value for value in found if value is not None]
    assert len(hard) == len(FIRST)
    assert [
        file
        for file, value, before in zip(FIRST, hard, accumulate([0.0, *hard], max), strict=False)
        if value > before + STEP
    ] == []
    means = [sum(hard[first : first + 5]) / 5 for first in range(0, len(hard), 5)]
    assert means == sorted(means)


@pytest.mark.parametrize("key", KNOWN)
def test_median_is_within_the_quartiles_of_the_reference(key: str) -> None:
    row = KNOWN[key]
    values = [figures[key] for figures in figures_of_ours().values() if key in figures]
    assert row.first <= median(values) <= row.third


def test_no_two_levels_share_too_many_of_their_solid_cells() -> None:
    assert alike(LEVELS, MAX_SHARED) == []


def test_no_motif_is_in_more_than_a_fifth_of_the_levels() -> None:
    found = common_motifs(LEVELS, MAX_WITH_MOTIF * len(LEVELS))
    assert [(motif_text(motif), files) for motif, files in found] == []


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
    assert [median(column) for column in columns] == sorted(map(median, columns))


def test_difficulty_rises_inside_the_episodes_that_do_not_teach() -> None:
    """From column 2 on: the last two levels of an episode are harder than its first two."""
    hard = {file[:4]: pars.difficulty or 0.0 for file, pars in OURS.pars.items()}
    for episode in {name[:2] for name in hard if name[0] in "234"}:
        first, last = (sum(hard[f"{episode}-{level}"] for level in pair) for pair in ((0, 1), (3, 4)))
        assert first < last, episode
