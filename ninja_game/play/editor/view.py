"""The editor's picture: the level in the middle, panels around it, and what of them has to be drawn again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import pygame

from ninja_game.play.editor.marks import GRIDS, MIDDLE, Grid, finding_points, level_marks
from ninja_game.play.editor.overlay import Overlay
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.sheet import LevelSheet
from ninja_game.play.ui.canvas import Colour, Point
from ninja_game.play.ui.theme import Area, wrapped
from ninja_game.play.ui.widgets import Widget

if TYPE_CHECKING:
    from ninja_game.editor.certify import Route
    from ninja_game.levels.findings import Finding
    from ninja_game.play.app import App


class EditorLayout(NamedTuple):
    """Where things are, px of the stage."""

    level: Area = (6, 30, 602, 456)
    palette: Area = (616, 30, 172, 226)
    properties: Area = (616, 262, 170, 222)
    findings: Area = (6, 490, 602, 84)
    file: Area = (616, 490, 170, 84)
    status: Area = (0, 579, 792, 21)


LAYOUT = EditorLayout()


class EditorView:
    """What is seen. ``stale``: the panels are to be drawn again; ``moved``: the pointer is somewhere else."""

    def __init__(self, app: App, session: EditorSession) -> None:
        self.app = app
        self.session = session
        self.stale = self.moved = True
        self.hovering = False
        self.hint = ""
        self.grid: Grid = GRIDS[1]
        self.lines = self.paths = True
        self.toolbar: list[Widget] = []
        self.properties: list[Widget] = []
        self.shown_findings: list[Finding] = []
        self.shown_certificate = ""
        self._look: tuple[object, ...] = ()
        self._marked: tuple[object, ...] = ()
        self._lay_out()

    def render_key(self) -> tuple[object, ...]:
        return self.app.canvas, self.app.theme.palette.name

    def _lay_out(self) -> None:
        canvas = self.app.canvas
        x, y, w, h = LAYOUT.level
        self.sheet = LevelSheet(canvas.rect(x, y, w, h).size, self.app.theme.palette)
        self.overlay = Overlay(self.sheet, canvas.point(x, y))
        self.sheet.show(self.session.draft)
        self.sheet.show_grid(self.grid.lines())
        self._look = self.render_key()
        self._marked = ()

    def next_grid(self) -> None:
        """Another grid."""
        self.grid = GRIDS[(GRIDS.index(self.grid) + 1) % len(GRIDS)]
        self._look = ()

    # --- drawing ---

    def draw(
        self, surface: pygame.Surface, widgets: Sequence[Widget], focus: Widget | None, *, whole: bool
    ) -> list[pygame.Rect] | None:
        """Draw what has changed; the px that did, None for all."""
        if self._look != self.render_key():
            self._lay_out()
            whole = True
        tools = self.session.tools
        if tools.draft is not self.sheet.draft:
            self.sheet.show(tools.draft)
        self._follow_marks()
        dirty = self.sheet.paint()
        changed = []
        if whole:
            surface.fill(self.app.theme.palette.tile)
            surface.blit(self.sheet.surface, self.overlay.canvas.origin)
            self.stale = True
        elif dirty or self.stale or self.moved:
            changed = self.overlay.restore(surface, dirty)
        if whole or changed or self.stale or self.moved:
            changed = changed + list(self.overlay.draw(surface, tools, hovering=self.hovering))
        if self.stale:
            changed += self._draw_panels(surface, widgets, focus)
        if self.stale or self.moved:
            changed.append(self._draw_status(surface))
        if self.session.certifier.busy and not self.stale:
            changed.append(self._draw_file(surface))
        self.stale = self.moved = False
        return None if whole else changed

    def _follow_marks(self) -> None:
        """The marks over the level as they should be now."""
        session, palette = self.session, self.app.theme.palette
        certifier = session.certifier
        stale = certifier.is_stale(session.draft.level)
        wanted = (
            session.draft.objects, self.lines, self.paths, session.last_try, certifier.route, stale,
            session.findings, session.tools.symmetry,
        )  # fmt: skip
        if len(wanted) == len(self._marked) and all(a is b for a, b in zip(wanted, self._marked, strict=True)):
            return
        self._marked = wanted
        routes: list[tuple[Route, Colour]] = [(session.last_try, palette.ghost)]
        routes.append((certifier.route, palette.faint if stale else palette.good))
        marks = level_marks(
            self.sheet.canvas, palette, session.draft, self.sheet.marks, lines=self.lines, signs=self._signs(),
            routes=routes if self.paths else (), axes=_AXES.get(session.tools.symmetry, ()),
        )  # fmt: skip
        self.sheet.show_marks(marks)

    def _signs(self) -> list[Point]:
        """Where the findings are, in the level that was examined."""
        examined = self.session.examined
        found = [p for each in self.session.findings for p in finding_points(examined, each)] if examined else []
        return list(dict.fromkeys(found))

    def _draw_panels(
        self, surface: pygame.Surface, widgets: Sequence[Widget], focus: Widget | None
    ) -> list[pygame.Rect]:
        canvas, theme = self.app.canvas, self.app.theme
        rects = [canvas.fill_rect(surface, theme.palette.tile, 0, 0, 792, 30)]
        rects.append(canvas.fill_rect(surface, theme.palette.tile, 610, 30, 182, 548))
        x, y, w, h = LAYOUT.findings
        rects.append(canvas.fill_rect(surface, theme.palette.panel, x, y, w, h, 3))
        px, py, pw, ph = LAYOUT.properties
        canvas.fill_rect(surface, theme.palette.background, px - 4, py - 5, pw + 6, ph + 2, 3)
        for widget in widgets:
            widget.draw(surface, theme, focused=widget is focus)
        rects.append(self._draw_file(surface))
        return rects

    def _draw_file(self, surface: pygame.Surface) -> pygame.Rect:
        """The level's name and file, and how far the solver is."""
        canvas, theme, palette, session = self.app.canvas, self.app.theme, self.app.theme.palette, self.session
        x, y, w, h = LAYOUT.file
        rect = canvas.fill_rect(surface, palette.panel, x - 4, y, w + 6, h, 3)
        theme.text(surface, session.name, x, y + 5, size=11, bold=True, width=w)
        file = session.source.path.name if session.source.path else "no file yet"
        state = "saved" if session.is_saved and session.source.path else "not saved" if not session.is_saved else ""
        theme.text(surface, f"{file}  {state}", x, y + 20, size=9, colour=palette.faint, width=w)
        certifier = session.certifier
        text = certifier.text or "Not certified: F7 looks for a run"
        stale = certifier.is_stale(session.draft.level)
        if stale and not certifier.busy:
            text = "Certified before the last change: F7 again"
        elif certifier.run and not certifier.busy:
            text += ". To keep it: File, Keep the solver's run"
        for number, line in enumerate(wrapped(theme, text, w, 9)[:3]):
            colour = palette.good if certifier.run and not stale else palette.text
            theme.text(surface, line, x, y + 36 + 12 * number, size=9, colour=colour)
        if certifier.busy:
            canvas.fill_rect(surface, palette.panel_edge, x, y + h - 9, w, 5, 2)
            canvas.fill_rect(surface, palette.accent, x, y + h - 9, max(1.0, w * certifier.share), 5, 2)
        return rect

    def _draw_status(self, surface: pygame.Surface) -> pygame.Rect:
        """Where the pointer is, and what to do."""
        canvas, theme, palette = self.app.canvas, self.app.theme, self.app.theme.palette
        tools = self.session.tools
        rect = canvas.fill_rect(surface, palette.tile, *LAYOUT.status)
        (column, row), (x, y) = tools.cell, tools.pointer
        top = LAYOUT.status[1] + 5
        theme.text(surface, f"{column},{row}", 8, top, size=9.5, colour=palette.on_tile)
        theme.text(surface, f"{x:.0f},{y:.0f} px", 58, top, size=9.5, colour=palette.on_tile)
        text = "Click where the switch is; Esc gives up" if tools.placing_switch else self.hint
        tool = "brush" if tools.tool == "rectangle" and tools.draws_one else tools.tool
        theme.text(surface, text or _TOOL_HINTS[tool], 140, top, size=9.5, colour=palette.on_tile, width=640)
        return rect


_TOOL_HINTS = {
    "brush": "Left button draws, right erases, middle picks; wheel: next in the palette. F1: help",
    "rectangle": "Drag a rectangle; right button erases. F1: help",
    "fill": "A click fills what is joined and alike. F1: help",
    "select": "Click or drag a frame; drag what is selected; Shift adds. Ctrl+C, Ctrl+V, H, J, U. F1: help",
    "pick": "Click what to draw with. F1: help",
}


_X, _Y = MIDDLE
_UPRIGHT, _LEVEL = ((_X, 24.0), (_X, 576.0)), ((24.0, _Y), (768.0, _Y))
_AXES: dict[str, Sequence[tuple[Point, Point]]] = {
    "left-right": [_UPRIGHT], "up-down": [_LEVEL], "both": [_UPRIGHT, _LEVEL],
    "point": [((_X - 12, _Y), (_X + 12, _Y)), ((_X, _Y - 12), (_X, _Y + 12))],
}  # fmt: skip
"""Lines that show a symmetry."""
