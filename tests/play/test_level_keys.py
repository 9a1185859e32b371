"""Keys in a level: retrying, stepping, leaving; what is reported, and where."""

import sqlite3
from pathlib import Path

import pygame
import pytest

from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App
from ninja_game.play.level.hud_view import hud_view
from ninja_game.play.level.level_play import DEATH_PAUSE, LATE_JUMP, Phase
from ninja_game.play.level.screen import LevelScreen, PausePanel
from ninja_game.play.menu_screen import Menu
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.playthrough import FilePlaythrough
from ninja_game.ui.input.bindings import ACTIONS
from tests.support.scripted import (
    ScriptedControls,
    frames,
    level_run,
    open_level,
    phase_of,
    play_to_the_end,
    press,
    tap,
)

LONG = "0" * 713 + "|5^100,566!11^400,564,300,564"


def test_retry_key_retries_after_a_death_and_never_watches(app: App, recording: Recording) -> None:
    screen = open_level(app, recording)
    tap(app, "confirm", pictures=5)
    screen.attempt.lifetime = 1
    frames(app, DEATH_PAUSE + 5)
    assert phase_of(screen) is Phase.DEAD
    tap(app, "retry")
    assert app.top is screen
    assert phase_of(screen) is Phase.READY


def test_default_keys_of_retry_and_replay_differ() -> None:
    assert not set(ACTIONS["retry"].keys) & set(ACTIONS["replay"].keys)


def test_jump_retries_after_the_death_message_and_begins_when_pressed_again(
    stage: tuple[App, ScriptedControls], recording: Recording
) -> None:
    app, controls = stage
    screen = open_level(app, recording)
    tap(app, "confirm", pictures=5)
    screen.attempt.lifetime = 1
    frames(app, 5)
    tap(app, "jump")
    assert phase_of(screen) is Phase.DEAD, "a jump that came too late does not cut the death short"
    frames(app, DEATH_PAUSE)
    controls.held_bits = 4
    tap(app, "jump", pictures=5)
    assert phase_of(screen) is Phase.READY
    controls.held_bits = 0
    frames(app)
    controls.held_bits = 4
    frames(app)
    assert phase_of(screen) is Phase.PLAY


@pytest.mark.parametrize("action", ["confirm", "right"])
def test_time_goes_on_after_single_steps(app: App, recording: Recording, action: str) -> None:
    screen = open_level(app, recording, practice_mode=True)
    tap(app, "confirm")
    tap(app, "step", pictures=5)
    tick = screen.attempt.simulation.tick
    assert "go on" in hud_view(screen.play).foot[1]
    tap(app, action, pictures=5)
    assert screen.attempt.simulation.tick > tick


@pytest.mark.parametrize("phase", [Phase.READY, Phase.PLAY, Phase.DEAD])
@pytest.mark.parametrize("key", ["back", "pause"])
def test_escape_pauses_a_level_from_its_first_picture_to_its_pass(
    stage: tuple[App, ScriptedControls], recording: Recording, phase: Phase, key: str
) -> None:
    app, _ = stage
    app.push(Menu(app, "below", []))
    screen = open_level(app, recording)
    if phase is not Phase.READY:
        tap(app, "confirm")
    if phase is Phase.DEAD:
        screen.give_up()
    for _ in range(2):
        tap(app, key)
        panel: object = app.top
        assert isinstance(panel, PausePanel)
        tap(app, key)
        assert screen is app.stack.top
        assert phase_of(screen) is phase
    assert len(app.stack) == 2


def test_space_goes_on_and_does_not_jump(app: App, recording: Recording, monkeypatch: pytest.MonkeyPatch) -> None:
    """The key that jumps and chooses: what it has chosen, while it is down, is no jump; pressed again it is one."""
    screen = open_level(app, recording)
    controls = app.controls
    assert isinstance(controls, ScriptedControls)
    monkeypatch.setattr(controls, "choosing", lambda: controls.held_bits & 4)

    def down(*, space: bool) -> None:
        controls.held_bits = 4 * space
        if space:
            press("jump", "confirm")
        frames(app)

    down(space=True)
    frames(app, 3)
    assert phase_of(screen) is Phase.PLAY
    assert not any(screen.attempt.inputs), "it begins"
    down(space=False)
    down(space=True)
    assert screen.attempt.inputs[-1] & 4
    tap(app, "back")
    down(space=False)
    controls.held_bits = 4
    tap(app, "confirm", pictures=3)
    assert phase_of(screen) is Phase.PLAY
    assert not any(screen.attempt.inputs[-2:]), "it ends the pause"
    down(space=False)
    screen.give_up()
    down(space=True)
    assert phase_of(screen) is Phase.DEAD, "a jump that came too late"
    frames(app, LATE_JUMP)
    down(space=True)
    assert phase_of(screen) is Phase.READY, "it tries again"
    frames(app, 3)
    assert phase_of(screen) is Phase.READY


def test_changed_level_file_is_read_again_on_retry(app: App, recording: Recording, tmp_path: Path) -> None:
    file = tmp_path / "mine.txt"
    both = f"$one#a#b#{LONG}#\n$two#a#b#{LONG}!0^9,9#\n"
    file.write_text(both)
    run = FilePlaythrough(app.player, load_levels(str(file)))
    run.advance()
    screen = LevelScreen(app, run)
    app.push(screen)
    file.write_text(both.replace("400,564", "500,564"))
    tap(app, "retry")
    assert screen.attempt.simulation.level == screen.playthrough.level == load_levels(str(file))[1].level
    assert "changed" in app.notice
    file.write_text("broken")
    tap(app, "retry")
    assert "cannot be played" in app.notice
    assert phase_of(screen) is Phase.READY
    tap(app, "retry")


def test_locked_records_are_a_notice(
    stage: tuple[App, ScriptedControls], recording: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    app, controls = stage
    screen = open_level(app, recording)
    play_to_the_end(app, controls, screen, recording)

    def locked(*_: object) -> None:
        raise sqlite3.OperationalError("database is locked")

    monkeypatch.setattr(app.player.records, "keep_replay", locked)
    tap(app, "export")
    assert "Not saved yet" in app.notice


def test_skipping_with_locked_records_goes_on_with_a_notice(
    app: App, recording: Recording, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = EpisodePlaythrough(app.player, app.player.catalogue.episodes[0], practice_mode=True)
    app.push(LevelScreen(app, run))

    def locked(*_: object, **__: object) -> None:
        raise sqlite3.OperationalError("database is locked")

    monkeypatch.setattr(app.player.progress, "level_passed", locked)
    tap(app, "skip")
    assert run.position == 1
    assert "Not saved yet" in app.notice


def test_a_passed_level_says_what_its_keys_do(
    stage: tuple[App, ScriptedControls], recording: Recording, tmp_path: Path
) -> None:
    app, controls = stage
    text = write_level_string(recording.level)
    (tmp_path / "two.txt").write_text(f"$one#me#a#{text}#\n$two#me#a#{text}#\n")
    two = LevelScreen(app, FilePlaythrough(app.player, load_levels(str(tmp_path / "two.txt"))))
    alone = LevelScreen(app, level_run(app, recording.level))
    for screen, words in ((two, "Confirm: next level"), (alone, "Confirm: play again")):
        app.push(screen)
        play_to_the_end(app, controls, screen, recording)
        end = hud_view(screen.play).end
        assert end is not None
        assert words in end.lines[-1]
    tap(app, "confirm")
    assert app.top is alone
    assert phase_of(alone) is Phase.READY


def test_nothing_is_written_over_the_level_but_the_passed_panel(app: App, recording: Recording) -> None:
    """Hints of practice and of stepping lie in the border, y >= 576 px."""
    screen = open_level(app, recording, practice_mode=True)
    for actions in (("confirm",), ("quick_save",), ("step",), ()):
        if actions:
            press(*actions)
        frames(app, 60)
        with_hud = app.surface.copy()
        view = screen.play.view
        view.draw(app.surface, screen.play.fraction, whole=True)
        changed = pygame.mask.from_threshold(app.surface, (0, 0, 0), (1, 1, 1, 255), with_hud)
        changed.invert()
        assert changed.count()
        assert all(rect.top >= 576 or rect.bottom <= 24 for rect in changed.get_bounding_rects())
        screen.redraw = True
