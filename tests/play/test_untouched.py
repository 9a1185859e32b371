"""Nothing that is drawn touches the world: digests are those of bare runs with everything on."""

from pathlib import Path

import pytest

from ninja_game.formats.load import load_replays
from ninja_game.play.level.level_play import Phase
from ninja_game.play.level.screen import LevelScreen
from ninja_game.player.playthrough import PacedRun
from ninja_game.simulation import Simulation
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.overlays import OVERLAY_ACTIONS
from tests.support.own_pack import PACK
from tests.support.scripted import frames, level_run, press, release, scripted_app, tap
from tests.support.slow import the_rest_is_slow

REPLAYS = sorted(PACK.glob("certificates/*.replay.txt"))
AFTER = 60


def bare_digests(path: Path) -> list[str]:
    """The digest after every tenth tick of a run that nobody looks at."""
    recording = load_replays(path)[0]
    run = Simulation(recording.level)
    digests = []
    inputs = recording.inputs + bytes(AFTER)
    for keys in inputs:
        run.step_keys(keys)
        if run.tick % 10 == 0:
            digests.append(run.digest())
    return digests


@pytest.mark.parametrize("path", the_rest_is_slow({path.name.split(".")[0]: path for path in reversed(REPLAYS)}, 2))
def test_a_run_with_everything_on_is_the_bare_run(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    recording = load_replays(path)[0]
    digests = []
    inputs = recording.inputs
    with scripted_app((396, 300), palette="safe-dark", show_keys=True) as (app, controls):
        run = level_run(app, recording.level)
        monkeypatch.setattr(run, "ghosts", lambda: [PacedRun(inputs[: len(inputs) // 2])])
        screen = LevelScreen(app, run)
        screen.overlays.on = set(OVERLAY_ACTIONS)
        screen.play.view.ghosts = [*screen.play.view.ghosts]
        app.push(screen)
        controls.script = iter(b"\0" + inputs)
        press("confirm")
        frames(app, 1, 0)
        controls.script = iter(inputs)
        while screen.attempt.simulation.tick < len(inputs) + AFTER:
            before = screen.attempt.simulation.tick
            frames(app)
            # The picture stands still for a moment at the exit.
            if screen.attempt.simulation.tick % 10 == 0 and screen.attempt.simulation.tick != before:
                digests.append(screen.attempt.simulation.digest())
        assert len(screen.play.view.ghosts) == 1
    assert digests == bare_digests(path)


def test_rewinding_again_and_again_changes_nothing() -> None:
    recording = load_replays(REPLAYS[-1])[0]
    inputs = recording.inputs
    with scripted_app((396, 300)) as (app, controls):
        screen = LevelScreen(app, level_run(app, recording.level, practice_mode=True))
        app.push(screen)
        press("confirm")
        frames(app, 1, 0)
        while screen.phase is Phase.PLAY:
            tick = screen.attempt.simulation.tick
            controls.script = iter(inputs[tick:])
            frames(app, 37)
            tap(app, "rewind", pictures=4)
            release("rewind")
            frames(app, 1, 0)
            tick = screen.attempt.simulation.tick
            controls.script = iter(inputs[tick:])
            frames(app, min(30, max(1, len(inputs) - tick)))
        assert screen.attempt.outcome == "exit"
        assert screen.attempt.replay().digest == getattr(recording.replay, "digest", None)


def test_looking_only_reads() -> None:
    """A view drawn twice as often, with a ghost, leaves a world in which every field is as without."""
    recording = load_replays(REPLAYS[-1])[0]
    bare, seen = Simulation(recording.level), Simulation(recording.level)
    sheet = OffscreenContext((396, 300))
    view = LevelView(sheet, seen, seed=5)
    import pygame

    from ninja_game.play.replay.playback import Ghost

    surface = pygame.Surface((396, 300))
    view.ghosts = [Ghost(b"", recording.level, "circle")]
    for keys in recording.inputs:
        bare.step_keys(keys)
        seen.step_keys(keys)
        view.on_tick()
        view.draw(surface, 0.3)
        view.draw(surface, 0.8)
        assert bare.first_difference(seen) is None
