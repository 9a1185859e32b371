"""Practice tools: quick-save, quick-load, rewind, slow motion, single step. A run with them is no record."""

from __future__ import annotations

from ninja_game.play.replay.timeline import Timeline
from ninja_game.player.attempt import Attempt, Moment

SLOW_TICK_MS = 100
"""A tick in slow motion: a quarter of the speed."""
REWIND_TICKS = 2
"""Ticks back for each tick's time that the rewind key is held."""
_SPACING, _MOST = 10, 480
"""A save-state every quarter of a second, for two minutes."""


class Practice:
    """The tools of one level screen. ``attempt``: what they act on."""

    def __init__(self, attempt: Attempt) -> None:
        self.attempt = attempt
        self.saved: Moment | None = None
        self.slow = False
        self.rewinding = False
        self.stepping = False
        self.restarted()

    def restarted(self) -> None:
        """The attempt began anew; a quick-save stays good."""
        self.timeline = Timeline(self.attempt.simulation, spacing=_SPACING, most=_MOST)
        self.rewinding = False

    def on_tick(self) -> None:
        """Call it after every tick."""
        self.timeline.note()

    def quick_save(self) -> None:
        """Keep this moment."""
        self.saved = self.attempt.save()

    def quick_load(self) -> bool:
        """Go back to the kept moment; whether there is one."""
        if self.saved is None:
            return False
        self.attempt.restore(self.saved)
        self.timeline.forget_after(self.attempt.simulation.tick)
        return True

    def rewind(self, ticks: int) -> None:
        """Go back in time."""
        attempt = self.attempt
        target = max(0, attempt.simulation.tick - ticks)
        self.timeline.seek(target, attempt.inputs)
        self.timeline.forget_after(target)
        attempt.rewound()
