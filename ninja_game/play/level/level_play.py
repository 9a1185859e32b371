"""The play of a level: its phases and ticks (game.md §2), with ghosts and practice tools."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from enum import Enum
from random import Random
from typing import NamedTuple

from ninja_game.formats.messages import arrow_targets, level_text
from ninja_game.levels.episodes import GAME
from ninja_game.play.app import App
from ninja_game.play.replay.playback import Ghost, Playback, RunClock
from ninja_game.player.attempt import Attempt, AttemptState
from ninja_game.player.playthrough import Playthrough
from ninja_game.player.progress import HELPED
from ninja_game.runs.advice import Advice
from ninja_game.runs.deaths import cause_of
from ninja_game.runs.message_queue import MessageQueue, in_two
from ninja_game.sim.grid import Point
from ninja_game.sim.inputs import MOVES
from ninja_game.sim.level import Level
from ninja_game.sim.rules import LIFETIME
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import CRUSHED
from ninja_game.simulation import Simulation
from ninja_game.ui.theme import Area
from ninja_game.view.hud import Hud, PlacedMessage, placed_message
from ninja_game.view.level_view import LevelView
from ninja_game.view.places import MAY, Things, things_in

_FILL_SHARE = 0.05  # least part of the missing length by which the bar grows per picture

DEATH_PAUSE = 8  # ticks after a death before the jump key retries

FREEZE_MS = 50  # ms for which the picture stands still at the exit

LATE_JUMP = 8  # ticks after the end in which the key for jump and retry counts as a jump that came too late

STAMP_TICKS = 14  # ticks from the exit contact to the stamp of the medal

# After a pass the failed tries are shown together.
TRIES_FROM = 40  # ticks after the exit contact
TRIES_TICKS = 80  # ticks for which they are shown
MAX_TRIES = 24  # the newest are shown

SLOW_TICK_MS = 100  # a tick in slow motion: a quarter of the speed

STUCK_AFTER = 4  # failed tries of a level before help is offered

MIN_TRY_TICKS = 20  # least ticks of a try that is shown after a pass

REWIND_TICKS = 2  # ticks back per tick for which the rewind key is held

_SPACING = 10  # ticks between save-states, at first


def eased_lifetime(shown: float, true: float) -> float:
    """The lifetime to show in the next picture: it approaches the true one, so that gold fills the bar smoothly."""
    if abs(true - shown) < 1:
        return true
    share = max(_FILL_SHARE, (1 - shown / LIFETIME) ** 2)
    return shown + (true - shown) * min(1.0, share)


def things_at_start(level: Level, world: World, texts: Iterable[str], inputs: bytes) -> Things:
    """The places that a level's texts should not cover: all things at its start, and the author's route."""
    places = list(things_in(world, tagged=bool(arrow_targets(texts))))
    if inputs:
        run = Simulation(level)
        for keys in inputs:
            run.step_keys(keys)
            if run.tick % 4 == 0:
                places.append((run.world.ninja.x, run.world.ninja.y, MAY))
    return tuple(places)


class Phase(Enum):
    """The phases of a level on the screen (game.md §2): waiting for a key, in play, paused, and after its end."""

    READY = "ready"
    PLAY = "play"
    PAUSED = "paused"
    DEAD = "dead"
    PASSED = "passed"


_PHASE_OF_OUTCOME = {"running": Phase.PLAY, "dead": Phase.DEAD, "exit": Phase.PASSED}
"""The phase in which an attempt with that outcome continues."""


class TextSpot(NamedTuple):
    """Where the ninja was when a text came, and where the other text lay then, px."""

    ninja: Point | None = None  #: None: the text stays in place
    taken: Area | None = None


class LevelPlay:
    """One level of a playthrough, played again and again; its view shows every tick."""

    def __init__(self, app: App, playthrough: Playthrough) -> None:
        self.app = app
        self.playthrough = playthrough
        self.rng = Random()  # noqa: S311 - presentation and the suicide key
        self.clock = RunClock()
        self.attempt = Attempt(
            playthrough.level,
            body=playthrough.body,
            lifetime=playthrough.lifetime,
            practice_mode=playthrough.practice_mode,
        )
        messages = playthrough.messages()
        level, inputs = playthrough.beginning() if messages else (playthrough.level, b"")
        is_same = level == playthrough.level
        world = self.attempt.simulation.world if is_same else Simulation(level).world
        texts = [message.text for message in messages]
        self.things = things_at_start(level, world, texts, inputs)  #: places that a message should not cover
        self.tools = PracticeTools(self.attempt)
        self.view = LevelView(app, self.attempt.simulation, seed=self.rng.randrange(1 << 30))
        self.all_gold = playthrough.level.gold
        self.show_tutorial = playthrough.show_tutorial
        self.helps = playthrough.shows_messages  #: whether the game gives advice
        teaches = bool(messages) and playthrough.entry.source != GAME
        happens, places = in_two(messages)
        self.messages = MessageQueue(happens, advice=Advice() if self.helps and not teaches else None)
        self.places = MessageQueue(places, self.attempt.simulation.tiles)  #: their texts come beside the others
        self.queues = self.messages, self.places
        self.spots: dict[MessageQueue, TextSpot] = {}  #: of the texts that came since the start
        for _ in range(playthrough.deaths):
            self.messages.on_death()
        self.shown_lifetime = float(self.attempt.lifetime)
        self.ghosts: list[Ghost] = []
        self.tries: deque[bytes] = deque(maxlen=MAX_TRIES)  #: inputs of the last failed tries
        self._frozen_ms = 0
        self._phase_before = Phase.READY
        self._wait_at_start()

    def _wait_at_start(self) -> None:
        self._go_to(Phase.READY)
        self.app.controls.stop_running()
        self._held_before = self.app.controls.poll()
        self.keys = self._ignored = self._tapped = 0  #: keys of the last tick
        self.ended_at = 0.0, 0.0  #: the ninja's place when the run ended, px
        self.after_end = self._frozen_ms = 0  #: ticks since the exit contact or death
        self.killer = ""  #: one of ``deaths.KILLERS``
        self.crushed = False  #: whether the killer crushed the ninja
        for queue in self.queues:
            if self.playthrough.lead:
                queue.say_again()
            else:
                queue.at_start()
        self.spots.clear()
        self.notices: list[str] = []  #: sentences about what a pass has won
        self.next_par = self.playthrough.next_par()  #: next medal and its time, while the level waits
        runs = self.playthrough.ghosts()
        if runs != [(ghost.inputs, ghost.pace) for ghost in self.ghosts]:
            self.ghosts = [Ghost(run, self.playthrough.level, self.playthrough.body, pace=pace) for run, pace in runs]
            self.view.ghosts = self.ghosts
        for keys in self.playthrough.lead:
            self.attempt.tick(keys)
            self.tools.playback.note()
            self._say()
        self.view.on_seek()

    def _say(self) -> None:
        """Update the messages after a tick. A new one keeps away from where the other is."""
        for queue, other in (self.queues, self.queues[::-1]):
            if queue.on_tick(self.attempt.simulation.world, other.text):
                there = self.placed(other)
                taken = Hud(self.app.theme).box(there).area if there else None
                self.spots[queue] = TextSpot(None if queue.is_start else self.ninja_place(), taken)
                self.changed = True

    def placed(self, queue: MessageQueue) -> PlacedMessage | None:
        """The text of a queue where it lies; None without one, and after the end."""
        text = queue.text
        is_advice = "\n" in text and queue.message is None
        if not text or self.phase in {Phase.DEAD, Phase.PASSED}:
            return None
        words = level_text(text, self.app.controls.name, self.attempt.gold, self.all_gold, self.messages.deaths)
        spot = self.spots.get(queue, TextSpot())
        event = queue.message and queue.event_places.get(queue.message)
        layout = self.playthrough.level.tiles, self.things, queue.message, spot.ninja, event
        # The text for a player who is stuck stays in place, too.
        placed = placed_message(words, *layout, of_start=queue.is_start or is_advice)
        lines = text.split("\n") if is_advice else []
        moves = tuple(sum(bit for name, bit in MOVES if f"{{{name}}}" in line) for line in lines)
        return placed._replace(taken=spot.taken, moves=moves)

    def ninja_place(self) -> tuple[float, float]:
        ninja = self.attempt.simulation.world.ninja
        return ninja.x, ninja.y

    # --- from phase to phase ---

    def _go_to(self, phase: Phase) -> None:
        self.phase = phase
        self.clock.reset()
        self.changed = True

    def begin(self, *, ignored: int = 0) -> None:
        """Start play. ``ignored``: keys that are down already, and count only when they are pressed again."""
        self._ignored = ignored
        self._go_to(Phase.PLAY)

    def pause(self) -> None:
        self._phase_before = self.phase
        self._go_to(Phase.PAUSED)

    def resume(self) -> None:
        self.app.controls.stop_running()
        self._held_before = self.app.controls.poll()
        self._ignored = self.app.controls.choosing()
        self._go_to(self._phase_before)

    def retry(self, *, ignored: int = 0) -> None:
        """Back to the level's start. Held keys count for this try, except the keys ``ignored``."""
        if self.attempt.outcome != "exit" and not self.attempt.assisted and len(self.attempt.inputs) > MIN_TRY_TICKS:
            self.tries.append(bytes(self.attempt.inputs))
        self.view.ghosts = self.ghosts
        self.attempt.restart()
        self.tools.restarted()
        self.shown_lifetime = float(self.attempt.lifetime)
        self._wait_at_start()
        self._held_before = ignored

    def give_up(self) -> None:
        """The suicide key: an explosion or a shot, by chance (game.md §2)."""
        rng = self.rng
        self.attempt.give_up(rng.random(), rng.uniform(-5, 5), -6 * rng.random())
        self.view.follow_ninja()
        self._note_end()

    @property
    def may_watch(self) -> bool:
        """Whether the attempt can be watched: the ninja died, or passed without invincibility."""
        return self.phase is Phase.DEAD or (self.phase is Phase.PASSED and not self.attempt.death_refused)

    @property
    def is_stuck(self) -> bool:
        """Whether there were enough failed tries to offer help."""
        return not self.playthrough.practice_mode and len(self.tries) + (self.phase is Phase.DEAD) >= STUCK_AFTER

    # --- practice ---

    def quick_load(self) -> bool:
        """Go back to the quick-save; False if there is none."""
        if not self.tools.quick_load():
            return False
        self.after_end = 0
        self.view.on_seek()
        self._go_to(_PHASE_OF_OUTCOME[self.attempt.outcome])
        return True

    def step(self) -> None:
        """Simulate one tick; then time stands still."""
        self.tools.stepping = self.changed = True
        self.run_ticks(1)

    def hold(self, *, rewinding: bool | None = None, slow: bool | None = None) -> None:
        """Apply a change of the keys for slow motion and rewind; both end the standstill of single steps."""
        tools = self.tools
        tools.rewinding = tools.rewinding if rewinding is None else rewinding
        tools.slow = tools.slow if slow is None else slow
        tools.stepping = False
        self.clock.reset()
        self.changed = True

    def _rewind(self, real_ms: int) -> None:
        due = self.clock.ticks_due(real_ms)
        if due:
            self.tools.rewind(due * REWIND_TICKS)
            self.view.on_seek()
            self.phase = Phase.PLAY if self.attempt.outcome == "running" else self.phase
            self.changed = True

    # --- time ---

    def update(self, real_ms: int) -> None:
        if self.phase is Phase.READY:
            due = self.clock.ticks_due(real_ms, self.app.tick_ms)
            for queue in self.queues:
                queue.add_read(due)
            self._wait_for_move()
        elif self.phase is not Phase.PAUSED:
            if self.tools.rewinding:
                self._rewind(real_ms)
            elif self._frozen_ms > 0:
                self._frozen_ms -= real_ms
            elif not self.tools.stepping:
                tick_ms = SLOW_TICK_MS if self.tools.slow else self.app.tick_ms * 100 // self.app.settings.game_speed
                self.run_ticks(self.clock.ticks_due(real_ms, tick_ms))
        if self.attempt.outcome != "exit":
            self.shown_lifetime = eased_lifetime(self.shown_lifetime, self.attempt.lifetime)

    @property
    def fraction(self) -> float:
        """The elapsed part of the present tick, 0…1."""
        still = self.phase in {Phase.PAUSED, Phase.READY} or self.tools.stepping or self.tools.rewinding
        return 1.0 if still else self.clock.fraction

    def _wait_for_move(self) -> None:
        """The first key press starts play; keys that were down before count only when they are pressed again."""
        held = self.app.controls.poll()
        self._held_before &= held
        self._tapped = held & ~self._held_before
        if self._tapped:
            self.begin()

    @property
    def invincible(self) -> bool:
        """Whether deaths are refused; not in practice, which can go back in time."""
        return self.app.settings.invincible and not self.playthrough.practice_mode

    def run_ticks(self, due: int) -> None:
        """Simulate a number of ticks, each with the keys of its moment."""
        slow = self.app.settings.game_speed < 100 or self.tools.slow or self.tools.stepping
        if due and self.phase is Phase.PLAY and slow:
            self.attempt.assists.add("slow motion")
        for _ in range(due):
            # Read the keys right before the tick, as late as possible.
            held = (self.app.controls.poll() | self._tapped) if self.phase is Phase.PLAY else 0
            self._ignored &= held
            self.keys, self._tapped = held & ~self._ignored, 0
            self.attempt.tick(self.keys, invincible=self.invincible)
            self.view.on_tick()
            self.tools.playback.note()
            if self.phase is Phase.PLAY:
                self._say()
            self._note_end()
        if due and self.phase is Phase.PLAY:
            self.attempt.check_time()
            if self.attempt.outcome == "dead":
                self.view.follow_ninja()
                self._note_end()

    def _note_end(self) -> None:
        """Change the phase at the first exit contact or death."""
        if self.phase is Phase.PLAY and self.attempt.outcome != "running":
            self.after_end, self.ended_at = 0, self.ninja_place()
            self.phase = _PHASE_OF_OUTCOME[self.attempt.outcome]
            self.changed = True
            if self.phase is Phase.PASSED:
                self.shown_lifetime = float(self.attempt.lifetime)
                self.notices = self.playthrough.passed(self.attempt)
                self._frozen_ms = 0 if self.app.settings.reduced_motion else FREEZE_MS
                if self.attempt.assisted and not self.playthrough.practice_mode:
                    self.notices = [HELPED, *self.notices]
            else:
                self.killer = self.attempt.killer
                self.crushed = cause_of(self.attempt.simulation.world) == CRUSHED
                self.messages.on_death()
                self.playthrough.died(self.attempt)
        elif self.phase in {Phase.DEAD, Phase.PASSED}:
            self.after_end += 1
            if self.phase is Phase.PASSED:
                self._celebrate()

    def _celebrate(self) -> None:
        """Stamp the medal; then show all failed tries together, fast enough for two seconds."""
        quiet = self.app.settings.reduced_motion
        if self.after_end == (1 if quiet else STAMP_TICKS) and self.medal:
            self.app.audio_output.play("medal")
        if self.after_end == TRIES_FROM and self.tries and not quiet:
            pace = max(1.0, max(map(len, self.tries)) / TRIES_TICKS)
            self.view.ghosts = [
                Ghost(run, self.playthrough.level, self.playthrough.body, pace=pace) for run in self.tries
            ]
        elif self.after_end == TRIES_FROM + TRIES_TICKS:
            self.view.ghosts = self.ghosts

    @property
    def medal(self) -> str:
        counts = self.phase is Phase.PASSED and not self.attempt.assisted
        return self.playthrough.pars.medal(self.attempt.ended_tick) if self.playthrough.pars and counts else ""

    @property
    def stamp(self) -> float:
        return 1.0 if self.app.settings.reduced_motion else min(1.0, (self.after_end + self.fraction) / STAMP_TICKS)


class PracticeTools:
    """The tools of a level screen. ``attempt``: the one they act on."""

    def __init__(self, attempt: Attempt) -> None:
        self.attempt = attempt
        self.saved: AttemptState | None = None
        self.slow = False
        self.rewinding = False
        self.stepping = False
        self.restarted()

    def restarted(self) -> None:
        """The attempt was restarted; a quick-save stays valid."""
        self.playback = Playback(self.attempt.simulation, self.attempt.inputs, spacing=_SPACING)
        self.rewinding = self.stepping = False

    def quick_save(self) -> None:
        self.saved = self.attempt.save()

    def quick_load(self) -> bool:
        """Go back to the quick-save; False if there is none."""
        if self.saved is None:
            return False
        self.attempt.restore(self.saved)
        self.playback.forget_after(self.attempt.simulation.tick)
        return True

    def rewind(self, ticks: int) -> None:
        attempt = self.attempt
        target = max(0, attempt.simulation.tick - ticks)
        self.playback.seek(target)
        self.playback.forget_after(target)
        attempt.after_rewind()
