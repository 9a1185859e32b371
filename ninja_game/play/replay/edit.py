"""From the replay viewer to the bench."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ninja_game.errors import NinjaGameError
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.play.replay.playback import RecordedRun
from ninja_game.runtime import require_desktop
from ninja_game.sim.inputs import Demo

if TYPE_CHECKING:
    from ninja_game.play.app import App


def edit_run(app: App, run: RecordedRun, others: Sequence[RecordedRun], tick: int) -> None:
    """Open the bench on a run, with others of its level beside it; a notice where that is impossible."""
    try:
        require_desktop()
        # They import NumPy, which watching does without.
        from ninja_game.play.tas.screen import TasScreen
        from ninja_game.tas.files import open_recording, same_level

        recording = _recording_of(run, app.settings.name)
        beside = [_recording_of(each, app.settings.name) for each in others]
        opened = open_recording(recording)
        screen = TasScreen(app, opened, [each for each in beside if same_level(each, recording)])
    except (NinjaGameError, OSError) as error:
        app.notify(f"It cannot be edited: {getattr(error, 'strerror', '') or error}")
        return
    screen.bench.go(tick)
    app.push(screen)


def _recording_of(run: RecordedRun, player: str) -> Recording:
    """What a run is from; one that was only played is the player's."""
    if run.recording is not None:
        return run.recording
    replay = run.replay or Replay(
        run.inputs, max(0, len(run.inputs) - 1), "", name=run.title, author=player, body=run.body, level=run.level
    )
    demo = Demo(replay.inputs, float(len(replay.inputs)))
    return Recording(replay.name, replay.author, "", run.level, demo, "", replay=replay)
