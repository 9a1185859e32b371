"""Help in play: slower, invincible, running by taps, marks for sounds. What makes a run easier is no record."""

import pygame
import pytest

from ninja_game.formats.ascii.reader import room_level
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.screen import LevelScreen
from ninja_game.play.panels.help import Page, read_pages
from ninja_game.player.attempt import Attempt
from ninja_game.player.progress import HELPED
from ninja_game.sim.inputs import KEY_LEFT, KEY_RIGHT
from ninja_game.sim.level import Level
from ninja_game.ui.audio.table import warning_of
from ninja_game.ui.input.bindings import Bindings
from ninja_game.ui.input.keys import SCANCODES
from tests.support.scripted import ScriptedControls, frames, level_run, open_level, play_to_the_end, press

DEATHS = [page for page in read_pages() if "died" in page.shows]
TALL = [*["@.#" if not row else "..#" for row in range(21)]]


@pytest.mark.parametrize("page", DEATHS, ids=lambda page: page.title)
def test_an_invincible_ninja_survives_every_death_of_the_help(page: Page) -> None:
    mortal, attempt = Attempt(page.level), Attempt(page.level)
    for keys in page.inputs:
        mortal.tick(keys & 7)
        attempt.tick(keys & 7, invincible=True)
    assert mortal.outcome == "dead"
    assert attempt.outcome == "running"
    assert attempt.death_refused
    assert attempt.assisted
    assert attempt.simulation.tick == len(page.inputs)


def test_a_landing_that_kills_is_softened() -> None:
    attempt = Attempt(room_level(TALL, ()))
    for _ in range(120):
        attempt.tick(0, invincible=True)
    assert attempt.outcome == "running"
    assert attempt.death_refused


def test_an_invincible_run_without_danger_is_the_same_run(recording: Recording) -> None:
    plain, attempt = Attempt(recording.level), Attempt(recording.level)
    for keys in recording.inputs:
        plain.tick(keys & 7)
        attempt.tick(keys & 7, invincible=True)
    assert attempt.simulation.digest() == plain.simulation.digest()
    assert not attempt.death_refused


@pytest.mark.parametrize("settings", [{"game_speed": 80}, {"invincible": True}])
def test_an_assisted_pass_is_no_record_and_says_so(
    stage: tuple[App, ScriptedControls], recording: Recording, settings: dict[str, object]
) -> None:
    app, controls = stage
    app.change_settings(**settings)
    screen = open_level(app, recording)
    play_to_the_end(app, controls, screen, recording)
    assert screen.phase is Phase.PASSED
    assert app.player.records.level_best(screen.playthrough.entry.digest) is None
    assert screen.play.notices[0] == HELPED


def test_game_speed_makes_ticks_longer(stage: tuple[App, ScriptedControls], recording: Recording) -> None:
    app, _ = stage
    app.change_settings(game_speed=50)
    screen = open_level(app, recording)
    press("confirm")
    frames(app, 1, ms=0)
    frames(app, 40, ms=25)
    assert screen.attempt.simulation.tick == 20


def test_no_replay_is_kept_of_a_run_that_keys_alone_do_not_make(stage: tuple[App, ScriptedControls]) -> None:
    app, _ = stage
    app.change_settings(invincible=True)
    screen = LevelScreen(app, level_run(app, _tall()))
    app.push(screen)
    press("confirm")
    frames(app, 120)
    assert screen.attempt.death_refused
    screen.keep_replay()
    assert app.notice == "No replay: only the invincible could survive this run"
    screen.copy_link()
    assert not screen.play.may_watch


def _tall() -> Level:
    return room_level(TALL, ())


def test_a_tap_runs_until_the_next_one(app: App) -> None:
    keys = Bindings()
    keys.tap_to_run = True
    assert _tapped(keys, "right") == KEY_RIGHT
    assert _tapped(keys, "left") == 0
    assert _tapped(keys, "left") == KEY_LEFT
    keys.stop_running()
    assert keys.poll() == 0
    keys.tap_to_run = False
    assert _tapped(keys, "right") == KEY_RIGHT
    assert keys.poll() == 0, "nothing is held"


def _tapped(keys: Bindings, name: str) -> int:
    for kind in (pygame.KEYDOWN, pygame.KEYUP):
        keys.decode(pygame.Event(kind, key=0, scancode=SCANCODES[name], mod=0, unicode=""))
    return keys.poll()


def test_what_warns_by_a_sound_has_a_mark_of_its_own() -> None:
    seen = set()
    for page in read_pages():
        attempt = Attempt(page.level)
        world = attempt.simulation.world
        for keys in page.inputs:
            attempt.tick(keys & 7)
            seen |= {warning_of(o) for o in world.objects[1 : world.id_count + 1]}
    assert seen == {"", "rocket", "weapon", "chase", "turret"}
