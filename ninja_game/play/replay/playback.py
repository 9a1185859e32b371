"""Recorded inputs played on a level, with seeking; ghosts; real time as ticks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial
from random import Random

import pygame

from ninja_game.budget import TURN_WORK, tick_cost
from ninja_game.formats.recording import Recording
from ninja_game.runs.save_states import SPACING, SaveStates
from ninja_game.sim.grid import Point
from ninja_game.sim.inputs import MAX_TICKS
from ninja_game.sim.level import Body, Level
from ninja_game.sim.rules import TICK_MS
from ninja_game.sim.states import CELEBRATING, DEAD
from ninja_game.simulation import SaveState, Simulation
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.theme import Theme, run_colour
from ninja_game.view.ninja.ninja_animation import NinjaAnimation
from ninja_game.view.sprites.drawing import is_near


class Playback:
    """Plays inputs on a simulation; after their last tick no key is down.

    ``inputs`` may grow during playback. ``spacing``: ticks between the save-states that make seeking fast; 0: only the
    start is kept. ``states``: of another playback of the same inputs, to be shared with it.
    """

    def __init__(
        self,
        simulation: Simulation,
        inputs: bytes | bytearray,
        *,
        spacing: int = SPACING,
        states: SaveStates[SaveState] | None = None,
    ) -> None:
        self.simulation = simulation
        self.inputs = inputs
        # A save-state also holds its inputs so far, one byte per tick.
        values = tick_cost(simulation.level) + len(inputs) // 250
        self.states = states or SaveStates(simulation.tick, simulation.save(), spacing=spacing, values=values)

    @property
    def tick(self) -> int:
        return self.simulation.tick

    def keys_at(self, tick: int) -> int:
        return self.inputs[tick] if 0 <= tick < len(self.inputs) else 0

    def step(self) -> None:
        self.simulation.step_keys(self.keys_at(self.simulation.tick))
        self.note()

    def note(self) -> None:
        """Keep a save-state if it is due: for ticks that ``step`` has not played."""
        if self.states.wants(self.simulation.tick):
            self.states.keep(self.simulation.tick, self.simulation.save())

    def forget_after(self, tick: int) -> None:
        """Drop the save-states after a tick: the inputs differ from there on."""
        self.states.forget_after(tick)

    def seek(self, tick: int, most: int = MAX_TICKS) -> int:
        """Seek to a tick, simulating at most ``most`` ticks; the number of ticks that are left."""
        run = self.simulation
        nearest, state = self.states.nearest(tick)
        if not nearest <= run.tick <= tick:
            run.restore(state)
        while run.tick < tick and most:
            self.step()
            most -= 1
        return most

    def find_end(self, most: int) -> int | None:
        """The tick of the exit contact or death, or the last one of the inputs: plays to it from the present moment.

        None if it is not reached within ``most`` ticks.
        """
        run = self.simulation
        while run.outcome == "running" and run.tick <= len(self.inputs) and most:
            self.step()
            most -= 1
        if run.outcome != "running":
            return max(0, run.tick - 1)
        return len(self.inputs) if run.tick > len(self.inputs) else None

    def beside(self) -> Playback:
        """A playback of the same inputs at the same moment in its own world; both share the save-states."""
        run = self.simulation
        other = Simulation(run.level, body=run.body)
        other.restore(run.save())
        return Playback(other, self.inputs, states=self.states)


class Ghost:
    """A recording that runs along with another one.

    ``behind``: ticks to catch up after a seek, a turn's work per tick. ``alone``: it catches up by itself; else only
    when called. ``pace``: its ticks for each tick of the clock. ``shade``: its colour, None: the palette's for ghosts;
    ``name``: stands above it.
    """

    def __init__(
        self,
        inputs: bytes,
        level: Level,
        body: Body,
        *,
        alone: bool = True,
        pace: float = 1.0,
        shade: pygame.Color | None = None,
        name: str = "",
    ) -> None:
        self.inputs = inputs
        self.name = name
        self.shade = shade
        self.pace = pace
        self._due = 0.0
        self.simulation = Simulation(level, body=body)
        self._playback = Playback(self.simulation, inputs, spacing=0)
        self.ninja_animation = NinjaAnimation(self.simulation.world, Random(1))  # noqa: S311 - presentation
        self._before = self._now = self._place()
        self._turn = max(1, TURN_WORK // tick_cost(level)) if alone else 0
        self.behind = 0

    def _place(self) -> Point:
        n = self.simulation.world.ninja
        return n.x, n.y

    @property
    def over(self) -> bool:
        """Whether it has reached its end, where it stays."""
        return self.simulation.world.ninja.state in {DEAD, CELEBRATING}

    def on_tick(self) -> None:
        self._before = self._now
        self._due += self.pace
        while self._due >= 1:
            self._due -= 1
            if self.behind:
                self.behind += 1
                self.catch_up(self._turn)
            elif not self.over:
                self._playback.step()
                self.ninja_animation.on_tick(self.simulation.world)
                self._now = self._place()

    def on_seek(self, tick: int) -> None:
        """Seek to a tick of the recording, or begin to catch up."""
        tick, self._due = int(tick * self.pace), tick * self.pace % 1
        if tick < self.simulation.tick or self.over:
            self._playback.seek(0)
        self.behind = tick - self.simulation.tick
        self.catch_up(self._turn)

    def catch_up(self, most: int) -> int:
        """Catch up by this many ticks at most; the number simulated."""
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


_MAX_NAME = 28  # most letters of a run's name among others


def names_of(runs: Sequence[Recording]) -> list[str]:
    """The label of each run: its player, or its file for several runs of one player."""
    names = [run.whose for run in runs]
    labels = [run.place or name if names.count(name) > 1 else name for run, name in zip(runs, names, strict=True)]
    return [name if len(name) <= _MAX_NAME else f"{name[: _MAX_NAME - 3]}..." for name in labels]


def ghosts_of(runs: Sequence[Recording], numbers: Sequence[int] = (), *, alone: bool = True) -> list[Ghost]:
    """Ghosts of runs, each with its name and a colour of its own; ``alone``: as in Ghost.

    ``numbers``: of their colours, such as those in a picture of the board; without them in their order.
    """
    colours = map(run_colour, numbers or range(len(runs)))
    return [
        Ghost(run.inputs, run.level, run.body, alone=alone, shade=colour, name=name)
        for run, colour, name in zip(runs, colours, names_of(runs), strict=True)
    ]


def draw_names(
    surface: pygame.Surface, theme: Theme, ghosts: Iterable[Ghost], fraction: float, size: float = 9.0
) -> list[pygame.Rect]:
    """Draw the names of ghosts above them, higher where one would cover another; their rectangles, px.

    All of a name stays between the sides of the level: beside it nothing is drawn again.

    ``size``: of the letters, px of the level.
    """
    covered = list[pygame.Rect]()
    for ghost in ghosts:
        x, y = ghost.place(fraction)
        if not is_near(x, y):
            continue
        half, above = theme.width(ghost.name, size) / 2, y - 15 - size
        x = max(half, min(x, WIDTH - half))
        write = partial(theme.text, text=ghost.name, x=x, size=size, colour=ghost.shade, align="centre")
        while write(None, y=above).collidelist(covered) >= 0:
            above -= size
        covered.append(write(surface, y=above))
    return covered


MAX_MS = 2000  # a longer picture is a stall: it counts as one tick and is not caught up


class RunClock:
    """Counts real time and gives the number of due ticks; the remainder is kept.

    >>> clock = RunClock()
    >>> [clock.ticks_due(ms) for ms in (24, 1, 60, 5000)]
    [0, 1, 2, 1]
    """

    def __init__(self) -> None:
        self.remainder = 0
        self.tick_ms = TICK_MS

    def reset(self) -> None:
        """Reset the clock: when play or a replay starts, and after a pause."""
        self.remainder = 0

    def ticks_due(self, real_ms: int, tick_ms: int = TICK_MS) -> int:
        """The number of ticks due after ``real_ms`` more; ``tick_ms``: real ms per tick."""
        self.tick_ms = tick_ms
        time = real_ms + self.remainder
        if time > MAX_MS:
            time = tick_ms
        due, self.remainder = divmod(time, tick_ms)
        return due

    @property
    def fraction(self) -> float:
        """The elapsed part of the next tick, 0…1, for drawing between two ticks."""
        return min(1.0, self.remainder / self.tick_ms)
