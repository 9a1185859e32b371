"""Practice tools: quick-save, quick-load, rewind, slow motion, single step. A run with them is not a record."""

from __future__ import annotations

from ninja_game.play.replay.playback import Playback
from ninja_game.player.attempt import Attempt, Moment

SLOW_TICK_MS = 100
"""A tick in slow motion: a quarter of the speed."""
REWIND_TICKS = 2
"""Ticks back for each tick's time that the rewind key is held."""
_SPACING = 10
"""Ticks between save-states, at first."""


class PracticeTools:
    """The tools of one level screen. ``attempt``: what they act on."""

    def __init__(self, attempt: Attempt) -> None:
        self.attempt = attempt
        self.saved: Moment | None = None
        self.slow = False
        self.rewinding = False
        self.stepping = False
        self.restarted()

    def restarted(self) -> None:
        """The attempt began again; a quick-save stays good."""
        self.playback = Playback(self.attempt.simulation, self.attempt.inputs, spacing=_SPACING)
        self.rewinding = self.stepping = False

    def on_tick(self) -> None:
        """Call it after every tick."""
        self.playback.note()

    def quick_save(self) -> None:
        """Keep this moment."""
        self.saved = self.attempt.save()

    def quick_load(self) -> bool:
        """Go back to the kept moment; whether there is one."""
        if self.saved is None:
            return False
        self.attempt.restore(self.saved)
        self.playback.forget_after(self.attempt.simulation.tick)
        return True

    def rewind(self, ticks: int) -> None:
        """Go back in time."""
        attempt = self.attempt
        target = max(0, attempt.simulation.tick - ticks)
        self.playback.seek(target)
        self.playback.forget_after(target)
        attempt.rewound()
