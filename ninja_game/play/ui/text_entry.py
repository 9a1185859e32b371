"""A line of text that the player types."""

from __future__ import annotations

from collections.abc import Callable

import pygame

from ninja_game.play.input.scancodes import key_name, scancode_of
from ninja_game.play.ui.theme import Area, Theme
from ninja_game.play.ui.widgets import PAD, TEXT, Widget

LONGEST = 40
"""How many characters can be typed unless a field says otherwise."""


class TextEntry(Widget):
    """A text field. With the focus it takes what is typed; left, right, Home, End, Backspace and Delete edit.

    Ctrl+A selects all of it.

    ``prompt``: shown while it is empty. ``put`` is called at every change. ``longest``: how many characters fit in.
    ``proposed``: what is typed first replaces the text.
    """

    def __init__(
        self,
        area: Area,
        prompt: str,
        text: str,
        put: Callable[[str], object],
        *,
        longest: int = LONGEST,
        hint: str = "",
        proposed: bool = False,
    ) -> None:
        super().__init__(area, hint=hint)
        self.proposed = proposed
        self.longest = longest
        self.prompt = prompt
        self.text = text
        self.put = put
        self.cursor = len(text)

    def text_event(self, event: pygame.Event) -> bool:
        """Type, move, erase."""
        if event.type == pygame.TEXTINPUT:
            self._insert(event.text)
            return True
        if event.type != pygame.KEYDOWN:
            return False
        name = key_name(scancode_of(event))
        ctrl = getattr(event, "mod", 0) & (pygame.KMOD_CTRL | pygame.KMOD_META)
        if ctrl and (event.key == ord("a") or name == "a"):
            self.proposed = bool(self.text)
            return True
        if self.proposed and name in ("backspace", "delete"):
            self._drop_proposal()
            return True
        if name in ("left", "right", "home", "end"):
            self.proposed = False
        if name == "backspace" and self.text:
            self._replace(self.cursor - 1, self.cursor)
        elif name == "delete":
            self._replace(self.cursor, self.cursor + 1)
        elif name in ("left", "right", "home", "end"):
            places = {"left": self.cursor - 1, "right": self.cursor + 1, "home": 0, "end": len(self.text)}
            self.cursor = min(len(self.text), max(0, places[name]))
        elif name not in ("space", "backspace") and len(name) > 1:
            return False
        # What types a character comes again as TEXTINPUT; as a key it must not move the focus.
        return True

    def click(self, x: float, y: float) -> bool:
        """What was proposed is kept, to be changed."""
        self.proposed = False
        return super().click(x, y)

    def _drop_proposal(self) -> None:
        self.proposed = False
        self.text, self.cursor = "", 0
        self.put("")

    def _insert(self, typed: str) -> None:
        if self.proposed:
            self._drop_proposal()
        typed = "".join(char for char in typed if char.isprintable())[: max(0, self.longest - len(self.text))]
        self.text = self.text[: self.cursor] + typed + self.text[self.cursor :]
        self.cursor += len(typed)
        self.put(self.text)

    def _replace(self, start: int, end: int) -> None:
        if start < 0:
            return
        self.text = self.text[:start] + self.text[end:]
        self.cursor = start
        self.put(self.text)

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        """The text with its cursor, or the prompt."""
        self.draw_base(surface, theme, focused=focused)
        x, y, w, h = self.area
        top = y + (h - TEXT) / 2
        shown = self.text
        while shown and theme.width(shown, TEXT) > w - 2 * PAD - 4:
            shown = shown[1:]
        if shown and self.proposed and focused:
            marked = x + PAD - 2, top - 3, theme.width(shown, TEXT) + 4, TEXT + 6
            theme.canvas.fill_rect(surface, theme.palette.bar_full, *marked)
        if shown:
            theme.text(surface, shown, x + PAD, top, size=TEXT)
        else:
            theme.text(surface, self.prompt, x + PAD, top, size=TEXT, colour=theme.palette.faint)
        if focused:
            before = shown[: max(0, self.cursor - (len(self.text) - len(shown)))]
            place = x + PAD + theme.width(before, TEXT) + 1
            theme.canvas.fill_rect(surface, theme.palette.accent, place, top - 2, 1.5, TEXT + 4)
