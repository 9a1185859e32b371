"""Recorded inputs played on a level: tick by tick, or to any of their moments."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, field, replace

from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.sim.level import Level
from ninja_game.simulation import Body, SaveState, Simulation

SPACING = 60
"""A save-state every so many ticks, at first."""
MOST_STATES = 300
"""With more save-states than this every second one is dropped, so that a run of any length fits into the memory."""


@dataclass(frozen=True)
class RecordedRun:
    """Inputs (one byte a tick) on a level; ``replay``: the replay that they are from, if any."""

    title: str
    level: Level
    inputs: bytes
    body: Body = "circle"
    replay: Replay | None = field(default=None, repr=False, compare=False)


def recorded_run(recording: Recording) -> RecordedRun:
    """A recording of any format, with the title under which it is shown."""
    title = recording.name or "replay"
    if recording.author:
        title += f" - {recording.author}"
    return RecordedRun(title, recording.level, recording.playback(recording.ticks), recording.body, recording.replay)


def replay_of(run: RecordedRun) -> Replay:
    """The replay that a run is from, with its level inside; of other runs one that is made by running it."""
    if run.replay:
        return replace(run.replay, level=run.level)
    # It imports NumPy, which playing does without.
    from ninja_game.runs.run import record_replay

    return record_replay(run.level, bytes(run.inputs) or bytes(1), body=run.body, name=run.title)


class Playback:
    """Plays inputs on a simulation; in ticks beyond them no key is down.

    ``inputs`` may grow while it plays. ``spacing``: ticks between the save-states that make seeking quick; 0: only the
    start is kept.
    """

    def __init__(self, simulation: Simulation, inputs: bytes | bytearray, *, spacing: int = SPACING) -> None:
        self.simulation = simulation
        self.inputs = inputs
        self._spacing = spacing
        self._ticks = [simulation.tick]
        self._states: list[SaveState] = [simulation.save()]

    @property
    def tick(self) -> int:
        """How many ticks have been played."""
        return self.simulation.tick

    def keys_at(self, tick: int) -> int:
        """The keys of a tick."""
        return self.inputs[tick] if 0 <= tick < len(self.inputs) else 0

    def step(self) -> None:
        """One tick."""
        self.simulation.step_keys(self.keys_at(self.simulation.tick))
        self.note()

    def note(self) -> None:
        """Keep this moment if it is due: for ticks that were not played by ``step``."""
        tick = self.simulation.tick
        if not self._spacing or tick % self._spacing:
            return
        at = bisect_right(self._ticks, tick)
        if at and self._ticks[at - 1] == tick:
            return
        self._ticks.insert(at, tick)
        self._states.insert(at, self.simulation.save())
        if len(self._ticks) > MOST_STATES:
            self._spacing *= 2
            del self._ticks[1::2], self._states[1::2]

    def forget_after(self, tick: int) -> None:
        """Drop the moments after a tick: from there the run goes another way."""
        keep = max(1, bisect_right(self._ticks, tick))
        del self._ticks[keep:], self._states[keep:]

    def seek(self, tick: int) -> None:
        """Go to the moment after so many ticks."""
        run = self.simulation
        at = max(0, bisect_right(self._ticks, tick) - 1)
        if not self._ticks[at] <= run.tick <= tick:
            run.restore(self._states[at])
        while run.tick < tick:
            self.step()

    def find_end(self) -> int:
        """The tick of the exit contact or death, or the last one of the inputs. Plays to it from the present moment."""
        run = self.simulation
        while run.outcome == "running" and run.tick <= len(self.inputs):
            self.step()
        return max(0, run.tick - 1) if run.outcome != "running" else len(self.inputs)
