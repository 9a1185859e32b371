"""Playback of the run from the cursor on, at any speed; and play by hand from there."""

from __future__ import annotations

import pygame

from ninja_game.play.replay.playback import RunClock
from ninja_game.play.replay.screen import SPEEDS
from ninja_game.sim.rules import TICK_MS
from ninja_game.tas.timeline import TICKS_BEHIND_END
from ninja_game.tas_editor.commands import BY_PAD, TAS_COMMANDS
from ninja_game.tas_editor.editor import TasEditor
from ninja_game.tas_editor.level.picture import LevelPicture
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.view.overlays import OVERLAY_ACTIONS


class Playing:
    """Playback of the run. ``on``: it plays. ``speed``: a number of SPEEDS. ``clock``: shared with play by hand."""

    def __init__(self, editor: TasEditor, picture: LevelPicture) -> None:
        self.editor = editor
        self.picture = picture
        self.clock = RunClock()
        wished = editor.app.settings.play_speed / 100
        self.speed = min(range(len(SPEEDS)), key=lambda speed: abs(SPEEDS[speed] - wished))
        self.on = False

    @property
    def tick_ms(self) -> int:
        return max(1, round(TICK_MS / SPEEDS[self.speed]))

    def toggle(self) -> None:
        self.on = not self.on
        if self.on and self.editor.cursor >= self.editor.last_tick:
            self.editor.go(0)
        self.clock.reset()
        self.editor.app.audio_output.quiet()

    def stop(self) -> None:
        if self.on:
            self.toggle()

    def change_speed(self, by: int) -> None:
        self.speed = min(len(SPEEDS) - 1, max(0, self.speed + by))
        self.clock.reset()

    def remember(self) -> None:
        """Save this speed for the next time."""
        percent = round(100 * SPEEDS[self.speed])
        if percent != self.editor.app.settings.play_speed:
            self.editor.app.change_settings(play_speed=percent)

    def step(self, ticks: int) -> None:
        self.stop()
        self.editor.go(self.editor.cursor + ticks)

    def update(self, real_ms: int) -> None:
        """Let real time pass. Playback waits for ticks that are not simulated yet."""
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


_OF_THE_APP = frozenset({"fullscreen", "screenshot", "boss"})
_MOVES = frozenset({"left", "right", "jump"})
_BY_ACTION = {"pause": "play", "back": "take_over", "frame_forward": "step", "frame_back": "step_back"}
"""Commands by actions of the game, for pads and for other keys."""
_WHILE_PLAYING = {
    "play", "take_over", "step", "step_back", "faster", "slower", "ghosts", "whole_level", *OVERLAY_ACTIONS
}  # fmt: skip
_BY_KEY = {"escape": "take_over"} | {
    key: command.name for command in TAS_COMMANDS.commands if command.name in _WHILE_PLAYING for key in command.keys
}
"""The commands during play by hand."""
_BY_PAD = {button: name for button, name in BY_PAD.items() if name in ("step", "step_back")}


class TakeOver:
    """Play by hand from the cursor on.

    ``on``: it is active. ``waiting``: it begins with the first key. ``still``: tick by tick, or paused. Each tick gets
    the keys that are down then; the whole is one edit. After an exit or a death nothing more is recorded; it ends when
    the ticks after that have been shown.
    """

    def __init__(self, playing: Playing) -> None:
        self.playing = playing
        self.editor = playing.editor
        self.on = self.waiting = self.still = False
        self.tick = 0
        self._held_before = 0

    def begin(self) -> None:
        """Begin at the tick under the cursor; the first pressed key starts the clock."""
        editor = self.editor
        self.playing.stop()
        editor.session.timeline.ensure(editor.cursor)
        if self._ended(editor.cursor):
            editor.app.notify(f"The run is over, {editor.session.timeline.ending()}; take over in a tick before")
            return
        editor.places[editor.track] = editor.cursor, editor.anchor
        editor.session.begin()
        self.on = self.waiting = True
        self.still = False
        self.tick = editor.cursor
        editor.go(self.tick)
        self._held_before = self._keys()

    def end(self) -> None:
        if self.on:
            self.on = False
            self.editor.app.audio_output.quiet()
            self.editor.session.end()
            self.editor.session.timeline.simulate(self.editor.session.ticks_per_frame)

    def pause(self) -> None:
        """Pause or continue; before the first key it still waits for one."""
        if not self.waiting:
            self.stand_still(still=not self.still)
        self.editor.app.controls.stop_running()

    def stand_still(self, *, still: bool = True) -> None:
        self.still, self.waiting = still, False
        self.playing.clock.reset()
        self.editor.app.audio_output.quiet()

    def step(self) -> None:
        self.stand_still()
        self._play_tick()

    def step_back(self) -> None:
        self.stand_still()
        self._go(max(0, self.tick - 1))

    def _go(self, tick: int, *, audible: bool = False) -> None:
        self.tick = tick
        self.editor.go(tick)
        self.playing.picture.show(tick, audible=audible)

    def _keys(self) -> int:
        """The keys to record: Space, which pauses, is no jump."""
        controls = self.editor.app.controls
        return controls.poll() & ~controls.choosing(pads=False)

    def _ended(self, tick: int, after: int = 0) -> bool:
        end = self.editor.session.timeline.end[0]
        return 0 <= end <= tick - after

    def _play_tick(self) -> None:
        editor, tick = self.editor, self.tick + 1
        session = editor.session
        if not self._ended(self.tick):
            keys = [self._keys()]
            if not editor.attempt(lambda: session.change(editor.track.replaced(tick, tick + 1, keys), ticks=0)):
                self.end()
                return
        session.timeline.ensure(tick)
        self._go(tick, audible=True)
        if self._ended(tick, TICKS_BEHIND_END) or tick >= editor.last_tick:
            self.end()

    def update(self, real_ms: int) -> None:
        if not self.on or self.still:
            return
        if self.waiting:
            # Keys that were down before count only when they are pressed again.
            held = self._keys()
            self._held_before &= held
            self.waiting = not held & ~self._held_before
            self.playing.clock.reset()
            return
        for _ in range(self.playing.clock.ticks_due(real_ms, self.playing.tick_ms)):
            if self.on:
                self._play_tick()

    @staticmethod
    def meaning(event: InputEvent) -> str:
        moves = _MOVES.intersection(event.pressed)
        # A key for both jump and confirm, as Space, is a command here; such a button of a pad does both.
        if event.source is None or (moves and (event.source[0] == "pad" or "confirm" not in event.pressed)):
            return ""
        if getattr(event.raw, "mod", 0) & (pygame.KMOD_CTRL | pygame.KMOD_META):
            return ""  # a command of the TAS editor, not of the bare key
        # The bare key counts: Shift may be down, which jumps.
        of_key = (_BY_KEY if event.source[0] == "keys" else _BY_PAD).get(event.source[1], "")
        return of_key or next((_BY_ACTION[action] for action in event.pressed if action in _BY_ACTION), "")

    def captures(self, event: InputEvent) -> bool:
        """Whether neither the commands nor the app get a key."""
        return event.source is not None and not self.meaning(event) and not _OF_THE_APP.intersection(event.pressed)
