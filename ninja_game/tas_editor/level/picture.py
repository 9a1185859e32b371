"""The world after any tick of the run as the game draws it, which part of it is seen, and the ghosts of other runs."""

from __future__ import annotations

from math import log
from random import Random

import pygame

from ninja_game.sim.inputs import fit_inputs
from ninja_game.sim.memory.schema import World
from ninja_game.simulation import SaveState, Simulation
from ninja_game.tas.timeline import Trajectory
from ninja_game.tas_editor.editor import TasEditor
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas, Lens, Point
from ninja_game.ui.theme import Palette
from ninja_game.view.level_view import LevelView, OffscreenContext
from ninja_game.view.ninja.ninja_animation import NinjaAnimation
from ninja_game.view.ninja.ragdoll import Ragdoll
from ninja_game.view.overlays import Overlays

ZOOM_STEP = 1.25  # one notch of the wheel
LARGEST_ZOOM = 8.0  # px of the window a px of the level, at most
_MARGIN = 0.3  # the part of the picture, at each side, in which what is followed moves the picture


class Camera:
    """``zoom``: 1: all of the level. ``centre``: what is in the middle, px of the level."""

    def __init__(self) -> None:
        self.zoom = 1.0
        self.centre: Point = WIDTH / 2, HEIGHT / 2

    @property
    def render_key(self) -> tuple[object, ...]:
        return self.zoom, self.centre

    def canvas(self, window: tuple[int, int]) -> Canvas:
        """From px of the level to px of a picture of this size."""
        whole = Canvas(window)
        if self.zoom == 1.0:
            return whole
        scale = whole.scale * self.zoom
        x, y = self.centre
        return Lens(window, scale, (_origin(window[0], WIDTH, x, scale), _origin(window[1], HEIGHT, y, scale)))

    def show_all(self) -> None:
        self.zoom = 1.0
        self.centre = WIDTH / 2, HEIGHT / 2

    def zoom_at(self, window: tuple[int, int], px: tuple[int, int], notches: float) -> None:
        """Show it larger or smaller; what is under a px stays there as far as that is possible."""
        canvas = self.canvas(window)
        x, y = canvas.logical(px)
        most = max(1.0, LARGEST_ZOOM / Canvas(window).scale)
        steps = round(log(self.zoom, ZOOM_STEP)) + notches
        self.zoom = min(most, max(1.0, ZOOM_STEP**steps))
        scale = Canvas(window).scale * self.zoom
        self._look_at(window, x - (px[0] - window[0] / 2) / scale, y - (px[1] - window[1] / 2) / scale)

    def move(self, window: tuple[int, int], dx: float, dy: float) -> None:
        scale = self.canvas(window).scale
        self._look_at(window, self.centre[0] - dx / scale, self.centre[1] - dy / scale)

    def follow(self, window: tuple[int, int], x: float, y: float) -> None:
        """Have a place of the level well inside of the picture."""
        scale = self.canvas(window).scale
        reach = [length / scale * (0.5 - _MARGIN) for length in window]
        cx, cy = self.centre
        self._look_at(window, min(max(cx, x - reach[0]), x + reach[0]), min(max(cy, y - reach[1]), y + reach[1]))

    def _look_at(self, window: tuple[int, int], x: float, y: float) -> None:
        """Have a place in the middle, but nothing beside the level in the picture."""
        scale = Canvas(window).scale * self.zoom
        half_w, half_h = window[0] / scale / 2, window[1] / scale / 2
        self.centre = (
            min(max(x, half_w), WIDTH - half_w) if half_w < WIDTH / 2 else WIDTH / 2,
            min(max(y, half_h), HEIGHT - half_h) if half_h < HEIGHT / 2 else HEIGHT / 2,
        )


def _origin(window: int, length: float, centre: float, scale: float) -> int:
    """Where the level begins, px: in the middle if it is smaller than the window, else without a gap."""
    whole = round(length * scale)
    if whole <= window:
        return (window - whole) // 2
    return min(0, max(window - whole, round(window / 2 - centre * scale)))


_GHOST_WARM = 12  # ticks that its figure follows before the one that is sought


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

    def colour(self, palette: Palette) -> pygame.Color:
        return self.shade or palette.ghost


_WARM = 4
"""Ticks that are run with their animations before the one that is sought, so that it looks as if played."""
_NEAR = 6  # ticks that are played on to, rather than sought


_FALL = 40  # ticks after which a corpse lies still


class CachedWorldSimulation(Simulation):
    """A simulation whose world is copied once a tick at most."""

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
    """``canvas``: from px of the level to px of ``surface``, which is the picture. ``run``: what it shows.

    ``camera``: which part of the level; ``overlays``: those of the game, which are shown over it.
    """

    def __init__(self, editor: TasEditor) -> None:
        self.editor = editor
        self.run = self._new_run()
        self.overlays = Overlays()
        self._context = OffscreenContext((1, 1), editor.app.settings)
        self._view: LevelView | None = None
        self.surface = pygame.Surface((1, 1))
        self.camera = Camera()
        self._seen: tuple[object, ...] = ()

    def _new_run(self) -> CachedWorldSimulation:
        session = self.editor.session
        return CachedWorldSimulation(session.about.level, body=session.about.body, memory=session.timeline.memory)

    @property
    def canvas(self) -> Canvas:
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
            self._view.overlays = self.overlays
            self._view.on_seek()
        return True

    def place(self, fraction: float) -> Point:
        return self._view.object_animation.ninja_place(fraction) if self._view is not None else (0.0, 0.0)

    def follow(self, ghosts: list[RunGhost]) -> None:
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
        run, inputs = self.run, fit_inputs(timeline.inputs[:moment], moment)
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
            self._view.ragdoll = corpse

    def _go(self, moment: int, inputs: bytes) -> None:
        """Be at the moment after this many ticks, as if nothing had been seen before."""
        if self.run.memory != self.editor.session.timeline.memory:
            self.run = self._new_run()
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
        corpse, world = self._view.ragdoll, self.run.world
        for _ in range(ticks - 1):
            if corpse is not None:
                corpse.step(self.run.tiles, world)
        return corpse

    def _play(self, inputs: bytes) -> None:
        for keys in inputs[self.run.tick :]:
            self.run.step_keys(keys)
            if self._view is not None:
                self._view.on_tick()

    def draw(self, fraction: float, *, whole: bool) -> None:
        if self._view is not None:
            self._view.draw(self.surface, fraction, whole=whole)

    def draw_ninja_over(self, surface: pygame.Surface, fraction: float) -> None:
        """Draw the ninja once more, on a copy of the picture over which something else was drawn."""
        if self._view is not None:
            self._view.draw_ninja_over(surface, fraction)
