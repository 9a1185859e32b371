"""Recorded inputs played on a level: tick by tick, or to any of their moments."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from ninja_game.budget import tick_cost
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.runs.save_states import SPACING, SaveStates
from ninja_game.sim.inputs import MAX_TICKS, Demo
from ninja_game.sim.level import Level
from ninja_game.simulation import Body, SaveState, Simulation


@dataclass(frozen=True)
class RecordedRun:
    """Inputs (one byte a tick) on a level; ``replay``, ``recording``: what they are from, if anything."""

    title: str
    level: Level
    inputs: bytes
    body: Body = "circle"
    replay: Replay | None = field(default=None, repr=False, compare=False)
    recording: Recording | None = field(default=None, repr=False, compare=False)


def recorded_run(recording: Recording) -> RecordedRun:
    """A recording of any format, with the title under which it is shown."""
    title = recording.name or "replay"
    if recording.author:
        title += f" - {recording.author}"
    inputs = recording.playback(recording.ticks)
    return RecordedRun(title, recording.level, inputs, recording.body, recording.replay, recording)


def replay_of(run: RecordedRun) -> Replay:
    """The replay that a run is from, with its level inside; of other runs one that is made by running it."""
    if run.replay:
        return replace(run.replay, level=run.level)
    # It imports NumPy, which playing does without.
    from ninja_game.runs.run import record_replay

    return record_replay(run.level, bytes(run.inputs) or bytes(1), body=run.body, name=run.title)


def recording_of(run: RecordedRun, player: str) -> Recording:
    """What a run is from; of one that was only played a recording by the player."""
    if run.recording is not None:
        return run.recording
    replay = run.replay or Replay(
        run.inputs, max(0, len(run.inputs) - 1), "", name=run.title, author=player, body=run.body, level=run.level
    )
    demo = Demo(replay.inputs, float(len(replay.inputs)))
    return Recording(replay.name, replay.author, "", run.level, demo, "", replay=replay)


class Playback:
    """Plays inputs on a simulation; in ticks beyond them no key is down.

    ``inputs`` may grow while it plays. ``spacing``: ticks between the save-states that make seeking quick; 0: only the
    start is kept. ``states``: those of another playback of the same inputs, which both use from now on.
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
        # A save-state holds the inputs that led to it too, a byte each.
        values = tick_cost(simulation.level) + len(inputs) // 250
        self._states = states or SaveStates(simulation.tick, simulation.save(), spacing=spacing, values=values)

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
        if self._states.wants(self.simulation.tick):
            self._states.keep(self.simulation.tick, self.simulation.save())

    def forget_after(self, tick: int) -> None:
        """Drop the moments after a tick: from there the run goes another way."""
        self._states.forget_after(tick)

    def seek(self, tick: int, most: int = MAX_TICKS) -> int:
        """Go to the moment after so many ticks, or as near as ``most`` ticks lead; how many of them are left."""
        run = self.simulation
        nearest, state = self._states.nearest(tick)
        if not nearest <= run.tick <= tick:
            run.restore(state)
        while run.tick < tick and most:
            self.step()
            most -= 1
        return most

    def find_end(self, most: int = MAX_TICKS + 1) -> int | None:
        """The tick of the exit contact or death, or the last one of the inputs: plays to it from the present moment.

        None where it is not reached within ``most`` ticks.
        """
        run = self.simulation
        while run.outcome == "running" and run.tick <= len(self.inputs) and most:
            self.step()
            most -= 1
        if run.outcome != "running":
            return max(0, run.tick - 1)
        return len(self.inputs) if run.tick > len(self.inputs) else None

    def beside(self) -> Playback:
        """A playback of the same inputs at the same moment in a world of its own; both use the same save-states."""
        run = self.simulation
        other = Simulation(run.level, body=run.body)
        other.restore(run.save())
        return Playback(other, self.inputs, states=self._states)
