"""Open the replay viewer on what the records have."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from ninja_game.errors import LevelError
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.simulation import Body

if TYPE_CHECKING:
    from ninja_game.play.app import App
    from ninja_game.play.replay.playback import Take


def watch(app: App, replays: Iterable[Replay | None], title: str = "") -> bool:
    """Watch replays one after another; whether there were any. Those that have gone are left out."""
    from ninja_game.play.replay.playback import Take

    takes = [
        Take(title or replay.name or "Replay", replay.level, replay.playback(replay.ticks), _body(replay))
        for replay in replays
        if replay is not None and replay.level is not None
    ]
    if takes:
        _open(app, takes)
    return bool(takes)


def _body(replay: Replay) -> Body:
    return "box" if replay.body == "box" else "circle"


def watch_recording(app: App, recording: Recording) -> None:
    """Watch a recording from a file."""
    _open(app, [recording])


def _open(app: App, takes: Sequence[Take | Recording]) -> None:
    """Open the viewer; a notice says why a level cannot be shown."""
    from ninja_game.play.replay.screen import ReplayScreen

    try:
        app.push(ReplayScreen(app, takes))
    except LevelError as error:
        app.notify(error.what)
