"""Attract mode goes from replay to replay, rests with reduced motion, and changes nothing in the player's records."""

from ninja_game.play.main_menu import MainMenu
from tests.support.menu_driver import MenuDriver


def test_one_replay_follows_another(driver: MenuDriver) -> None:
    menu = driver.shown(MainMenu)
    names, ended = set(), set()
    for _ in range(3000):
        menu.attract.update(500)
        names.add(menu.attract.name)
        if menu.attract.view and menu.attract.view.simulation.outcome == "exit":
            ended.add(menu.attract.shown)
        if menu.attract.shown > 4:
            break
    assert menu.attract.shown > 4
    assert len(names) > 3
    assert ended >= {1, 2, 3, 4}, "each is shown to its end"
    assert not driver.player.records.replays()


def test_reduced_motion_shows_a_still_picture(driver: MenuDriver) -> None:
    menu = driver.shown(MainMenu)
    driver.app.change_settings(reduced_motion=True)
    assert menu.attract.view is not None
    tick = menu.attract.view.simulation.tick
    driver.frames(20)
    assert menu.attract.view.simulation.tick == tick
