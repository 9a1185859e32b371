"""The level beside the roll: the world after the tick under the cursor, and the ways of runs."""

from __future__ import annotations

import numpy as np
import pygame

from ninja_game.play.input.events import InputEvent
from ninja_game.play.replay.screen import SPEEDS
from ninja_game.play.tas.bench import Bench
from ninja_game.play.tas.controls import command_of
from ninja_game.play.tas.level.other_runs import OtherRuns
from ninja_game.play.tas.level.paths import FAINT, NEAR, LevelPaths, Positions, Way, first_other_place, shown_span
from ninja_game.play.tas.level.picture import LevelPicture
from ninja_game.play.tas.level.playing import Playing
from ninja_game.play.tas.level.pointing import nearest_tick, object_at
from ninja_game.play.tas.level.run_ghost import RunGhost
from ninja_game.play.tas.level.take_over import TakeOver
from ninja_game.play.tas.part import Commands, Part
from ninja_game.play.tas.tabs.object_list import proposal
from ninja_game.play.tas.tabs.plot import colour_of
from ninja_game.play.ui.theme import Theme
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.simulation import ObjectView

_LETTERS = 17
"""Size of what is written into the level's frame, px of the level."""


class LevelPart(Part):
    """The level, smaller than in the game. ``hover``: the tick to which a click goes; ``pointed``: the object there."""

    slot = "level"

    def __init__(self, bench: Bench) -> None:
        super().__init__(bench)
        self.picture = LevelPicture(bench)
        self.playing = Playing(bench, self.picture)
        self.take_over = TakeOver(self.playing)
        self.others = OtherRuns(bench)
        self.hover: int | None = None
        self.pointed: ObjectView | None = None
        self._hovered_run = bench.take
        self._paths: LevelPaths | None = None
        self._ghosts: dict[object, RunGhost] = {}
        self._known: tuple[object, ...] = ()
        self._positions: Positions = np.zeros((0, 2))

    def commands(self) -> Commands:
        """Playing, taking over, other runs."""
        playing, taken = self.playing, self.take_over
        shared: Commands = {
            "faster": lambda: playing.change_speed(1), "slower": lambda: playing.change_speed(-1),
            "ghosts": self._toggle_ghosts, **self.others.commands(),
        }  # fmt: skip
        if taken.on:
            return {
                "play": taken.pause, "step": taken.step, "step_back": taken.step_back, "take_over": taken.end, **shared
            }  # fmt: skip
        return {
            "play": playing.toggle, "step": lambda: playing.step(1), "step_back": lambda: playing.step(-1),
            "take_over": taken.begin, **shared,
        }  # fmt: skip

    def meaning(self, event: InputEvent) -> str:
        """The command that an event means; '' for none."""
        return self.take_over.meaning(event) if self.take_over.on else command_of(event)

    @property
    def ghosts(self) -> list[RunGhost]:
        """Those that were drawn last."""
        return list(self._ghosts.values())

    def _toggle_ghosts(self) -> None:
        self.bench.ghosts = not self.bench.ghosts

    # --- time ---

    def update(self, real_ms: int) -> None:
        """Play on."""
        self.playing.update(real_ms)
        self.take_over.update(real_ms)
        if self._hovered_run is not self.bench.take:
            self.mouse_left()

    def stop(self) -> None:
        """End playing and taking over."""
        self.playing.stop()
        self.take_over.end()

    # --- keys and mouse ---

    def capture(self, event: InputEvent) -> bool:
        """Take the keys of the game while the run is taken over; Escape ends playing. Whether it did."""
        taken = self.take_over
        if taken.on:
            if event.raw.type == pygame.WINDOWFOCUSLOST:
                taken.stand_still()
            return event.raw.type == pygame.MOUSEBUTTONDOWN or taken.captures(event)
        if self.playing.on and event.source == ("keys", "escape"):
            self.playing.stop()
            return True
        return False

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """A click, or a drag, goes to the tick in which the ninja was nearest."""
        if event.type == pygame.MOUSEWHEEL:
            if not self.take_over.on:
                self.playing.step(-event.y)
            return True
        positions = self.bench.session.timeline.positions
        if self.take_over.on or not len(positions):
            return False
        canvas = self.bench.theme.canvas
        corner = canvas.rect(*self.area).topleft
        px, py = canvas.point(x, y)
        at = self.picture.canvas.logical((px - corner[0], py - corner[1]))
        dragged = event.type == pygame.MOUSEMOTION and event.buttons[0]
        pressed = event.button if event.type == pygame.MOUSEBUTTONDOWN else 0
        self.hover = nearest_tick(positions, *at, self.bench.cursor, dragged=dragged)
        self._hovered_run = self.bench.take
        self.pointed = None if dragged else object_at(self.picture.run, *at)
        words = f"{self.pointed.kind} {self.pointed.id}; right button: watch it   " if self.pointed else ""
        self.bench.hint = f"{words}Click: to tick {self.hover}"
        if dragged or pressed == pygame.BUTTON_LEFT:
            self.playing.stop()
            self.bench.go(self.hover, select=bool(pygame.key.get_mods() & pygame.KMOD_SHIFT))
        elif pressed == pygame.BUTTON_RIGHT and self.pointed:
            self.bench.ask_to_watch(proposal(self.pointed.id, KIND_NAMES.index(self.pointed.kind)))
        return True

    def mouse_left(self) -> None:
        """Nothing is pointed at."""
        self.hover = self.pointed = None

    # --- picture ---

    def look(self) -> tuple[object, ...]:
        """Run, cursor, what is shown beside, playing."""
        bench, timeline, playing = self.bench, self.bench.session.timeline, self.playing
        moving = playing.on or self.take_over.on
        return (
            bench.take, bench.cursor, bench.selection, timeline.valid, bench.session.before, bench.ghosts,
            tuple(bench.others), bench.preview, self.hover, self.pointed, bench.app.settings, playing.on, playing.speed,
            self.take_over.on, self.take_over.still, self.take_over.waiting, moving and playing.clock.remainder,
        )  # fmt: skip

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        """The level, the ways of runs, their ghosts, what goes on."""
        bench, picture = self.bench, self.picture
        rect = theme.canvas.rect(*self.area)
        whole = picture.fit(rect.size)
        if whole or self._paths is None:
            self._paths = LevelPaths(picture.context.theme)
        positions = self._present()
        ways = self._follow_others(positions)
        picture.show(bench.cursor)
        running = self.playing.on or (self.take_over.on and not (self.take_over.still or self.take_over.waiting))
        fraction = self.playing.clock.fraction if running else 1.0
        picture.draw(fraction, whole=whole)
        surface.blit(picture.surface, rect)
        inner = surface.subsurface(rect.clip(surface.get_rect()))
        paths = self._paths
        paths.draw_beside(inner, ways)
        if len(positions):
            paths.draw_present(inner, positions, bench.cursor, bench.selection, shown_span(bench.cursor))
            paths.draw_flags(inner, positions, bench.take.markers)
        picture.draw_ninja_over(inner, fraction)
        for ghost in self.ghosts:
            if ghost.label:
                paths.draw_name(inner, ghost.label, ghost.place(fraction), ghost.colour(picture.context.theme.palette))
        if self.hover is not None and self.hover < len(positions):
            paths.draw_hover(inner, positions, self.hover)
        if self.pointed is not None:
            paths.draw_object(inner, self.pointed)
        self._write(inner, picture.context.theme)

    def _present(self) -> Positions:
        """Where the ninja is after each simulated tick."""
        timeline = self.bench.session.timeline
        known = timeline.inputs, timeline.valid
        if known != self._known:
            self._known, self._positions = known, timeline.positions
        return self._positions

    def _follow_others(self, positions: Positions) -> list[Way]:
        """The ways of other runs, and of the run before the last edit where it was elsewhere; their ghosts go along."""
        bench = self.bench
        kept, self._ghosts = self._ghosts, {}
        if not bench.ghosts:
            self.picture.follow([])
            return []
        palette = self.picture.context.theme.palette
        runs = [(run, colour_of(number, palette)) for number, run in enumerate(bench.others)]
        if bench.preview is not None:
            runs.append((bench.preview, palette.exit))
        before = bench.session.before
        at = first_other_place(positions, before.positions)
        if at <= min(bench.cursor, len(before) - 1, len(positions) - 1):
            self._ghosts[before] = kept.get(before) or RunGhost(before)
        for run, colour in runs:
            self._ghosts[run.course] = kept.get(run.course) or RunGhost(run.course, run.name, colour)
        self.picture.follow(self.ghosts)
        # Not at each tick of a run that is taken over is the other one shorter.
        first, last = shown_span(bench.cursor)
        beside = [Way(run.course, colour, first, last) for run, colour in runs]
        return [Way(before, palette.ghost, max(first, at - at % NEAR - 1), last, FAINT), *beside]

    def _write(self, surface: pygame.Surface, theme: Theme) -> None:
        """What goes on, in the level's frame."""
        take_over = self.take_over
        if take_over.on:
            now = "press a key to begin" if take_over.waiting else "tick by tick" if take_over.still else "your keys"
            go_on = "go on" if take_over.still else "pause"
            text = f"Taken over: {now}.   Enter: end   Space: {go_on}   . ,: a tick on, back"
        elif self.playing.on:
            text = "Playing.   Space: stop"
        else:
            text = "Space: play   Enter: take over"
        colour = theme.palette.on_tile
        theme.text(surface, text, 10, 578, size=_LETTERS, colour=colour, bold=take_over.on, width=690)
        theme.text(surface, f"x {SPEEDS[self.playing.speed]:g}", 782, 578, size=_LETTERS, colour=colour, align="right")
