"""What a picture of a world needs: options, palette, canvas, audio output. `App` is one, `OffscreenContext` another."""

from __future__ import annotations

from typing import Protocol

from ninja_game.play.audio.output import AudioOutput, NullAudio
from ninja_game.play.options import Options
from ninja_game.play.ui.canvas import Canvas
from ninja_game.play.ui.palette import PALETTES
from ninja_game.play.ui.theme import Theme


class RenderContext(Protocol):
    """Where a level is shown."""

    options: Options
    theme: Theme
    canvas: Canvas
    audio_output: AudioOutput


class OffscreenContext:
    """A silent scene without a window, for pictures and films. ``size``: px."""

    def __init__(self, size: tuple[int, int], options: Options | None = None) -> None:
        self.options = options or Options()
        self.canvas = Canvas(size)
        self.theme = Theme(PALETTES[self.options.palette], self.canvas)
        self.audio_output: AudioOutput = NullAudio()
