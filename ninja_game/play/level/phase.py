"""The phases of a level being played (game.md §2)."""

from __future__ import annotations

from enum import Enum

DEATH_PAUSE = 41
"""Ticks after a death before the message comes."""


class Phase(Enum):
    """Where in its life a level is."""

    READY = "ready"
    PLAY = "play"
    PAUSED = "paused"
    DEAD = "dead"
    PASSED = "passed"


PHASE_OF_OUTCOME = {"running": Phase.PLAY, "dead": Phase.DEAD, "exit": Phase.PASSED}
"""The phase in which an attempt with that outcome goes on."""
