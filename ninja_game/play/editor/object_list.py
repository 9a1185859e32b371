"""The list of the level's objects, with a search."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import lru_cache, partial

import pygame

from ninja_game.editor.brush import Tool
from ninja_game.editor.specs import BODY_PART, object_type_name, points
from ninja_game.formats.ascii.writer import best_form
from ninja_game.play.editor.part import EditorPart, ToolButton
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.sim.grid import cell_of
from ninja_game.sim.level import ObjectSpec
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button

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
    panel = (612, 26, 176, 230)

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
        self.session.tools.selected.reorder(by * len(self.session.draft.objects) if _shift() else by)

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
        tools.tool = Tool.SELECT

    def _choose_shown(self) -> None:
        tools = self.session.tools
        tools.choose(frozenset((n, part) for n in self.shown for part in points(tools.draft.objects[n])))
        tools.tool = Tool.SELECT

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
