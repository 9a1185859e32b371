"""From the menu to a record: episodes and single levels are played by script, saved, and come back as ghosts."""

from __future__ import annotations

from pathlib import Path

from ninja_game.play.level.phase import Phase
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episode_grid import EpisodeGrid
from ninja_game.play.menus.episode_passed import EpisodePassed
from ninja_game.play.menus.records import RecordsScreen
from ninja_game.play.menus.replays import ReplaysScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.progress import UNLOCKED
from tests.support.menu_driver import Stage


def test_first_episode_is_played_to_its_end(stage: Stage) -> None:
    stage.open("Play")
    stage.press("return")
    for number in range(1, 6):
        level = stage.top()
        assert isinstance(level, LevelScreen)
        assert level.course.title.startswith(f"Episode 0 Level {number - 1}")
        assert level.course.lesson == (number == 1)
        level.begin()
        stage.play_replay(number)
        assert level.phase is Phase.PASSED
        assert "saved" in " ".join(level.notices)
        stage.press("space")
    passed = stage.top()
    assert isinstance(passed, EpisodePassed)
    assert stage.player.progress.state(1) == UNLOCKED
    best = stage.player.records.episode_best(passed.run.episode.key)
    assert best is not None
    assert best.score == passed.run.score
    stage.frames(3)
    stage.press("down", "return")
    assert isinstance(stage.top(), ReplayScreen)
    stage.press("escape", "up", "return")
    following = stage.top()
    assert isinstance(following, LevelScreen)
    assert following.course.title.startswith("Episode 1 Level 0")
    stage.press("q")
    assert isinstance(stage.top(), EpisodeGrid)


def test_best_run_of_a_level_runs_along_the_next_time(stage: Stage, tmp_path: Path) -> None:
    browser = stage.open("Levels")
    assert isinstance(browser, Browser)
    stage.press("return")
    level = stage.top()
    assert isinstance(level, LevelScreen)
    assert not level.view.ghosts
    level.begin()
    stage.play_replay(1)
    assert level.phase is Phase.PASSED
    stage.press("q")
    stage.close()
    # The next start of the program.
    again = Stage(tmp_path)
    again.open("Levels")
    again.press("return")
    level = again.top()
    assert isinstance(level, LevelScreen)
    assert [ghost.frames for ghost in level.view.ghosts]
    assert isinstance(browser, Browser)
    again.press("q", "escape")
    assert isinstance(again.open("Records"), RecordsScreen)
    again.press("down", "return")
    assert isinstance(again.top(), ReplayScreen)
    again.press("escape", "escape")
    replays = again.open("Replays")
    assert isinstance(replays, ReplaysScreen)
    assert replays.rows[0].text == "First Steps"
    again.press("delete")
    assert again.player.records.level_bests()
    again.close()


def test_deaths_are_counted_and_retry_is_one_key(stage: Stage) -> None:
    stage.open("Play")
    stage.press("return", "space")
    level = stage.top()
    assert isinstance(level, LevelScreen)
    stage.press("k")
    assert level.phase is Phase.DEAD
    assert stage.player.statistics.deaths()["player"] == 1
    stage.press("space")
    assert level.attempt.simulation.tick == 0


def test_practice_saves_no_record_and_unlocks_nothing(stage: Stage) -> None:
    grid = stage.open("Play")
    assert isinstance(grid, EpisodeGrid)
    grid._set_practice(True)
    stage.press("return")
    for number in range(1, 6):
        level = stage.top()
        assert isinstance(level, LevelScreen)
        level.begin()
        stage.play_replay(number)
        assert level.phase is Phase.PASSED
        stage.press("space")
    assert isinstance(stage.top(), EpisodePassed)
    assert stage.player.records.level_bests() == {}
    assert stage.player.progress.state(1) != UNLOCKED
