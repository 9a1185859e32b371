"""Save-states of a run at even distances, so that going to any of its ticks is quick."""

from __future__ import annotations

from bisect import bisect_right
from typing import Generic, TypeVar

State = TypeVar("State")

SPACING = 60  # a save-state every this many ticks, at first
MAX_STATES = 300
"""With more save-states than this every second one is dropped, so that a run of any length fits into the memory."""

MAX_VALUES = 300_000  # in all save-states together, some 100 MB
MIN_STATES = 10  # that there may be even of the largest level and run


class SaveStates(Generic[State]):
    """The save-states of one run, by tick. ``first``: its start, always kept. ``spacing`` 0: only the start is kept.

    ``values``: about how many numbers a state holds; fewer large ones are kept.
    """

    def __init__(self, tick: int, first: State, *, spacing: int = SPACING, values: int = 0) -> None:
        self.spacing = spacing
        self._most = min(MAX_STATES, max(MIN_STATES, MAX_VALUES // max(1, values)))
        self._ticks = [tick]
        self._states = [first]

    def __len__(self) -> int:
        return len(self._ticks)

    def wants(self, tick: int) -> bool:
        """Whether a state of this tick is due and not kept yet."""
        if not self.spacing or tick % self.spacing:
            return False
        return self._ticks[self._at(tick)] != tick

    def keep(self, tick: int, state: State) -> None:
        at = self._at(tick) + 1
        self._ticks.insert(at, tick)
        self._states.insert(at, state)
        if len(self._ticks) > self._most:
            self.spacing *= 2
            del self._ticks[1::2], self._states[1::2]

    def nearest(self, tick: int) -> tuple[int, State]:
        """The last state at or before a tick, and its tick."""
        at = self._at(tick)
        return self._ticks[at], self._states[at]

    def forget_after(self, tick: int) -> None:
        """Drop the save-states after a tick: the inputs differ from there on."""
        keep = self._at(tick) + 1
        del self._ticks[keep:], self._states[keep:]

    def _at(self, tick: int) -> int:
        return max(0, bisect_right(self._ticks, tick) - 1)
