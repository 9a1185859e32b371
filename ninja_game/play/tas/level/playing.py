"""The run plays in the TAS editor: from the cursor on, at any speed, and the cursor goes along."""

from __future__ import annotations

from ninja_game.play.level.play import RunClock
from ninja_game.play.replay.screen import SPEEDS
from ninja_game.play.tas.editor import TasEditor
from ninja_game.play.tas.level.picture import LevelPicture
from ninja_game.sim.rules import TICK_MS


class Playing:
    """``on``: it plays. ``speed``: a number of SPEEDS. ``clock``: also of a run that was taken over."""

    def __init__(self, editor: TasEditor, picture: LevelPicture) -> None:
        self.editor = editor
        self.picture = picture
        self.clock = RunClock()
        wished = editor.app.settings.play_speed / 100
        self.speed = min(range(len(SPEEDS)), key=lambda speed: abs(SPEEDS[speed] - wished))
        self.on = False

    @property
    def tick_ms(self) -> int:
        """Real ms a tick."""
        return max(1, round(TICK_MS / SPEEDS[self.speed]))

    def toggle(self) -> None:
        """Play, from the start if the cursor is at the end; or stop."""
        self.on = not self.on
        if self.on and self.editor.cursor >= self.editor.last_tick:
            self.editor.go(0)
        self.clock.reset()
        self.editor.app.audio_output.quiet()

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
        if percent != self.editor.app.settings.play_speed:
            self.editor.app.change_settings(play_speed=percent)

    def step(self, ticks: int) -> None:
        """Some ticks on, or back, and stop."""
        self.stop()
        self.editor.go(self.editor.cursor + ticks)

    def update(self, real_ms: int) -> None:
        """Let real time pass. It waits for what is not simulated yet."""
        if not self.on:
            return
        editor = self.editor
        for _ in range(self.clock.ticks_due(real_ms, self.tick_ms)):
            if editor.cursor >= editor.last_tick:
                self.stop()
                return
            if editor.session.timeline.simulated_until > editor.cursor + 1:
                editor.go(editor.cursor + 1)
                self.picture.show(editor.cursor, audible=True)
