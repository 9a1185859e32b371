"""A recording to be watched, and the run that comes of it."""

from __future__ import annotations

from dataclasses import dataclass

from ninja_game.formats.recording import Recording
from ninja_game.play.replay.timeline import Timeline
from ninja_game.sim.level import Level
from ninja_game.sim.rules import LIFETIME
from ninja_game.simulation import Body, Simulation

_SPACING = 60
"""A save-state every so many ticks: seeking never runs more than these."""
AFTERMATH = 130
"""Ticks that are shown after the end (game.md §2)."""


@dataclass(frozen=True)
class Take:
    """Inputs (one byte a tick) on a level. ``lifetime``: ticks at its start."""

    title: str
    level: Level
    inputs: bytes
    body: Body = "circle"
    lifetime: int = LIFETIME


def take_of(recording: Recording) -> Take:
    """A recording of any format as a take."""
    body: Body = "box" if recording.replay and recording.replay.body == "box" else "circle"
    title = recording.name or "replay"
    if recording.author:
        title += f" - {recording.author}"
    return Take(title, recording.level, recording.playback(recording.ticks), body)


class Playback:
    """A take being played: run once to its end, then any of its moments is near.

    ``end``: the tick of the exit contact or death, or the last one of the recording. ``length``: ticks to show.
    """

    def __init__(self, take: Take) -> None:
        self.take = take
        self.simulation = Simulation(take.level, body=take.body)
        self.timeline = Timeline(self.simulation, spacing=_SPACING)
        run = self.simulation
        while run.outcome == "running" and run.tick <= len(take.inputs):
            self.step()
        self.outcome = run.outcome
        self.end = max(0, run.tick - 1) if run.outcome != "running" else len(take.inputs)
        self.length = self.end + AFTERMATH
        self.timeline.seek(0, take.inputs)

    def step(self) -> None:
        """One tick."""
        tick = self.simulation.tick
        self.simulation.step_keys(self.input_at(tick))
        self.timeline.note()

    def input_at(self, tick: int) -> int:
        """The input of a tick."""
        inputs = self.take.inputs
        return inputs[tick] if 0 <= tick < len(inputs) else 0

    def seek(self, tick: int) -> None:
        """Go to the moment after so many ticks."""
        self.timeline.seek(min(max(0, tick), self.length), self.take.inputs)
