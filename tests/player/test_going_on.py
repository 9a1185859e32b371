"""Play goes on where it was left: in the middle of an episode, with the clock and the runs that belong to it."""

from __future__ import annotations

from pathlib import Path

import pytest

from ninja_game.player.catalogue import Episode
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import EpisodeRun, Navigation, next_run
from ninja_game.sim.level import Level
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from tests.support.players import EXIT_TICK, entry, played, player_data, short_level

LEVELS = [short_level(gold=number) for number in (0, 1, 2)]


def episode(*levels: Level) -> Episode:
    return Episode(0, "tests", tuple(map(entry, levels)))


def place(data: PlayerData, *, practice: bool = False) -> int:
    """The level of its episode with which play goes on."""
    run = next_run(data, practice_mode=practice)
    assert run is not None
    return run.position


def test_episode_is_continued_with_its_clock_and_its_runs(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode(*LEVELS))
    run = next_run(data)
    assert run is not None
    assert run.position == 0
    run.passed(played(LEVELS[0]))
    assert run.advance() is Navigation.NEXT_LEVEL
    run.passed(played(LEVELS[1], lifetime=run.lifetime))
    run.advance()
    lifetime = run.lifetime
    assert lifetime == LIFETIME + GOLD_BONUS - 2 * EXIT_TICK
    data.close()

    data = player_data(tmp_path, episode(*LEVELS))
    run = next_run(data)
    assert run is not None
    assert (run.position, run.lifetime, run.entry) == (2, lifetime, data.catalogue.episodes[0].levels[2])
    run.passed(played(LEVELS[2], lifetime=run.lifetime))
    best = data.records.episode_best(run.episode.key)
    assert best is not None
    assert best.score == LIFETIME + 3 * GOLD_BONUS - 3 * EXIT_TICK
    assert len(best.replays) == 3, "the runs of the first levels were kept"
    assert place(data) == 0, "an episode that is over is not continued"
    data.close()


def test_practice_neither_keeps_a_place_nor_goes_on_from_one(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode(*LEVELS))
    run = EpisodeRun(data, data.catalogue.episodes[0], practice_mode=True)
    run.passed(played(LEVELS[0], practice=True))
    assert place(data) == 0
    run = EpisodeRun(data, data.catalogue.episodes[0])
    run.passed(played(LEVELS[0]))
    assert place(data) == 1
    assert place(data, practice=True) == 0
    data.close()


@pytest.mark.parametrize("value", ["", "[]", "{}", '["nobody", "x"]', "[1, 2]", "5", "[" * 100_000])
def test_damaged_place_is_forgotten(tmp_path: Path, value: str) -> None:
    data = player_data(tmp_path, episode(*LEVELS))
    data.store.connection.execute("INSERT INTO fact VALUES ('episode left half-way', ?)", (value,))
    assert place(data) == 0
    data.close()


def test_clock_is_not_continued_behind_changed_levels(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode(*LEVELS))
    EpisodeRun(data, data.catalogue.episodes[0]).passed(played(LEVELS[0]))
    data.close()
    data = player_data(tmp_path, episode(short_level(gold=3), *LEVELS[1:]))
    run = next_run(data)
    assert run is not None
    assert (run.position, run.whole, run.lifetime) == (1, False, LIFETIME)
    data.close()
