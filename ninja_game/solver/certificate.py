"""From inputs that a search found to a replay: run again from tick 0 on the plain memory, which no search touches."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from ninja_game.errors import NinjaGameError
from ninja_game.files.writing import write_atomically
from ninja_game.formats.replay.text import Replay, write_replay
from ninja_game.runs.run import record_replay
from ninja_game.sim.level import Level
from ninja_game.simulation import Body, Simulation


class UnverifiedRunError(NinjaGameError):
    """A run that the plain memory does not confirm."""


@dataclass(frozen=True)
class VerifiedRun:
    """A run to the exit that the plain memory has confirmed from tick 0.

    ``inputs``: one byte a tick, up to and including the tick of the exit contact; ``digest``: what a replay
    states after it.
    """

    level: Level
    body: Body
    inputs: bytes
    gold: int
    digest: str

    @property
    def end_tick(self) -> int:
        """The tick of the exit contact: the length by which runs are compared."""
        return len(self.inputs) - 1


def verified_run(level: Level, inputs: bytes, *, body: Body = "circle", gold: int = 0) -> VerifiedRun:
    """Play inputs from the start on the plain memory. What comes after the exit is cut off.

    Raises UnverifiedRunError if they do not reach the exit, or with less gold than asked for.
    """
    run = Simulation(level, body=body, memory="plain")
    for keys in inputs:
        run.step_keys(keys)
        if run.outcome != "running":
            break
    if run.outcome != "exit":
        raise UnverifiedRunError(f"the run does not reach the exit: {run.outcome} after {run.tick} ticks")
    if run.gold < gold:
        raise UnverifiedRunError(f"the run collects {run.gold} pieces of gold, {gold} were asked for")
    return VerifiedRun(level, body, inputs[: run.tick], run.gold, run.replay_digest())


def replay_of(run: VerifiedRun, *, name: str = "", author: str = "", level_author: str = "") -> Replay:
    """A replay that holds its level; both have the same name."""
    replay = record_replay(run.level, run.inputs, body=run.body, name=name, author=author)
    return replace(replay, level_name=name, level_author=level_author)


def save_replay(path: Path, replay: Replay) -> None:
    """Write a replay, whole or not at all. Raises OSError."""
    write_atomically(path, write_replay(replay))
