"""The world after any tick of the run, drawn as the game draws it."""

from __future__ import annotations

import pygame

from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.tas.level.camera import Camera
from ninja_game.play.tas.level.run_ghost import RunGhost
from ninja_game.play.ui.canvas import Canvas, Point
from ninja_game.play.view.level_view import LevelView
from ninja_game.play.view.ninja.ragdoll import Ragdoll
from ninja_game.play.view.render_context import OffscreenContext
from ninja_game.sim.inputs import fitted_inputs
from ninja_game.sim.memory.schema import World
from ninja_game.simulation import SaveState, Simulation

_WARM = 4
"""Ticks that are run with their animations before the one that is sought, so that it looks as if played."""
_NEAR = 6
"""Ticks that are played on to, rather than sought."""


_FALL = 40
"""Ticks after which a corpse lies still."""


class CachedWorldSimulation(Simulation):
    """A simulation whose world is copied once a tick at most."""

    _copy: World | None = None

    @property
    def world(self) -> World:
        """The whole state as plain objects, as it is in this tick."""
        if self._copy is None:
            self._copy = super().world
        return self._copy

    def step_keys(self, keys: int) -> None:
        """Advance one tick with these keys."""
        self._copy = None
        super().step_keys(keys)

    def restore(self, state: SaveState) -> None:
        """Go back to a saved moment."""
        self._copy = None
        super().restore(state)


class LevelPicture:
    """``canvas``: from px of the level to px of ``surface``, which is the picture. ``run``: what it shows.

    ``camera``: which part of the level.
    """

    def __init__(self, editor: TasEditor) -> None:
        self.editor = editor
        session = editor.session
        self.run = CachedWorldSimulation(session.about.level, body=session.about.body, memory=session.timeline.memory)
        self._context = OffscreenContext((1, 1), editor.app.settings)
        self._view: LevelView | None = None
        self.surface = pygame.Surface((1, 1))
        self.camera = Camera()
        self._seen: tuple[object, ...] = ()

    @property
    def canvas(self) -> Canvas:
        """From px of the level to px of the picture."""
        return self._context.canvas

    @property
    def tick(self) -> int:
        """The tick after which the world is shown; -1 at the start."""
        return self.run.tick - 1

    def fit(self, size: tuple[int, int]) -> bool:
        """Have a size, px, the player's settings and what the camera shows; whether all is to be drawn again."""
        app, seen = self.editor.app, (size, *self.camera.render_key)
        settings = app.settings.changed(show_ghost=True)
        if self._view is not None and self._context.settings.palette == settings.palette and size == self._seen[0]:
            self._context.settings = settings
            if seen == self._seen:
                return False
        else:
            self._context = OffscreenContext(size, settings)
            self._context.audio_output = app.audio_output
            self.surface = pygame.Surface(size)
            self._view = None
        self._seen = seen
        self._context.canvas = self.camera.canvas(size)
        if self._view is None:
            self._view = LevelView(self._context, self.run, audible=False)
            self._view.on_seek()
        return True

    def place(self, fraction: float) -> Point:
        """Where the ninja is drawn, px of the level."""
        return self._view.object_animation.ninja_place(fraction) if self._view is not None else (0.0, 0.0)

    def follow(self, ghosts: list[RunGhost]) -> None:
        """Have other runs go along."""
        if self._view is not None and self._view.ghosts != ghosts:
            self._view.ghosts = ghosts
            for ghost in ghosts:
                ghost.on_seek(self.run.tick)

    def show(self, tick: int, *, audible: bool = False) -> None:
        """Show the world after a tick, if that is simulated. ``audible``: it is played, and its events are heard."""
        timeline = self.editor.session.timeline
        moment = tick + 1
        if timeline.simulated_until < moment:
            return
        run, inputs = self.run, fitted_inputs(timeline.inputs[:moment], moment)
        if run.inputs == inputs:
            return
        if self._view is not None:
            self._view.audible = audible
        if not (moment - _NEAR <= run.tick < moment and inputs.startswith(run.inputs)):
            self._seek(moment, inputs)
        self._play(inputs)
        if self._view is not None:
            self._view.audible = False

    def _seek(self, moment: int, inputs: bytes) -> None:
        """Some ticks before the moment after this many ticks."""
        start = max(0, moment - _WARM)
        end, outcome = self.editor.session.timeline.end
        corpse = self._corpse(end, inputs, min(start - end, _FALL)) if outcome == "dead" and start > end else None
        self._go(start, inputs)
        if self._view is not None and corpse is not None:
            self._view.doll = corpse

    def _go(self, moment: int, inputs: bytes) -> None:
        """Be at the moment after this many ticks, as if nothing had been seen before."""
        self.run.restore(self.editor.session.timeline.save_state(moment))
        while self.run.tick < moment:
            self.run.step_keys(inputs[self.run.tick])
        if self._view is not None:
            self._view.on_seek()

    def _corpse(self, end: int, inputs: bytes, ticks: int) -> Ragdoll | None:
        """What lies there so many ticks after the death: it falls again, in the world as it was then."""
        if self._view is None:
            return None
        self._go(end, inputs)
        self._play(inputs[: end + 1])
        corpse, world = self._view.doll, self.run.world
        for _ in range(ticks - 1):
            if corpse is not None:
                corpse.step(self.run.tiles, world)
        return corpse

    def _play(self, inputs: bytes) -> None:
        """All ticks that are missing."""
        for keys in inputs[self.run.tick :]:
            self.run.step_keys(keys)
            if self._view is not None:
                self._view.on_tick()

    def draw(self, fraction: float, *, whole: bool) -> None:
        """Draw it, ``fraction`` of a tick after the last but one."""
        if self._view is not None:
            self._view.draw(self.surface, fraction, whole=whole)

    def draw_ninja_over(self, surface: pygame.Surface, fraction: float) -> None:
        """Draw the ninja once more, on a copy of the picture over which something else was drawn."""
        if self._view is not None:
            self._view.draw_ninja_over(surface, fraction)
