"""Save-states along a run, so that any of its moments is a few ticks away."""

from __future__ import annotations

from bisect import bisect_right

from ninja_game.simulation import SaveState, Simulation


class Timeline:
    """Save-states of a simulation every ``spacing`` ticks, at most ``most`` of them; the oldest but the first go.

    The start is always kept. Inputs are those given to ``seek``: the run must have been made from them.
    """

    def __init__(self, simulation: Simulation, *, spacing: int, most: int = 4000) -> None:
        self.simulation = simulation
        self.spacing = spacing
        self.most = most
        self._ticks: list[int] = []
        self._states: list[SaveState] = []
        self.note()

    def note(self) -> None:
        """Keep this moment if it is due: call it after every tick."""
        tick = self.simulation.tick
        if tick % self.spacing and self._ticks:
            return
        at = bisect_right(self._ticks, tick)
        if at and self._ticks[at - 1] == tick:
            return
        self._ticks.insert(at, tick)
        self._states.insert(at, self.simulation.save())
        if len(self._ticks) > self.most:
            del self._ticks[1], self._states[1]

    def forget_after(self, tick: int) -> None:
        """Drop the moments after a tick: from there the run goes another way."""
        keep = max(1, bisect_right(self._ticks, tick))
        del self._ticks[keep:], self._states[keep:]

    def seek(self, tick: int, inputs: bytes | bytearray) -> None:
        """Bring the simulation to the moment after ``tick`` ticks of these inputs."""
        run = self.simulation
        at = max(0, bisect_right(self._ticks, tick) - 1)
        if not self._ticks[at] <= run.tick <= tick:
            run.restore(self._states[at])
        while run.tick < tick:
            run.step_keys(inputs[run.tick] if run.tick < len(inputs) else 0)
            self.note()
