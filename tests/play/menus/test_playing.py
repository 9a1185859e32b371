"""From the menu to a record: episodes and single levels are played by script, saved, and come back as ghosts."""

from pathlib import Path

from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.text import lifetimes
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.passed import EpisodePassed
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.menus.browser import Browser
from ninja_game.play.menus.episodes import EpisodeGrid
from ninja_game.play.panels.replays import RecordsScreen, ReplaysScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.player_data import EPISODE_BEST, OF_A_LEVEL
from ninja_game.player.progress import UNLOCKED
from ninja_game.runs.verify import verify_recording
from tests.support.draw_log import drawn
from tests.support.menu_driver import MenuDriver


def test_first_episode_is_played_to_its_end(driver: MenuDriver) -> None:
    driver.open("Episodes")
    driver.press("return")
    for number in range(1, 6):
        level = driver.shown(LevelScreen)
        assert level.playthrough.title.startswith(f"Episode 1.1, level {number}: ")
        assert level.playthrough.show_tutorial == (number == 1)
        level.begin()
        driver.play_replay(number)
        assert level.phase is Phase.PASSED
        assert level.play.notices[0] == "First pass"
        driver.press("return")
    passed = driver.shown(EpisodePassed)
    assert driver.player.progress.state(1) == UNLOCKED
    shown = drawn(driver.app)
    assert EPISODE_BEST not in shown, "there was none to be better than"
    assert not [notice for notice in OF_A_LEVEL if notice in shown], "what the last level has brought is not its"
    best = driver.player.records.episode_best(passed.run.episode.key)
    assert best is not None
    assert best.score == passed.run.score
    driver.frames(3)
    driver.choose("Episodes")
    assert isinstance(driver.top(), EpisodeGrid)
    assert len(driver.app.stack) == 2, "that from which it was opened"
    driver.app.push(EpisodePassed(driver.app, passed.run, passed._play))
    driver.app.stack.screens.pop(1)
    driver.choose("Episodes")
    assert isinstance(driver.top(), EpisodeGrid), "whatever it was opened from"
    assert len(driver.app.stack) == 2
    driver.app.push(passed)
    driver.choose("Watch the run")
    assert isinstance(driver.top(), ReplayScreen)
    driver.press("escape", "up", "return")
    following = driver.shown(LevelScreen)
    assert following.playthrough.title.startswith("Episode 1.2, level 1: ")
    driver.press("q")
    assert isinstance(driver.top(), EpisodeGrid)
    driver.press("escape")
    driver.open("Records")
    driver.press("e")
    (file,) = (driver.player.folder / "exports").iterdir()
    runs = load_replays(file)
    assert file.name.endswith(".episode.txt")
    assert [run.level for run in runs] == [each.named.level for each in passed.run.episode.levels]
    assert lifetimes([run.replay for run in runs])[-1] == passed.run.score
    assert all(verify_recording(run).good and str(run.replay.made) == "played" for run in runs)


def test_runs_that_are_begun_again_count_with_their_gold(driver: MenuDriver) -> None:
    driver.open("Levels")
    level = driver.open_level()
    recording = load_replays(bundled_replays()[0])[0]
    gold = 0
    for _ in range(2):
        level.begin()
        driver.keys.script = [keys & 7 for keys in recording.inputs][:-10]
        driver.frames(len(driver.keys.script))
        gold += level.attempt.gold
        driver.press("r")
    level.begin()
    driver.frames(5)
    driver.press("escape")
    level.quit()
    played = driver.player.statistics.played()
    assert (played.attempts, played.passes, played.gold) == (3, 0, gold)
    assert gold > 0


def test_best_run_of_a_level_runs_along_the_next_time(driver: MenuDriver, tmp_path: Path) -> None:
    browser = driver.opened("Levels", Browser)
    level = driver.open_level()
    assert not level.play.view.ghosts
    level.begin()
    driver.play_replay(1)
    assert level.phase is Phase.PASSED
    driver.press("q")
    driver.close()
    # The next start of the program.
    again = MenuDriver(tmp_path)
    again.open("Levels")
    again.choose("Watch best")
    assert again.shown(ReplayScreen).run.inputs.startswith(bytes(level.attempt.inputs))
    again.press("escape", "escape")
    again.open("Levels")
    again.press("return")
    level = again.shown(LevelScreen)
    assert [ghost.inputs for ghost in level.play.ghosts]
    assert isinstance(browser, Browser)
    again.press("q", "escape")
    assert isinstance(again.open("Records"), RecordsScreen)
    again.press("down", "return")
    assert isinstance(again.top(), ReplayScreen)
    again.press("escape", "escape")
    replays = again.opened("Replays", ReplaysScreen)
    assert replays.rows[0].text == "Run and Hop"
    again.press("delete")
    assert again.player.records.level_bests()
    again.close()


def test_deaths_are_counted_and_retry_is_one_key(driver: MenuDriver) -> None:
    driver.open("Episodes")
    driver.press("return", "space")
    level = driver.shown(LevelScreen)
    driver.press("k")
    assert level.phase is Phase.DEAD
    assert driver.player.statistics.deaths()["player"] == 1
    driver.press("return")
    assert level.attempt.simulation.tick == 0


def test_practice_saves_no_record_and_unlocks_nothing(driver: MenuDriver) -> None:
    grid = driver.opened("Episodes", EpisodeGrid)
    grid.practice.put(True)
    driver.press("return")
    for number in range(1, 6):
        level = driver.shown(LevelScreen)
        level.begin()
        driver.play_replay(number)
        assert level.phase is Phase.PASSED
        driver.press("return")
    assert isinstance(driver.top(), EpisodePassed)
    assert driver.player.records.level_bests() == {}
    assert driver.player.progress.state(1) != UNLOCKED
