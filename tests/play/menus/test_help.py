"""Every page of the help shows what it tells."""

from typing import Any

import pygame
import pytest

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.reader import room_level
from ninja_game.play.panels.help import HelpScreen, Page, read_pages
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.simulation import Simulation
from ninja_game.ui.input.bindings import ACTIONS
from ninja_game.ui.input.keys import key_label
from ninja_game.ui.lettering import Lettering
from tests.support.menu_driver import MenuDriver

PAGES = read_pages()


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.title)
def test_demonstration_contains_what_it_should_show(page: Page) -> None:
    run = Simulation(page.level)
    happened = set()
    for keys in page.inputs:
        run.step_keys(keys)
        happened |= {event.name for event in run.events}
    assert set(page.shows) <= happened
    assert ("died" in page.shows) == (run.outcome == "dead")


def test_every_kind_of_object_has_a_page() -> None:
    shown = {record.kind for page in PAGES for record in page.level.objects}
    assert shown == set(range(len(KIND_NAMES)))


def test_a_wrong_room_is_named() -> None:
    with pytest.raises(LevelError):
        room_level(["@..,.."], ["nonsense 5,5"])


def test_every_page_plays_and_loops(driver: MenuDriver) -> None:
    screen = driver.opened("Help", HelpScreen)
    for index, page in enumerate(PAGES):
        screen.list.select(index)
        assert screen.demonstration is not None
        first = screen.demonstration.simulation
        driver.frames(3)
        last = 0
        for _ in range(len(page.inputs) + 70):
            if screen.demonstration.simulation is first:
                last = screen.demonstration.playback.tick
            screen.update(25)
        assert screen.demonstration.simulation is not first
        assert last == len(page.inputs) + 60, "it stands still for a second and a half"
    screen.list.select(len(PAGES))
    driver.frames(2)
    assert screen.demonstration is None


def test_the_keys_page_has_every_key_of_every_action(driver: MenuDriver, monkeypatch: pytest.MonkeyPatch) -> None:
    screen = driver.opened("Help", HelpScreen)
    driver.press("end", "right")
    assert screen.focus is screen.keys
    drawn: set[str] = set()
    draw = Lettering.draw

    def noted(self: Lettering, surface: pygame.Surface | None, text: str, *args: Any, **options: Any) -> pygame.Rect:
        drawn.add(text)
        rect = draw(self, surface, text, *args, **options)
        assert driver.app.surface.get_rect().contains(rect), text
        return rect

    monkeypatch.setattr(Lettering, "draw", noted)
    for _ in ACTIONS:
        driver.press("down")
    for action, entry in ACTIONS.items():
        assert entry.label in drawn
        assert ", ".join(map(key_label, entry.keys)) in drawn, action
