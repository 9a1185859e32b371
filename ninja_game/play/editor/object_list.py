"""The objects of the level in their order, in the place of the palette: found by words, chosen, moved in the order."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache, partial

import pygame

from ninja_game.editor.specs import object_type_name, points
from ninja_game.formats.ascii.writer import best_form
from ninja_game.play.editor.parts import EditorPart, ToolButton
from ninja_game.play.editor.view import LAYOUT, EditorView
from ninja_game.sim.level import ObjectSpec
from ninja_game.ui.list_view import ListView
from ninja_game.ui.text_entry import TextEntry
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import Button


@lru_cache(maxsize=2000)
def object_text(spec: ObjectSpec) -> str:
    """An object as its line in a level's text."""
    return " ".join(filter(None, best_form(spec))) or object_type_name(spec)


_MOVES = (
    ("Earlier", -1, "Earlier in the order; with Shift the first of all"),
    ("Later", 1, "Later in the order; with Shift the last of all"),
)
"""Texts and hints of the buttons that move what is selected so many places."""


def _shift() -> bool:
    return bool(pygame.key.get_mods() & pygame.KMOD_SHIFT)


class ObjectList(EditorPart):
    """``shown``: the numbers of the objects whose texts have all the words that are looked for."""

    area = LAYOUT.palette

    def __init__(self, view: EditorView, run: Callable[[str], object]) -> None:
        super().__init__(view)
        x, y, w, h = self.area
        self.shown: list[int] = []
        self._words = ""
        self._state: tuple[object, ...] = ()
        hint = "A click selects it, with Shift too; what comes first is made first, and moves first"
        self.list = ListView((x + 2, y + 26, w - 6, h - 50), 15, self._draw_row, self._choose, empty="None", hint=hint)
        find = TextEntry((x + 4, y + 3, w - 60, 18), "Find: drone left", "", self._find)
        find.hint = "Objects whose lines have all these words"
        moves = [
            Button((x + 2 + 52 * k, y + h - 22, 49, 19), text, partial(self._move, by), size=9, hint=hint)
            for k, (text, by, hint) in enumerate(_MOVES)
        ]
        every = Button((x + 106, y + h - 22, 70, 19), "Select all", self._choose_shown, size=9)
        every.hint = "Select all that are shown; a property that all of them have is changed at once, below"
        palette = ToolButton((x + w - 54, y + 3, 46, 17), "list", "Palette", run, view)
        self.widgets = [find, palette, self.list, *moves, every]

    def _move(self, by: int) -> None:
        self.session.tools.reorder(by * len(self.session.draft.objects) if _shift() else by)

    def _find(self, text: str) -> None:
        self._words = text

    def update(self, real_ms: int) -> None:
        """Follow the level, the words, and what is selected elsewhere."""
        tools = self.session.tools
        state = self._words, tools.draft.objects, tools.selection
        if len(state) == len(self._state) and all(a is b for a, b in zip(state, self._state, strict=True)):
            return
        self._state = state
        words = self._words.lower().split()
        texts = map(object_text, tools.draft.objects)
        self.shown = [number for number, text in enumerate(texts) if all(word in text for word in words)]
        chosen = next((place for place, number in enumerate(self.shown) if number in tools.selection.numbers), None)
        self.list.index = self.list.index if chosen is None else chosen
        self.list.fill(self.shown)

    def render_key(self) -> tuple[object, ...]:
        return self._state, self.list.first

    def paint(self, surface: pygame.Surface, theme: Theme) -> None:
        super().paint(surface, theme)
        x, y, w, h = self.area
        theme.canvas.fill_rect(surface, theme.palette.panel, x + 2, y, w - 6, h - 1, 3)

    def _choose(self, place: int) -> None:
        tools = self.session.tools
        number = self.shown[place]
        parts = frozenset((number, part) for part in points(tools.draft.objects[number]))
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
        text, room = object_text(tools.draft.objects[number]), w - 24
        size = max(7.0, min(9.0, 9 * room / theme.width(text, 9, bold=chosen)))
        theme.text(surface, text, x + 22, y + 3 + (9 - size) / 2, size=size, bold=chosen, width=room)
