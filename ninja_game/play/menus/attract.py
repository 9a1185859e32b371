"""Attract mode: replays that play behind the menu, one after another (game.md §7)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random

import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.files.user_folder import bundled_replays
from ninja_game.formats.load import load_replays
from ninja_game.formats.recording import Recording
from ninja_game.play.app import App
from ninja_game.play.clock import RunClock
from ninja_game.play.replay.playback import Playback
from ninja_game.play.view.level_view import LevelView
from ninja_game.simulation import Simulation

REST_TICKS = 130
"""How long a replay goes on after its end or a death."""


class Attract:
    """Plays replays for ever in a shuffled order, silently. ``shown``: how many were begun."""

    def __init__(self, app: App, *, seed: int | None = None) -> None:
        self.app = app
        self.shown = 0
        self._clock = RunClock()
        self._rng = Random(seed)  # noqa: S311 - the order is no secret
        self._order = self._shuffled()
        self._playback: Playback | None = None
        self._until = 0
        self.view: LevelView | None = None
        self.name = ""

    def _shuffled(self) -> Iterator[Callable[[], Recording]]:
        """Readers of all recordings, again and again, each round in another order."""
        while True:
            files = bundled_replays()
            self._rng.shuffle(files)
            if not files:
                return
            for file in files:
                yield lambda file=file: load_replays(file)[0]  # type: ignore[misc]

    def _begin_next(self) -> None:
        """Put the next recording on the stage; one that cannot be read is left out."""
        for read in self._order:
            try:
                recording = read()
                simulation = Simulation(recording.level)
            except (NinjaGameError, OSError):
                continue
            self._playback = Playback(simulation, recording.inputs, spacing=0)
            self._until = len(self._playback.inputs) + REST_TICKS
            self.view = LevelView(self.app, simulation, seed=self.shown, audible=False)
            self.name = recording.name
            self.shown += 1
            return

    def update(self, real_ms: int) -> None:
        """Let time pass. With reduced motion the picture stands still."""
        playback = self._playback
        if playback is None or self.view is None:
            self._begin_next()
            return
        if self.app.settings.reduced_motion:
            return
        for _ in range(self._clock.ticks_due(real_ms)):
            if playback.tick >= self._until:
                self._begin_next()
                return
            if playback.tick < len(playback.inputs) or playback.simulation.outcome != "running":
                playback.step()
                self.view.on_tick()
            else:
                self._until = 0

    def draw(self, surface: pygame.Surface, *, whole: bool = False) -> list[pygame.Rect] | None:
        """Draw the replay as it is now; the px that changed, None for all."""
        if self.view is None:
            surface.fill(self.app.theme.palette.background)
            return None
        return self.view.draw(surface, self._clock.fraction, whole=whole)
