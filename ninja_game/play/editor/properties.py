"""The panel of properties: of the object that is selected, or of the one that is drawn with."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from ninja_game.editor.brush import tile_name
from ninja_game.editor.motion import CLOCKWISE, FLIP, MIRROR, Motion
from ninja_game.editor.records import SWITCH, carried, has_switch, object_type_name, points, properties, with_word, word
from ninja_game.editor.tools import EditorTools
from ninja_game.errors import LevelError
from ninja_game.formats.ascii.places import place_text, read_place
from ninja_game.play.ui.text_entry import TextEntry
from ninja_game.play.ui.theme import Area
from ninja_game.play.ui.widgets import Button, Choice, Label, Widget

if TYPE_CHECKING:
    from collections.abc import Sequence

ROW = 23.0


def subject(tools: EditorTools) -> tuple[object, ...]:
    """What the panel is about: when it changes, the panel is rebuilt."""
    if tools.selection:
        record = tools.chosen
        kind = (record.kind, len(record.values)) if record else None
        return tools.selection.area, tools.selection.records, kind, record and tuple(points(record))
    return tools.objects, tools.record.kind if tools.objects else tools.tile


def property_widgets(tools: EditorTools, area: Area) -> Sequence[Widget]:
    x, y, w, _ = area
    rows: list[Callable[[Area], Widget]] = []
    if tools.selection and tools.chosen is None:
        count = len(tools.selection.records)
        cells = tools.selection.area[2] * tools.selection.area[3] if tools.selection.area else 0
        title = f"Selected: {cells} cells, {count} objects" if cells else f"Selected: {count} objects"
        turns = {"Mirror (H)": MIRROR, "Flip (J)": FLIP, "Turn (U)": CLOCKWISE}
        rows += [partial(Button, text=text, action=partial(tools.turn, turn), size=9.5) for text, turn in turns.items()]
        rows.append(partial(Button, text="Delete (Del)", action=tools.delete, size=9.5))
    elif tools.selection or tools.objects:
        record = tools.chosen or tools.record
        title = f"{'Selected' if tools.selection else 'Draw'}: {object_type_name(record)}"
        rows += [_choice(tools, name) for name in properties(record)]
        if tools.selection:
            rows += [_place(tools, part) for part in points(record)]
        elif has_switch(record):
            rows.append(partial(Label, text="Then click where its switch is", size=9.5, faint=True))
    else:
        title = f"Draw: {tile_name(tools.tile)}"
        texts = ("1 to 8: shape", "Q W A S: its solid corner", "E: full    D: empty", "H, J, U: mirror, flip, turn")
        rows += [partial(Label, text=text, size=9.5, faint=True) for text in texts]
    head = Label((x, y, w, ROW), title, size=10)
    return [head, *(make((x, y + 17 + ROW * k, w, ROW - 3)) for k, make in enumerate(rows))]


def _choice(tools: EditorTools, name: str) -> Callable[[Area], Widget]:
    """A property by its words. Values that no word means show as "(other)"."""

    def put(text: object) -> None:
        if text:
            tools.put_subject(with_word(tools.subject, name, str(text)))

    def get() -> str:
        record = tools.subject
        return word(record, name) if name in properties(record) else ""

    label = f"{name}: " if name not in ("type", "movement") else ""
    words = [(label + text, text) for text in properties(tools.subject)[name].words]
    options: list[tuple[str, object]] = [*words, *([] if get() else [("(other)", "")])]
    return lambda area: Choice(area, "", options, get, put, hint=f"The object's {name}")


def _place(tools: EditorTools, part: int) -> Callable[[Area], Widget]:
    """Where a part is, as text: cells as ``5,7`` or px as ``60,564px``."""

    def put(text: str) -> None:
        record = tools.subject
        old = points(record).get(part)
        try:
            x, y = read_place(text.replace(" ", ""))
        except LevelError:
            return
        if old is not None and (x, y) != old:
            tools.put_subject(carried(record, Motion(dx=x - old[0], dy=y - old[1]), (part,)))

    text = place_text(*points(tools.subject)[part])
    hint = f"Where {'its switch' if part == SWITCH else 'it'} is: column,row as in 5,7 or px as in 60,564px"

    return lambda area: TextEntry(area, "place", text, put, hint=hint)
