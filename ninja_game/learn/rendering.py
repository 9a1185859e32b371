"""The game's picture of an episode: as an array, in a window, or as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import ArgumentError
from ninja_game.levels.picture import level_picture
from ninja_game.sim.kinds import EXIT, GOLD, KINDS, MINE, NINJA
from ninja_game.sim.level import Body, Level, ObjectSpec, makes_object
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.simulation import Simulation

if TYPE_CHECKING:
    from ninja_game.play.window import Window

_MOVING = {kind.number for kind in KINDS if kind.moves and (kind.disc or kind.box)}
"""Kinds that are drawn at their present place; a turret and a launcher stay, only their shots move."""
_GONE_WHEN_0 = {GOLD, MINE}
_NOWHERE = (0.0, 0.0)

MAX_PX = 8192  # longest side of a picture


def checked_size(size: object) -> tuple[int, int]:
    """Check width and height of a picture, px. Raises ArgumentError for anything else."""
    sides = list(size) if isinstance(size, tuple | list) else []
    if len(sides) != 2 or not all(isinstance(side, int) and 1 <= side <= MAX_PX for side in sides):
        raise ArgumentError(f"render_size is {size!r:.40}; expected width and height, 1 to {MAX_PX} px")
    return sides[0], sides[1]


class EpisodePicture:
    """Draws a run as the game does, from ``begin`` on; or follows an episode by its inputs in its own world.

    ``size``: px, width and height. ``window``: show every tick in a window, at the game's speed.

    Raises NinjaGameError for a window where there is no display.
    """

    def __init__(self, size: tuple[int, int], *, window: bool = False) -> None:
        import pygame

        from ninja_game.ui.canvas import Canvas
        from ninja_game.view.level_view import OffscreenContext

        self._pygame = pygame
        self._canvas = Canvas
        self._window: Window | None = None
        if window:
            from ninja_game.play.window import Window
            from ninja_game.player.settings import Settings

            self._window = Window(size, Settings())
        self._clock = pygame.time.Clock()
        self._context = OffscreenContext(size)
        self._surface = pygame.Surface(size)

    def begin(self, simulation: Simulation) -> None:
        from ninja_game.view.level_view import LevelView

        self._simulation = simulation
        self._view = LevelView(self._context, self._simulation, audible=False)
        self._show()

    def follow(self, inputs: bytes, shown: int) -> None:
        """Go on to the state after these inputs, one byte per tick from the start of the level.

        ``shown``: number of the last ticks that a window shows.
        """
        played = self._simulation.inputs
        if not inputs.startswith(played):
            self._simulation.reset()
            self._view.on_seek()
            played = b""
        for tick in range(len(played), len(inputs)):
            self._simulation.step_keys(inputs[tick])
            self._view.on_tick()
            if tick >= len(inputs) - shown:
                self._show()

    def _show(self) -> None:
        """Show the present tick in the window and wait for its end; a closed window stays closed."""
        if self._window is None:
            return
        pygame = self._pygame
        self._view.draw(self._window.surface)
        pygame.display.flip()
        for event in pygame.event.get():
            if event.type == pygame.QUIT:
                self.close()
            elif event.type == pygame.VIDEORESIZE:
                self._context.canvas = self._canvas(event.size)
        self._clock.tick(TICKS_PER_SECOND)

    def rgb(self) -> NDArray[np.uint8]:
        """The picture as a new array, (height, width, 3)."""
        self._view.draw(self._surface)
        return self._pygame.surfarray.array3d(self._surface).swapaxes(0, 1).copy()

    def close(self) -> None:
        if self._window is not None:
            self._window = None
            self._pygame.display.quit()


def state_text(level: Level, body: Body, inputs: bytes) -> str:
    """Show the state after these inputs as text: the level by quarter blocks and the legend's characters, then a line.

    Gold taken, exploded mines and the switch of an open exit are left out; moving objects are at their present places.
    """
    run = Simulation(level, body=body)
    for keys in inputs:
        run.step_keys(keys)
    seen = {obj.id: (obj.x, obj.y, obj.status) for obj in run.objects}
    objects, ninja = [], []
    for number, spec in enumerate(filter(makes_object, level.objects)):
        x, y, status = seen.get(number, (*spec.values[:2], 1))
        values = spec.values
        if spec.kind == NINJA:
            ninja.append(ObjectSpec(NINJA, (run.ninja.x, run.ninja.y)))
        elif spec.kind in _MOVING:
            objects.append(ObjectSpec(spec.kind, (x, y, *values[2:])))
        elif spec.kind == EXIT and status:
            objects.append(ObjectSpec(EXIT, (*values[:2], *_NOWHERE)))
        elif status or spec.kind not in _GONE_WHEN_0:
            objects.append(spec)
    # Later records cover earlier ones.
    picture = level_picture(Level(level.tiles, tuple(objects + ninja))).plain
    return f"{picture}\ntick {run.tick}, {run.outcome}, {run.gold} gold"
