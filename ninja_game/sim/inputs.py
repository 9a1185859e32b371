"""The inputs of a recording, one frame a tick, apart from the text they are written in (game.md §4)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ninja_game.errors import DemoError

LEFT, RIGHT, HELD, TRIGGERED = 1, 2, 4, 8
"""Bits of a frame: the keys that are down, and whether the jump key was pressed just now."""

MAX_FRAMES = 25_193
"""The game closes a recording at this length."""


@dataclass(frozen=True)
class Demo:
    """A recording's inputs.

    ``frames``: one byte a tick from tick 0, 1 left + 2 right + 4 jump held + 8 jump triggered; in ticks beyond them no
    key is down. ``length``: how many ticks the recording claims; texts may claim a fraction, NaN or the absurd.
    """

    frames: bytes
    length: float

    @property
    def end(self) -> int:
        """The first tick that is not the recording's: N for a passed level, 0 if the length is no number.

        Never beyond both the frames and the longest recording that the game makes: an absurd length costs nothing.
        """
        if not self.length > 0:
            return 0
        limit = max(len(self.frames), MAX_FRAMES)
        return limit if self.length >= limit else math.ceil(self.length)

    def inputs(self, ticks: int) -> bytes:
        """The input of each of the first ``ticks`` ticks in playback (game.md §4.4).

        Frame k while k < length; then the last frame once more, trigger and all; then no key.
        """
        end = self.end
        played = self.frames[:end].ljust(end, b"\0")
        return (played + played[-1:])[:ticks].ljust(ticks, b"\0")


def fitted_demo(frames: bytes, length: float) -> Demo:
    """The demo with as many frames as it plays: superfluous ones dropped, missing ones added (no key)."""
    demo = Demo(frames, length)
    return Demo(frames[: demo.end].ljust(demo.end, b"\0"), length)


def check_frames(frames: bytes) -> None:
    """Raise DemoError for a frame with other bits than the four keys'."""
    for tick, frame in enumerate(frames):
        if frame > 15:
            raise DemoError(f"the input of tick {tick} is none", found=str(frame), expected="0 to 15")
