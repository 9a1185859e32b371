"""The bench opened on a run that is being watched."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ninja_game.errors import NinjaGameError
from ninja_game.formats.recording import Recording

if TYPE_CHECKING:
    from ninja_game.play.app import App


def open_bench(app: App, recording: Recording, beside: Sequence[Recording], tick: int) -> None:
    """Open the bench on a run, with others of its level beside it; a notice where that is impossible."""
    try:
        # They import NumPy, which watching does without.
        from ninja_game.play.tas.screen import TasScreen
        from ninja_game.tas.files import open_recording, same_level

        opened = open_recording(recording)
        screen = TasScreen(app, opened, [each for each in beside if same_level(each, recording)])
    except (NinjaGameError, OSError) as error:
        app.notify(f"It cannot be edited: {getattr(error, 'strerror', '') or error}")
        return
    screen.bench.go(tick)
    app.push(screen)
