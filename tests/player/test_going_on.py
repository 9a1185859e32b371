"""Play goes on where it was left: in the middle of an episode, with the clock and the runs that belong to it."""

from dataclasses import replace
from pathlib import Path

import pytest

from ninja_game.levels.episodes import Episode
from ninja_game.player.episode_playthrough import EpisodePlaythrough, next_run
from ninja_game.player.player_data import PlayerData
from ninja_game.player.playthrough import LevelPlaythrough, Navigation
from ninja_game.player.progress import HELPED
from ninja_game.sim.level import Level
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from tests.support.players import EXIT_TICK, entry, played, player_data, short_level

LEVELS = [short_level(gold=number) for number in (0, 1, 2)]


def episode(*levels: Level) -> Episode:
    return Episode(0, "tests", tuple(map(entry, levels)))


def placed(number: int, *levels: Level) -> Episode:
    """An episode whose levels know their places, as those of a pack do."""
    made = Episode(number, "tests", tuple(map(entry, levels)))
    return replace(made, levels=tuple(replace(each, episode=f"{number:02d}-{k}") for k, each in enumerate(made.levels)))


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
    run = EpisodePlaythrough(data, data.catalogue.episodes[0], practice_mode=True)
    run.passed(played(LEVELS[0], practice=True))
    assert place(data) == 0
    run = EpisodePlaythrough(data, data.catalogue.episodes[0])
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
    EpisodePlaythrough(data, data.catalogue.episodes[0]).passed(played(LEVELS[0]))
    data.close()
    data = player_data(tmp_path, episode(short_level(gold=3), *LEVELS[1:]))
    run = next_run(data)
    assert run is not None
    assert (run.position, run.whole, run.lifetime) == (1, False, LIFETIME)
    data.close()


def test_play_goes_on_behind_a_level_that_was_skipped(tmp_path: Path) -> None:
    data = player_data(tmp_path, placed(0, *LEVELS))
    run = EpisodePlaythrough(data, data.catalogue.episodes[0])
    run.passed(played(LEVELS[0]))
    run.advance()
    run.advance()
    assert place(data) == 2
    levels = data.catalogue.episodes[0].levels
    words = [data.reached(each, data.marks.of(each.digest)) for each in levels]
    assert words[1:] == ["Skipped, not passed yet", "Not passed yet"]
    data.close()


def test_play_goes_on_in_the_episode_played_last_also_after_a_skip_and_at_its_end(tmp_path: Path) -> None:
    others = [short_level(number, gold=1) for number in (11, 12)]
    data = player_data(tmp_path, placed(0, *LEVELS), placed(10, *others), placed(11, short_level(13)))
    run = EpisodePlaythrough(data, data.catalogue.episodes[10])
    run.advance()
    goes_on = next_run(data)
    assert goes_on is not None
    assert (goes_on.episode.number, goes_on.position) == (10, 1)
    run.passed(played(others[1]))
    goes_on = next_run(data)
    assert goes_on is not None
    assert (goes_on.episode.number, goes_on.position) == (11, 0)
    data.close()


def test_pass_with_help_opens_what_follows_and_is_called_so_everywhere(tmp_path: Path) -> None:
    data = player_data(tmp_path, placed(0, *LEVELS))
    run = EpisodePlaythrough(data, data.catalogue.episodes[0])
    helped = played(LEVELS[0])
    helped.assists.add("slow motion")
    run.passed(helped)
    first = run.episode.levels[0]
    assert place(data) == 1
    assert data.marks.of(first.digest) is None
    assert data.reached(first, None) == HELPED
    assert not LevelPlaythrough(data, first).shows_messages, "its texts are done"
    run = EpisodePlaythrough(data, data.catalogue.episodes[0])
    run.passed(played(LEVELS[0]))
    assert data.reached(first, data.marks.of(first.digest)).startswith("Time")
    data.close()


def test_level_passed_by_itself_where_the_episode_stands_moves_it_on(tmp_path: Path) -> None:
    data = player_data(tmp_path, placed(0, *LEVELS), placed(1, short_level(5)))
    first, second, third = data.catalogue.episodes[0].levels
    LevelPlaythrough(data, second).passed(played(LEVELS[1]))
    assert place(data) == 0, "the first has not been passed"
    LevelPlaythrough(data, first, practice_mode=True).passed(played(LEVELS[0], practice=True))
    assert place(data) == 0, "practice moves nothing"
    LevelPlaythrough(data, first).passed(played(LEVELS[0]))
    assert place(data) == 2
    LevelPlaythrough(data, third).passed(played(LEVELS[2]))
    goes_on = next_run(data)
    assert goes_on is not None
    assert goes_on.episode.number == 1
    data.close()
