"""Levels that no one should make are drawn all the same: nothing that a level may hold stops a picture."""

import pygame
import pytest

from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.sim.death import kill
from ninja_game.sim.states import EXPLOSIVE
from ninja_game.simulation import Simulation
from ninja_game.ui.theme import PALETTES
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.overlays import OVERLAY_ACTIONS, Overlays
from ninja_game.view.sprites.drawing import _turned
from ninja_game.view.sprites.thumbnail import thumbnail

TILES = "0" * 713
NINJA = "5^100,560"
ODD = {
    "places that are not numbers": f"{NINJA}!0^396,NaN!12^x,y!4^,!1^NaN,300!11^NaN,NaN,NaN,NaN!2^100,NaN,0,-1",
    "a ninja nowhere": "5^NaN,NaN!0^300,300",
    "a ninja far away": "5^90000,-90000!0^300,300",
    "several ninjas": "5^100,560!5^200,560!5^300,560",
    "doors off the grid": f"{NINJA}!9^100,500,0,0,-5,90,1,0,0!9^120,500,1,1,40,2,0,0,-1!9^0,0,7,0,0.5,3,0,0,0",
    "drones of no sort": f"{NINJA}!6^300,300,9,1,7,8!6^-50,-50,0,0,1,0!6^400,300,NaN,0,2,NaN",
    "pads and platforms without direction": f"{NINJA}!2^200,560,NaN,4!2^230,560,-3.5,0.01!7^300,500,9!8^340,300,5",
    "weapons off the grid": f"{NINJA}!3^-100,-100!10^900,700!3^100,560!10^100,560",
    "wrong counts": f"{NINJA}!0^1!3^1,2,3!6^1,2!11^5,5!9^1",
}


@pytest.mark.parametrize("name", ODD)
def test_it_is_drawn(name: str) -> None:
    level = parse_level_string(f"{TILES}|{ODD[name]}")
    run = Simulation(level)
    view = LevelView(OffscreenContext((264, 200)), run)
    view.overlays = Overlays()
    view.overlays.on = set(OVERLAY_ACTIONS)
    surface = pygame.Surface((264, 200))
    for tick in range(200):
        run.step_keys((1, 2, 12, 6)[tick // 9 % 4])
        view.on_tick()
        if tick % 4 == 0:
            view.draw(surface, 0.5)
    kill(run.world, EXPLOSIVE, 0, 3.0, -2.0, 100.0, 100.0)
    view.follow_ninja()
    for _ in range(30):
        run.step_keys(0)
        view.on_tick()
        view.draw(surface, 0.5)
    thumbnail(level, PALETTES["safe"], 100)


def test_the_extent_of_a_turned_drawing_is_that_of_its_farthest_corner() -> None:
    assert _turned((-3.0, -4.0, 1.0, 2.0)) == (-5.0, -5.0, 5.0, 5.0)


def test_a_level_without_ninja_has_a_thumbnail() -> None:
    level = parse_level_string("1" * 300 + "0" * 413 + "|0^300,300")
    assert thumbnail(level, PALETTES["classic"], 132).get_size() == (132, 100)


def test_undefined_and_odd_tiles_are_drawn() -> None:
    run = Simulation(parse_level_string("!o~Q1" + "0" * 708 + f"|{NINJA}"))
    LevelView(OffscreenContext((264, 200)), run).draw(pygame.Surface((264, 200)))
