"""The shared state of all parts of the TAS editor: session, cursor, selection, other runs; and the layout."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from math import ceil
from typing import ClassVar, NamedTuple
from weakref import WeakKeyDictionary

import pygame

from ninja_game.errors import NinjaGameError, reason
from ninja_game.play.app import App
from ninja_game.play.workspace import Commands, Pane
from ninja_game.player.settings import Settings
from ninja_game.sim.grid import Point
from ninja_game.tas.contributions import Contributions
from ninja_game.tas.journal import BesideRun
from ninja_game.tas.session import TasSession
from ninja_game.tas.timeline import Timeline, Trajectory
from ninja_game.tas.tracks import InputTrack
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Widget

Span = tuple[int, int]  # the first tick, and the first one behind the last


@dataclass(frozen=True)
class OtherRun:
    """A run shown beside the one under edit.

    ``trajectory``: its ninja's; ``made``: how, and by whom; ``ending``: its end in words.
    """

    name: str
    track: InputTrack
    trajectory: Trajectory = field(repr=False)
    made: Contributions = field(default_factory=Contributions)
    ending: str = ""


class TasEditor:
    """The shared state of all parts of the TAS editor."""

    def __init__(self, app: App, session: TasSession) -> None:
        self.app = app
        self.session = session
        self.theme: Theme = app.theme  #: in the TAS editor's own logical px, unlike other screens'
        self.cursor = 0  #: tick of the present row; the level is shown after that tick
        self.anchor: int | None = None  #: where a selection began; None: only the tick under the cursor is selected
        self._selected: Span | None = None
        self.others: list[OtherRun] = []  #: runs opened beside this one
        self.chosen = 0  #: number of the other run to copy from, if there are any
        self.ghosts = True
        self.preview: OtherRun | None = None  #: a search result or a branch that is shown
        self.tab = "Values"  #: name of the tab to show
        #: The run that the lead is measured against; None: the chosen other one, else the run as it was opened
        self.against: InputTrack | None = None
        self.hint = ""  #: text of the status line about the thing under the mouse
        self.leads: dict[int, int] = {}  #: ticks by which the run is ahead at each event of both runs, by its own tick
        #: Cursor and anchor when a run was edited, for undo
        self.places: WeakKeyDictionary[InputTrack, tuple[int, int | None]] = WeakKeyDictionary()

    @property
    def track(self) -> InputTrack:
        return self.session.track

    @property
    def beside(self) -> OtherRun | None:
        return self.others[self.chosen % len(self.others)] if self.others else None

    def other_run(self, name: str, track: InputTrack, made: Contributions | None = None) -> OtherRun:
        """An input track on the level of the run, to be shown beside it."""
        origin, memory = self.session.origin, self.session.timeline.memory
        timeline = Timeline(origin.level, track.inputs, body=origin.body, memory=memory)
        timeline.simulate(len(timeline))
        return OtherRun(
            name, track, timeline.trajectory(), made or Contributions(), timeline.ending() or timeline.unended_text()
        )

    def show_beside(self, run: OtherRun) -> None:
        """Show another run, and keep it in the journal."""
        self.others.append(run)
        self.session.show_beside(BesideRun(run.name, run.track, run.made))

    @property
    def selection(self) -> Span:
        anchor = self.cursor if self.anchor is None else self.anchor
        return min(anchor, self.cursor), max(anchor, self.cursor) + 1

    @property
    def last_tick(self) -> int:
        return len(self.session.timeline) - 1

    def go(self, tick: int, *, select: bool = False) -> None:
        """Put the cursor on a tick; ``select``: select the ticks between."""
        if not select:
            self.anchor = None
        elif self.anchor is None or (tick > self.cursor and (self.cursor, self.anchor) == self._selected):
            self.anchor = self.cursor
        self._selected = None
        self.cursor = min(max(0, tick), self.last_tick)

    def select(self, first: int, last: int) -> None:
        """Select the ticks ``first`` … ``last`` - 1; ``go`` extends the selection from either end."""
        self._selected = self.cursor, self.anchor = first, max(first, last - 1)

    def refuse(self, why: str) -> None:
        self.app.notify(why, refuses=True)

    def accept(self) -> None:
        """Clear the last refusal after a successful action."""
        if self.app.notice_refuses:
            self.app.notify("")

    def attempt(self, edit: Callable[[], object]) -> bool:
        """Run an action that may be refused; a notice says why. Whether it was done."""
        try:
            edit()
        except (NinjaGameError, OSError) as error:
            self.refuse(reason(error))
            return False
        self.accept()
        self.cursor = min(self.cursor, self.last_tick)
        if self.anchor is not None:
            self.anchor = min(self.anchor, self.last_tick)
        return True

    def edit(self, make: Callable[[InputTrack], InputTrack], taken: Contributions | None = None) -> bool:
        """Change the run by a function of its track; a refusal is reported. Whether it was done.

        ``taken``: the contributions of those whose keys are copied.
        """
        return self.attempt(lambda: self.session.change(make(self.track), taken=taken))

    def edit_selected(self, make: Callable[[InputTrack], InputTrack], taken: Contributions | None = None) -> bool:
        """Change the selected ticks; undo selects them again. Whether it was done."""
        self.places[self.track] = self.cursor, self.anchor
        return self.edit(make, taken)


class TasPart(Pane):
    """A part of the TAS editor. ``slot``: the name of its place in the layout."""

    slot: ClassVar[str] = ""

    def __init__(self, editor: TasEditor) -> None:
        self.editor = editor


MIN_LEFT, MIN_LEVEL, MIN_TABS, MIN_ROLL = 424.0, 200.0, 150.0, 350.0
MAX_ROLL, USUAL_TABS = 460.0, 203.0  # default sizes, logical px

_HEAD, _FOOT, _STRIP = 26.0, 21.0, 18.0
_EDGE, _GAP, _THIN = 6.0, 3.0, 2.0
_ABOVE, _BELOW = _HEAD + _THIN, _FOOT + _GAP
_BETWEEN = _GAP + _STRIP + _THIN  # distance between the level and the tabs


class TasLayout(NamedTuple):
    """Logical px: areas of the parts. ``strip``: of the names of the tabs."""

    size: Point
    head: Area
    level: Area
    strip: Area
    tabs: Area
    roll: Area
    foot: Area


def tas_canvas(window: tuple[int, int], text_scale: int = 0) -> Canvas:
    """A canvas that fills the window. A logical px, and so the text, grows as the square root of the window's size.

    >>> [round(tas_canvas(size).scale, 2) for size in ((792, 600), (1920, 1080), (2560, 1440))]
    [1.0, 1.34, 1.55]
    """
    width, height = max(1, window[0]), max(1, window[1])
    largest = min(width / WIDTH, height / HEIGHT)
    scale = min(largest, text_scale / 100 if text_scale else largest**0.5)
    return Canvas((width, height), (width / scale, height / scale))


def tas_layout(size: Point, settings: Settings) -> TasLayout:
    """The areas in a window of this logical size, at least that of the stage.

    Level and tabs are at the left, the roll at the right. By default (0 in the settings) the level is as large as the
    tabs' default height, at least a third, allows, and the roll has the rest of the width.
    """
    w, h = size
    shared = w - 3 * _EDGE
    height = h - _ABOVE - _BETWEEN - _BELOW
    usual = max(USUAL_TABS, height / 3)
    roll = min(max(MIN_ROLL, shared - (height - usual) * WIDTH / HEIGHT), MAX_ROLL)
    left = shared * settings.level_width / 100 if settings.level_width else shared - roll
    left = min(max(MIN_LEFT, left), shared - MIN_ROLL)
    usual = max(usual, height - ceil(left * HEIGHT / WIDTH))
    tabs = height * settings.tabs_height / 100 if settings.tabs_height else usual
    tabs = min(max(MIN_TABS, tabs), height - MIN_LEVEL)
    top = _ABOVE + height - tabs
    aside = left + 2 * _EDGE
    return TasLayout(
        size,
        head=(0, 0, w, _HEAD),
        level=(_EDGE, _ABOVE, left, height - tabs),
        strip=(_EDGE, top + _GAP, left, _STRIP),
        tabs=(_EDGE, top + _BETWEEN, left, tabs),
        roll=(aside, _ABOVE, w - aside - _EDGE, h - _ABOVE - _BELOW),
        foot=(0, h - _FOOT, w, _FOOT),
    )


_TEXT_SCALES = (80, 90, 100, 110, 125, 140, 160, 180, 200, 240, 280, 320, 400)
"""Sizes of the letters to choose from, percent."""


class Splitters(TasPart):
    """The borders between the parts, which the mouse drags. ``layout``: valid after ``fit``.

    Dragged borders and the size of the letters are settings.
    """

    layout: TasLayout

    def __init__(self, editor: TasEditor, parts: Sequence[TasPart]) -> None:
        super().__init__(editor)
        self._parts = parts
        self._known: tuple[object, ...] = ()
        self._dragged_to: Settings | None = None
        self._side = ""
        self._grabbed = 0.0, 0.0
        self._before: TasLayout | None = None

    @property
    def _settings(self) -> Settings:
        return self._dragged_to or self.editor.app.settings

    def fit(self) -> bool:
        """Update theme and layout for the window, and place all parts; whether they have changed."""
        theme, settings = self.editor.app.theme, self._settings
        if (theme, settings) == self._known:
            return False
        canvas = tas_canvas(theme.canvas.window, settings.text_scale)
        if self._known[:1] != (theme,) or self.editor.theme.canvas.scale != canvas.scale:
            self.editor.theme = Theme(theme.palette, canvas)
        self._known = theme, settings
        self.layout = tas_layout((canvas.window[0] / canvas.scale, canvas.window[1] / canvas.scale), settings)
        for part in self._parts:
            part.place(getattr(self.layout, part.slot))
        return True

    def commands(self) -> Commands:
        return {
            "zoom_in": lambda: self.change_text_scale(1),
            "zoom_out": lambda: self.change_text_scale(-1),
            "reset_layout": lambda: self.editor.app.change_settings(text_scale=0, level_width=0, tabs_height=0),
        }

    def change_text_scale(self, by: int) -> None:
        app = self.editor.app
        now = self.editor.theme.canvas.scale * 100
        largest = app.theme.canvas.scale * 100
        sizes = [scale for scale in _TEXT_SCALES if (scale - now) * by > 1 and scale < largest]
        text_scale = min(sizes, key=lambda scale: abs(scale - now), default=round(largest) if by > 0 else 0)
        if not text_scale or (by > 0 and now > largest - 1):
            app.notify(f"The layout is as {'large as this window allows' if by > 0 else 'small as can be'}")
        else:
            app.change_settings(text_scale=text_scale)

    def draw(self, surface: pygame.Surface, theme: Theme, focus: Widget | None, *, whole: bool) -> list[pygame.Rect]:
        return []

    def contains(self, x: float, y: float) -> bool:
        return bool(self._side_at(x, y))

    def _side_at(self, x: float, y: float) -> str:
        """The border at a place: "left" of the roll, above the "tabs", or ''."""
        level, strip, roll = self.layout.level, self.layout.strip, self.layout.roll
        if level[0] + level[2] <= x < roll[0] and level[1] <= y < roll[1] + roll[3]:
            return "left"
        return "tabs" if level[0] <= x < roll[0] and level[1] + level[3] <= y < strip[1] else ""

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == pygame.BUTTON_LEFT:
            left, top, w, h = self.layout.level
            self._side = self._side_at(x, y)
            self._grabbed = (x - left - w, y - top - h)
            self._before = self.layout
        elif event.type == pygame.MOUSEMOTION:
            side = self._side or self._side_at(x, y)
            _show_pointer(pygame.SYSTEM_CURSOR_SIZEWE if side == "left" else pygame.SYSTEM_CURSOR_SIZENS)
            self.editor.hint = "Drag: more room for one side; Ctrl+0: reset the layout"
            if self._side:
                self._drag(x, y)
        elif event.type == pygame.MOUSEBUTTONUP:
            self._end()
        return True

    def _drag(self, x: float, y: float) -> None:
        (left, top, w, h), tabs = self.layout.level, self.layout.tabs[3]
        dx, dy = self._grabbed
        if self._side == "left":
            width = _percent((x - dx - left) / (w + self.layout.roll[2]))
            self._dragged_to = self._settings.changed(level_width=width)
        else:
            self._dragged_to = self._settings.changed(tabs_height=_percent(1 - (y - dy - top) / (h + tabs)))

    def _end(self) -> None:
        self._side = ""
        settings, self._dragged_to = self._dragged_to, None
        # A window too small to drag in changes no choice for larger windows.
        if settings is not None and self.layout != self._before:
            self.editor.app.change_settings(level_width=settings.level_width, tabs_height=settings.tabs_height)

    def mouse_left(self) -> None:
        _show_pointer(pygame.SYSTEM_CURSOR_ARROW)
        self._end()


def _show_pointer(pointer: int) -> None:
    with suppress(pygame.error):  # some systems have only one
        pygame.mouse.set_cursor(pointer)


def _percent(share: float) -> int:
    return min(99, max(1, round(100 * share)))
