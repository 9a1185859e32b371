"""Inputs: the keys of every tick, apart from the text they are written in (game.md §4)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import IntFlag

from ninja_game.errors import DemoError
from ninja_game.sim.memory.declare import fast


class Input(IntFlag):
    """The keys of one tick, as one number from 0 to 15: which are down, and whether jump was pressed just now."""

    LEFT = 1
    RIGHT = 2
    JUMP_HELD = 4
    JUMP_PRESSED = 8


KEY_LEFT, KEY_RIGHT, JUMP_HELD, JUMP_PRESSED = (int(key) for key in Input)
"""The flags of ``Input`` as plain numbers, which rules compile."""

MOVES = (("left", KEY_LEFT), ("right", KEY_RIGHT), ("jump", JUMP_HELD))
"""The three keys by name."""

ALL_KEYS = KEY_LEFT + KEY_RIGHT + JUMP_HELD + JUMP_PRESSED
KEYS_DOWN = KEY_LEFT + KEY_RIGHT + JUMP_HELD
_VALID = bytes(range(ALL_KEYS + 1))
_DOWN = bytes(keys & KEYS_DOWN for keys in range(256))
_HELD = bytes(JUMP_PRESSED if keys & JUMP_HELD else 0 for keys in range(256))


@fast
def with_press_bit(keys: int, held: int) -> int:
    """The keys of a tick with JUMP_PRESSED where the jump key goes down: it is down and was not (``held``) before."""
    down = keys & KEYS_DOWN
    return down + JUMP_PRESSED if down & JUMP_HELD and not held else down


def with_press_bits(inputs: Iterable[int]) -> bytes:
    """Inputs with JUMP_PRESSED in every tick in which the jump key goes down, and in no other."""
    keys = inputs if isinstance(inputs, bytes) else bytes(list(inputs))
    # All ticks at once, as one long number with a byte for each tick.
    down = int.from_bytes(keys.translate(_DOWN), "little")
    held = int.from_bytes(keys.translate(_HELD), "little")
    return (down | held & ~(held << 8)).to_bytes(len(keys), "little")


MAX_TICKS = 1_000_000
"""Longest run, almost seven hours: a slip in a number must not fill the memory."""


def fit_inputs(inputs: bytes, ticks: int) -> bytes:
    """The inputs of the first ``ticks`` ticks; beyond them no key is down. Raises DemoError for more than a million."""
    if not 0 <= ticks <= MAX_TICKS:
        raise DemoError("a run of too many ticks", found=str(ticks)[:20], expected=f"0 to {MAX_TICKS}")
    return inputs[:ticks].ljust(ticks, b"\0")


MAX_DEMO_TICKS = 25_193
"""The game closes a recording at this length."""


@dataclass(frozen=True)
class Demo:
    """A recording's inputs.

    ``inputs``: one byte per tick from tick 0, the sum of its ``Input`` flags; in ticks beyond them no key is down.
    ``length``: how many ticks the recording claims; texts may claim a fraction, NaN or the absurd. ``missing``: how
    many inputs it claims that its text does not hold; no key is down in them.
    """

    inputs: bytes
    length: float
    missing: int = field(default=0, compare=False)

    @property
    def end(self) -> int:
        """The first tick after the recording: its length, rounded up; 0 if the length is not a number.

        Never beyond both the inputs and the longest recording that the game makes: an absurd length costs nothing.
        """
        if not self.length > 0:
            return 0
        limit = max(len(self.inputs), MAX_DEMO_TICKS)
        return limit if self.length >= limit else math.ceil(self.length)

    def playback(self, ticks: int) -> bytes:
        """The input of each of the first ``ticks`` ticks in playback (game.md §4.4).

        Input k while k < length; then the last one once more, its press of jump too; then no key.
        """
        end = self.end
        played = fit_inputs(self.inputs, end)
        return fit_inputs(played + played[-1:], ticks)


def fit_demo(inputs: bytes, length: float) -> Demo:
    """The demo with as many inputs as it plays: superfluous ones dropped, missing ones added (no key)."""
    demo = Demo(inputs, length)
    return Demo(fit_inputs(inputs, demo.end), length, max(0, demo.end - len(inputs)))


def check_inputs(inputs: bytes) -> None:
    """Raise DemoError for more than a million ticks, and for a tick with other bits than those of ``Input``."""
    if len(inputs) > MAX_TICKS:
        raise DemoError("a run of too many ticks", found=str(len(inputs)), expected=f"0 to {MAX_TICKS}")
    wrong = inputs.translate(None, _VALID)
    if wrong:
        tick = inputs.index(wrong[:1])
        raise DemoError(f"tick {tick} has unknown keys", found=str(wrong[0]), expected=f"0 to {ALL_KEYS}")
