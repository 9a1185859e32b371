"""Open the replay viewer on what the records or a file have."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ninja_game.errors import LevelError
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.play.replay.screen import ReplayScreen

if TYPE_CHECKING:
    from ninja_game.play.app import App


def watch(app: App, replays: Iterable[Replay | None]) -> bool:
    """Watch replays of the records one after another; whether there were any. Those that have gone are left out."""
    runs = [Recording(replay.level, replay) for replay in replays if replay is not None and replay.level is not None]
    if runs:
        app.push(ReplayScreen(app, runs))
    return bool(runs)


def watch_recording(app: App, recording: Recording) -> None:
    """Watch a recording from a file; a notice says why where its level cannot be played."""
    try:
        app.push(ReplayScreen(app, [recording]))
    except LevelError as error:
        app.notify(f"{recording.name or 'The replay'} cannot be watched: {error.what}")
