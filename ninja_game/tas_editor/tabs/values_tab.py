"""Watched values at the cursor's tick, their plots over the run, and the objects to choose from."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np
import pygame

from ninja_game.errors import NinjaGameError
from ninja_game.play.app import App
from ninja_game.play.menu_screen import MenuScreen, ask_text
from ninja_game.play.workspace import Commands
from ninja_game.runs.splits import SPLIT_EVENTS
from ninja_game.search.formula.language import FormulaValues
from ninja_game.sim.kinds import DOOR, EXIT, GOLD, KIND_NAMES, KIND_OF, MINE
from ninja_game.tas.timeline import Watch, parse_watch
from ninja_game.tas_editor.editor import TasEditor
from ninja_game.tas_editor.tabs.tab import SMALL, UNPLACED, Rows, Tab, put_in_a_row, what_is_wrong
from ninja_game.ui.list_view import ListView
from ninja_game.ui.theme import Area, Theme, contains_point, plot_colour
from ninja_game.ui.widgets import Button, Widget

MIN_SHOWN_TICKS = 10.0  # least ticks shown
_STEPS = (1, 2, 5, 10, 20, 40, 100, 200, 400, 1000, 2000, 4000, 10_000, 40_000)  # ticks between two numbers of the axis


@dataclass
class TickRange:
    """The ticks ``first`` … ``last`` (with fractions) of a run of ``length`` ticks, from ``left`` over ``width`` px."""

    left: float = 0.0
    width: float = 1.0
    length: float = MIN_SHOWN_TICKS
    first: float = 0.0
    last: float = MIN_SHOWN_TICKS

    @property
    def is_whole(self) -> bool:
        return self.first <= 0 and self.last >= self.length

    def x(self, tick: float) -> float:
        return self.left + self.width * (tick - self.first) / (self.last - self.first)

    def tick(self, x: float) -> float:
        return self.first + (self.last - self.first) * (x - self.left) / self.width

    def fit(self, length: float) -> None:
        whole, self.length = self.is_whole, max(length, MIN_SHOWN_TICKS)
        if whole:
            self.show_all()
        self.move(0.0)

    def show_all(self) -> None:
        self.first, self.last = 0.0, self.length

    def zoom(self, x: float, steps: int) -> None:
        """Show fewer ticks (steps > 0) or more, around the one at a place."""
        ticks = min(max((self.last - self.first) * 0.8**steps, MIN_SHOWN_TICKS), self.length)
        share = (x - self.left) / self.width
        self.first = self.tick(x) - share * ticks
        self.last = self.first + ticks
        self.move(0.0)

    def move(self, ticks: float) -> None:
        span = self.last - self.first
        self.first = max(0.0, min(self.first + ticks, self.length - span))
        self.last = self.first + span

    def follow(self, tick: float) -> None:
        if not self.first <= tick <= self.last:
            self.move(tick - (self.first + self.last) / 2)

    def axis(self) -> Iterator[int]:
        step = next((option for option in _STEPS if self.width * option / (self.last - self.first) >= 36), _STEPS[-1])
        return iter(range(-(-int(self.first) // step) * step, int(self.last) + 1, step))


def draw_lane(
    surface: pygame.Surface, theme: Theme, area: Area, window: TickRange, values: FormulaValues, colour: pygame.Color
) -> None:
    """A value over ticks, float64 (ticks,), in the window; NaN leaves a gap. Its bounds are at the left."""
    canvas, palette = theme.canvas, theme.palette
    x, y, w, h = area
    canvas.fill_rect(surface, palette.background, *area)
    start = max(0, int(window.first))
    in_window = values[start : int(window.last) + 2]
    finite = in_window[np.isfinite(in_window)]
    if not len(finite):
        theme.text(surface, "no value here", x + w / 2, y + h / 2 - 5, size=9, colour=palette.faint, align="centre")
        return
    low, high = float(finite.min()), float(finite.max())
    middle, span = (low + high) / 2, max(high - low, 1e-9)
    top, height = y + 3, h - 6
    if low < 0 < high:
        zero = top + height * (high / span)
        canvas.fill_rect(surface, palette.panel_edge, x, zero, w, 0.5)
    ticks = np.arange(start, start + len(in_window), dtype=np.float64)
    most = max(2, canvas.px(w))
    if len(in_window) > 2 * most:
        ticks, in_window = _thinned(ticks, in_window, most)
    share = (high - in_window) / span if high > low else np.full(len(in_window), 0.5) + 0 * in_window
    left, above = canvas.exact(window.left, top)
    px = left + (ticks - window.first) * (window.width * canvas.scale / (window.last - window.first))
    lane = canvas.rect(*area)
    inner = surface.subsurface(lane.clip(surface.get_rect()))
    points = np.column_stack([px, above + share * (height * canvas.scale)]) - inner.get_offset()
    _draw_line(inner, colour, points, canvas.px(1))
    bounds = ((high, y + 1), (low, y + h - 9)) if high > low else ((middle, y + h / 2 - 4),)
    for value, at in bounds:
        theme.text(surface, f"{value:.4g}", x - 3, at, size=8, colour=colour, align="right")


def _thinned(ticks: FormulaValues, values: FormulaValues, columns: int) -> tuple[FormulaValues, FormulaValues]:
    """The least and the greatest value in each column of px."""
    starts = np.arange(columns) * len(values) // columns
    pairs = np.column_stack([np.fmin.reduceat(values, starts), np.fmax.reduceat(values, starts)])
    return np.repeat(ticks[starts], 2), pairs.ravel()


def _draw_line(surface: pygame.Surface, colour: pygame.Color, points: FormulaValues, width: int) -> None:
    """A line through points, float64 (n, 2), px; NaN leaves a gap."""
    finite = np.isfinite(points[:, 1])
    for piece in np.split(points, np.flatnonzero(np.diff(finite)) + 1):
        if len(piece) > 1 and np.isfinite(piece[0, 1]):
            x, y = piece.T.tolist()  # twice as quick as a list for each point
            pygame.draw.lines(surface, colour, False, [*zip(x, y, strict=True)], width)


WatchableObject = tuple[int, int, float, float]  # id, kind, x and y (px) of an object


class ObjectChoice(MenuScreen):
    """All objects. ``choose`` is called with a formula about the chosen one."""

    title = "Objects of this level"
    foot = "Enter proposes to watch an object; Esc goes back"

    def __init__(self, app: App, objects: Sequence[WatchableObject], choose: Callable[[str], object]) -> None:
        super().__init__(app)
        self._objects = objects
        self._choose = choose
        self.list = ListView((40, 88, 712, 430), 20, self._draw_row, self._chosen, empty="This level has no objects")
        self.list.fill(objects)

    def build(self) -> Sequence[Widget]:
        return [self.list, Button((640, 530, 112, 24), "Back", self.back, size=10)]

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme = self.app.theme
        for x, text in ((48, "Id"), (100, "What"), (300, "x, y at the start, px"), (500, "To be watched")):
            theme.text(surface, text, x, 68, size=10, colour=theme.palette.faint)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        id_, kind, px, py = self._objects[index]
        x, y, w, h = area
        theme.row(surface, (x, y, w, h - 1), chosen=focused, focused=False, filled=focused)
        place, formula = f"{px:.6g}, {py:.6g}", proposed_formula(id_, kind)
        for at, text in ((48, str(id_)), (100, KIND_NAMES[kind]), (300, place), (500, formula)):
            theme.text(surface, text, at, y + 4, size=10.5)

    def _chosen(self, index: int) -> None:
        self.app.pop()
        self._choose(proposed_formula(*self._objects[index][:2]))


def proposed_formula(id_: int, kind: int) -> str:
    """The formula proposed for an object of a kind.

    >>> proposed_formula(3, GOLD), proposed_formula(4, EXIT)
    ('taken(3)', 'opened(4)')
    """
    if kind in (GOLD, MINE):
        return f"taken({id_})"
    if kind in (EXIT, DOOR):
        return f"opened({id_})"
    return f"object_x({id_})" if KIND_OF[kind].moves else f"status({id_})"


_USUAL = ("speed", "vx", "vy")  # watched by default
_LANES = 4  # values whose plot is shown at once


@dataclass(eq=False)
class Watched:
    """A watched value. ``plotted``: its plot is shown; ``number``: of its colour."""

    watch: Watch
    number: int
    plotted: bool = True
    values: FormulaValues = field(default_factory=lambda: np.zeros(0))


def watched_values(texts: Sequence[str]) -> Iterator[Watched]:
    """Saved formulas; invalid ones are left out."""
    for number, text in enumerate(texts):
        with suppress(NinjaGameError):
            yield Watched(parse_watch(text), number, plotted=number < _LANES)


def shown_value(watched: Watched, tick: int) -> str:
    value = float(watched.values[tick]) if tick < len(watched.values) else np.nan
    if not np.isfinite(value):
        return "-"
    if watched.watch.formula.truth:
        return "yes" if value > 0 else "no"
    return f"{value:.6g}"


_MAX_FORMULA = 200  # characters of a formula

_STILL = 3.0  # less movement of the mouse than this, px, is a click


class ValuesTab(Tab):
    """Formulas with their values at the cursor's tick, and plots of up to four of them."""

    name = "Values"

    def __init__(self, editor: TasEditor) -> None:
        super().__init__(editor)
        self.watched = list(watched_values(editor.session.branches.watched or _USUAL))
        self.window = TickRange()
        self._plot: Area = UNPLACED
        self.events: list[tuple[int, str]] = []
        hint = "Values at the cursor; a click shows or hides the plot"
        self.list = Rows(self._draw_row, self._toggle, empty="V watches a value", hint=hint)
        actions = [
            ("Watch", self.ask, "V: watch another value, such as object_x(12) or x > 400"),
            ("Objects", self.show_objects, "The objects of the level with their ids"),
            ("Remove", self.remove, "Stop watching the chosen value"),
        ]
        self._buttons = [Button(UNPLACED, text, action, hint=hint, size=SMALL) for text, action, hint in actions]
        self.widgets = [self.list, *self._buttons]
        self._made: tuple[object, ...] = ()
        self._cursor = 0
        self._grabbed: float | None = None
        self._dragged = False

    def arrange(self, x: float, y: float, w: float, h: float) -> None:
        listed = 168 + (w - 424) / 5
        self.list.area = x + 4, y + 5, listed, h - 27
        put_in_a_row((x + 4, y + h - 21, listed, 17), self._buttons, (48, 54, 54))
        left = x + listed + 40
        self._plot = left, y + 4, x + w - 6 - left, h - 23
        self.window.left, self.window.width = left, self._plot[2]

    def commands(self) -> Commands:
        return {"watch": self.ask}

    def refresh(self) -> None:
        timeline = self.editor.session.timeline
        state = (self.editor.track.inputs, timeline.simulated_until, *self.watched)
        if state != self._made:
            for watched in self.watched:
                watched.values = watched.watch.values(timeline)
            self.events = timeline.event_ticks
            self._made = state
            self.list.fill(self.watched)

    def ask(self, text: str = "") -> None:
        self.editor.tab = self.name
        prompt = "speed, x > 400, object_x(12) ..."
        ask_text(self.editor.app, "Watch a value", prompt, text, "Watch", self.add, _MAX_FORMULA)

    def add(self, text: str) -> None:
        """Watch a formula; an invalid one is reported and can be corrected."""
        try:
            watch = parse_watch(text)
            watch.values(self.editor.session.timeline)
        except NinjaGameError as error:
            self.ask(text)
            self.editor.app.notify(what_is_wrong(error))
            return
        number = next(k for k in range(len(self.watched) + 1) if k not in {watched.number for watched in self.watched})
        self.watched.append(Watched(watch, number))
        self._keep()
        self.list.nudge("last")
        self._few_lanes(self.watched[-1])

    def remove(self) -> None:
        del self.watched[self.list.index : self.list.index + 1]
        self._keep()

    def _keep(self) -> None:
        self.editor.session.watch(watched.watch.text for watched in self.watched)
        self.list.fill(self.watched)

    def show_objects(self) -> None:
        """The list of all objects; the formula of a chosen one is proposed."""
        self.editor.app.push(ObjectChoice(self.editor.app, self.editor.session.timeline.objects, self.ask))

    def _toggle(self, index: int) -> None:
        watched = self.watched[index]
        watched.plotted = not watched.plotted
        self._few_lanes(watched)

    def _few_lanes(self, latest: Watched) -> None:
        """Hide the first other plot if there are too many."""
        others = [watched for watched in self.watched if watched.plotted and watched is not latest]
        if latest.plotted and len(others) >= _LANES:
            others[0].plotted = False

    def update(self, real_ms: int) -> None:
        if self.editor.tab != self.name:
            return
        self.refresh()
        self.window.fit(self.editor.last_tick)
        if self.editor.cursor != self._cursor:
            self._cursor = self.editor.cursor
            self.window.follow(self._cursor)

    def render_key(self) -> tuple[object, ...]:
        editor = self.editor
        plotted = tuple((watched, watched.plotted) for watched in self.watched)
        view = self.window.first, self.window.last, self.list.over
        run = editor.track, editor.session.timeline.simulated_until
        return run, editor.cursor, editor.selection, plotted, view

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        x, y, w, h = self._plot
        lanes = [watched for watched in self.watched if watched.plotted]
        if not lanes:
            hint, faint = "Click a value to see its plot", theme.palette.faint
            theme.text(surface, hint, x + w / 2, y + h / 2, size=SMALL, colour=faint, align="centre", width=w)
        for k, watched in enumerate(lanes):
            lane = (x, y + h * k / len(lanes), w, h / len(lanes) - 3)
            draw_lane(surface, theme, lane, self.window, watched.values, plot_colour(watched.number, theme.palette))
        self._paint_ticks(surface, theme)

    def _paint_ticks(self, surface: pygame.Surface, theme: Theme) -> None:
        canvas, palette, window = theme.canvas, theme.palette, self.window
        x, y, w, h = self._plot
        before = surface.get_clip()
        surface.set_clip(canvas.rect(x, y, w, h + 8))
        first, last = self.editor.selection
        if last - first > 1:
            tint = pygame.Color(palette.accent.r, palette.accent.g, palette.accent.b, 40)
            canvas.fill_rect(surface, tint, window.x(first), y, window.x(last) - window.x(first), h)
        for tick, names in self.events:
            if window.first <= tick <= window.last:
                counts = any(name in SPLIT_EVENTS for name in names.split())
                colour = palette.gold_dark if "gold-taken" in names else palette.accent if counts else palette.faint
                canvas.fill_rect(surface, colour, window.x(tick) - 0.5, y + h - 1, 1, 7 if counts else 3)
        canvas.fill_rect(surface, palette.accent, window.x(self.editor.cursor) - 0.5, y, 1, h)
        surface.set_clip(before)
        for tick in window.axis():
            half = theme.width(str(tick), 8) / 2
            at = min(window.x(tick), x + w - half)
            theme.text(surface, str(tick), at, y + h + 7, size=8, colour=palette.faint, align="centre")

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, _: bool) -> None:
        watched, palette = self.watched[index], theme.palette
        x, y, w, h = area
        sign = (x + 4, y + h / 2 - 4, 8, 8)
        colour = plot_colour(watched.number, palette)
        if watched.plotted:
            theme.canvas.fill_rect(surface, colour, *sign, 2)
        else:
            theme.canvas.frame_rect(surface, colour, *sign, 1, 2)
        value = shown_value(watched, self.editor.cursor)
        right = theme.text(surface, value, x + w - 4, y + 3, size=SMALL, bold=True, align="right")
        width = right.left / theme.canvas.scale - theme.canvas.origin[0] / theme.canvas.scale - (x + 16) - 4
        theme.text(surface, watched.watch.text, x + 16, y + 3, size=SMALL, width=width)

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """In the plot: the wheel zooms, a drag moves, a click puts the cursor there, the right button shows all."""
        left, top, w, h = self._plot
        in_plot = contains_point((left, top, w, h + 18), x, y)
        if event.type == pygame.MOUSEBUTTONUP and self._grabbed is not None:
            if not self._dragged:
                self.editor.go(round(self.window.tick(x)), select=bool(pygame.key.get_mods() & pygame.KMOD_SHIFT))
            self._grabbed = None
            return True
        if event.type == pygame.MOUSEMOTION and self._grabbed is not None:
            self._dragged = self._dragged or abs(x - self._grabbed) > _STILL
            if self._dragged:
                self.window.move(self.window.tick(self._grabbed) - self.window.tick(x))
                self._grabbed = x
            return True
        if not in_plot:
            return super().mouse(event, x, y)
        if event.type == pygame.MOUSEMOTION:
            super().mouse(event, x, y)
            self._tell(round(self.window.tick(x)))
        if event.type == pygame.MOUSEWHEEL:
            self.window.zoom(x, event.y)
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            self._grabbed, self._dragged = x, False
        elif event.type == pygame.MOUSEBUTTONDOWN and event.button == 3:
            self.window.show_all()
        return True

    def _tell(self, tick: int) -> None:
        tick = min(max(0, tick), self.editor.last_tick)
        values = "  ".join(f"{lane.watch.text}: {shown_value(lane, tick)}" for lane in self.watched if lane.plotted)
        self.editor.hint = f"tick {tick}  {values}   (wheel: zoom, drag: move, right: all)"
