"""Ghosts: recordings that run along in worlds of their own, drawn behind the ninja."""

from __future__ import annotations

from random import Random

import pygame

from ninja_game.budget import TURN_WORK, tick_cost
from ninja_game.play.replay.playback import Playback
from ninja_game.play.ui.canvas import Point
from ninja_game.play.ui.theme import Palette
from ninja_game.play.view.ninja.ninja_animation import NinjaAnimation
from ninja_game.player.playthrough import GhostRun
from ninja_game.sim.level import Level
from ninja_game.sim.states import CELEBRATING, DEAD
from ninja_game.simulation import Body, Simulation


class Ghost:
    """One recording, ticking along.

    ``behind``: ticks that it lags behind after a leap: it catches up by the work of a turn with each tick. Not
    ``alone``: only when it is told to.
    """

    def __init__(self, run: GhostRun, level: Level, body: Body, *, alone: bool = True) -> None:
        self.label = run.label
        self.inputs = run.inputs
        self._colour = run.colour
        self.simulation = Simulation(level, body=body)
        self._playback = Playback(self.simulation, run.inputs, spacing=0)
        self.ninja_animation = NinjaAnimation(self.simulation.world, Random(1))  # noqa: S311 - presentation
        self._before = self._now = self._place()
        self._turn = max(1, TURN_WORK // tick_cost(level)) if alone else 0
        self.behind = 0

    def _place(self) -> Point:
        n = self.simulation.world.ninja
        return n.x, n.y

    @property
    def over(self) -> bool:
        """Whether it has reached its end; it then stays where it is."""
        return self.simulation.world.ninja.state in {DEAD, CELEBRATING}

    def on_tick(self) -> None:
        """One more tick."""
        self._before = self._now
        if self.behind:
            self.behind += 1
            self.catch_up(self._turn)
        elif not self.over:
            self._playback.step()
            self.ninja_animation.on_tick(self.simulation.world)
            self._now = self._place()

    def on_seek(self, tick: int) -> None:
        """Be where the recording is after that many ticks, or on the way to there."""
        if tick < self.simulation.tick or self.over:
            self._playback.seek(0)
        self.behind = tick - self.simulation.tick
        self.catch_up(self._turn)

    def catch_up(self, most: int) -> int:
        """Go on after a leap for this many ticks at most; how many it was."""
        before = self.simulation.tick
        ticks = min(self.behind, most)
        self.behind -= ticks
        while ticks and not self.over:
            self._playback.step()
            ticks -= 1
        if self.over:
            self.behind = 0
        self.ninja_animation.reset(self.simulation.world)
        self._before = self._now = self._place()
        return self.simulation.tick - before

    def place(self, fraction: float) -> Point:
        (bx, by), (x, y) = self._before, self._now
        return bx + (x - bx) * fraction, by + (y - by) * fraction

    def colour(self, palette: Palette) -> pygame.Color:
        """Its own colour, or the palette's for ghosts."""
        return pygame.Color(self._colour) if self._colour else palette.ghost
