"""The world after any tick of the run, the visible part of it, and the ghosts of other runs."""

from __future__ import annotations

from random import Random

import pygame

from ninja_game.sim.grid import Point
from ninja_game.sim.inputs import fit_inputs
from ninja_game.sim.schema.world_fields import World
from ninja_game.simulation import SaveState, Simulation
from ninja_game.tas.timeline import Trajectory
from ninja_game.tas_editor.editor import TasEditor
from ninja_game.ui.canvas import Camera, Canvas
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.ninja.ninja_animation import NinjaAnimation
from ninja_game.view.ninja.ragdoll import Ragdoll
from ninja_game.view.overlays import Overlays

_GHOST_WARM = 12  # ticks of animation before a sought tick


class RunGhost:
    """Another run in the level, of one tick or more. ``label``: its name. ``shade``: None: the palette's for ghosts."""

    def __init__(self, trajectory: Trajectory, label: str = "", shade: pygame.Color | None = None) -> None:
        self.trajectory = trajectory
        self.label = label
        self.shade = shade
        self._world = World()
        self._random = Random(1)  # noqa: S311 - presentation
        self.on_seek(0)

    def _follow(self, tick: int) -> None:
        ninja = self._world.ninja
        ninja.was_in_air = ninja.in_air
        for name, value in self.trajectory.at(max(0, tick)).items():
            setattr(ninja, name, value)

    def on_tick(self) -> None:
        self._moment += 1
        if self._moment <= len(self.trajectory):
            self._follow(self._moment - 1)
            self.ninja_animation.on_tick(self._world)

    def on_seek(self, tick: int) -> None:
        self._moment = max(0, min(tick, len(self.trajectory)) - _GHOST_WARM)
        self._follow(self._moment - 1)
        self.ninja_animation = NinjaAnimation(self._world, self._random)
        while self._moment < min(tick, len(self.trajectory)):
            self.on_tick()
        self._moment = tick

    def place(self, fraction: float) -> Point:
        now, before = self.trajectory.at(max(0, self._moment - 1)), self.trajectory.at(max(0, self._moment - 2))
        (bx, by), (x, y) = (before["x"], before["y"]), (now["x"], now["y"])
        return bx + (x - bx) * fraction, by + (y - by) * fraction


_WARM = 4  # ticks run with animations before a sought one, so that it looks as if played
_NEAR = 6  # most ticks that are played rather than sought


_FALL = 40  # ticks after which a corpse lies still


class CachedWorldSimulation(Simulation):
    """A simulation that copies its world at most once per tick."""

    _copy: World | None = None

    @property
    def world(self) -> World:
        if self._copy is None:
            self._copy = super().world
        return self._copy

    def step_keys(self, keys: int) -> None:
        self._copy = None
        super().step_keys(keys)

    def restore(self, state: SaveState) -> None:
        self._copy = None
        super().restore(state)


class LevelPicture:
    """The level with its runs. ``canvas``: from px of the level to px of ``surface``, where ``view`` draws.

    ``run``: the one shown. ``camera``: the visible part of the level; ``overlays``: those of the game.
    """

    def __init__(self, editor: TasEditor) -> None:
        self.editor = editor
        self.run = self._new_run()
        self.overlays = Overlays()
        self.camera = Camera()
        self.surface: pygame.Surface
        self._context: OffscreenContext
        self.view: LevelView
        self._seen: tuple[object, ...] = ()
        self.fit((1, 1))

    def _new_run(self) -> CachedWorldSimulation:
        session = self.editor.session
        return CachedWorldSimulation(session.origin.level, body=session.origin.body, memory=session.timeline.memory)

    @property
    def canvas(self) -> Canvas:
        return self._context.canvas

    @property
    def tick(self) -> int:
        """The tick after which the world is shown; -1 at the start."""
        return self.run.tick - 1

    def fit(self, size: tuple[int, int]) -> bool:
        """Apply a size, px, the player's settings and the camera's part; whether to draw all again."""
        app, before = self.editor.app, self._seen
        settings = app.settings.changed(show_ghost=True)
        self._seen = size, settings.palette, *self.camera.render_key
        if before[:2] == self._seen[:2]:
            self._context.settings = settings
            if before != self._seen:
                self._context.canvas = self.camera.canvas(size)
            return before != self._seen
        self._context = OffscreenContext(size, settings)
        self._context.audio_output = app.audio_output
        self._context.canvas = self.camera.canvas(size)
        self.surface = pygame.Surface(size)
        self.view = LevelView(self._context, self.run, audible=False)
        self.view.overlays = self.overlays
        self.view.on_seek()
        return True

    def place(self, fraction: float) -> Point:
        return self.view.object_animation.ninja_place(fraction)

    def follow(self, ghosts: list[RunGhost]) -> None:
        if self.view.ghosts != ghosts:
            self.view.ghosts = ghosts
            for ghost in ghosts:
                ghost.on_seek(self.run.tick)

    def show(self, tick: int, *, audible: bool = False) -> None:
        """Show the world after a tick, if that is simulated. ``audible``: during playback, with sounds."""
        timeline = self.editor.session.timeline
        moment = tick + 1
        if timeline.simulated_until < moment:
            return
        run, inputs = self.run, fit_inputs(timeline.inputs[:moment], moment)
        if run.inputs == inputs:
            return
        self.view.audible = audible
        if not (moment - _NEAR <= run.tick < moment and inputs.startswith(run.inputs)):
            self._seek(moment, inputs)
        self._play(inputs)
        self.view.audible = False

    def _seek(self, moment: int, inputs: bytes) -> None:
        """Seek to some ticks before a tick."""
        start = max(0, moment - _WARM)
        end, outcome = self.editor.session.timeline.end
        corpse = self._corpse(end, inputs, min(start - end, _FALL)) if outcome == "dead" and start > end else None
        self._go(start, inputs)
        if corpse is not None:
            self.view.ragdoll = corpse

    def _go(self, moment: int, inputs: bytes) -> None:
        """Go to a tick, without animations from earlier pictures."""
        if self.run.memory != self.editor.session.timeline.memory:
            self.run = self._new_run()
        self.run.restore(self.editor.session.timeline.save_state(moment))
        while self.run.tick < moment:
            self.run.step_keys(inputs[self.run.tick])
        self.view.on_seek()

    def _corpse(self, end: int, inputs: bytes, ticks: int) -> Ragdoll | None:
        """The corpse a number of ticks after the death: it falls again, in the world of those ticks."""
        self._go(end, inputs)
        self._play(inputs[: end + 1])
        corpse, world = self.view.ragdoll, self.run.world
        for _ in range(ticks - 1):
            if corpse is not None:
                corpse.step(self.run.tiles, world)
        return corpse

    def _play(self, inputs: bytes) -> None:
        for keys in inputs[self.run.tick :]:
            self.run.step_keys(keys)
            self.view.on_tick()
