"""What a picture of a world needs: settings, palette, canvas, audio output. `App`, `OffscreenContext`."""

from __future__ import annotations

from typing import Protocol

from ninja_game.play.audio.player import AudioOutput
from ninja_game.play.ui.canvas import Canvas
from ninja_game.play.ui.theme import Theme, palette_named
from ninja_game.player.settings import Settings


class RenderContext(Protocol):
    """Where a level is shown."""

    theme: Theme
    canvas: Canvas
    audio_output: AudioOutput

    @property
    def settings(self) -> Settings:
        """What the player has chosen."""


class OffscreenContext:
    """A silent context without a window, for pictures and films. ``size``: px."""

    def __init__(self, size: tuple[int, int], settings: Settings | None = None) -> None:
        self.settings = settings or Settings()
        self.canvas = Canvas(size)
        self.theme = Theme(palette_named(self.settings.palette), self.canvas)
        self.audio_output = AudioOutput()
