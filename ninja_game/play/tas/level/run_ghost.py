"""The ninja of another run as a ghost: where that run's trajectory has it, without a world of its own."""

from __future__ import annotations

from random import Random

import pygame

from ninja_game.play.ui.canvas import Point
from ninja_game.play.ui.theme import Palette
from ninja_game.play.view.ninja.ninja_animation import NinjaAnimation
from ninja_game.sim.memory.schema import World
from ninja_game.tas.timeline import Trajectory

_WARM = 12
"""Ticks that its figure follows before the one that is sought."""


class RunGhost:
    """``label``: the run's name. ``shade``: its colour, None: the palette's for ghosts. It has ticks."""

    def __init__(self, trajectory: Trajectory, label: str = "", shade: pygame.Color | None = None) -> None:
        self.trajectory = trajectory
        self.label = label
        self.shade = shade
        self._world = World()
        self._random = Random(1)  # noqa: S311 - presentation
        self.on_seek(0)

    def _follow(self, tick: int) -> None:
        """The fields of the ninja after a tick."""
        ninja = self._world.ninja
        ninja.was_in_air = ninja.in_air
        for name, value in self.trajectory.at(max(0, tick)).items():
            setattr(ninja, name, value)

    def on_tick(self) -> None:
        """One more tick."""
        self._moment += 1
        if self._moment <= len(self.trajectory):
            self._follow(self._moment - 1)
            self.ninja_animation.on_tick(self._world)

    def on_seek(self, tick: int) -> None:
        """Be where the run is after that many ticks."""
        self._moment = max(0, min(tick, len(self.trajectory)) - _WARM)
        self._follow(self._moment - 1)
        self.ninja_animation = NinjaAnimation(self._world, self._random)
        while self._moment < min(tick, len(self.trajectory)):
            self.on_tick()
        self._moment = tick

    def place(self, fraction: float) -> Point:
        """Where to draw it."""
        now, before = self.trajectory.at(max(0, self._moment - 1)), self.trajectory.at(max(0, self._moment - 2))
        (bx, by), (x, y) = (before["x"], before["y"]), (now["x"], now["y"])
        return bx + (x - bx) * fraction, by + (y - by) * fraction

    def colour(self, palette: Palette) -> pygame.Color:
        """Its own colour, or the palette's for ghosts."""
        return self.shade or palette.ghost
