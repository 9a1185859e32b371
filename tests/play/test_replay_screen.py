"""The replay viewer: any tick is exact, time runs both ways, films are made."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from random import Random
from unittest.mock import patch

import pygame
import pytest

from ninja_game.budget import TURN_WORK, tick_cost
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.play.app import App
from ninja_game.play.replay import playback
from ninja_game.play.replay.film import Film, film_pictures, write_film
from ninja_game.play.replay.playback import Playback, draw_names
from ninja_game.play.replay.screen import SHOWN_AFTER_END, SPEEDS, ReplayScreen
from ninja_game.runs import save_states
from ninja_game.sim.level import Level
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.theme import RUN_COLOURS, Theme
from tests.support.draw_log import noted_texts
from tests.support.heavy import heavy_level
from tests.support.own_pack import PACK
from tests.support.page_scenes import settle
from tests.support.scripted import frames, press, scripted_app, tap

RUN = load_replays(PACK / "certificates" / "01-2-no-hurry.exit.replay.txt")[0]


def recording(name: str, level: Level, inputs: bytes) -> Recording:
    """Inputs that nobody has made claims about."""
    return Recording(level, Replay.of_inputs(inputs, level, name=name))


def straight_digests(of: Recording, ticks: int) -> list[str]:
    run = Simulation(of.level, body=of.body)
    digests = [run.digest()]
    for tick in range(ticks):
        run.step_keys(of.inputs[tick] if tick < len(of.inputs) else 0)
        digests.append(run.digest())
    return digests


@contextmanager
def viewer(*runs: Recording, size: tuple[int, int] = (396, 300)) -> Iterator[tuple[App, ReplayScreen]]:
    """The viewer with some runs, on an app without a display."""
    with scripted_app(size) as (app, _):
        screen = ReplayScreen(app, runs)
        app.push(screen)
        yield app, screen


def test_any_tick_sought_is_the_one_of_a_straight_run() -> None:
    with viewer(RUN) as (app, screen):
        settle(app, screen)
        digests = straight_digests(RUN, screen.length)
        rng = Random(4)
        for tick in [0, 1, screen.length, *(rng.randrange(screen.length) for _ in range(40))]:
            screen.seek(tick)
            frames(app, 1, 0)
            settle(app, screen)
            assert screen.tick == tick
            assert screen.playback.simulation.digest() == digests[tick]


def test_single_ticks_and_seconds_go_both_ways_and_stop() -> None:
    with viewer(RUN) as (app, screen):
        screen.seek(100)
        tap(app, "frame_forward", pictures=5)
        assert (screen.tick, screen.paused) == (101, True)
        press("frame_back")
        tap(app, "frame_back", pictures=5)
        assert screen.tick == 99
        for key, tick in (("left", 59), ("right", 99)):
            tap(app, key, pictures=5)
            assert screen.tick == tick


def test_a_key_with_two_meanings_has_the_first_one_and_a_run_that_stands_is_silent() -> None:
    with viewer(RUN) as (app, screen), patch.object(app.audio_output, "quiet") as quiet:
        screen.seek(100)
        screen.handle(InputEvent(pygame.Event(pygame.KEYDOWN), pressed=("pause", "frame_forward")))
        assert (screen.tick, screen.paused, quiet.call_count) == (100, True, 1)


def test_speed_and_stillness_at_the_start() -> None:
    with viewer(RUN) as (app, screen):
        frames(app, 20)
        assert screen.tick == 0, "half a second of stillness"
        frames(app, 10)
        assert screen.tick == 10
        tap(app, "faster", pictures=11)
        assert SPEEDS[screen.speed] == 2.0
        assert 30 <= screen.tick <= 34
        with patch.object(screen.view, "draw", wraps=screen.view.draw) as draw:
            frames(app, 3, ms=7)
        assert 0 < min(call.args[1] for call in draw.call_args_list) < 1


def test_it_starts_again_after_the_end() -> None:
    with viewer(RUN) as (app, screen):
        settle(app, screen)
        screen.still_ms = 0
        screen.seek(screen.end + SHOWN_AFTER_END - 2)
        frames(app, 3)
        assert screen.tick == 0


def test_others_on_the_same_level_run_along() -> None:
    other = recording("other", RUN.level, RUN.inputs[:50])
    with viewer(RUN, other, other) as (app, screen):
        screen.seek(80)
        settle(app, screen)
        assert [ghost.simulation.tick for ghost in screen.ghosts] == [80, 80]
        screen.seek(20)
        settle(app, screen)
        assert [ghost.simulation.tick for ghost in screen.ghosts] == [20, 20]


def test_a_key_shows_and_hides_the_others() -> None:
    with scripted_app((396, 300)) as (app, _):
        app.push(ReplayScreen(app, [RUN]))
        for shown in (False, True):
            tap(app, "ghost")
            assert app.settings.show_ghost is shown


def test_the_mouse_drags_the_bar() -> None:
    with viewer(RUN, size=(792, 600)) as (app, screen):
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=(224, 588), button=1))
        pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=(224, 588), button=1))
        frames(app, 1, 0)
        assert abs(screen.tick - screen.length / 2) <= 2


def test_a_folder_of_pictures_has_one_a_tick(tmp_path: Path) -> None:
    short = recording("short", RUN.level, RUN.inputs[:5])
    write_film([Film(short)], tmp_path / "film")
    names = sorted(path.name for path in (tmp_path / "film").iterdir())
    assert len(names) == len(Film(short).moments)
    assert names[0] == "00000.png"


def test_a_gif_has_as_many_pictures(tmp_path: Path) -> None:
    image = pytest.importorskip("PIL.Image")
    short = recording("short", RUN.level, RUN.inputs[:5])
    write_film([Film(short)], tmp_path / "film.gif")
    with image.open(tmp_path / "film.gif") as film:
        ms = 0
        for frame in range(film.n_frames):
            film.seek(frame)
            ms += film.info["duration"]
        # Pillow joins equal pictures: the time is what counts.
        assert abs(ms - 25 * len(Film(short).moments)) <= 30


def test_home_and_end_lead_to_the_start_and_the_outcome() -> None:
    with viewer(RUN) as (app, screen):
        settle(app, screen)
        press("last")
        frames(app, 1, 0)
        settle(app, screen)
        assert screen.tick == screen.end
        press("first")
        frames(app, 1, 0)
        assert screen.tick == 0


def test_count_of_ticks_stops_at_the_end_of_the_recording(monkeypatch: pytest.MonkeyPatch) -> None:
    with viewer(RUN) as (app, screen):
        screen.seek(screen.end + 20)
        written = noted_texts(monkeypatch)
        screen.draw(app.surface)
        assert any(text.endswith(f"tick {screen.end}") for text in written)


def test_mark_of_an_exit_is_not_that_of_a_death() -> None:
    marks = []
    for inputs, outcome in ((RUN.inputs, "exit"), (bytes(600), "running")):
        with scripted_app((792, 600)) as (app, _):
            screen = ReplayScreen(app, [recording("run", RUN.level, inputs)])
            app.push(screen)
            frames(app, 1, 0)
            assert screen.outcome == outcome
            x = 24 + 400 * screen.end / screen.length
            marks.append(app.surface.get_at((round(x), 584))[:3])
            if outcome == "exit":
                assert marks[0] == app.theme.palette.bar_full[:3]
                assert marks[0] != app.theme.palette.bar_empty[:3]
    assert marks[0] != marks[1]


def test_nothing_of_the_viewer_is_written_over_the_level() -> None:
    with scripted_app() as (app, _):
        screen = ReplayScreen(app, [RUN])
        app.push(screen)
        tap(app, "pause", pictures=3)
        with_words = app.surface.copy()
        screen.view.draw(app.surface, 1.0, whole=True)
        changed = pygame.mask.from_threshold(app.surface, (0, 0, 0), (1, 1, 1, 255), with_words)
        changed.invert()
        assert changed.count()
        assert all(rect.top >= 576 or rect.bottom <= 24 for rect in changed.get_bounding_rects())


def test_sound_is_back_after_seeking_even_if_it_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [RUN])

        def broken() -> None:
            raise RuntimeError

        monkeypatch.setattr(screen.playback, "step", broken)
        with pytest.raises(RuntimeError):
            screen.seek(50)
        assert screen.view.audible


def work_of_turns(app: App, monkeypatch: pytest.MonkeyPatch, deeds: list[Callable[[], object]]) -> list[int]:
    """The work of each turn, as they pass: ticks of all worlds times what a tick of theirs costs.

    ``deeds``: what is to happen at the start of the next turn.
    """
    turns = [0]
    step, frame = Playback.step, app.frame

    def counted(playback: Playback) -> None:
        turns[-1] += tick_cost(playback.simulation.level)
        step(playback)

    def turn(ms: int) -> None:
        turns.append(0)
        while deeds:
            deeds.pop()()
        frame(ms)

    monkeypatch.setattr(Playback, "step", counted)
    monkeypatch.setattr(app, "frame", turn)
    return turns


@pytest.mark.parametrize("blocks, speed", [pytest.param(11_000, 1, marks=pytest.mark.slow), (1000, 6), (0, 6)])
def test_no_turn_of_the_costliest_run_is_longer_than_others(
    monkeypatch: pytest.MonkeyPatch, blocks: int, speed: int
) -> None:
    run = recording("long", heavy_level(blocks), bytes(1_000_000))
    with scripted_app((396, 300)) as (app, _):
        deeds: list[Callable[[], object]] = []
        turns = work_of_turns(app, monkeypatch, deeds)
        screen = ReplayScreen(app, [run, recording("a", run.level, bytes(9)), recording("b", run.level, bytes(9))])
        app.push(screen)
        frames(app, 2)
        assert (screen.tick, screen.is_settled) == (0, False), "the first picture is there while the end is looked for"
        screen.still_ms, screen.speed = 0, speed
        frames(app, 5, 300)
        played = screen.tick
        assert played
        deeds += [partial(screen.seek, played + tick) for tick in range(200, 250)]
        frames(app, 3)
        assert screen.tick > played
        deeds.append(partial(screen.seek, 3))
        frames(app, 8)
        screen.toggle_pause()
        frames(app, 3)
        # A tick of each of the worlds is the least that there can be beside it.
        assert max(turns) <= TURN_WORK + 4 * tick_cost(run.level)


@pytest.mark.parametrize("x", [24.0, 768.0])
def test_a_long_name_of_a_ghost_stays_between_the_sides_of_the_level(x: float) -> None:
    """What is drawn beside the level, in a wide window, is not drawn over again."""
    with viewer(RUN, replace(RUN, file="", replay=replace(RUN.replay, author="M" * 24))) as (_, screen):
        theme = Theme(screen.theme.palette, Canvas((1280, 600)))
        with patch.object(screen.ghosts[0], "place", return_value=(x, 300.0)):
            (covered,) = draw_names(pygame.Surface((1280, 600)), theme, screen.ghosts, 1.0)
    assert theme.canvas.rect(0, 0, 792, 600).inflate(2, 0).contains(covered)


def test_ghosts_have_names_and_colours_and_are_in_the_film(monkeypatch: pytest.MonkeyPatch) -> None:
    others = [replace(RUN, file="", replay=replace(RUN.replay, author=name)) for name in ("Ann", "Cy")]
    with viewer(RUN, *others) as (app, screen):
        assert [ghost.name for ghost in screen.ghosts] == ["Ann", "Cy"]
        assert screen.ghosts[0].shade != screen.ghosts[1].shade
        for numbers, shades in (([3, 2, 5], [2, 5]), ([3], [1, 2])):  # one for each run, else in their order
            coloured = ReplayScreen(app, [RUN, *others], numbers)
            assert [ghost.shade for ghost in coloured.ghosts] == [RUN_COLOURS[number] for number in shades]
        drawn = noted_texts(monkeypatch)
        frames(app, 2)
        assert {"Ann", "Cy"} <= drawn.keys()
        app.change_settings(show_ghost=False)
        drawn.clear()
        frames(app, 2)
        assert "Ann" not in drawn
        app.change_settings(show_ghost=True)
        made: list[Film] = []

        def written(films: Sequence[Film], *_: object) -> bool:
            made.extend(films)
            return True

        monkeypatch.setattr("ninja_game.play.replay.film.write_film", written)
        screen.start_export()
        while screen.export is not None:
            frames(app, 1)
        assert made[0].ghosts == (*others,)
        shown = next(film_pictures(made[0]))
        pixels = {tuple(shown.get_at((x, y))) for x in range(shown.width) for y in range(shown.height)}
        assert {tuple(ghost.shade) for ghost in screen.ghosts if ghost.shade} <= pixels
        assert "-ann-cy-1.gif" in app.notice


def test_ghosts_catch_up_after_a_leap_in_turns() -> None:
    level = heavy_level(300)
    with viewer(*(recording(name, level, bytes(500)) for name in "abc")) as (app, screen):
        screen.toggle_pause()
        screen.seek(400)
        while screen._way:
            frames(app, 1, 0)
        assert any(ghost.behind for ghost in screen.ghosts)
        settle(app, screen)
        assert [ghost.simulation.tick for ghost in screen.ghosts] == [400, 400]
        assert screen.ghosts[0].simulation.digest() == screen.playback.simulation.digest()


def test_each_run_has_its_name_and_its_colour_whichever_is_watched(monkeypatch: pytest.MonkeyPatch) -> None:
    """The names of ghosts at one place stand one above the other."""
    written, names = noted_texts(monkeypatch), ("Ann", "Bea", "Cid", "Dee")
    with viewer(*(recording(name, heavy_level(3), bytes(50)) for name in names)) as (app, screen):
        for watched, others in ((0, (1, 2, 3)), (1, (0, 2, 3))):
            screen.show(watched)
            written.clear()
            frames(app, 2)
            assert [ghost.shade for ghost in screen.ghosts] == [RUN_COLOURS[each] for each in others]
            first, *above = (written[names[each]] for each in others)
            assert first.collidelist(above) == above[0].collidelist(above[1:]) == -1
        app.change_settings(show_ghost=False)
        written.clear()
        frames(app, 2)
        assert not {"Ann", "Cid", "Dee"} & written.keys()


def test_a_run_that_costs_too_much_is_shown_as_far_as_it_may_go(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.play.replay.screen.affordable_ticks", lambda _: 50)
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [RUN])
        assert app.notice == "This run costs too much work: it is shown up to tick 50"
        settle(app, screen)
        assert screen.end == 50


def test_save_states_of_large_levels_are_few(monkeypatch: pytest.MonkeyPatch) -> None:
    """A tenth of the values in a tenth of the level."""
    monkeypatch.setattr(save_states, "MAX_VALUES", save_states.MAX_VALUES // 10)
    played = playback.Playback(Simulation(heavy_level(300)), bytes(110), spacing=1)
    played.seek(110)
    assert len(played.states) <= 30_000 / 300


def test_long_run_keeps_few_states_and_every_moment_stays_exact(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(save_states, "MAX_STATES", 10)
    played = playback.Playback(Simulation(RUN.level), RUN.inputs, spacing=4)
    digests = straight_digests(RUN, 300)
    played.seek(300)
    assert len(played.states) <= 10
    for tick in (0, 299, 8, 150, 151, 3):
        played.seek(tick)
        assert played.simulation.digest() == digests[tick]


def test_without_a_tas_editor_nothing_is_edited() -> None:
    with viewer(RUN) as (app, screen):
        screen.toggle_pause()
        press("edit")
        frames(app, 1, 0)
        assert app.top is screen
        assert "edit" not in screen._hint()


def test_film_is_made_from_the_viewer_and_told_whatever_the_palette() -> None:
    with scripted_app((396, 300), palette="of-another-version") as (app, _):
        screen = ReplayScreen(app, [recording("a / b", RUN.level, RUN.inputs[:3])])
        app.push(screen)
        press("export")
        frames(app, 1, 0)
        job = screen.export
        assert job is not None
        job.thread.join(60)
        frames(app, 1, 0)
        assert app.notice == f"Saved: {app.player.folder / 'exports' / 'a-b-1.gif'}"
        assert (app.player.folder / "exports" / "a-b-1.gif").is_file()


def test_film_that_cannot_be_saved_is_reported() -> None:
    with scripted_app((396, 300)) as (app, _):
        screen = ReplayScreen(app, [recording("run", RUN.level, RUN.inputs[:3])])
        app.push(screen)
        (app.player.folder / "exports").rmdir()
        (app.player.folder / "exports").write_text("in the way")
        press("export")
        frames(app, 1, 0)
        if screen.export:
            # It may have failed already, and been reported, within that frame.
            screen.export.thread.join(60)
            frames(app, 1, 0)
        assert app.notice == "No film: File exists"
