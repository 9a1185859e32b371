"""The run plays in the bench: from the cursor on, at any speed, and the cursor follows."""

from __future__ import annotations

from ninja_game.play.level.run_clock import RunClock
from ninja_game.play.replay.screen import SPEEDS
from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.level.picture import LevelPicture
from ninja_game.sim.rules import TICK_MS


class Playing:
    """``on``: it plays. ``speed``: a number of SPEEDS. ``clock``: also of a run that was taken over."""

    def __init__(self, bench: Bench, picture: LevelPicture) -> None:
        self.bench = bench
        self.picture = picture
        self.clock = RunClock()
        wished = bench.app.settings.play_speed / 100
        self.speed = min(range(len(SPEEDS)), key=lambda speed: abs(SPEEDS[speed] - wished))
        self.on = False

    @property
    def tick_ms(self) -> int:
        """Real ms a tick."""
        return max(1, round(TICK_MS / SPEEDS[self.speed]))

    def toggle(self) -> None:
        """Play, from the start if the cursor is at the end; or stop."""
        self.on = not self.on
        if self.on and self.bench.cursor >= self.bench.last_tick:
            self.bench.go(0)
        self.clock.reset()
        self.bench.app.audio_output.quiet()

    def stop(self) -> None:
        """Stop."""
        if self.on:
            self.toggle()

    def change_speed(self, by: int) -> None:
        """Faster or slower by this many steps."""
        self.speed = min(len(SPEEDS) - 1, max(0, self.speed + by))
        self.clock.reset()

    def remember(self) -> None:
        """Have this speed the next time, too."""
        percent = round(100 * SPEEDS[self.speed])
        if percent != self.bench.app.settings.play_speed:
            self.bench.app.change_settings(play_speed=percent)

    def step(self, ticks: int) -> None:
        """Some ticks on, or back, and stop."""
        self.stop()
        self.bench.go(self.bench.cursor + ticks)

    def update(self, real_ms: int) -> None:
        """Let real time pass. It waits for what is not simulated yet."""
        if not self.on:
            return
        bench = self.bench
        for _ in range(self.clock.ticks_due(real_ms, self.tick_ms)):
            if bench.cursor >= bench.last_tick:
                self.stop()
                return
            if bench.session.timeline.valid > bench.cursor + 1:
                bench.go(bench.cursor + 1)
                self.picture.show(bench.cursor, audible=True)
