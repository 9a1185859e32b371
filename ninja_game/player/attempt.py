"""One try at a level: inputs recorded and played, the lifetime counted, the score taken (game.md §1-§4)."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from ninja_game.budget import NO_LIMIT
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import Replay
from ninja_game.formats.run_time import level_score
from ninja_game.runs.deaths import SELF, killer_of
from ninja_game.runs.run import record_replay
from ninja_game.sim.events import DIED
from ninja_game.sim.inputs import with_press_bit
from ninja_game.sim.kinds import INERT
from ninja_game.sim.level import Body, Level
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import CELEBRATING, DEAD, EXPLOSIVE, FALL, HARD_BULLET, OUTCOME_DEAD
from ninja_game.simulation import SaveState, Simulation

AttemptState = tuple[SaveState, bytes, int, int, bool]
"""A save-state with the inputs, the lifetime, the tick of the end, whether the player ended the try."""


class Attempt:
    """One try at a level, from its start until the exit, death, or the player's decision to end it."""

    def __init__(
        self, level: Level, *, body: Body = "circle", lifetime: int = LIFETIME, practice_mode: bool = False
    ) -> None:
        self.simulation = Simulation(level, body=body)
        self._start = self.simulation.save()
        self.start_lifetime = lifetime
        self.practice_mode = practice_mode
        self._begin()

    def restart(self) -> None:
        self.simulation.restore(self._start)
        self._begin()

    def _begin(self) -> None:
        self.lifetime = self.start_lifetime  #: ticks left, which gold adds to
        self.inputs = bytearray()  #: the recording, one byte per tick
        self.score = 0  #: ticks, taken at the exit contact
        self.ended_tick = -1  #: the tick of the first exit contact or death, counted from 0
        self.self_inflicted = False
        self.assists = {"practice"} if self.practice_mode else set()  #: the help used, which makes it no record
        self.death_refused = False  #: whether only invincibility saved the ninja: its keys alone do not make this run

    @property
    def assisted(self) -> bool:
        return bool(self.assists)

    @property
    def made(self) -> Provenance:
        return Provenance(played=True, assists=tuple(sorted(self.assists)))

    @property
    def outcome(self) -> str:
        return self.simulation.outcome

    @property
    def gold(self) -> int:
        return self.simulation.gold

    @property
    def killer(self) -> str:
        """The ninja's killer, one of ``deaths.KILLERS``; to be read right after the tick of the death."""
        return SELF if self.self_inflicted else killer_of(self.simulation.world)

    def tick(self, held: int, *, invincible: bool = False) -> None:
        """Run one tick with the held keys: 1 left + 2 right + 4 jump. ``invincible``: a death in it is refused."""
        world = self.simulation.world
        was_held = world.ninja.jump_held
        gold = world.gold
        running = world.outcome == 0
        keys = with_press_bit(held, was_held)
        if invincible and running:
            self.assists.add("invincible")
            self.death_refused |= tick_without_death(self.simulation, keys)
        else:
            self.simulation.step_keys(keys)
        # The input is sampled after all physics of the tick, and only by a ninja that lives and is not celebrating.
        if world.ninja.state not in {DEAD, CELEBRATING} and running:
            self.inputs.append(keys)
        if running:
            self._count(world, gold)

    def _count(self, world: Any, gold: int) -> None:
        self.lifetime += GOLD_BONUS * (world.gold - gold)
        if world.outcome != 0:
            self.ended_tick = world.tick - 1
            # The score is taken inside the tick of the exit contact, before its lifetime step.
            self.score = level_score(world.gold, self.ended_tick)
        elif not self.practice_mode:
            self.lifetime -= 1

    def check_time(self) -> None:
        """Kill a ninja whose lifetime is over: called once per picture, after its ticks."""
        if self.lifetime <= 0 and not self.practice_mode and self.outcome == "running":
            self._kill(FALL, 0.0, 0.0)

    def give_up(self, draw: float, dx: float, dy: float) -> None:
        """The suicide key: ``draw`` (0…1) below 0.3 explodes; (dx, dy) is the corpse's impulse."""
        if self.outcome == "running":
            self.self_inflicted = True
            self._kill(EXPLOSIVE if draw < 0.3 else HARD_BULLET, dx, dy)

    def _kill(self, cause: int, dx: float, dy: float) -> None:
        self.simulation.kill(cause, dx, dy)
        self.ended_tick = self.simulation.tick

    def save(self) -> AttemptState:
        return self.simulation.save(), bytes(self.inputs), self.lifetime, self.ended_tick, self.self_inflicted

    def restore(self, moment: AttemptState) -> None:
        state, inputs, self.lifetime, self.ended_tick, self.self_inflicted = moment
        self.simulation.restore(state)
        self.inputs[:] = inputs
        self.score = level_score(self.gold, self.ended_tick) if self.outcome == "exit" else 0
        self.assists.add("save-states")

    def after_rewind(self) -> None:
        """Drop the inputs after the present tick, to which the simulation was set back; update clock and result."""
        tick = self.simulation.tick
        ended = self.outcome != "running"
        del self.inputs[tick:]
        self.lifetime = self.start_lifetime + GOLD_BONUS * self.gold
        if not ended:
            # After a self-chosen death the ticks continued without input.
            self.inputs.extend(bytes(tick - len(self.inputs)))
            self.ended_tick, self.score, self.self_inflicted = -1, 0, False
        self.assists.add("rewind")

    def replay(self, name: str = "", author: str = "") -> Replay:
        """The recording as our replay: run again from its inputs, so that its claims are true."""
        ticks = max(1, len(self.inputs) + (self.outcome != "running"))
        level, body = self.simulation.level, self.simulation.body
        inputs = bytes(self.inputs)
        replay = record_replay(level, inputs, ticks=ticks, body=body, name=name, author=author, budget=NO_LIMIT)
        return replace(replay, made=self.made)


_MAX_TRIES = 20  # more than any place has killers: a ninja that is still crushed after them is dead


def tick_without_death(simulation: Simulation, keys: int) -> bool:
    """One tick of a run on the plain memory that survives; whether a death was refused.

    An object that kills is frozen for the tick and cannot be touched; a deadly landing is done at half the speed. The
    rules of the world do not change: it is set back to the tick before, changed, and run again.
    """
    world, before = simulation.world, simulation.save()
    left_out: dict[int, int] = {}
    share = 1.0
    simulation.step_keys(keys)
    for _ in range(_MAX_TRIES):
        if world.outcome != OUTCOME_DEAD:
            break
        killer = next(event.slot for event in world.events[: world.event_count] if event.kind == DIED)
        simulation.restore(before)
        if killer:
            left_out[killer] = world.objects[killer].kind
        else:
            share /= 2
        for slot in left_out:
            world.objects[slot].kind = INERT
        if share < 1:
            ninja = world.ninja
            ninja.prev_x = ninja.x - share * (ninja.x - ninja.prev_x)
            ninja.prev_y = ninja.y - share * (ninja.y - ninja.prev_y)
        simulation.step_keys(keys)
    for slot, kind in left_out.items():
        world.objects[slot].kind = kind
    return bool(left_out) or share < 1
