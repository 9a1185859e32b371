"""How play goes on: open and locked levels, what stopped a player, runs to race against."""

from dataclasses import replace
from unittest.mock import patch

import pytest

from ninja_game.play.level.hud_view import hud_view
from ninja_game.play.level.level_play import STUCK_AFTER, Phase
from ninja_game.play.level.screen import LevelScreen, PausePanel, play_level
from ninja_game.play.main_menu import MainMenu
from ninja_game.play.menu_screen import Menu
from ninja_game.play.menus.browser import Browser
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.playthrough import LevelPlaythrough
from ninja_game.ui.widgets import Button
from tests.support.menu_driver import MenuDriver
from tests.support.players import entry, short_level


def test_levels_of_a_locked_episode_are_locked_everywhere(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    place = next(k for k, each in enumerate(browser.shown) if each.episode == "01-0")
    browser.list.select(place)
    assert not browser.play_button.enabled
    assert not browser.practice.enabled
    assert browser.practice.hint == "Finish 5 more levels of episode 1.1 first"
    browser.play(place)
    assert browser.message == "Finish 5 more levels of episode 1.1 first"
    assert driver.top() is browser
    for level in range(5):
        driver.player.progress.level_passed((0, level), legitimate=True)
        assert driver.player.lock_of(browser.shown[place]) == [
            *(f"Finish {left} more levels of episode 1.1 first" for left in (4, 3, 2)),
            "Finish 1 more level of episode 1.1 first", "",
        ][level]  # fmt: skip
    browser.play(place)
    assert isinstance(driver.top(), LevelScreen)


def test_play_goes_on_with_the_next_level(driver: MenuDriver) -> None:
    menu = driver.shown(MainMenu)
    assert isinstance(menu.focus, Button)
    assert (menu.focus.detail, menu.focus.hint) == ("Begin with Run and Hop", "8 levels in 2 episodes")
    level = driver.open_level()
    level.begin()
    driver.play_replay(1)
    driver.press("q")
    assert driver.top() is menu
    assert isinstance(menu.focus, Button)
    assert (menu.focus.detail, menu.focus.hint) == ("Go on with Stone to Stone", "Episode 1.1, level 2")
    driver.press("return")
    assert driver.shown(LevelScreen).playthrough.lifetime > 3000, "with the time that was left"


@pytest.mark.parametrize("rows, title", [(0, "level 2: Stone to Stone"), (1, "level 1: Run and Hop")])
def test_episode_left_half_way_goes_on_or_begins_again(driver: MenuDriver, rows: int, title: str) -> None:
    driver.press("return")
    driver.shown(LevelScreen).begin()
    driver.play_replay(1)
    driver.press("q")
    driver.open("Episodes")
    driver.press("return", *["down"] * rows, "return")
    assert driver.shown(LevelScreen).playthrough.title == f"Episode 1.1, {title}"


@pytest.mark.parametrize("wanted, medal", [("silver", "silver"), ("author", "author"), ("next", "silver")])
def test_ghost_of_a_medal_just_earns_it(driver: MenuDriver, wanted: str, medal: str) -> None:
    driver.app.change_settings(ghost=wanted)
    first = driver.player.catalogue.episodes[0].levels[0]
    assert first.pars is not None
    assert play_level(driver.app, first) == ""
    level = driver.shown(LevelScreen)
    level.begin()
    (ghost,) = level.play.ghosts
    ticks = 0
    while not ghost.over:
        ghost.on_tick()
        ticks += 1
    assert ticks <= first.pars.par(medal) + 2
    assert ticks >= first.pars.par(medal) - 2


def test_gold_medal_opens_the_authors_run(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    first = browser.shown[0]
    assert first.pars is not None
    opened = []
    for late in (1, 0):
        driver.player.marks.passed(first.digest, first.pars.par("gold") + late, 0)
        browser.enter()
        opened.append(browser.watch_author.enabled)
    assert opened == [False, True]
    browser.watch_author.confirm()
    driver.shown(ReplayScreen)


def test_level_without_its_certificate_races_the_best_run(driver: MenuDriver) -> None:
    driver.app.change_settings(ghost="gold")
    own = replace(entry(short_level()), source="yours")
    assert LevelPlaythrough(driver.player, own).ghosts() == []


def test_nobody_is_stopped_by_one_level(driver: MenuDriver) -> None:
    level = driver.stuck_level()
    end = hud_view(level.play).end
    assert end
    assert end.lines[-1].endswith("N: get help")
    driver.press("n")
    assert [getattr(each, "text", "") for each in driver.shown(Menu).widgets] == [
        "Try again", "Watch how", "Slow down to 70%", "Skip this level",
    ]  # fmt: skip
    driver.choose("Skip this level")
    run = level.playthrough
    assert isinstance(run, EpisodePlaythrough)
    assert driver.top() is level
    assert run.position == 1
    assert not run.whole
    driver.press("q")
    driver.press("return")
    assert driver.shown(LevelScreen).playthrough.title.endswith("Stone to Stone"), "play goes on behind it"


def test_slower_play_opens_what_follows_without_a_record(driver: MenuDriver) -> None:
    level = driver.stuck_level()
    driver.press("n")
    driver.choose("Slow down to 70%")
    assert driver.player.settings.game_speed == 70
    driver.press("n")
    driver.choose("Full speed")
    assert driver.player.settings.game_speed == 100
    level.attempt.assists.add("slow motion")
    level.playthrough.passed(level.attempt)
    assert driver.player.progress.columns[0].beaten == (0, 1)
    assert driver.player.marks.of(level.playthrough.entry.digest) is None


def test_help_with_a_level_can_always_be_asked_for_and_says_what_is_not_possible(driver: MenuDriver) -> None:
    level = driver.open_level()
    for begun, keys in ((False, ["n"]), (True, ["n"]), (True, ["escape", "down", "down", "return"])):
        level.retry()
        if begun:
            level.begin()
        driver.press(*keys)
        menu = driver.shown(Menu)
        hints = {each.text: each.hint for each in menu.widgets if isinstance(each, Button)}
        assert f"Watch how (after {STUCK_AFTER} failed tries)" in hints
        assert hints["Skip this level"] == "The next one opens. This one counts only once you pass it"
        tick = level.attempt.simulation.tick
        driver.frames(5)
        assert level.attempt.simulation.tick == tick
        driver.press("escape")
        if begun:
            assert isinstance(driver.top(), PausePanel), "play does not go on by itself"
            assert level.phase is Phase.PAUSED
            driver.press("escape")
        assert driver.top() is level
        assert level.phase is (Phase.PLAY if begun else Phase.READY)
    level.retry()
    driver.press("escape", "down", "down", "return", "escape")
    panel = driver.shown(PausePanel)
    assert panel.focus is panel.widgets[2], "help goes back to where it was asked for"
    driver.press("escape")
    assert level.phase is Phase.READY
    driver.press("n", "down", "return")
    assert driver.shown(Menu).focus, "what is off does nothing"


def test_a_win_in_levels_leads_to_the_next_one_that_is_open(driver: MenuDriver) -> None:
    browser = driver.opened("Levels", Browser)
    level = driver.open_level()
    titles = []
    for number in (1, 2):
        level.begin()
        driver.play_replay(number)
        assert level.phase is Phase.PASSED
        titles.append(level.playthrough.title)
        end = hud_view(level.play).end
        assert end
        assert end.lines[-1].startswith("Space: next level    R: play again")
        driver.press("return")
    assert titles == ["Run and Hop", "Stone to Stone"]
    driver.press("q")
    last = next(k for k, each in enumerate(browser.shown) if each.place == "Episode 1.1, level 5")
    browser.play(last)
    playthrough = driver.shown(LevelScreen).playthrough
    assert playthrough.has_next == any(not driver.player.lock_of(each) for each in browser.shown[last + 1 :])


def test_last_level_of_an_episode_left_out_leads_to_the_next_episode(driver: MenuDriver) -> None:
    level = driver.open_level()
    run = level.playthrough
    assert isinstance(run, EpisodePlaythrough)
    count = len(run.episode.levels)
    for _ in range(count):
        driver.press("n")
        driver.choose("Skip this level")
    following = driver.player.catalogue.following(run.episode)
    assert following
    after = driver.shown(LevelScreen).playthrough
    assert isinstance(after, EpisodePlaythrough)
    assert (after.episode.key, after.position) == (following.key, 0)
    assert driver.app.notice == f"Skipped. Now episode {following.code}: {following.name}"
    last = driver.shown(LevelScreen)
    with patch.object(driver.player.catalogue, "following", lambda _: None):
        for _ in range(len(following.levels)):
            last.go_on()
    assert driver.app.notice == "That was the last episode"
    assert driver.top() is not last
