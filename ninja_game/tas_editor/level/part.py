"""The level beside the roll: the world after the cursor's tick, the paths of runs, and the mouse over it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import hypot

import numpy as np
import pygame

from ninja_game.formats.replay.notations import KEY_NAMES
from ninja_game.play.replay.screen import SPEEDS
from ninja_game.play.workspace import Commands
from ninja_game.sim.grid import Point
from ninja_game.sim.kinds import EXIT, KIND_NAMES, SWITCH
from ninja_game.simulation import ObjectView, Simulation
from ninja_game.tas_editor.commands import TAS_COMMANDS
from ninja_game.tas_editor.editor import TasEditor, TasPart
from ninja_game.tas_editor.level import paths
from ninja_game.tas_editor.level.other_runs import OtherRuns
from ninja_game.tas_editor.level.picture import LevelPicture, RunGhost
from ninja_game.tas_editor.level.playing import Playing, TakeOver
from ninja_game.tas_editor.tabs.values_tab import proposed_formula
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.theme import Theme, plot_colour
from ninja_game.view.overlays import OVERLAY_ACTIONS

_REACH = 16.0  # px of the level within which the mouse points at an object
_NEAR = 40.0  # px of the level within which a click goes to a tick
_LEAP = 40.0  # least gain in px for which a drag leaps to a part of the run that is many ticks away

LINE = 13.0  # height of a text below the level, logical px

Px = tuple[int, int]


def nearest_tick(positions: paths.Positions, x: float, y: float, cursor: int, *, dragged: bool) -> int | None:
    """The tick, among those with a visible path, after which the ninja was nearest to a place, px of the level.

    None if it was never near, unless the mouse is ``dragged``.
    """
    first, last = paths.shown_span(cursor)
    in_span = positions[first:last] if first < len(positions) else positions
    first = first if first < len(positions) else 0
    far = np.hypot(in_span[:, 0] - x, in_span[:, 1] - y)
    if dragged:
        far += np.minimum(np.abs(np.arange(len(far)) + first - cursor), _LEAP)
    return first + int(np.argmin(far)) if dragged or far.min() < _NEAR else None


def object_at(run: Simulation, x: float, y: float) -> ObjectView | None:
    """The object nearest to a place now, if it is near; the switch of an exit counts as that exit."""
    world, objects = run.world, run.objects
    switches = (world.objects[world.objects[obj.id + 1].partner] for obj in objects if obj.kind == KIND_NAMES[EXIT])
    objects += [replace(run.object(obj.partner - 1), x=obj.x, y=obj.y) for obj in switches if obj.kind == SWITCH]
    nearest = min(objects, key=lambda obj: hypot(obj.x - x, obj.y - y), default=None)
    return nearest if nearest is not None and hypot(nearest.x - x, nearest.y - y) < _REACH else None


class LevelPart(TasPart):
    """The level, smaller than in the game. ``hover``: the tick for a click; ``pointed``: the object under the mouse.

    ``ask_to_watch``: proposes a formula about that object.
    """

    slot = "level"

    def __init__(self, editor: TasEditor, ask_to_watch: Callable[[str], object]) -> None:
        super().__init__(editor)
        self.ask_to_watch = ask_to_watch
        self.picture = LevelPicture(editor)
        self.playing = Playing(editor, self.picture)
        self.take_over = TakeOver(self.playing)
        self.others = OtherRuns(editor)
        self.hover: int | None = None
        self.pointed: ObjectView | None = None
        self._hovered_run = editor.track
        self.paths: paths.LevelPaths | None = None
        self._ghosts: dict[object, RunGhost] = {}
        self._known: tuple[object, ...] = ()
        self._positions: paths.Positions = np.zeros((0, 2))
        self._pointer = LevelPointer(self)
        self._followed: Point = (0.0, 0.0)

    def commands(self) -> Commands:
        playing, take_over = self.playing, self.take_over
        shared: Commands = {
            "faster": lambda: playing.change_speed(1), "slower": lambda: playing.change_speed(-1),
            "ghosts": self._switch_ghosts,
            "whole_level": self.picture.camera.show_all, **self.others.commands(),
            **{name: partial(self.picture.overlays.toggle, name) for name in OVERLAY_ACTIONS},
        }  # fmt: skip
        if take_over.on:
            return {
                "play": take_over.pause, "step": take_over.step, "step_back": take_over.step_back,
                "take_over": take_over.end, **shared,
            }  # fmt: skip
        return {
            "play": playing.toggle, "step": lambda: playing.step(1), "step_back": lambda: playing.step(-1),
            "take_over": take_over.begin, **shared,
        }  # fmt: skip

    def _switch_ghosts(self) -> None:
        self.editor.ghosts = not self.editor.ghosts

    def meaning(self, event: InputEvent) -> str:
        return self.take_over.meaning(event) if self.take_over.on else TAS_COMMANDS.meaning(event)

    @property
    def ghosts(self) -> list[RunGhost]:
        """The ghosts that were drawn last."""
        return list(self._ghosts.values())

    def update(self, real_ms: int) -> None:
        self.playing.update(real_ms)
        self.take_over.update(real_ms)
        if self._hovered_run is not self.editor.track:
            self.mouse_left()

    def stop(self) -> None:
        """End playback and play by hand; the speed is saved."""
        self.playing.stop()
        self.playing.remember()
        self.take_over.end()

    def capture(self, event: InputEvent) -> bool:
        take_over = self.take_over
        if take_over.on:
            if event.raw.type == pygame.WINDOWFOCUSLOST:
                take_over.stand_still()
            return event.raw.type == pygame.MOUSEBUTTONDOWN or take_over.captures(event)
        if self.playing.on and event.source == ("keys", "escape"):
            self.playing.stop()
            return True
        return False

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        self._pointer.handle_mouse(event, x, y)
        return True

    def point_at(self, tick: int | None, obj: ObjectView | None) -> None:
        self.hover, self.pointed = tick, obj
        self._hovered_run = self.editor.track

    def mouse_left(self) -> None:
        self.hover = self.pointed = None
        self._pointer.release()

    def render_key(self) -> tuple[object, ...]:
        editor, timeline, playing = self.editor, self.editor.session.timeline, self.playing
        moving = playing.on or self.take_over.on
        return (
            editor.track, editor.cursor, editor.selection, timeline.simulated_until, editor.session.before,
            editor.ghosts, tuple(editor.others), editor.preview, self.hover, self.pointed, editor.app.settings,
            playing.on, playing.speed,
            self.picture.camera.render_key, frozenset(self.picture.overlays.on),
            self.take_over.on, self.take_over.still, self.take_over.waiting,
            moving and playing.clock.remainder,
        )  # fmt: skip

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        editor, picture = self.editor, self.picture
        rect = theme.canvas.rect(*self.area)
        running = self.playing.on or (self.take_over.on and not (self.take_over.still or self.take_over.waiting))
        fraction = self.playing.clock.fraction if running else 1.0
        positions = self._present()
        whole = picture.fit(rect.size)
        others = self._follow_others(positions)
        picture.show(editor.cursor)
        self._follow_ninja(rect.size, fraction)
        whole = picture.fit(rect.size) or whole
        if whole or self.paths is None or self.paths.theme is not theme:
            self.paths = paths.LevelPaths(theme, picture.canvas)
        picture.view.draw(picture.surface, fraction, whole=whole)
        surface.blit(picture.surface, rect)
        inner = surface.subsurface(rect.clip(surface.get_rect()))
        over = self.paths
        over.draw_beside(inner, others)
        over.draw_flags(inner, positions, editor.track.markers)
        names = [(run.label, run.place(fraction), run.shade or theme.palette.ghost) for run in self.ghosts]
        over.draw_names(inner, names, picture.place(fraction))
        if len(positions):
            over.draw_present(inner, positions, editor.cursor, editor.selection, paths.shown_span(editor.cursor))
        picture.view.draw_ninja_over(inner, fraction)
        if self.hover is not None and self.hover < len(positions):
            over.draw_hover(inner, positions, self.hover)
        if self.pointed is not None:
            over.draw_object(inner, self.pointed)
        self._write(surface, theme)

    def _follow_ninja(self, size: tuple[int, int], fraction: float) -> None:
        """Scroll to the ninja after it has moved, unless the mouse drags."""
        place = self.picture.place(fraction)
        if place != self._followed and not self._pointer.is_busy:
            self.picture.camera.follow(size, *place)
        self._followed = place

    def _present(self) -> paths.Positions:
        """The ninja's place after each simulated tick."""
        timeline = self.editor.session.timeline
        state = timeline.inputs, timeline.simulated_until
        if state != self._known:
            self._known, self._positions = state, timeline.positions
        return self._positions

    def _follow_others(self, positions: paths.Positions) -> list[paths.OtherRunPath]:
        """Update the paths of other runs, and of the run before the last edit where it differs; and their ghosts."""
        editor = self.editor
        ghosts, self._ghosts = self._ghosts, {}
        if not editor.ghosts:
            self.picture.follow([])
            return []
        palette = self.editor.theme.palette
        runs = [(run, plot_colour(number, palette)) for number, run in enumerate(editor.others)]
        if editor.preview is not None:
            runs.append((editor.preview, palette.exit))
        before = editor.session.before
        at = paths.first_other_place(positions, before.positions)
        if at <= min(editor.cursor, len(before) - 1, len(positions) - 1):
            self._ghosts[before] = ghosts.get(before) or RunGhost(before)
        for run, colour in runs:
            self._ghosts[run.trajectory] = ghosts.get(run.trajectory) or RunGhost(run.trajectory, run.name, colour)
        self.picture.follow(self.ghosts)
        # During play by hand the other run is not shortened at each tick.
        first, last = paths.shown_span(editor.cursor)
        other_paths = [paths.OtherRunPath(run.trajectory, colour, first, last) for run, colour in runs]
        return [
            paths.OtherRunPath(before, palette.ghost, max(first, at - at % paths.BRIGHT_TICKS - 1), last, paths.FAINT),
            *other_paths,
        ]

    def _write(self, surface: pygame.Surface, theme: Theme) -> None:
        take_over = self.take_over
        if take_over.on:
            now, go_on = "your keys", " Space: pause;"
            if take_over.waiting:
                now, go_on = "press a key to begin", ""
            elif take_over.still:
                now, go_on = "tick by tick", " Space: go on;"
            text = f"Taken over: {now}. Enter: end;{go_on} . and ,: step"
        elif self.playing.on:
            text = "Playing. Space: stop"
        else:
            track, cursor = self.editor.track, self.editor.cursor
            down = (KEY_NAMES[track.keys_at(tick)].strip(".") or "-" for tick in (cursor, cursor + 1))
            text = f"Keys: {', next: '.join(down)}. Space: play; Enter: take over"
        x, y, w, h = self.area
        palette, y = theme.palette, y + h - LINE
        theme.canvas.fill_rect(surface, palette.tile, x, y, w, LINE)
        speed = f"speed x {SPEEDS[self.playing.speed]:g}"
        if self.picture.camera.zoom > 1:
            speed = f"zoom {self.picture.camera.zoom:.1f}, {speed}"
        right = theme.text(surface, speed, x + w - 6, y + 1, size=paths.LETTERS, colour=palette.on_tile, align="right")
        width = right.left / theme.canvas.scale - x - 12
        theme.text(
            surface, text, x + 6, y + 1, size=paths.LETTERS, colour=palette.on_tile, bold=take_over.on, width=width
        )


class LevelPointer:
    """The mouse over the level: goes along the run, moves the picture, zooms, points at objects."""

    def __init__(self, part: LevelPart) -> None:
        self._part = part
        self._editor = part.editor
        self._goes = False
        self._camera = part.picture.camera
        self._button = 0

    @property
    def is_busy(self) -> bool:
        """Whether it drags along the run or moves the picture."""
        return self._goes or self._camera.held is not None

    def release(self) -> None:
        self._goes, self._camera.held = False, None

    def handle_mouse(self, event: pygame.Event, x: float, y: float) -> None:
        """A mouse event at logical px of the window."""
        rect = self._editor.theme.canvas.rect(*self._part.area)
        left, top = self._editor.theme.canvas.point(x, y)
        point = left - rect.left, top - rect.top
        if event.type == pygame.MOUSEMOTION and not any(event.buttons):
            self.release()
        if event.type == pygame.MOUSEWHEEL:
            self._wheel(event.y, rect.size, point)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button in (pygame.BUTTON_MIDDLE, pygame.BUTTON_RIGHT):
            self._camera.grab(point)
            self._button = event.button
        elif event.type == pygame.MOUSEMOTION and self._camera.held:
            self._camera.drag(rect.size, point)
        elif event.type == pygame.MOUSEBUTTONUP and not self._camera.held:
            self.release()
        elif event.type == pygame.MOUSEBUTTONUP and event.button == self._button:
            self._click()
        elif not self._part.take_over.on:
            self._point(event, point)

    def _wheel(self, notches: float, size: Px, at: Px) -> None:
        part = self._part
        if not pygame.key.get_mods() & pygame.KMOD_CTRL:
            self._camera.zoom_at(size, at, notches)
        elif not part.take_over.on:
            part.playing.step(-round(notches))

    def _click(self) -> None:
        part = self._part
        self.release()
        if self._camera.moved or part.take_over.on:
            return
        if self._button == pygame.BUTTON_MIDDLE:
            self._camera.show_all()
        elif part.pointed is not None:
            part.ask_to_watch(proposed_formula(part.pointed.id, KIND_NAMES.index(part.pointed.kind)))

    def _point(self, event: pygame.Event, at: Px) -> None:
        """Name the object under the mouse; a click or a drag goes to the tick where the ninja was nearest."""
        part, editor = self._part, self._editor
        timeline = editor.session.timeline
        behind = timeline.end[0] + 1 or max(1, len(editor.track))
        positions = timeline.positions[:behind]
        if not len(positions):
            return
        place = part.picture.canvas.logical(at)
        dragged = self._goes and event.type == pygame.MOUSEMOTION and bool(event.buttons[0])
        pressed = event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT
        tick = nearest_tick(positions, *place, editor.cursor, dragged=dragged)
        part.point_at(tick, None if dragged else object_at(part.picture.run, *place))
        obj = part.pointed
        words = f"{obj.kind} {obj.id}; right button: watch it; " if obj else ""
        zoomed = self._camera.zoom > 1
        click = "" if tick is None else f"Click: to tick {tick}; "
        editor.hint = f"{words}{click}wheel: zoom{', right button: move, 0: all' if zoomed else ''}"
        self._goes = tick is not None and (dragged or pressed)
        if self._goes and tick is not None:
            part.playing.stop()
            editor.go(tick, select=bool(pygame.key.get_mods() & pygame.KMOD_SHIFT))
