"""Properties of what is selected, pasted or in hand."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import partial

from ninja_game.editor.bench import TAKES
from ninja_game.editor.brush import CURVES, NEAREST, SPACINGS, Tool
from ninja_game.editor.motion import CLOCKWISE, FLIP, MIRROR, Motion
from ninja_game.editor.palette import OTHER_KINDS, can_be_remade, remade, tile_name
from ninja_game.editor.specs import SWITCH_PART, carried, has_switch, object_type_name, points, properties, word
from ninja_game.editor.tools import EditorTools
from ninja_game.errors import LevelError
from ninja_game.files.shown_text import counted
from ninja_game.formats.ascii.places import place_text, read_place
from ninja_game.formats.messages import parse_messages
from ninja_game.play.editor.commands import EDITOR_COMMANDS
from ninja_game.play.editor.palette_view import live_changes
from ninja_game.play.editor.part import EditorPart
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.play.menu_screen import CANCEL, Menu, MenuRow, ask_text
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.rules import CELL
from ninja_game.ui.canvas import Colour
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Palette, wrapped
from ninja_game.ui.widgets import Button, Choice, Label, Widget

_RowMaker = Callable[[Area], Widget | Sequence[Widget]]  # makes the widgets of a row in its place

_ROW_HEIGHT = 22.5  # px

_KEY_HEIGHT = 13.0  # px of a line of the table of keys

_MESSAGE_LINES = 4  # the most lines of a message in the panel

_OPENS = "Its text, moment, place and frame; a double click on the bubble opens it too"

FIRST_STEPS = (
    "First draw a floor; put the ninja",
    "(Shift+N) on it, and the exit",
    "(Shift+E) with its switch. F5 plays",
)
"""The panel's text for an empty level."""


_TILE_KEYS = {"1 to 8": "shape", "Q W A S": "solid corner", "9, 0": "full, empty", "H J U": "mirror, flip, turn"}
_DRAWING_KEYS = {"Right click": "erases", "Middle click": "picks"}
_TOOL_KEYS = {
    "select": {"Click": "selects", "Drag": "a frame selects", "Shift": "adds to it"},
    "pick": {"Click": "takes what is there"},
    "line": {"Wheel": "bends it", **_DRAWING_KEYS},
}
"""What the mouse does with each tool; with the others it draws."""


def key_table(tools: EditorTools) -> dict[str, str]:
    """What keys and mouse do to what is selected, pasted or in hand, with the present tool."""
    if tools.ghost:
        return {"H J U": _TILE_KEYS["H J U"], "Esc": "gives it up"}
    changes = {" ".join(letters).upper(): name for name, letters in live_changes(tools).items()}
    if tools.selection:
        return {**changes, "Drag": "moves", "Ctrl+drag": "copies", "Del": "deletes"}
    in_hand = changes if tools.about_objects else _TILE_KEYS
    return {**in_hand, **_TOOL_KEYS.get(tools.effective_tool, _DRAWING_KEYS)}


def panel_key(tools: EditorTools) -> tuple[object, ...]:
    """The subject of the panel: when it changes, the panel is rebuilt."""
    if tools.ghost:
        return len(tools.ghost.tiles), len(tools.ghost.objects), "pasted"
    if tools.selection:
        spec = tools.selected.chosen
        kind = (object_type_name(spec), len(spec.values)) if spec else None
        return (
            tools.selection.area,
            tools.selection.parts,
            [(name, not _present(tools, name)) for name in _common(tools.selected.subjects)],
            kind,
            spec and tuple(points(spec).items()),
        )
    brush = tools.brush
    drawn = object_type_name(brush.spec) if brush.draws_objects else brush.tile
    return tools.draft.level == Level(), brush.draws_objects, drawn, tools.effective_tool in CURVES, _taking(tools)


def _taking(tools: EditorTools) -> str:
    """What a press does to the panel's subject."""
    return "Draw" if tools.tool.draws else "In hand"


def _title(verb: str, cells: int, objects: int) -> str:
    return f"{verb}: {counted(cells, 'cell') + ', ' if cells else ''}{counted(objects, 'object')}"


def _turning(view: EditorView) -> _RowMaker:
    turns = {"mirror": MIRROR, "flip": FLIP, "turn": CLOCKWISE}
    return _button_row(
        [(name.capitalize(), partial(view.turn, turn), EDITOR_COMMANDS.hint(name)) for name, turn in turns.items()]
    )


def property_widgets(view: EditorView, area: Area) -> Sequence[Widget]:
    """A title and rows about what is selected, pasted or in hand, and the table of keys as far as there is room."""
    x, y, w, _ = area
    tools = view.session.tools
    if view.message is not None:
        title, rows = _of_message(view, view.message, w)
    elif tools.ghost:
        title = _title("A click pastes", len(tools.ghost.tiles), len(tools.ghost.objects))
        rows = [_turning(view)]
    elif tools.selection and tools.selected.chosen is None:
        title, rows = _of_several(view)
    elif tools.selection or tools.brush.draws_objects:
        title, rows = _of_object(tools)
    else:
        title, rows = _of_tile(view)
    head, rows = Label((x, y, w, 15), title, size=10), [*_copying(tools), *rows]
    row = min(_ROW_HEIGHT, (area[3] - 17) / max(1, len(rows)))
    widgets: list[Widget] = [head]
    for k, make in enumerate(rows):
        made = make((x, y + 17 + row * k, w, row - 3))
        widgets += made if isinstance(made, Sequence) else [made]
    below = y + 21 + row * len(rows)
    room = max(0, int((y + area[3] - 3 - below) // _KEY_HEIGHT))
    lines = list(key_table(tools).items())[:room] if view.message is None else []
    keys = [
        Label((x + right, below + _KEY_HEIGHT * number, width, _KEY_HEIGHT), text, size=9, faint=bool(right))
        for number, line in enumerate(lines)
        for text, right, width in zip(line, (0, 68), (66, w - 68), strict=True)
    ]
    return [*widgets, *keys]


def _copying(tools: EditorTools) -> list[_RowMaker]:
    """What Select takes, and what happens to the empty cells of a copy."""
    rows: list[_RowMaker] = []
    if tools.tool == Tool.SELECT and not tools.ghost:
        choices = list(zip(("takes: all", "takes: only tiles", "takes: only objects"), TAKES, strict=True))
        rows.append(
            lambda area: Choice(area, "", choices, lambda: tools.takes, tools.take, hint=EDITOR_COMMANDS.hint("takes"))
        )
    if tools.ghost.tiles if tools.ghost else tools.selection.area:
        empty = [("empty cells: left out", False), ("empty cells: copied", True)]
        about = "Whether empty cells of a copy remove tiles there"

        def put_empty(copied: bool) -> None:
            tools.pastes_empty = copied

        rows.append(lambda area: Choice(area, "", empty, lambda: tools.pastes_empty, put_empty, hint=about))
    return rows


def _of_message(view: EditorView, number: int, width: float) -> tuple[str, list[_RowMaker]]:
    message = parse_messages(view.session.draft.says)[number]
    lines = wrapped(view.app.theme, f"{message.when}: {message.one_line}", width, 9.5)[:_MESSAGE_LINES]
    rows: list[_RowMaker] = [partial(Label, text=line, size=9.5) for line in lines]
    return "Selected: message", [*rows, _button_row([("Open...", partial(view.open_message, number), _OPENS)])]


def _of_several(view: EditorView) -> tuple[str, list[_RowMaker]]:
    tools = view.session.tools
    cells = tools.selection.area[2] * tools.selection.area[3] if tools.selection.area else 0
    rows: list[_RowMaker] = [_choice(tools, name) for name in _common(tools.selected.subjects)]
    rows.append(_turning(view))
    rows += [_align_buttons(tools, head) for head in _ARRANGING]
    remake = partial(_ask_kind, view) if any(map(can_be_remade, tools.selected.subjects)) else None
    last: list[MenuRow] = [
        ("Move...", partial(_ask_move, view), "Move what is selected by columns and rows, or by px"),
        ("Kind...", remake, "What the selected objects become, in their places: not ninjas, exits, doors"),
        ("Delete", tools.delete, EDITOR_COMMANDS.hint("delete")),
    ]
    return _title("Selected", cells, len(tools.selection.numbers)), [*rows, _button_row(last)]


def _of_object(tools: EditorTools) -> tuple[str, list[_RowMaker]]:
    """The selected object, or the one in hand."""
    spec = tools.selected.chosen or tools.brush.spec
    rows: list[_RowMaker] = [_choice(tools, name) for name in properties(spec)]
    if tools.selection:
        rows += [_place(tools, part) for part in points(spec)]
    elif has_switch(spec):
        rows.append(partial(Label, text="Then click where its switch is", size=9.5, faint=True))
    elif tools.effective_tool in CURVES:
        words = [(f"one every {spacing:.0f} px", spacing) for spacing in SPACINGS]

        def put(spacing: float) -> None:
            tools.brush.spacing = spacing

        hint = "How far apart they lie along it"
        rows.append(lambda area: Choice(area, "", words, lambda: tools.brush.spacing, put, hint=hint))
    return f"{'Selected' if tools.selection else _taking(tools)}: {object_type_name(spec)}", rows


def _of_tile(view: EditorView) -> tuple[str, list[_RowMaker]]:
    tools, set_slopes = view.session.tools, view.session.set_slopes
    about = EDITOR_COMMANDS.hint("slopes")
    first = FIRST_STEPS if tools.draft.level == Level() else ()
    rows: list[_RowMaker] = [partial(Label, text=text, size=9.5) for text in first]
    modes = [("slopes: by hand", False), ("slopes: by themselves", True)]
    rows.append(lambda area: Choice(area, "", modes, lambda: tools.brush.slopes, set_slopes, hint=about))
    return f"{_taking(tools)}: {tile_name(tools.brush.tile)}", rows


_ARRANGING: dict[str, dict[str, tuple[int, float | None]]] = {
    "Align": {"Left": (0, 0.0), "Centre": (0, 0.5), "Right": (0, 1.0)},
    "": {"Top": (1, 0.0), "Middle": (1, 0.5), "Bottom": (1, 1.0)},
    "Spread": {"Across": (0, None), "Down": (1, None)},
}
"""Rows of buttons that align objects, with axis and share of ``stamp.arranged``."""


def _align_buttons(tools: EditorTools, head: str) -> _RowMaker:
    most, buttons = len(tools.selection.parts), []
    for text, (axis, share) in _ARRANGING[head].items():
        verb = head or "Align"
        able = most > 1 + (share is None)
        hint = f"{verb} the selected objects: {text.lower()}"
        why = f"{verb} needs {'three' if share is None else 'two'} or more selected objects; cells stay in place"
        buttons.append((text, partial(tools.selected.arrange, axis, share) if able else None, hint if able else why))
    return _button_row(buttons, head, 30)


def _button_row(buttons: Sequence[MenuRow], head: str = "", room: int = 0) -> _RowMaker:
    """Buttons side by side, behind the word ``head``, which has ``room`` px."""

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
        elif not view.session.tools.selected.shift(step * float(match[1]), step * float(match[2])):
            view.app.notify("Not moved: a part of it would leave the level")

    ask_text(view.app, "Move right and down by", "Cells: 2,-1   Or px: 6,0px", "", "Move", on_accept, 20)


def _ask_kind(view: EditorView) -> None:
    """Ask for another kind for the selected objects."""
    change = view.session.tools.selected.change_each
    rows: list[MenuRow] = [(kind.capitalize(), partial(change, partial(remade, name=kind)), "") for kind in OTHER_KINDS]
    view.app.push(Menu(view.app, "Selected objects become", [*rows, CANCEL]))


def _common(specs: Sequence[ObjectSpec]) -> list[str]:
    """The properties that all subjects have, with the same words."""
    first = properties(specs[0]) if specs else {}
    return [name for name, what in first.items() if all(properties(spec).get(name) == what for spec in specs)]


def _present(tools: EditorTools, name: str) -> str:
    """The word for a property of all subjects, "" where they differ."""
    if name == "side" and tools.brush.nearest and not tools.selection:
        return NEAREST
    words = {word(spec, name) for spec in tools.selected.subjects if name in properties(spec)}
    return words.pop() if len(words) == 1 else ""


def _choice(tools: EditorTools, name: str) -> _RowMaker:
    """A choice of the words of a property; "(other)" for values without a word, "(several)" where subjects differ."""

    def put(text: str) -> None:
        if text:
            tools.selected.put_word(name, text)

    label = "" if name in ("type", "movement") else f"{name}: "
    follows = [NEAREST] if name == "side" and not tools.selection else []
    words = [(label + text, text) for text in (*follows, *properties(tools.selected.subjects[0])[name].words)]
    unsaid = f"{name}: (several)" if len(tools.selected.subjects) > 1 else "(other)"
    options = [*words, *([] if _present(tools, name) else [(unsaid, "")])]
    hint = f"The {name} of all that is selected" if len(tools.selected.subjects) > 1 else f"The object's {name}"
    return lambda area: Choice(area, "", options, lambda: _present(tools, name), put, hint=hint)


def _place(tools: EditorTools, part: int) -> _RowMaker:
    """The place of a part, as a text behind its name: cells as ``5,7`` or px as ``60,564px``."""

    def put(text: str) -> None:
        spec = tools.selected.subjects[0]
        old = points(spec).get(part)
        try:
            x, y = read_place(text.replace(" ", ""))
        except LevelError:
            return
        if old is not None and (x, y) != old:
            tools.selected.change_each(lambda spec: carried(spec, Motion(dx=x - old[0], dy=y - old[1]), (part,)))

    text = place_text(*points(tools.selected.subjects[0])[part])
    hint = f"Where {'its switch' if part == SWITCH_PART else 'it'} is: column,row as in 5,7 or px as in 60,564px"

    def make(area: Area) -> Sequence[Widget]:
        (x, y, w, h), name = area, "switch at" if part == SWITCH_PART else "at"
        field = TextEntry((x + 46, y, w - 46, h), "place", text, put, hint=hint)
        return [Label((x, y + 4, 44, h), name, size=9.5), field]

    return make


class Properties(EditorPart):
    area = LAYOUT.properties
    panel = (612, 257, 176, 224)

    def __init__(self, view: EditorView) -> None:
        super().__init__(view)
        self._subject: tuple[object, ...] = ()

    def panel_colour(self, palette: Palette) -> Colour:
        return palette.background

    def refresh(self) -> None:
        tools = self.session.tools
        message = self.view.message is not None and (self.view.message, tools.draft.says)
        about = tools.tool, tools.tool == Tool.SELECT and tools.takes, tools.pastes_empty, message, *panel_key(tools)
        if about != self._subject:
            self._subject = about
            x, y, w, h = self.area
            self.widgets = property_widgets(self.view, (x + 6, y + 5, w - 12, h - 9))

    def render_key(self) -> tuple[object, ...]:
        tools = self.session.tools
        return self._subject, tools.selected.chosen, tools.selection, tools.brush.state
