"""One attempt at a level: the world under it, what is recorded, and how the lifetime runs (game.md §1-§4).

Nothing here knows a clock or a window: the game calls ``tick`` with the keys that are down, and ``time_up`` once a
picture.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import random

from ninja_game.formats.demo import MAX_FRAMES
from ninja_game.formats.level_string import level_digest
from ninja_game.formats.replay import Replay
from ninja_game.session.scoring import level_score
from ninja_game.sim.death import kill
from ninja_game.sim.level_data import LevelData
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.sim.states import CELEBRATING, DEAD, EXPLOSIVE, FALL, HARD_BULLET
from ninja_game.simulation import HELD, LEFT, RIGHT, TRIGGERED, Body, SaveState, Simulation

RETRY_DELAY = 40
"""After more ticks than this since death the recording is closed and the retry message comes (game.md §2)."""

READY, PLAYING, DEAD_PHASE, PASSED = "ready", "playing", "dead", "passed"
"""Phases: before the start, in play, after a death, after the exit contact."""


@dataclass(frozen=True)
class AttemptState:
    """A moment of an attempt to come back to (practice)."""

    world: SaveState
    frames: int
    phase: str
    counters: tuple[int, int, int, bool, bool]


class Attempt:
    """A level being played.

    ``lifetime``: ticks left at its start. ``practice``: no countdown, no death by time. ``chance``: numbers in [0, 1)
    for the suicide's impulse, which is the only thing here that chance decides. Raises LevelError for a level that
    cannot be played.
    """

    def __init__(
        self,
        level: LevelData,
        *,
        lifetime: int = LIFETIME,
        practice: bool = False,
        body: Body = "circle",
        chance: Callable[[], float] = random,
    ) -> None:
        self.level = level
        self.practice = practice
        self.start_lifetime = lifetime
        self.simulation = Simulation(level, body=body)
        self._chance = chance
        self._begin()

    def _begin(self) -> None:
        self.phase = READY
        self.lifetime = self.start_lifetime
        self.frames = bytearray()
        self.recording_open = True
        self.suicide = False
        self.ended_tick = -1
        self.score = 0
        self._gold = 0

    def retry(self) -> None:
        """The level from its start: lifetime as at its start, this attempt's gold and recording gone."""
        self.simulation.reset()
        self._begin()

    def start(self) -> None:
        """Begin to play, from the phase ``ready``."""
        if self.phase == READY:
            self.phase = PLAYING

    # --- time ---

    def tick(self, held: int) -> None:
        """One tick with these keys down (1 left, 2 right, 4 jump). Nothing happens in ``ready``."""
        if self.phase == READY:
            return
        w = self.simulation.world
        frame = held & (LEFT | RIGHT | HELD)
        if frame & HELD and not w.ninja.held:
            frame |= TRIGGERED
        self.simulation.step_frame(frame)
        if w.ninja.state not in (DEAD, CELEBRATING):
            self._record(frame)
        if w.gold > self._gold:
            # The bonus comes at once, in practice too; what is taken in the tick of the exit still counts.
            self.lifetime += GOLD_BONUS * (w.gold - self._gold)
            self._gold = w.gold
        if self.phase == PLAYING:
            if w.outcome:
                self._end()
            if not self.practice and self.phase != PASSED:
                self.lifetime -= 1
        if self.waiting_ticks == RETRY_DELAY + 1:
            self._close_recording()

    def _record(self, frame: int) -> None:
        """One more frame, if the recording is still open; at the longest length it is closed instead (§4.1)."""
        if self.recording_open and self.phase != PASSED:
            if len(self.frames) >= MAX_FRAMES:
                self._close_recording()
            else:
                self.frames.append(frame)

    def _end(self) -> None:
        """The exit contact or the death has just come, in the tick that ``simulation.tick`` has counted."""
        self.ended_tick = self.simulation.tick - 1
        if self.simulation.outcome == "exit":
            self.phase = PASSED
            self.score = level_score(self._gold, self.ended_tick)
        else:
            self.phase = DEAD_PHASE

    def time_up(self) -> bool:
        """Once a picture, after its ticks: who has no time left dies of it (§1.2). Whether that happened now."""
        due = self.phase == PLAYING and not self.practice and self.lifetime <= 0
        if due:
            self._kill(FALL, 0.0, 0.0)
        return due

    def give_up(self) -> None:
        """The suicide key: 30 % explosive, 70 % bullet, a random impulse. Only while playing."""
        if self.phase == PLAYING:
            kind = EXPLOSIVE if self._chance() < 0.3 else HARD_BULLET
            self.suicide = True
            self._kill(kind, self._chance() * 10.0 - 5.0, -6.0 * self._chance())

    def _kill(self, kind: int, fx: float, fy: float) -> None:
        w = self.simulation.world
        kill(w, kind, fx, fy, w.ninja.x, w.ninja.y)
        self.ended_tick = self.simulation.tick
        self.phase = DEAD_PHASE

    # --- after the end ---

    @property
    def waiting_ticks(self) -> int:
        """Ticks since the death; 0 while alive or passed."""
        return self.simulation.tick - self.ended_tick if self.phase == DEAD_PHASE else 0

    @property
    def retry_offered(self) -> bool:
        """Whether the retry message may stand there: more than 40 ticks after the death."""
        return self.waiting_ticks > RETRY_DELAY

    def _close_recording(self) -> None:
        """The recording's length goes down by one, the words stay (§4.3): the length is all that playback looks at."""
        if self.recording_open:
            self.recording_open = False
            del self.frames[max(len(self.frames) - 1, 0) :]

    @property
    def recording(self) -> bytes:
        """The inputs so far, one byte a tick; of a passed level exactly those up to the exit contact."""
        return bytes(self.frames)

    @property
    def gold(self) -> int:
        """Pieces of gold taken."""
        return self._gold

    @property
    def outcome(self) -> str:
        """What came first: "exit", "dead" or "running"; also deaths that the world did not cause."""
        return {PASSED: "exit", DEAD_PHASE: "dead"}.get(self.phase, "running")

    def replay(self, name: str = "", author: str = "") -> Replay:
        """The attempt as a replay text's content, with its level inside. Of a passed level: up to the exit contact.

        The inputs are run again, since the world has gone on since; what chance or the clock killed is "running" there.
        """
        final = self.ended_tick if self.phase == PASSED else max(len(self.frames) - 1, 0)
        run = Simulation(self.level, body=self.simulation.body)
        for frame in bytes(self.frames).ljust(final + 1, b"\0")[: final + 1]:
            run.step_frame(frame)
        return Replay(
            inputs=bytes(self.frames),
            final_tick=final,
            outcome=run.outcome,
            gold=run.gold,
            digest=run.digest(),
            name=name,
            author=author,
            body=run.body,
            level_digest=level_digest(self.level),
            level=self.level,
        )

    # --- practice ---

    def save(self) -> AttemptState:
        """This moment, to come back to."""
        counters = (self.lifetime, self.ended_tick, self._gold, self.suicide, self.recording_open)
        return AttemptState(self.simulation.save(), len(self.frames), self.phase, counters)

    def restore(self, state: AttemptState, frames: bytes | None = None) -> None:
        """Go back to a saved moment of this attempt; ``frames``: the inputs up to it, where they are not a prefix."""
        self.simulation.restore(state.world)
        if frames is not None:
            self.frames = bytearray(frames)
        del self.frames[state.frames :]
        self.phase = state.phase
        self.lifetime, self.ended_tick, self._gold, self.suicide, self.recording_open = state.counters
        self.score = level_score(self._gold, self.ended_tick) if self.phase == PASSED else 0
