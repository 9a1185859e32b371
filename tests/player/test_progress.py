"""Episodes, progress, bests and unlocks grow as game.md §2.1 and §8 say."""

from pathlib import Path
from unittest.mock import patch

import pytest

from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.player_data import EPISODE_BEST, NEW_BEST
from ninja_game.player.playthrough import LevelPlaythrough, Navigation
from ninja_game.player.progress import CHEATED, LOCKED, UNLOCKED, PackProgress, complete_columns, new_unlocks
from ninja_game.player.store import Store
from ninja_game.runs.deaths import SELF
from ninja_game.sim.rules import LIFETIME
from tests.support.players import EXIT_TICK, deadly_level, entry, episode, played, player_data, short_level


@pytest.fixture
def progress() -> PackProgress:
    return PackProgress(Store(None))


def pass_levels(progress: PackProgress, number: int, levels: int = 5, *, legitimate: bool = True) -> None:
    for level in range(levels):
        progress.level_passed((number, level), legitimate=legitimate)


def test_first_episode_of_each_column_is_unlocked_at_the_start(progress: PackProgress) -> None:
    unlocked = [number for number in range(100) if progress.state(number) == UNLOCKED]
    assert unlocked == list(range(0, 100, 10))


def test_passing_an_episode_unlocks_the_next_of_its_column(progress: PackProgress) -> None:
    pass_levels(progress, 20, 4)
    assert progress.state(21) == LOCKED
    pass_levels(progress, 20)
    assert progress.state(21) == UNLOCKED
    assert progress.is_beaten(20)
    assert progress.columns[2].beaten == (21, 0)


def test_padlock_says_what_opens_an_episode(tmp_path: Path) -> None:
    data = player_data(tmp_path, *(episode(number) for number in range(3)))
    data.progress.level_passed((0, 0), legitimate=True)
    locks = [data.lock_of_episode(data.catalogue.episodes[number]) for number in range(3)]
    assert locks == ["", "Finish 4 more levels of episode 1.1 first", "Finish episode 1.2 first"]
    data.close()


def test_illegitimate_passing_only_moves_reached(progress: PackProgress) -> None:
    pass_levels(progress, 0, legitimate=False)
    assert progress.state(1) == CHEATED
    assert not progress.is_beaten(0)


def test_tenth_episode_counts_from_its_last_level_on(progress: PackProgress) -> None:
    for number in range(9):
        pass_levels(progress, number)
    pass_levels(progress, 9, 3)
    assert complete_columns(progress, range(10)) == 0
    progress.level_passed((9, 3), legitimate=True)
    assert progress.columns[0].beaten == (9, 4)
    assert complete_columns(progress, range(10)) == 1
    progress.level_passed((9, 4), legitimate=True)
    assert progress.columns[0].beaten == (9, 4)


def test_progress_is_read_back(tmp_path: Path) -> None:
    store = Store(tmp_path / "r.sqlite")
    pass_levels(PackProgress(store), 0)
    store.close()
    assert PackProgress(Store(tmp_path / "r.sqlite")).state(1) == UNLOCKED


def test_replaying_an_old_episode_changes_no_progress(progress: PackProgress) -> None:
    pass_levels(progress, 0)
    progress.level_passed((1, 0), legitimate=True)
    before = list(progress.columns)
    pass_levels(progress, 0)
    assert progress.columns == before


def test_unlocks_are_announced_once() -> None:
    store = Store(None)
    assert new_unlocks(store, 0, 10) == []
    assert new_unlocks(store, 1, 10) == ["A new ninja colour is yours: see Settings"]
    assert new_unlocks(store, 1, 10) == []
    # Fewer columns, because episodes were added: what was announced stays announced.
    assert new_unlocks(store, 0, 10) == []
    assert new_unlocks(store, 1, 10) == []
    assert "Overclock unlocked: see Settings" in new_unlocks(store, 6, 10)
    assert "All ninja colours are yours: see Settings" in new_unlocks(store, 10, 10)
    assert "All ninja colours are yours: see Settings" in new_unlocks(Store(None), 1, 1), "the only column"


def test_episode_carries_its_lifetime_and_saves_its_best(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode())
    run = EpisodePlaythrough(data, episode())
    for level in range(5):
        assert run.position == level
        attempt = played(run.entry.named.level, lifetime=run.lifetime)
        notices = run.passed(attempt)
        assert run.advance() is (Navigation.NEXT_LEVEL if level < 4 else Navigation.EPISODE_END)
    assert run.score == LIFETIME - 5 * EXIT_TICK
    assert EPISODE_BEST not in notices, "there was none to be better than"
    best = data.records.episode_best(episode().key)
    assert best is not None
    assert best.score == run.score
    assert [replay.level_digest for replay in map(data.records.replay, best.replays) if replay] == [
        each.digest for each in episode().levels
    ]
    assert data.progress.state(1) == UNLOCKED
    assert "A new ninja colour is yours: see Settings" in notices  # the only episode of its column
    with patch.object(data.records, "episode_passed", lambda *_: True):
        again = EpisodePlaythrough(data, episode())
        for _ in range(5):
            notices = again.passed(played(again.entry.named.level, lifetime=again.lifetime))
            again.advance()
    assert EPISODE_BEST in notices


def test_assisted_level_takes_the_episodes_record_and_opens_what_follows(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode())
    run = EpisodePlaythrough(data, episode())
    for level in range(5):
        attempt = played(run.entry.named.level, lifetime=run.lifetime)
        attempt.assists = {"slow motion"} if level == 0 else set()
        run.passed(attempt)
        run.advance()
    assert data.records.episode_best(episode().key) is None
    assert len(data.records.level_bests()) == 4
    assert data.progress.state(1) == UNLOCKED


def test_cheated_episode_gives_no_bests(tmp_path: Path) -> None:
    data = player_data(tmp_path, episode(0), episode(1))
    pass_levels(data.progress, 0, legitimate=False)
    run = EpisodePlaythrough(data, episode(1))
    run.passed(played(run.entry.named.level))
    assert data.records.level_bests() == {}


def test_only_a_better_level_score_replaces_the_best(tmp_path: Path) -> None:
    data = player_data(tmp_path)
    run = LevelPlaythrough(data, entry(short_level()))
    assert "First pass" in run.passed(played(short_level(), wait=5))[0]
    assert run.passed(played(short_level(), wait=5)) == []
    assert run.passed(played(short_level(), wait=9)) == []
    assert run.passed(played(short_level())) == [NEW_BEST]
    best = data.records.level_best(run.entry.digest)
    assert best is not None
    assert best.score == LIFETIME - EXIT_TICK
    assert len(data.records.replays()) == 1


def test_deaths_are_counted_by_killer(tmp_path: Path) -> None:
    data = player_data(tmp_path)
    run = LevelPlaythrough(data, entry(deadly_level()))
    run.died(played(deadly_level()))
    run.died(played(deadly_level()))
    attempt = played(deadly_level())
    attempt.self_inflicted = True
    run.died(attempt)
    deaths = data.statistics.deaths()
    assert (deaths["mine"], deaths[SELF], sum(deaths.values())) == (2, 1, 3)
    assert data.statistics.played(run.entry.digest).deaths == 3


def test_levels_of_an_episode_count_only_from_the_episode_reached(progress: PackProgress) -> None:
    progress.level_passed((3, 0), legitimate=True)
    assert progress.columns[0].beaten == (0, 0)
