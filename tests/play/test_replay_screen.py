"""The replay viewer: any tick is exact, time runs both ways, films are made."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pygame
import pytest

from ninja_game.formats.load import load_replays
from ninja_game.play.replay.export import export_film, film_length
from ninja_game.play.replay.playback import RecordedRun, recorded_run
from ninja_game.play.replay.screen import AFTERMATH, SPEEDS, ReplayScreen
from ninja_game.simulation import Simulation
from tests.support.scripted import frames, press, scripted_app

REPLAYS = Path(__file__).parent.parent / "replays"
TAKE = recorded_run(load_replays(REPLAYS / "08-the-works.replay.txt")[0])


def straight_digests(take: RecordedRun, ticks: int) -> list[str]:
    run = Simulation(take.level, body=take.body)
    digests = [run.digest()]
    for tick in range(ticks):
        run.step_keys(take.inputs[tick] if tick < len(take.inputs) else 0)
        digests.append(run.digest())
    return digests


def test_any_tick_sought_is_the_one_of_a_straight_run() -> None:
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [TAKE])
        app.push(screen)
        digests = straight_digests(TAKE, screen.length)
        chance = Random(4)
        for tick in [0, 1, screen.length, *(chance.randrange(screen.length) for _ in range(40))]:
            screen.seek(tick)
            frames(app, 1, 0)
            assert screen.tick == tick
            assert screen.playback.simulation.digest() == digests[tick]


def test_single_ticks_go_both_ways_and_stop() -> None:
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [TAKE])
        app.push(screen)
        screen.seek(100)
        press("frame_forward")
        frames(app, 5)
        assert (screen.tick, screen.paused) == (101, True)
        press("frame_back")
        press("frame_back")
        frames(app, 5)
        assert screen.tick == 99


def test_speed_and_stillness_at_the_start() -> None:
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [TAKE])
        app.push(screen)
        frames(app, 20)
        assert screen.tick == 0, "half a second of stillness"
        frames(app, 10)
        assert screen.tick == 10
        press("faster")
        frames(app, 11)
        assert SPEEDS[screen.speed] == 2.0
        assert 30 <= screen.tick <= 34


def test_it_starts_again_after_the_end() -> None:
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [TAKE])
        app.push(screen)
        screen.still_ms = 0
        screen.seek(screen.end + AFTERMATH - 2)
        frames(app, 3)
        assert screen.tick == 0


def test_others_on_the_same_level_run_along() -> None:
    other = RecordedRun("other", TAKE.level, TAKE.inputs[:50])
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [TAKE, other, other])
        app.push(screen)
        screen.seek(80)
        assert [ghost.simulation.tick for ghost in screen.view.ghosts] == [80, 80]
        screen.seek(20)
        assert [ghost.simulation.tick for ghost in screen.view.ghosts] == [20, 20]


def test_the_mouse_drags_the_bar() -> None:
    with scripted_app((792, 600)) as (app, _):
        screen = ReplayScreen(app, [TAKE])
        app.push(screen)
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=(304, 588), button=1))
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=(304, 588), button=1))
        frames(app, 1, 0)
        assert abs(screen.tick - screen.length / 2) <= 2


def test_a_folder_of_pictures_has_one_a_tick(tmp_path: Path) -> None:
    short = RecordedRun("short", TAKE.level, TAKE.inputs[:5])
    export_film(short, tmp_path / "film")
    names = sorted(path.name for path in (tmp_path / "film").iterdir())
    assert len(names) == film_length(short)
    assert names[0] == "00000.png"


def test_a_gif_has_as_many_pictures(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    short = RecordedRun("short", TAKE.level, TAKE.inputs[:5])
    export_film(short, tmp_path / "film.gif")
    with image.open(tmp_path / "film.gif") as film:
        ms = 0
        for frame in range(film.n_frames):
            film.seek(frame)
            ms += film.info["duration"]
        # Pillow joins equal pictures: the time is what counts.
        assert abs(ms - 25 * film_length(short)) <= 30
