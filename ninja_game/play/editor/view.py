"""The level under edit in its window: drawn, pointed at, and where the other parts are around it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import pygame

from ninja_game.play.app import App
from ninja_game.play.editor.marks import GRIDS, MIDDLE, Grid, finding_points, level_marks
from ninja_game.play.editor.overlay import Overlay
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.sheet import LevelSheet
from ninja_game.play.ui.canvas import Colour, Point
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import Widget
from ninja_game.play.workspace.part import Part

if TYPE_CHECKING:
    from ninja_game.editor.certify import Route


class EditorLayout(NamedTuple):
    """Where the parts are, px of the stage."""

    toolbar: Area = (0, 0, 792, 26)
    level: Area = (6, 30, 602, 456)
    palette: Area = (610, 26, 182, 231)
    properties: Area = (610, 257, 182, 231)
    findings: Area = (6, 490, 602, 84)
    file: Area = (612, 490, 176, 84)
    status: Area = (0, 579, 792, 21)


LAYOUT = EditorLayout()


class EditorView(Part):
    """The level under edit, and what lies over it. ``hovering``: the pointer is shown; ``hint``: for the line below."""

    area = LAYOUT.level

    def __init__(self, app: App, session: EditorSession, step_palette: Callable[[int], object]) -> None:
        self.app = app
        self.session = session
        self.hovering = False
        self.hint = ""
        self.grid: Grid = GRIDS[1]
        self.lines = self.paths = True
        self._step_palette = step_palette
        self._held = False
        self._marked: tuple[object, ...] = ()
        self._lay_out()

    def _layout_key(self) -> tuple[object, ...]:
        return self.app.canvas, self.app.theme.palette.name

    def _lay_out(self) -> None:
        canvas = self.app.canvas
        x, y, w, h = self.area
        self.sheet = LevelSheet(canvas.rect(x, y, w, h).size, self.app.theme.palette)
        self.overlay = Overlay(self.sheet, canvas.point(x, y))
        self.sheet.show(self.session.draft)
        self.sheet.show_grid(self.grid.lines())
        self._laid_out = self._layout_key()
        self._marked = ()

    def next_grid(self) -> None:
        self.grid = GRIDS[(GRIDS.index(self.grid) + 1) % len(GRIDS)]
        self.sheet.show_grid(self.grid.lines())

    # --- the mouse ---

    def press(self, *, erase: bool = False, pick: bool = False, add: bool = False) -> None:
        """A button goes down at the pointer."""
        self._held = True
        self.session.tools.press(erase=erase, pick=pick, add=add)

    def release(self) -> bool:
        """A button goes up; whether one was down."""
        held, self._held = self._held, False
        if held:
            self.session.tools.release()
        return held

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """Drawing, dragging; the wheel goes on in the palette."""
        if event.type == pygame.MOUSEWHEEL:
            self._step_palette(-event.y)
            return True
        if event.type == pygame.MOUSEBUTTONUP:
            self.release()
            return True
        self.session.tools.move(*self.overlay.canvas.logical(event.pos))
        self.hovering = self.overlay.area.collidepoint(event.pos)
        if event.type == pygame.MOUSEBUTTONDOWN:
            add = bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)
            right, middle = event.button == pygame.BUTTON_RIGHT, event.button == pygame.BUTTON_MIDDLE
            self.press(erase=right, pick=middle, add=add)
        return True

    def mouse_left(self) -> None:
        self.hovering = False

    # --- drawing ---

    def render_key(self) -> tuple[object, ...]:
        """All that the overlay depends on; the sheet knows what has changed of the level."""
        tools = self.session.tools
        return (
            tools.pointer, self.hovering, tools.tool, tools.objects, tools.tile, tools.record, tools.snap,
            tools.symmetry, tools.selection, tools.marquee, tools.placing_switch, tools.draft,
        )  # fmt: skip

    def draw(
        self, surface: pygame.Surface, theme: Theme, focus: Widget | None, *, whole: bool
    ) -> list[pygame.Rect]:  # fmt: skip
        if self._laid_out != self._layout_key():
            self._lay_out()
            whole = True
        tools = self.session.tools
        if tools.draft is not self.sheet.draft:
            self.sheet.show(tools.draft)
        self._follow_marks()
        dirty, key = self.sheet.paint(), self.render_key()
        if not (whole or dirty) and key == self._drawn:
            return []
        self._drawn = key
        if whole:
            changed = [self.overlay.area]
            surface.blit(self.sheet.surface, self.overlay.area)
        else:
            changed = self.overlay.restore(surface, dirty)
        return [*changed, *self.overlay.draw(surface, tools, hovering=self.hovering)]

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


_X, _Y = MIDDLE
_UPRIGHT, _LEVEL = ((_X, 24.0), (_X, 576.0)), ((24.0, _Y), (768.0, _Y))
_AXES: dict[str, Sequence[tuple[Point, Point]]] = {
    "left-right": [_UPRIGHT], "up-down": [_LEVEL], "both": [_UPRIGHT, _LEVEL],
    "point": [((_X - 12, _Y), (_X + 12, _Y)), ((_X, _Y - 12), (_X, _Y + 12))],
}  # fmt: skip
"""Lines that show a symmetry."""
