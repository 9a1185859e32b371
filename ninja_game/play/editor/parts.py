"""The parts around the level: toolbar, palette or list of objects, properties, findings, the file, the status line."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import lru_cache, partial

import pygame

from ninja_game.editor.brush import tile_name
from ninja_game.editor.motion import CLOCKWISE, FLIP, MIRROR, Motion
from ninja_game.editor.specs import (
    BODY_PART,
    SWITCH_PART,
    carried,
    has_switch,
    object_type_name,
    points,
    properties,
    word,
)
from ninja_game.editor.tools import CURVES, NEAREST, OTHER_KINDS, SPACINGS, TAKES, EditorTools, can_be_remade, remade
from ninja_game.errors import LevelError
from ninja_game.files.shown_text import counted
from ninja_game.files.user_folder import short_path
from ninja_game.formats.ascii.places import place_text, read_place
from ninja_game.formats.ascii.writer import best_form
from ninja_game.formats.messages import parse_messages
from ninja_game.levels.findings import Finding
from ninja_game.play.editor.commands import EDITOR_COMMANDS
from ninja_game.play.editor.palette_view import PaletteView, live_changes
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.sheet import message_near
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.play.menu_screen import CANCEL, Menu, MenuRow, ask_text
from ninja_game.play.workspace import Pane
from ninja_game.sim.grid import cell_of
from ninja_game.sim.kinds import DOOR, EXIT
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.rules import CELL
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme, wrapped
from ninja_game.ui.widgets import Button, Choice, Label, Widget

_ROW = 22.5

_MESSAGE_LINES = 4  # the most lines of a message in the panel

_OPENS = "Its text, moment, place and frame; a double click on the bubble opens it too"

FIRST_STEPS = (
    "First draw a floor; put the ninja",
    "(Shift+N) on it, and the exit",
    "(Shift+E) with its switch. F5 plays",
)
"""The panel's text for an empty level."""


def panel_key(tools: EditorTools) -> tuple[object, ...]:
    """The subject of the panel: when it changes, the panel is rebuilt."""
    if tools.ghost:
        return len(tools.ghost.tiles), len(tools.ghost.objects), "pasted"
    if tools.selection:
        spec = tools.chosen
        kind = (object_type_name(spec), len(spec.values)) if spec else None
        return (
            tools.selection.area,
            tools.selection.parts,
            [(name, not _present(tools, name)) for name in _common(tools.subjects)],
            kind,
            spec and tuple(points(spec).items()),
        )
    drawn = object_type_name(tools.spec) if tools.draws_objects else tools.tile
    return tools.draft.level == Level(), tools.draws_objects, drawn, tools.effective_tool in CURVES, _taking(tools)


def _taking(tools: EditorTools) -> str:
    """What a press does to the panel's subject."""
    return "In hand" if tools.tool in ("select", "pick") else "Draw"


def _title(verb: str, cells: int, objects: int) -> str:
    return f"{verb}: {counted(cells, 'cell') + ', ' if cells else ''}{counted(objects, 'object')}"


def _turning(view: EditorView) -> Callable[[Area], Sequence[Widget]]:
    turns = {"mirror": MIRROR, "flip": FLIP, "turn": CLOCKWISE}
    return _row(
        [(name.capitalize(), partial(view.turn, turn), EDITOR_COMMANDS.hint(name)) for name, turn in turns.items()]
    )


_Row = Callable[[Area], Widget | Sequence[Widget]]  # makes the widgets of a row in its place


def property_widgets(view: EditorView, area: Area) -> Sequence[Widget]:
    """A title and rows about what is selected, pasted or in hand."""
    x, y, w, _ = area
    tools = view.session.tools
    if view.message is not None:
        title, rows = _of_message(view, view.message, w)
    elif tools.ghost:
        title = _title("A click pastes", len(tools.ghost.tiles), len(tools.ghost.objects))
        rows = [_turning(view)]
    elif tools.selection and tools.chosen is None:
        title, rows = _of_several(view)
    elif tools.selection or tools.draws_objects:
        title, rows = _of_object(tools)
    else:
        title, rows = _of_tile(view)
    head, rows = Label((x, y, w, 15), title, size=10), [*_copying(tools), *rows]
    row = min(_ROW, (area[3] - 17) / max(1, len(rows)))
    made = [make((x, y + 17 + row * k, w, row - 3)) for k, make in enumerate(rows)]
    return [head, *(widget for widgets in made for widget in (widgets if isinstance(widgets, Sequence) else [widgets]))]


def _hints(texts: Sequence[str]) -> list[_Row]:
    return [partial(Label, text=text, size=9.5, faint=True) for text in texts]


def _copying(tools: EditorTools) -> list[_Row]:
    """What Select takes, and what happens to the empty cells of a copy."""
    rows: list[_Row] = []
    if tools.tool == "select" and not tools.ghost:
        taken = list(zip(("takes: all", "takes: only tiles", "takes: only objects"), TAKES, strict=True))
        rows.append(
            lambda area: Choice(area, "", taken, lambda: tools.takes, tools.take, hint=EDITOR_COMMANDS.hint("takes"))
        )
    if tools.ghost.tiles if tools.ghost else tools.selection.area:
        empty = [("empty cells: left out", False), ("empty cells: copied", True)]
        put_empty, about = partial(setattr, tools, "pastes_empty"), "Whether empty cells of a copy remove tiles there"
        rows.append(lambda area: Choice(area, "", empty, lambda: tools.pastes_empty, put_empty, hint=about))
    return rows


def _of_message(view: EditorView, number: int, width: float) -> tuple[str, list[_Row]]:
    message = parse_messages(view.session.draft.says)[number]
    lines = wrapped(view.app.theme, f"{message.when}: {message.one_line}", width, 9.5)[:_MESSAGE_LINES]
    rows: list[_Row] = [partial(Label, text=line, size=9.5) for line in lines]
    return "Selected: message", [*rows, _row([("Open...", partial(view.open_message, number), _OPENS)])]


def _of_several(view: EditorView) -> tuple[str, list[_Row]]:
    tools = view.session.tools
    cells = tools.selection.area[2] * tools.selection.area[3] if tools.selection.area else 0
    rows: list[_Row] = [_choice(tools, name) for name in _common(tools.subjects)]
    rows.append(_turning(view))
    rows += [_arranging(tools, head) for head in _ARRANGING]
    remake = partial(_ask_kind, view) if any(map(can_be_remade, tools.subjects)) else None
    last: list[MenuRow] = [
        ("Move...", partial(_ask_move, view), "Move what is selected by columns and rows, or by px"),
        ("Kind...", remake, "What the selected objects become, in their places: not ninjas, exits, doors"),
        ("Delete", tools.delete, EDITOR_COMMANDS.hint("delete")),
    ]
    return _title("Selected", cells, len(tools.selection.numbers)), [*rows, _row(last)]


def _of_object(tools: EditorTools) -> tuple[str, list[_Row]]:
    """The selected object, or the one in hand."""
    spec = tools.chosen or tools.spec
    rows: list[_Row] = [_choice(tools, name) for name in properties(spec)]
    rows += _hints([f"{' '.join(letters).upper()}: {name}" for name, letters in live_changes(tools).items()])
    if tools.selection:
        rows += [_place(tools, part) for part in points(spec)]
    elif has_switch(spec):
        rows += _hints(["Then click where its switch is"])
    elif tools.effective_tool in CURVES:
        words = [(f"one every {spacing:.0f} px", spacing) for spacing in SPACINGS]
        put, hint = partial(setattr, tools, "spacing"), "How far apart they lie along it"
        rows.append(lambda area: Choice(area, "", words, lambda: tools.spacing, put, hint=hint))
    return f"{'Selected' if tools.selection else _taking(tools)}: {object_type_name(spec)}", rows


def _of_tile(view: EditorView) -> tuple[str, list[_Row]]:
    tools, set_slopes = view.session.tools, view.session.set_slopes
    first = FIRST_STEPS if tools.draft.level == Level() else ()
    rows: list[_Row] = [partial(Label, text=text, size=9.5) for text in first]
    rows += _hints(["1 to 8: shape", "Q W A S: its solid corner", "9: full    0: empty", "H, J, U: mirror, flip, turn"])
    modes = [("slopes: by hand", False), ("slopes: by themselves", True)]
    rows.append(
        lambda area: Choice(area, "", modes, lambda: tools.slopes, set_slopes, hint=EDITOR_COMMANDS.hint("slopes"))
    )
    return f"{_taking(tools)}: {tile_name(tools.tile)}", rows


_ARRANGING: dict[str, dict[str, tuple[int, float | None]]] = {
    "Align": {"Left": (0, 0.0), "Centre": (0, 0.5), "Right": (0, 1.0)},
    "": {"Top": (1, 0.0), "Middle": (1, 0.5), "Bottom": (1, 1.0)},
    "Spread": {"Across": (0, None), "Down": (1, None)},
}
"""Rows of buttons that align objects, with axis and share of ``stamp.arranged``."""


def _arranging(tools: EditorTools, head: str) -> Callable[[Area], Sequence[Widget]]:
    most, buttons = len(tools.selection.parts), []
    for text, (axis, share) in _ARRANGING[head].items():
        able, verb = most > 1 + (share is None), head or "Align"
        hint = f"{verb} the selected objects: {text.lower()}"
        why = f"{verb} needs {'three' if share is None else 'two'} or more selected objects; cells stay in place"
        buttons.append((text, partial(tools.arrange, axis, share) if able else None, hint if able else why))
    return _row(buttons, head, 30)


def _row(buttons: Sequence[MenuRow], head: str = "", room: int = 0) -> Callable[[Area], Sequence[Widget]]:
    """Buttons side by side, behind a word of that width."""

    def make(area: Area) -> Sequence[Widget]:
        x, y, w, h = area
        width = (w - room) / len(buttons)
        places = [(x + room + width * k, y, width - 2, h) for k in range(len(buttons))]
        row = [Button(at, *button[:2], hint=button[2], size=8) for at, button in zip(places, buttons, strict=True)]
        return [Label((x, y + 5, room, h), head, size=8.5), *row]

    return make


def _ask_move(view: EditorView) -> None:
    """Ask how far to move the selection: columns and rows, or px."""

    def on_accept(text: str) -> None:
        match = re.fullmatch(r"([+-]?\d+(?:\.\d+)?),([+-]?\d+(?:\.\d+)?)(px)?", text.replace(" ", ""))
        step = 1.0 if match and match[3] else CELL
        if match is None:
            view.app.notify("Not moved: write two numbers, as 2,-1 for cells or 6,0px for px")
        elif not view.session.tools.shift(step * float(match[1]), step * float(match[2])):
            view.app.notify("Not moved: a part of it would leave the level")

    ask_text(view.app, "Move right and down by", "Cells: 2,-1   Or px: 6,0px", "", "Move", on_accept, 20)


def _ask_kind(view: EditorView) -> None:
    """Ask for another kind for the selected objects."""
    change = view.session.tools.change_each
    rows: list[MenuRow] = [(kind.capitalize(), partial(change, partial(remade, name=kind)), "") for kind in OTHER_KINDS]
    view.app.push(Menu(view.app, "Selected objects become", [*rows, CANCEL]))


def _common(specs: Sequence[ObjectSpec]) -> list[str]:
    """The properties that all subjects have, with the same words."""
    first = properties(specs[0]) if specs else {}
    return [name for name, what in first.items() if all(properties(spec).get(name) == what for spec in specs)]


def _present(tools: EditorTools, name: str) -> str:
    """The word for a property of all subjects, "" where they differ."""
    if name == "side" and tools.nearest and not tools.selection:
        return NEAREST
    words = {word(spec, name) for spec in tools.subjects if name in properties(spec)}
    return words.pop() if len(words) == 1 else ""


def _choice(tools: EditorTools, name: str) -> Callable[[Area], Widget]:
    """A choice of the words of a property; "(other)" for values without a word, "(several)" where subjects differ."""

    def put(text: str) -> None:
        if text:
            tools.put_word(name, text)

    label = "" if name in ("type", "movement") else f"{name}: "
    follows = [NEAREST] if name == "side" and not tools.selection else []
    words = [(label + text, text) for text in (*follows, *properties(tools.subjects[0])[name].words)]
    unsaid = f"{name}: (several)" if len(tools.subjects) > 1 else "(other)"
    options = [*words, *([] if _present(tools, name) else [(unsaid, "")])]
    hint = f"The {name} of all that is selected" if len(tools.subjects) > 1 else f"The object's {name}"
    return lambda area: Choice(area, "", options, lambda: _present(tools, name), put, hint=hint)


def _place(tools: EditorTools, part: int) -> Callable[[Area], Sequence[Widget]]:
    """The place of a part, as a text behind its name: cells as ``5,7`` or px as ``60,564px``."""

    def put(text: str) -> None:
        spec = tools.subjects[0]
        old = points(spec).get(part)
        try:
            x, y = read_place(text.replace(" ", ""))
        except LevelError:
            return
        if old is not None and (x, y) != old:
            tools.change_each(lambda spec: carried(spec, Motion(dx=x - old[0], dy=y - old[1]), (part,)))

    text = place_text(*points(tools.subjects[0])[part])
    hint = f"Where {'its switch' if part == SWITCH_PART else 'it'} is: column,row as in 5,7 or px as in 60,564px"

    def make(area: Area) -> Sequence[Widget]:
        (x, y, w, h), name = area, "switch at" if part == SWITCH_PART else "at"
        field = TextEntry((x + 46, y, w - 46, h), "place", text, put, hint=hint)
        return [Label((x, y + 4, 44, h), name, size=9.5), field]

    return make


_TOP, TALL, _GAP = 4.0, 21.0, 2.0

_BUTTONS = (
    ("file", "File", 30, 0), ("undo", "Undo", 36, 0), ("redo", "Redo", 36, 4),
    ("brush", "Brush", 38, 0), ("rectangle", "Box", 28, 0), ("line", "Line", 30, 0), ("ellipse", "Ellipse", 42, 0),
    ("fill", "Fill", 26, 0), ("select", "Select", 42, 0), ("pick", "Pick", 32, 4),
    ("symmetry", "Mirror: {symmetry}", 86, 0), ("grid", "Grid: {grid}", 92, 0), ("snap_next", "Snap: {snap}", 72, 4),
    ("test", "Test", 34, 0), ("certify", "{certify}", 46, 0), ("more", "More", 34, 0), ("help", "Help", 32, 0),
)  # fmt: skip
"""Command, text, width, more than the usual gap behind it, px."""


class ToolButton(Button):
    """A button of a command, highlighted while the command is active."""

    def __init__(self, area: Area, name: str, text: str, run: Callable[[str], object], view: EditorView) -> None:
        super().__init__(area, text, lambda: run(name), hint=EDITOR_COMMANDS.hint(name), size=9)
        self.name, self.view = name, view

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        tools, (x, y, w, h) = self.view.session.tools, self.area
        lit = self.name == tools.effective_tool or (self.name == "symmetry" and tools.symmetry != "off")
        theme.row(surface, self.area, chosen=lit, focused=lit, radius=3)
        self.enabled = {"undo": tools.history.can_undo, "redo": tools.history.can_redo}.get(self.name, True)
        grid, certify = self.view.grid.name, self.view.session.certify_text
        zoom = "fit" if self.view.camera.zoom == 1 else f"{self.view.camera.zoom:.2g}x"
        text = self.text.format(symmetry=tools.symmetry, grid=grid, snap=tools.snap, certify=certify, zoom=zoom)
        colour = theme.palette.text if self.enabled else theme.palette.faint
        bold, place = lit or focused, (x + w / 2, y + (h - 9) / 2)
        theme.text(surface, text, *place, size=9, colour=colour, align="centre", bold=bold, width=w)


class EditorPart(Pane):
    ground: tuple[str, Area] | None = None  #: what it is drawn on: a colour of the palette, and where

    def __init__(self, view: EditorView) -> None:
        self.view = view
        self.session: EditorSession = view.session

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        theme.canvas.fill_rect(surface, theme.palette.tile, *self.area)
        if self.ground:
            colour, area = self.ground
            theme.canvas.fill_rect(surface, getattr(theme.palette, colour), *area, 3)

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        """Show the hint of the button under the mouse in the status line; the widgets do the rest."""
        if event.type != pygame.MOUSEMOTION or any(event.buttons):
            return False
        widget = next((part for part in self.widgets if part.focusable and part.contains(x, y)), None)
        self.view.hint = widget.hint if widget else ""
        return True


class Toolbar(EditorPart):
    """The row of buttons above the level. ``run``: does a command."""

    area = LAYOUT.toolbar

    def __init__(self, view: EditorView, run: Callable[[str, Area], object]) -> None:
        super().__init__(view)
        x, buttons = 6.0, []
        for name, text, width, gap in _BUTTONS:
            area = (x, _TOP, width, TALL)
            buttons.append(ToolButton(area, name, text, partial(lambda at, name: run(name, at), area), view))
            x += width + _GAP + gap
        self.widgets = buttons

    def render_key(self) -> tuple[object, ...]:
        tools = self.session.tools
        history = tools.history.can_undo, tools.history.can_redo
        return tools.effective_tool, tools.symmetry, self.view.grid, tools.snap, history, self.session.certify_text


class PalettePart(EditorPart):
    area = LAYOUT.palette
    ground = "panel", (612, 26, 178, 231)

    def __init__(self, view: EditorView, palette: PaletteView, run: Callable[[str], object]) -> None:
        super().__init__(view)
        self._palette = palette
        x, y, w, h = self.area
        listed = ToolButton((x + w - 38, y + h - 15, 34, 14), "list", "List", run, view)
        stamps = ToolButton((x + w - 78, y + h - 15, 39, 14), "stamps", "Stamps", run, view)
        self.widgets = [palette, listed, stamps]

    def render_key(self) -> tuple[object, ...]:
        tools = self.session.tools
        return tools.tile, tools.spec, self._palette.hovered, tools.draws_objects

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        x, y, w, h = self.area
        theme.text(surface, self._palette.label, x + 5, y + h - 13, size=8, width=w - 83, height=13)

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        used = super().mouse(event, x, y)
        if used:
            self._palette.hover(x, y)
        elif event.type == pygame.MOUSEWHEEL:
            self._palette.step(-event.y)
        return used or event.type == pygame.MOUSEWHEEL

    def mouse_left(self) -> None:
        self._palette.hovered = None


class Properties(EditorPart):
    area = LAYOUT.properties
    ground = "background", (612, 257, 176, 224)

    def __init__(self, view: EditorView) -> None:
        super().__init__(view)
        self._subject: tuple[object, ...] = ()

    def refresh(self) -> None:
        tools = self.session.tools
        message = self.view.message is not None and (self.view.message, tools.draft.says)
        about = tools.tool == "select" and tools.takes, tools.pastes_empty, message, *panel_key(tools)
        if about != self._subject:
            self._subject = about
            x, y, w, h = self.area
            self.widgets = property_widgets(self.view, (x + 6, y + 5, w - 12, h - 9))

    def render_key(self) -> tuple[object, ...]:
        tools = self.session.tools
        spec = tools.chosen or tools.spec
        return self._subject, tools.tile, spec, tools.selection, tools.slopes, tools.spacing, tools.nearest


class Findings(EditorPart):
    """The findings about the level. ``go_to``: called with the number of a finding."""

    area = LAYOUT.findings
    ground = "panel", LAYOUT.findings

    def __init__(self, view: EditorView, go_to: Callable[[int], object]) -> None:
        super().__init__(view)
        self._shown: list[Finding] = []
        self._gone_to = -1
        self._lines: list[tuple[int, str]] = []
        self.list = ListView(self.area, 19, self._draw_row, lambda row: go_to(self._lines[row][0]))
        self.list.empty, self.list.hint = "No problems found", "A click goes there and selects it"
        self.widgets = [self.list]

    def render_key(self) -> tuple[object, ...]:
        return tuple(self._lines), self.list.first

    def update(self, real_ms: int) -> None:
        if self._shown is not self.session.findings:
            self._shown, theme = self.session.findings, self.view.app.theme
            width = self.area[2] - 32
            accepted = self.session.accepted
            texts = [
                f"{odd.sentence}. Accepted: {accepted[odd.code]}" if odd.code in accepted else odd.advice
                for odd in self._shown
            ]
            self._lines = [(k, line) for k, text in enumerate(texts) for line in wrapped(theme, text, width, 9.5)]
            self.list.fill(self._lines)
        if self._gone_to != self.view.finding:
            self._gone_to = self.view.finding
            rows = [row for row, (number, _) in enumerate(self._lines) if number == self._gone_to]
            for row in reversed(rows):
                self.list.select(row)

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        number, line = self._lines[index]
        x, y, w, _ = area
        accepted = self._shown[number].code in self.session.accepted
        if not accepted and (index == 0 or self._lines[index - 1][0] != number):
            theme.text(surface, "!", x + 4, y + 5, size=9.5, bold=True, colour=theme.palette.bad)
        colour = theme.palette.faint if accepted else theme.palette.text
        theme.text(surface, line, x + 14, y + 5, size=9.5, width=w - 16, colour=colour)


class FilePart(EditorPart):
    area = LAYOUT.file
    ground = "panel", LAYOUT.file

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        used, path = super().mouse(event, x, y), self.session.source.path
        self.view.hint = short_path(path) if used and path else self.view.hint
        return used

    def render_key(self) -> tuple[object, ...]:
        session, certifier = self.session, self.session.certifier
        solver = certifier.text, certifier.is_busy, certifier.certification.share, certifier.certification.run is None
        return session.name, session.source.path, session.is_saved, solver, certifier.is_stale(session.draft.level)

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        canvas, palette, session = theme.canvas, theme.palette, self.session
        x, y, w, h = self.area
        x, w = x + 4, w - 6
        theme.text(surface, session.name, x, y + 5, size=11, bold=True, width=w)
        path, state = session.source.path, "saved" if session.is_saved else "not saved"
        file = f"{path.name}: {state}" if path else "not in a file yet"
        theme.text(surface, file, x, y + 20, size=9, colour=palette.faint, width=w)
        certifier = session.certifier
        stale, run = certifier.is_stale(session.draft.level), certifier.certification.run
        text = certifier.text or "Not certified yet: F7 looks for a way through it"
        if stale and certifier.is_busy:
            text = "The level has changed: the search starts again once you pause, or now by F7"
        elif stale:
            text = f"{'Certified before' if run else 'Not certified since'} the last change: F7 again"
        elif run and not certifier.is_busy:
            text += f". {session.keeping}"
        for number, line in enumerate(wrapped(theme, text, w, 9)[:3]):
            colour = palette.good if run and not stale else palette.text
            theme.text(surface, line, x, y + 36 + 12 * number, size=9, colour=colour)
        if certifier.is_busy and certifier.certification.progress:
            canvas.fill_rect(surface, palette.panel_edge, x, y + h - 9, w, 5, 2)
            canvas.fill_rect(surface, palette.accent, x, y + h - 9, max(1.0, w * certifier.certification.share), 5, 2)


class StatusLine(EditorPart):
    area = LAYOUT.status

    def __init__(self, view: EditorView, run: Callable[[str], object]) -> None:
        super().__init__(view)
        x, y, w, _ = self.area
        self.widgets = [ToolButton((x + w - 62, y + 2, 58, 17), "zoom", "Zoom: {zoom}", run, view)]

    def _text(self) -> str:
        tools = self.session.tools
        if tools.placing_switch:
            what = object_type_name(tools.spec)
            return f"Now the switch of the {what}: click where it is. Esc puts the {what} away"
        if tools.ghost:
            return "Click where it is pasted; H, J, U mirror, flip and turn it; Esc gives up"
        number = message_near(tools.draft, *tools.pointer) if self.view.hovering else None
        if number is not None:
            message = parse_messages(tools.draft.says)[number]
            drag = ", Select drags it" if message.place else ""
            return f"Double click opens the message{drag}: {message.one_line}"
        slopes = "Slopes by themselves. " if tools.sets_slopes else ""
        if tools.slopes and tools.tool == "rectangle" and not tools.draws_objects:
            slopes = "No slopes: a box keeps its corners. "
        if tools.tool == "select" and tools.takes != TAKES[0]:
            slopes = f"Takes only {tools.takes}: Shift+V. "
        start, shown = self.session.start, slopes + _TOOL_HINTS[tools.effective_tool]
        if tools.draws_objects and tools.effective_tool == "brush" and tools.spec.kind in (DOOR, EXIT):
            what, two = object_type_name(tools.spec), has_switch(tools.spec)
            shown = (
                f"Click where the {what} is{', then where its switch is' if two else ': it has no switch'}. F1: help"
            )
        if start != "off" and self.view.hovering:
            shown = _REACH.format(start) if self.session.reach else _NO_REACH
        return self.view.hint or shown

    def render_key(self) -> tuple[object, ...]:
        return self.session.tools.pointer, self.session.tools.frame_size, self._text(), self.view.camera.zoom

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        tools, colour, top = self.session.tools, theme.palette.on_tile, self.area[1] + 5
        (column, row), (x, y) = tools.cell, tools.pointer
        theme.text(surface, f"{column},{row}", 8, top, size=9.5, colour=colour)
        place = "{} x {} cells".format(*tools.frame_size) if tools.frame_size else f"{x:.0f},{y:.0f} px"
        theme.text(surface, place, 58, top, size=9.5, colour=colour)
        theme.text(surface, self._text(), 140, top, size=9.5, colour=colour, width=584)


_REACH = "In 1 s, {}, the ninja can be where it is shaded, dies in the red; red lines: enemies; bars: last jumps"
_NO_REACH = "What is reached comes in a moment; the first time, what finds it is compiled for some minutes"
_TOOL_HINTS = {
    "brush": "Left button draws, right erases, middle picks; wheel zooms, middle drag moves. F1: help",
    "rectangle": "Drag a rectangle; right button erases. F1: help",
    "line": "Drag a line; the wheel bends it meanwhile; objects lie along it. F1: help",
    "ellipse": "Drag an ellipse; tiles fill it, objects lie along it. F1: help",
    "fill": "A click fills what is joined and alike. F1: help",
    "select": "Click or drag a frame; drag moves it, with Ctrl a copy; Shift adds, right button gives up. F1: help",
    "pick": "Click what to draw with. F1: help",
}


_PX_PLACE = re.compile(r"(-?[0-9.]+),(-?[0-9.]+)px")


@lru_cache(maxsize=2000)
def object_text(spec: ObjectSpec) -> str:
    text = " ".join(filter(None, best_form(spec))) or object_type_name(spec)
    return _PX_PLACE.sub(lambda px: "{},{} ({})".format(*cell_of(float(px[1]), float(px[2])), px[0]), text)


_MOVES = (
    ("Up", -1, "What is selected goes up in the list, and moves earlier in play; with Shift to its top"),
    ("Down", 1, "What is selected goes down in the list, and moves later in play; with Shift to its end"),
)
"""Texts and hints of the buttons that move the selection by a number of places."""


def _shift() -> bool:
    return bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)


class _Find(TextEntry):
    """The search field; typing after a click replaces its words."""

    def click(self, x: float, y: float) -> bool:
        super().click(x, y)
        self.edited.select_all()
        return True


class ObjectList(EditorPart):
    """The level's objects. ``shown``: the numbers of those whose texts contain all the words of the search."""

    area = LAYOUT.palette
    ground = "panel", (612, 26, 176, 230)

    def __init__(self, view: EditorView, run: Callable[[str], object]) -> None:
        super().__init__(view)
        x, y, w, h = self.area
        self.shown: list[int] = []
        self._history = self.session.tools.history
        self._state: tuple[object, ...] = ()
        hint = "A click selects it, with Shift too; what comes first is made first, and moves first"
        self.list = ListView((x + 2, y + 26, w - 6, h - 50), 15, self._draw_row, self._choose, empty="None", hint=hint)
        self.find = _Find((x + 4, y + 3, w - 84, 18), "Find", "", lambda _: None)
        self.find.hint = "Objects whose lines have all these words, such as: drone left"
        moves = [
            Button((x + 2 + 52 * k, y + h - 22, 49, 19), text, partial(self._move, by), size=9, hint=hint)
            for k, (text, by, hint) in enumerate(_MOVES)
        ]
        every = Button((x + w - 78, y + 3, 70, 18), "Select all", self._choose_shown, size=9)
        every.hint = "Select all that are shown; a property that all of them have is changed at once, below"
        # Where the palette has its button for the list: a second click there leads back.
        palette = ToolButton((x + w - 54, y + h - 21, 50, 18), "list", "Palette", run, view)
        self.widgets = [self.find, palette, self.list, *moves, every]

    def _move(self, by: int) -> None:
        self.session.tools.reorder(by * len(self.session.draft.objects) if _shift() else by)

    def update(self, real_ms: int) -> None:
        tools = self.session.tools
        if tools.history is not self._history:
            self._history = tools.history
            self.find.show("")
        state = self.find.text, tools.draft.objects, tools.selection
        if len(state) == len(self._state) and all(a is b for a, b in zip(state, self._state, strict=True)):
            return
        self._state = state
        words = self.find.text.lower().split()
        texts = map(object_text, tools.draft.objects)
        self.shown = [number for number, text in enumerate(texts) if all(part in text for part in words)]
        chosen = next((place for place, number in enumerate(self.shown) if number in tools.selection.numbers), None)
        self.list.index = self.list.index if chosen is None else chosen
        self.list.fill(self.shown)

    def render_key(self) -> tuple[object, ...]:
        return self._state, self.list.first

    def _choose(self, place: int) -> None:
        tools = self.session.tools
        number = self.shown[place]
        places = points(tools.draft.objects[number])
        parts = frozenset((number, part) for part in places)
        self.view.follow(*places.get(BODY_PART, tools.pointer))
        tools.choose(parts ^ tools.selection.parts if _shift() else parts)
        tools.tool = "select"

    def _choose_shown(self) -> None:
        tools = self.session.tools
        tools.choose(frozenset((n, part) for n in self.shown for part in points(tools.draft.objects[n])))
        tools.tool = "select"

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        tools, number, (x, y, w, h) = self.session.tools, self.shown[index], area
        chosen = number in tools.selection.numbers
        if chosen:
            theme.row(surface, (x, y, w, h), chosen=True, focused=False, radius=2)
        faint = theme.palette.faint
        theme.text(surface, str(number), x + 19, y + 3, size=8.5, colour=faint, align="right", width=19)
        text, width = object_text(tools.draft.objects[number]), w - 24
        size = max(7.0, min(9.0, 9 * width / theme.width(text, 9, bold=chosen)))
        theme.text(surface, text, x + 22, y + 3 + (9 - size) / 2, size=size, bold=chosen, width=width)
