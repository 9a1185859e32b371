"""Inputs: the keys of every tick, independent of the text format that stores them (game.md §4)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import IntFlag

from ninja_game.errors import DemoError
from ninja_game.sim.schema.declare import fast


class Input(IntFlag):
    """The keys of one tick as a number from 0 to 15: which keys are down, and whether jump went down in this tick."""

    LEFT = 1
    RIGHT = 2
    JUMP_HELD = 4
    JUMP_PRESSED = 8


KEY_LEFT, KEY_RIGHT, JUMP_HELD, JUMP_PRESSED = (int(key) for key in Input)
"""The flags of ``Input`` as plain numbers: rules that use them can be compiled."""

MOVES = (("left", KEY_LEFT), ("right", KEY_RIGHT), ("jump", JUMP_HELD))  # the three keys, by name

ALL_KEYS = KEY_LEFT + KEY_RIGHT + JUMP_HELD + JUMP_PRESSED
KEYS_DOWN = KEY_LEFT + KEY_RIGHT + JUMP_HELD
_VALID = bytes(range(ALL_KEYS + 1))
_DOWN = bytes(keys & KEYS_DOWN for keys in range(256))
_HELD = bytes(JUMP_PRESSED if keys & JUMP_HELD else 0 for keys in range(256))


@fast
def with_press_bit(keys: int, held: int) -> int:
    """Add JUMP_PRESSED to the keys of a tick if jump is down and was not ``held`` down before."""
    down = keys & KEYS_DOWN
    return down + JUMP_PRESSED if down & JUMP_HELD and not held else down


def with_press_bits(inputs: Iterable[int]) -> bytes:
    """Set JUMP_PRESSED in every tick in which the jump key goes down, and clear it in all others."""
    keys = inputs if isinstance(inputs, bytes) else bytes(list(inputs))
    # All ticks at once, as one long number with a byte for each tick.
    down = int.from_bytes(keys.translate(_DOWN), "little")
    held = int.from_bytes(keys.translate(_HELD), "little")
    return (down | held & ~(held << 8)).to_bytes(len(keys), "little")


MAX_TICKS = 1_000_000
"""Longest run, almost seven hours. The limit keeps a wrong number in a file from filling the memory."""


def fit_inputs(inputs: bytes, ticks: int) -> bytes:
    """Cut inputs to ``ticks`` ticks or add ticks without keys. Raises DemoError for more than MAX_TICKS."""
    if not 0 <= ticks <= MAX_TICKS:
        raise DemoError("a run of too many ticks", found=str(ticks)[:20], expected=f"0 to {MAX_TICKS}")
    return inputs[:ticks].ljust(ticks, b"\0")


MAX_DEMO_TICKS = 25_193  # the game stops recording at this length, ticks


@dataclass(frozen=True)
class Demo:
    """A recording's inputs.

    ``inputs``: one byte per tick from tick 0, the sum of its ``Input`` flags; after their end no key is down.
    ``length``: the number of ticks that the recording claims; a text may claim a fraction, NaN or an absurd number.
    ``missing``: how many of the claimed inputs the text lacks; no key is down in them.
    """

    inputs: bytes
    length: float
    missing: int = field(default=0, compare=False)

    @property
    def end(self) -> int:
        """The first tick after the recording: its length, rounded up; 0 if the length is not a number.

        It is at most the number of inputs or MAX_DEMO_TICKS, the greater of both, so an absurd length costs nothing.
        """
        if not self.length > 0:
            return 0
        limit = max(len(self.inputs), MAX_DEMO_TICKS)
        return limit if self.length >= limit else math.ceil(self.length)

    def playback(self, ticks: int) -> bytes:
        """The inputs of the first ``ticks`` ticks in playback (game.md §4.4).

        Playback uses input k while k < length, then the last input once more (with its press of jump), then no key.
        """
        end = self.end
        played = fit_inputs(self.inputs, end)
        return fit_inputs(played + played[-1:], ticks)


def fit_demo(inputs: bytes, length: float) -> Demo:
    """Make a demo with exactly the inputs that it plays: drop superfluous ones, add missing ones (no key down)."""
    demo = Demo(inputs, length)
    return Demo(fit_inputs(inputs, demo.end), length, max(0, demo.end - len(inputs)))


def check_inputs(inputs: bytes) -> None:
    """Raise DemoError for more than MAX_TICKS ticks, and for a tick with bits that ``Input`` does not have."""
    if len(inputs) > MAX_TICKS:
        raise DemoError("a run of too many ticks", found=str(len(inputs)), expected=f"0 to {MAX_TICKS}")
    wrong = inputs.translate(None, _VALID)
    if wrong:
        tick = inputs.index(wrong[:1])
        raise DemoError(f"tick {tick} has unknown keys", found=str(wrong[0]), expected=f"0 to {ALL_KEYS}")
