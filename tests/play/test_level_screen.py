"""A level from its start to its end, played by a script on pictures 25 ms apart: one tick each."""

from itertools import pairwise
from pathlib import Path

import pygame
import pytest

from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App
from ninja_game.play.level.hud_view import cause_of_death, hud_view
from ninja_game.play.level.level_play import DEATH_PAUSE, Phase
from ninja_game.play.level.screen import LevelScreen, play_level
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.playthrough import FilePlaythrough
from ninja_game.sim.rules import LIFETIME
from ninja_game.sim.states import CRUSHED
from ninja_game.view.hud import Hud, bar_length
from ninja_game.view.places import away_from, hidden_by
from tests.support.menu_driver import MenuDriver
from tests.support.scripted import ScriptedControls, frames, open_level, phase_of, play_to_the_end, press, release, tap


def test_a_script_of_the_recording_passes_the_level(stage: tuple[App, ScriptedControls], recording: Recording) -> None:
    app, controls = stage
    screen = open_level(app, recording)
    play_to_the_end(app, controls, screen, recording)
    assert recording.replay is not None
    assert screen.phase is Phase.PASSED
    assert screen.attempt.ended_tick == recording.replay.final_tick
    assert screen.attempt.gold == recording.replay.gold
    assert screen.attempt.score == LIFETIME + 80 * screen.attempt.gold - screen.attempt.ended_tick
    assert bytes(screen.attempt.inputs) == recording.replay.playback(len(screen.attempt.inputs))
    assert screen.attempt.replay().digest == recording.replay.digest


def test_passing_makes_a_ghost_for_the_next_try(stage: tuple[App, ScriptedControls], recording: Recording) -> None:
    app, controls = stage
    screen = open_level(app, recording)
    play_to_the_end(app, controls, screen, recording)
    tap(app, "confirm")
    assert screen.phase is Phase.READY
    assert screen.attempt.simulation.tick == 0
    assert len(screen.play.view.ghosts) == 1
    tap(app, "confirm", pictures=40)
    ghost = screen.play.ghosts[0]
    assert ghost.simulation.tick == screen.attempt.simulation.tick == 40


def test_nothing_ticks_before_a_move_and_any_move_begins(
    stage: tuple[App, ScriptedControls], recording: Recording
) -> None:
    app, controls = stage
    controls.held_bits = 2
    screen = open_level(app, recording)
    frames(app, 20)
    assert phase_of(screen) is Phase.READY, "a key that was down before does not begin"
    controls.held_bits = 0
    frames(app)
    controls.held_bits = 2
    frames(app, 2)
    assert phase_of(screen) is Phase.PLAY
    assert screen.attempt.inputs[0] == 2


def test_pause_stops_time_and_the_clock_starts_afresh(app: App, recording: Recording) -> None:
    screen = open_level(app, recording)
    press("confirm")
    frames(app, 10, 33)
    tap(app, "pause")
    tick = screen.attempt.simulation.tick
    frames(app, 10, 400)
    assert screen.phase is Phase.PAUSED
    assert screen.attempt.simulation.tick == tick
    press("pause")
    frames(app, 1, 24)
    assert screen.attempt.simulation.tick == tick, "24 ms are not a tick: the remainder was dropped"


def test_a_stall_counts_as_one_tick(app: App, recording: Recording) -> None:
    screen = open_level(app, recording)
    tap(app, "confirm")
    tick = screen.attempt.simulation.tick
    frames(app, 1, 30_000)
    assert screen.attempt.simulation.tick == tick + 1


def test_retry_in_play_is_at_once_and_the_world_is_new(
    stage: tuple[App, ScriptedControls], recording: Recording
) -> None:
    app, controls = stage
    screen = open_level(app, recording)
    start = screen.attempt.simulation.digest()
    press("confirm")
    controls.held_bits = 2
    frames(app, 30)
    controls.held_bits = 0
    tap(app, "retry")
    assert screen.phase is Phase.READY
    assert screen.attempt.simulation.digest() == start
    assert not screen.attempt.inputs


def test_death_goes_on_as_a_corpse_then_offers_retry_and_replay(
    stage: tuple[App, ScriptedControls], recording: Recording
) -> None:
    app, controls = stage
    screen = open_level(app, recording)
    controls.held_bits = 2
    tap(app, "confirm", pictures=10)
    screen.attempt.lifetime = 1
    frames(app, 2)
    assert phase_of(screen) is Phase.DEAD
    assert screen.play.view.ragdoll is not None
    tick = screen.attempt.simulation.tick
    frames(app, DEATH_PAUSE + 2)
    assert screen.attempt.simulation.tick == tick + DEATH_PAUSE + 2
    tap(app, "replay")
    assert isinstance(app.top, ReplayScreen)
    tap(app, "back")
    tap(app, "confirm")
    assert phase_of(screen) is Phase.PLAY, "the key that is held is meant for the new try"
    assert screen.attempt.outcome == "running"


def test_a_run_that_was_ended_by_the_player_is_watched_as_far_as_it_went(app: App, recording: Recording) -> None:
    screen = open_level(app, recording)
    tap(app, "confirm", pictures=3)
    press("suicide")
    frames(app, 1)
    assert "watch it" in (hud_view(screen.play).end or ("", [""], 0))[1][-1]
    tap(app, "replay")
    assert isinstance(app.top, ReplayScreen)


def test_practice_goes_back_to_a_saved_moment_exactly(
    stage: tuple[App, ScriptedControls], recording: Recording
) -> None:
    app, controls = stage
    screen = open_level(app, recording, practice_mode=True)
    controls.script = iter(recording.inputs)
    tap(app, "confirm", pictures=60)
    press("quick_save")
    frames(app, 1, 0)
    saved, played = screen.attempt.simulation.digest(), bytes(screen.attempt.inputs)
    frames(app, 50)
    press("quick_load")
    frames(app, 1, 0)
    assert screen.attempt.simulation.digest() == saved
    assert bytes(screen.attempt.inputs) == played
    assert screen.attempt.assisted


def test_rewind_runs_the_recording_backwards(stage: tuple[App, ScriptedControls], recording: Recording) -> None:
    app, controls = stage
    screen = open_level(app, recording, practice_mode=True)
    controls.script = iter(recording.inputs)
    digests = {}
    press("confirm")
    for _ in range(80):
        frames(app)
        digests[screen.attempt.simulation.tick] = screen.attempt.simulation.digest()
    tap(app, "rewind", pictures=15)
    release("rewind")
    frames(app, 1, 0)
    tick = screen.attempt.simulation.tick
    assert tick < 60
    assert screen.attempt.simulation.digest() == digests[tick]
    assert len(screen.attempt.inputs) == tick


def test_slow_motion_and_single_steps(app: App, recording: Recording) -> None:
    screen = open_level(app, recording, practice_mode=True)
    tap(app, "confirm")
    tap(app, "slow", pictures=8)
    assert screen.attempt.simulation.tick == 3, "eight pictures of 25 ms are two slow ticks"
    tap(app, "step", pictures=5)
    assert screen.attempt.simulation.tick == 4, "time stands still after a step"


def test_tools_do_nothing_outside_practice(app: App, recording: Recording) -> None:
    screen = open_level(app, recording)
    tap(app, "confirm", pictures=30)
    tap(app, "rewind", pictures=5)
    assert screen.attempt.simulation.tick == 35
    assert not screen.attempt.assisted


def test_the_boss_sees_a_sheet_of_figures(app: App, recording: Recording) -> None:
    screen = open_level(app, recording)
    tap(app, "confirm", pictures=20)
    tick = screen.attempt.simulation.tick
    tap(app, "boss", pictures=30)
    assert app.top is not screen
    assert app.surface.get_at((700, 580))[:3] != app.theme.palette.tile[:3]
    tap(app, "boss", pictures=2)
    assert app.top is screen
    assert tick <= screen.attempt.simulation.tick <= tick + 2, "time stood still"
    for leave in (pygame.K_ESCAPE, pygame.K_TAB):
        tap(app, "boss", pictures=2)
        assert app.top is not screen
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=leave, mod=0, unicode="", scancode=0))
        frames(app)
        assert app.top is screen, "Esc comes back too, whatever hides"
    tap(app, "boss", pictures=2)
    tap(app, "quit")
    assert not app.running


def test_the_levels_of_a_file_follow_each_other(
    stage: tuple[App, ScriptedControls], recording: Recording, tmp_path: Path
) -> None:
    app, controls = stage
    file = tmp_path / "two.txt"
    text = write_level_string(recording.level)
    file.write_text(f"$one#me#a#{text}#\n$none#me#a#{'0' * 713}|#\n$two#me#a#{text}#\n")
    screen = LevelScreen(app, FilePlaythrough(app.player, load_levels(str(file))))
    app.push(screen)
    frames(app)
    file.write_text(file.read_text().replace("#a#", "#b#"))
    for title in ("two", "one"):
        tap(app, "retry")
        assert screen.playthrough.entry.named.comment == "b"
        play_to_the_end(app, controls, screen, recording)
        tap(app, "confirm")
        assert screen.playthrough.title == title
        assert phase_of(screen) is Phase.READY


def test_it_says_what_the_ninja_died_of(stage: tuple[App, ScriptedControls], recording: Recording) -> None:
    app, _ = stage
    screen = open_level(app, recording)
    press("confirm")
    frames(app, 3)
    screen.attempt.simulation.kill(CRUSHED, 0.0, 0.0)
    screen.play._note_end()
    frames(app, DEATH_PAUSE + 4)
    assert screen.play.crushed
    assert cause_of_death(screen.play) == ("You were crushed", "")


def test_the_time_bar_is_linear_and_what_gold_adds_to_a_full_one_is_seen(app: App) -> None:
    lengths = [bar_length(lifetime) for lifetime in range(0, LIFETIME + 40, 40)]
    assert max(b - a for a, b in pairwise(lengths)) - min(b - a for a, b in pairwise(lengths)) < 1e-9
    hud, pictures = Hud(app.theme), []
    for lifetime in (LIFETIME, LIFETIME + 80, 2 * LIFETIME):
        app.surface.fill("black")
        hud.time_bar(app.surface, lifetime)
        pictures.append(pygame.image.tobytes(app.surface.subsurface(app.canvas.rect(24, 8, 600, 8)), "RGB"))
    assert len(set(pictures)) == 3


@pytest.mark.parametrize("pars", [(), (("gold", 700.0),)])
def test_what_the_borders_cover_is_reported_not_what_lies_between(
    app: App, pars: tuple[tuple[str, float], ...]
) -> None:
    hud = Hud(app.theme)
    app.surface.fill("black")
    drawn_areas = hud.time_bar(app.surface, LIFETIME / 2, pars) + hud.foot(app.surface, "left", "right")
    assert all(0 < rect.height < app.canvas.px(24) for rect in drawn_areas)
    assert sum(rect.width for rect in drawn_areas[2:]) < app.surface.width / 2
    for rect in drawn_areas:
        app.surface.fill("black", rect)
    assert set(pygame.image.tobytes(app.surface, "RGB")) == {0}


@pytest.mark.parametrize("size", [100, 125, 150])
def test_the_time_left_ends_at_the_border_and_says_what_it_is_for(app: App, size: int) -> None:
    app.change_settings(text_size=size)
    app.surface.fill("black")
    for lifetime in (99 * 400, 4 * LIFETIME, 700):
        Hud(app.theme).time_bar(app.surface, lifetime)
        beyond = app.surface.subsurface(app.canvas.rect(770, 0, 22, 24))
        assert set(pygame.image.tobytes(beyond, "RGB")) == {0}


def test_silver_and_gold_are_marked_on_the_time_bar_of_a_level_that_was_passed(tmp_path: Path) -> None:
    driver = MenuDriver(tmp_path)
    entry = driver.player.catalogue.ours.levels[0]
    pars = entry.pars
    assert pars is not None

    def marks() -> list[tuple[str, float]]:
        play_level(driver.app, entry)
        driver.frames(1)
        level = driver.shown(LevelScreen)
        level.begin()
        driver.frames(40)
        return list(hud_view(level.play).pars)

    assert marks() == []
    driver.player.marks.passed(entry.digest, pars.par("silver") + 1, 0)
    assert marks() == [(medal, LIFETIME - pars.par(medal)) for medal in ("silver", "gold")]


def test_keys_of_practice_are_named_where_they_work(app: App, recording: Recording) -> None:
    screen = open_level(app, recording, practice_mode=True)
    assert "rewind" not in hud_view(screen.play).foot[1]
    press("confirm")
    frames(app, 3)
    assert "Rewind: rewind" in hud_view(screen.play).foot[1]
    frames(app, 620)
    assert "rewind" not in hud_view(screen.play).foot[1]


@pytest.mark.parametrize(
    "point, away, hides",
    [
        ((150, 120), 0, True),
        ((100, 100), 0, True),
        ((90, 120), 10, True),
        ((80, 120), 20, False),
        ((215, 120), 15, True),
        ((220, 120), 20, False),
        ((150, 90), 10, True),
        ((150, 80), 20, False),
        ((150, 160), 20, False),
        ((230, 180), 50, False),
        ((97, 96), 5, True),
    ],
)
def test_a_panel_hides_what_is_within_16_px_of_it(point: tuple[float, float], away: float, hides: bool) -> None:
    panel = 100, 100, 100, 40
    assert away_from(point, *panel) == away
    assert [*hidden_by(((*point, 7),), *panel)] == [7] * hides
