"""The toolbar above the level, and the status line below it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import pygame

from ninja_game.editor.bench import TAKES
from ninja_game.editor.brush import Tool
from ninja_game.editor.specs import has_switch, object_type_name
from ninja_game.formats.messages import parse_messages
from ninja_game.play.editor.part import EditorPart, ToolButton
from ninja_game.play.editor.sheet import message_near
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.sim.kinds import DOOR, EXIT
from ninja_game.ui.theme import Area, Theme

_TOP, _TALL, _GAP = 4.0, 21.0, 2.0

_BUTTONS = (
    ("file", "File", 30, 0), ("undo", "Undo", 36, 0), ("redo", "Redo", 36, 4),
    ("brush", "Brush", 38, 0), ("rectangle", "Box", 28, 0), ("line", "Line", 30, 0), ("ellipse", "Ellipse", 42, 0),
    ("fill", "Fill", 26, 0), ("select", "Select", 42, 0), ("pick", "Pick", 32, 4),
    ("symmetry", "Mirror: {symmetry}", 86, 0), ("grid", "Grid: {grid}", 92, 0), ("snap_next", "Snap: {snap}", 72, 4),
    ("playtest", "Test", 34, 0), ("certify", "{certify}", 46, 0), ("more", "More", 34, 0), ("help", "Help", 32, 0),
)  # fmt: skip
"""Command, text, width, more than the usual gap behind it, px."""


class Toolbar(EditorPart):
    """The row of buttons above the level. ``run``: does the command of a button in an area."""

    area = LAYOUT.toolbar

    def __init__(self, view: EditorView, run: Callable[[Area, str], object]) -> None:
        super().__init__(view)
        x, buttons = 6.0, []
        for name, text, width, gap in _BUTTONS:
            area = (x, _TOP, width, _TALL)
            buttons.append(ToolButton(area, name, text, partial(run, area), view))
            x += width + _GAP + gap
        self.widgets = buttons

    def render_key(self) -> tuple[object, ...]:
        tools = self.session.tools
        history = tools.history.can_undo, tools.history.can_redo
        return tools.effective_tool, tools.brush.state, self.view.grid, history, self.session.certify_text


class StatusLine(EditorPart):
    """The line below the level: what the next click does, and what is under the pointer."""

    area = LAYOUT.status

    def __init__(self, view: EditorView, run: Callable[[str], object]) -> None:
        super().__init__(view)
        x, y, w, _ = self.area
        self.widgets = [ToolButton((x + w - 62, y + 2, 58, 17), "zoom", "Zoom: {zoom}", run, view)]

    def text(self) -> str:
        tools = self.session.tools
        if tools.placing_switch:
            what = object_type_name(tools.brush.spec)
            return f"Now the switch of the {what}: click where it is. Esc removes the {what}"
        if tools.ghost:
            return "Click where it is pasted; H, J, U mirror, flip and turn it; Esc cancels"
        number = message_near(tools.draft, *tools.pointer) if self.view.hovering else None
        if number is not None:
            message = parse_messages(tools.draft.says)[number]
            drag = ", Select drags it" if message.place else ""
            return f"Double click opens the message{drag}: {message.one_line}"
        slopes = "Slopes by themselves. " if tools.sets_slopes else ""
        if tools.brush.slopes and tools.tool == Tool.RECTANGLE and not tools.brush.draws_objects:
            slopes = "No slopes: a box keeps its corners. "
        if tools.tool == Tool.SELECT and tools.takes != TAKES[0]:
            slopes = f"Takes only {tools.takes}: Shift+V. "
        start, hint = self.session.edited.at_pointer.start, slopes + _TOOL_HINTS[tools.effective_tool]
        if tools.brush.draws_objects and tools.effective_tool == Tool.BRUSH and tools.brush.spec.kind in (DOOR, EXIT):
            what, two = object_type_name(tools.brush.spec), has_switch(tools.brush.spec)
            hint = f"Click where the {what} is{', then where its switch is' if two else ': it has no switch'}. F1: help"
        if start != "off" and self.view.hovering:
            hint = _REACH.format(start) if self.session.edited.at_pointer.reach else _NO_REACH
        return self.view.hint or hint

    def render_key(self) -> tuple[object, ...]:
        return self.session.tools.pointer, self.session.tools.frame_size, self.text(), self.view.camera.zoom

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        tools, colour, top = self.session.tools, theme.palette.on_tile, self.area[1] + 5
        (column, row), (x, y) = tools.cell, tools.pointer
        theme.text(surface, f"{column},{row}", 8, top, size=9.5, colour=colour)
        place = "{} x {} cells".format(*tools.frame_size) if tools.frame_size else f"{x:.0f},{y:.0f} px"
        theme.text(surface, place, 58, top, size=9.5, colour=colour)
        theme.text(surface, self.text(), 140, top, size=9.5, colour=colour, width=584)


_REACH = "In 1 s, {}, the ninja can be where it is shaded, dies in the red; red lines: enemies; bars: last jumps"
_NO_REACH = "What is reached comes in a moment; the first time, what finds it is compiled for about half a minute"
_TOOL_HINTS = {
    Tool.BRUSH: "Left button draws, right erases, middle picks; wheel zooms, middle drag moves. F1: help",
    Tool.RECTANGLE: "Drag a rectangle; right button erases. F1: help",
    Tool.LINE: "Drag a line; the wheel bends it meanwhile; objects lie along it. F1: help",
    Tool.ELLIPSE: "Drag an ellipse; tiles fill it, objects lie along it. F1: help",
    Tool.FILL: "A click fills what is joined and alike. F1: help",
    Tool.SELECT: "Click or drag a frame; drag moves it, with Ctrl a copy; Shift adds, right button cancels. F1: help",
    Tool.PICK: "Click what to draw with. F1: help",
}
