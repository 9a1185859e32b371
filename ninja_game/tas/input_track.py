"""A run as its maker edits it: the keys of every tick, and names for some of the ticks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ninja_game.errors import ArgumentError
from ninja_game.formats.replay.input_runs import Marker
from ninja_game.formats.replay.input_text import marker_name
from ninja_game.sim.inputs import JUMP_HELD, KEYS_DOWN, MAX_TICKS, pressed


@dataclass(frozen=True)
class InputTrack:
    """``inputs``: one byte per tick, the sum of its ``Input`` flags; in ticks beyond them no key is down.

    The jump triggers where the key goes down. A recording that is odd there (``Input.JUMP_PRESSED`` without the key, or
    a key that goes down without it) stays as it is in all ticks that are not edited.
    """

    inputs: bytes
    markers: tuple[Marker, ...] = ()

    def __len__(self) -> int:
        return len(self.inputs)

    def keys_at(self, tick: int) -> int:
        """The keys that are down in a tick, a sum of left, right and jump."""
        return self.inputs[tick] & KEYS_DOWN if 0 <= tick < len(self.inputs) else 0

    def replaced(self, first: int, last: int, keys: Sequence[int]) -> InputTrack:
        """Other keys instead of the ticks ``first`` … ``last`` - 1; what follows moves if they are more or fewer.

        All edits are this one. Where the run ends before ``first``, ticks without a key are put between. Markers of
        ticks that are dropped go; those behind move. Raises ArgumentError for ticks that there cannot be.
        """
        if not 0 <= first <= last:
            raise ArgumentError(f"ticks {first} to {last} are not a span")
        if first + len(keys) + max(0, len(self.inputs) - last) > MAX_TICKS:
            raise ArgumentError(f"a run has at most {MAX_TICKS} ticks")
        before = self.inputs[:first].ljust(first, b"\0")
        held = before[-1] & JUMP_HELD if before else 0
        made = bytearray()
        for key in keys:
            made.append(pressed(key, held))
            held = key & JUMP_HELD
        after = bytearray(self.inputs[last:])
        if after:
            after[0] = self._joined(last, held)
        return InputTrack(before + bytes(made) + bytes(after), self._markers_after(first, last, len(made)))

    def _joined(self, tick: int, held: int) -> int:
        """A tick behind an edit: it triggers as the keys say, unless it was odd before."""
        keys, held_before = self.inputs[tick], self.inputs[tick - 1] & JUMP_HELD if tick else 0
        return pressed(keys, held) if keys == pressed(keys, held_before) else keys

    def _markers_after(self, first: int, last: int, count: int) -> tuple[Marker, ...]:
        """The markers when ``count`` ticks stand for the ticks ``first`` … ``last`` - 1."""
        kept = []
        for tick, name in self.markers:
            if tick >= last:
                kept.append(Marker(tick + count - (last - first), name))
            elif tick < first + count:
                kept.append(Marker(tick, name))
        return tuple(kept)

    def with_key(self, first: int, last: int, key: int, *, down: bool) -> InputTrack:
        """A key down, or up, in the ticks ``first`` … ``last`` - 1. The run grows if it ends before them."""
        if last > MAX_TICKS:
            raise ArgumentError(f"a run has at most {MAX_TICKS} ticks")
        keys = [self.keys_at(tick) | key if down else self.keys_at(tick) & ~key for tick in range(first, last)]
        return self.replaced(first, last, keys)

    def named(self, tick: int, name: str) -> InputTrack:
        """With another name for a tick, blanks as '-'; '': without one. The run grows if it ends before the tick.

        Raises ReplayError for a name that replay texts cannot hold, ArgumentError for a tick that there cannot be.
        """
        name = name.strip().replace(" ", "-")
        name = name and marker_name(name)
        if not 0 <= tick <= MAX_TICKS:
            raise ArgumentError(f"a run has at most {MAX_TICKS} ticks")
        others = [marker for marker in self.markers if marker.tick != tick and marker.name != name]
        if not name:
            return InputTrack(self.inputs, tuple(others))
        return InputTrack(self.inputs.ljust(tick, b"\0"), tuple(sorted([*others, Marker(tick, name)])))

    def first_difference(self, other: InputTrack) -> int:
        """The first tick whose input differs; the length of the shorter one if none does."""
        return first_difference(self.inputs, other.inputs)


def first_difference(ours: bytes, theirs: bytes) -> int:
    """The first index at which bytes differ; the length of the shorter ones if none does."""
    shared = min(len(ours), len(theirs))
    unequal = np.frombuffer(ours, np.uint8, shared) != np.frombuffer(theirs, np.uint8, shared)
    return int(np.argmax(unequal)) if unequal.any() else shared
