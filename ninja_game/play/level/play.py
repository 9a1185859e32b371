"""The play of a level: ready, play, pause, death, success (game.md §2), with ghosts and practice tools."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import pygame

from ninja_game.play.level.context import Course
from ninja_game.play.level.ghosts import Ghost
from ninja_game.play.level.hud import followed
from ninja_game.play.level.phase import DEATH_PAUSE, PHASE_OF_OUTCOME, Phase
from ninja_game.play.level.practice import REWIND_TICKS, SLOW_TICK_MS, Practice
from ninja_game.play.level.run_clock import RunClock
from ninja_game.play.menus.pause import PausePanel
from ninja_game.play.screen import Screen
from ninja_game.play.view.level_view import LevelView
from ninja_game.play.view.overlays import Overlays
from ninja_game.player.attempt import Attempt
from ninja_game.player.playthrough import keep_replay
from ninja_game.player.statistics import SELF, killer_of
from ninja_game.sim.kinds import GOLD

if TYPE_CHECKING:
    from ninja_game.play.app import App

_NOTICE_MS = 4000


class LevelPlay(Screen):
    """What happens in a level screen; ``LevelScreen`` adds keys and picture.

    Menus may call ``resume``, ``retry``, ``onward`` and ``quit``.
    """

    def __init__(self, app: App, course: Course) -> None:
        super().__init__(app)
        self.chance = Random()  # noqa: S311 - presentation and the suicide key
        self.clock = RunClock()
        self.overlays = Overlays()
        self._start(course)

    def _start(self, course: Course) -> None:
        """Begin a course: its first attempt."""
        self.course = course
        self.attempt = Attempt(
            course.level, body=course.body, lifetime=course.lifetime, practice=course.practice
        )  # fmt: skip
        self.practice = Practice(self.attempt)
        self.view = LevelView(self.app, self.attempt.simulation, chance=self.chance.randrange(1 << 30))
        self.view.overlays = self.overlays
        self.all_gold = sum(record.kind == GOLD for record in course.level.objects)
        self.shown_lifetime = 0.0
        self._ready()

    def _ready(self) -> None:
        """At the level's start, waiting for the player."""
        self.phase = Phase.READY
        self.notices: list[str] = []
        self._notice_ms = 0
        self._held_before = self.app.controls.held()
        self.last_keys = 0
        self.after_end = 0
        self.killer = ""
        self._ghosts()
        self.view.on_seek()
        self.redraw = True

    def _ghosts(self) -> None:
        runs = self.course.ghosts()
        if [run.inputs for run in runs] != [ghost.inputs for ghost in self.view.ghosts]:
            self.view.ghosts = [Ghost(run, self.course.level, self.course.body) for run in runs]

    # --- what menus and keys do ---

    def enter(self) -> None:
        """Uncovered: the clock starts afresh, and text input is off, so that keys are keys."""
        self.clock.reset()
        pygame.key.stop_text_input()

    def leave(self) -> None:
        """No sound from a covered level."""
        self.app.audio_output.quiet()

    def begin(self) -> None:
        """Start to play."""
        self.phase = Phase.PLAY
        self.clock.reset()
        self.redraw = True

    def pause(self) -> None:
        """Stop time; the app's panel, or a message."""
        if self.phase is not Phase.PLAY:
            return
        self.phase = Phase.PAUSED
        self.app.audio_output.quiet()
        self.redraw = True
        self.app.push(PausePanel(self.app, self))

    def resume(self) -> None:
        """Go on after a pause."""
        self.phase = Phase.PLAY
        self.clock.reset()
        self.redraw = True

    def retry(self) -> None:
        """Back to the level's start, at once."""
        self.app.audio_output.quiet()
        self.course.gave_up(self.attempt)
        self.attempt.restart()
        self.practice.restarted()
        self.shown_lifetime = float(self.attempt.lifetime)
        self._ready()
        # What is held is meant for this try.
        self._held_before = 0

    def onward(self) -> None:
        """From a passed level to what comes next."""
        following = self.course.onward()
        if following is None:
            self.quit()
        elif following is self.course:
            self.retry()
        else:
            self.app.audio_output.quiet()
            self._start(following)

    def skip(self) -> None:
        """In practice a level may be left out."""
        if self.course.practice:
            self.onward()

    def quit(self) -> None:
        """Leave the level."""
        self.course.gave_up(self.attempt)
        screen = self.course.leaving()
        if screen is None:
            self.app.pop()
        else:
            self.app.replace(screen)

    def watch_replay(self) -> None:
        """The attempt again, from its inputs."""
        from ninja_game.play.replay.playback import Take
        from ninja_game.play.replay.screen import ReplayScreen

        take = Take(self.course.title, self.course.level, bytes(self.attempt.inputs), self.course.body)
        self.app.push(ReplayScreen(self.app, [take]))

    def keep_replay(self) -> None:
        """Put this run among the player's replays, whatever it is worth."""
        player = self.app.player
        self.tell(keep_replay(player, self.attempt.replay(self.course.title, player.settings.name)))

    # --- what comes of it ---

    @property
    def may_watch(self) -> bool:
        """Whether the attempt can be watched: passed, or dead for a while and not by the player's own hand."""
        if self.phase is Phase.PASSED:
            return True
        return self.phase is Phase.DEAD and self.after_end > DEATH_PAUSE and not self.attempt.own_hand

    def give_up(self) -> None:
        """The suicide key: an explosion or a shot, thrown at random (game.md §2)."""
        chance = self.chance
        self.attempt.give_up(chance.random(), chance.uniform(-5, 5), -6 * chance.random())
        self.view.on_death()
        self._note_end()

    def put_back(self) -> None:
        """The attempt is at another moment: so is everything that shows it."""
        self.phase = PHASE_OF_OUTCOME[self.attempt.outcome]
        self.after_end = 0
        self.view.on_seek()
        self.clock.reset()
        self.redraw = True

    def tell(self, notice: str) -> None:
        """Show a line for a while."""
        self.notices = [notice]
        self._notice_ms = _NOTICE_MS
        self.redraw = True

    # --- time ---

    def update(self, real_ms: int) -> None:
        """Let the world go on, if it does."""
        if self._notice_ms > 0 and self.phase is not Phase.PASSED:
            self._notice_ms -= real_ms
            if self._notice_ms <= 0:
                self.notices = []
        if self.phase is Phase.READY:
            self._wait_for_move()
        elif self.phase is not Phase.PAUSED:
            if self.practice.rewinding:
                self._rewind(real_ms)
            elif not self.practice.stepping:
                tick_ms = SLOW_TICK_MS if self.practice.slow else self.app.tick_ms
                self.run_ticks(self.clock.ticks_due(real_ms, tick_ms))
        if self.attempt.outcome != "exit":
            self.shown_lifetime = followed(
                self.shown_lifetime, self.attempt.lifetime, filling=self.phase is Phase.READY
            )

    def _wait_for_move(self) -> None:
        """Any move begins; keys that were down before do not count until they are pressed again."""
        held = self.app.controls.held()
        self._held_before &= held
        if held & ~self._held_before:
            self.begin()

    def run_ticks(self, due: int) -> None:
        """So many ticks, each with the input of its moment."""
        for _ in range(due):
            # Sampled right before the tick: as late as can be.
            self.last_keys = self.app.controls.held() if self.phase is Phase.PLAY else 0
            self.attempt.tick(self.last_keys)
            self.view.on_tick()
            self.practice.on_tick()
            self._note_end()
        if due and self.phase is Phase.PLAY:
            self.attempt.check_time()
            if self.attempt.outcome == "dead":
                self.view.on_death()
                self._note_end()

    def _note_end(self) -> None:
        """Phases follow the first exit contact or death."""
        if self.phase is Phase.PLAY and self.attempt.outcome != "running":
            self.after_end = 0
            if self.attempt.outcome == "exit":
                self.phase = Phase.PASSED
                self.shown_lifetime = float(self.attempt.lifetime)
                self.notices = self.course.passed(self.attempt)
            else:
                self.phase = Phase.DEAD
                self.killer = SELF if self.attempt.own_hand else killer_of(self.attempt.simulation.world)
                self.course.died(self.attempt)
            self.redraw = True
        elif self.phase in {Phase.DEAD, Phase.PASSED}:
            self.after_end += 1
            if self.after_end == DEATH_PAUSE + 1:
                self.redraw = True

    def _rewind(self, real_ms: int) -> None:
        due = self.clock.ticks_due(real_ms)
        if due:
            self.practice.rewind(due * REWIND_TICKS)
            self.view.on_seek()
            self.phase = Phase.PLAY if self.attempt.outcome == "running" else self.phase
            self.redraw = True
