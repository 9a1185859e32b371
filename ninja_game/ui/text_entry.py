"""Text fields, of one line or several."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable
from contextlib import suppress

import pygame

from ninja_game.ui.input.keys import chord
from ninja_game.ui.theme import Area, Theme
from ninja_game.ui.widgets import PAD, TEXT_SIZE, Widget

MAX_ENTRY = 40  # most characters, unless a field says otherwise
_NO_TEXT = {"tab", "escape", "return", "kp_enter", "up", "down", "pageup", "pagedown", "insert"}
_FUNCTION_KEY = re.compile("f[0-9]+")
TEXT_LINE = TEXT_SIZE + 4.0  # height of a line of several, px
DOUBLE_MS = 400  # ms in which a second click selects a word, a third one everything


class TextEntry(Widget):
    """A text field with the usual keys: arrows, Home and End, with Shift to select, with Ctrl by words.

    Also Backspace and Delete; Ctrl+A, C, X, V and Z; dragging and double clicks. ``prompt``: shown while it is empty.
    ``put`` is called at every change. ``longest``: most characters. ``proposed``: the text is selected at first, so
    that typing replaces it. ``most_lines``: of a TextArea.
    """

    def __init__(
        self,
        area: Area,
        prompt: str,
        text: str,
        put: Callable[[str], object],
        *,
        longest: int = MAX_ENTRY,
        hint: str = "",
        proposed: bool = False,
        most_lines: int = 1,
    ) -> None:
        super().__init__(area, hint=hint)
        self.prompt = prompt
        self.put = put
        self.edited = EditedText(text, longest, most_lines)
        if proposed:
            self.edited.select_all()
        self.first_shown = 0
        self.stops: list[float] = [0.0]
        self._rows = [(0, self.stops)]
        self._top, self._upper, self._row_height = 0, 0.0, 1.0
        self._clicks, self._clicked = 0, (-DOUBLE_MS, 0.0)

    @property
    def text(self) -> str:
        return self.edited.text

    def show(self, text: str) -> None:
        self.edited = EditedText(text, self.edited.longest, self.edited.most_lines)

    def text_event(self, event: pygame.Event) -> bool:
        if event.type not in (pygame.TEXTINPUT, pygame.KEYDOWN):
            return False
        before = self.text
        if event.type == pygame.TEXTINPUT:
            self.edited.put(event.text)
        used = event.type == pygame.TEXTINPUT or self._press(event)
        if self.text != before:
            self.put(self.text)
        return used

    def _press(self, event: pygame.Event) -> bool:
        *modifiers, key = chord(event).split("+")
        select, ctrl = "shift" in modifiers, "ctrl" in modifiers
        if key in ("left", "right"):
            self.edited.step(1 if key == "right" else -1, word=ctrl, select=select)
        elif key in ("home", "end"):
            self.edited.go(0 if key == "home" else len(self.text), select=select)
        elif key in ("backspace", "delete"):
            self.edited.erase(1 if key == "delete" else -1, word=ctrl)
        elif ctrl and not getattr(event, "mod", 0) & pygame.KMOD_ALT:
            return self._command(key)
        else:
            # A key that types a character also sends TEXTINPUT; the key event itself must do nothing.
            return key not in _NO_TEXT and not _FUNCTION_KEY.fullmatch(key)
        return True

    def _command(self, letter: str) -> bool:
        """Handle Ctrl and a letter; whether a text uses it."""
        edited = self.edited
        with suppress(pygame.error):
            if letter == "a":
                edited.select_all()
            elif letter == "z":
                edited.undo()
            elif letter in ("c", "x") and edited.selected:
                pygame.scrap.put_text(edited.selected)
                if letter == "x":
                    edited.put("")
            elif letter == "v":
                edited.put(pygame.scrap.get_text())
        return letter in ("a", "z", "c", "x", "v")

    def click(self, x: float, y: float) -> bool:
        """Put the cursor there; twice: select the word, three times: everything. With Shift select up to there."""
        self._to_row(y)
        now, place = pygame.time.get_ticks(), self._place_at(x)
        last, where = self._clicked
        self._clicks = self._clicks % 3 + 1 if now - last < DOUBLE_MS and abs(where - x) < PAD else 1
        self._clicked = now, x
        if self._clicks == 1:
            self.edited.go(place, select=bool(pygame.key.get_mods() & pygame.KMOD_SHIFT))
        elif self._clicks == 2:
            self.edited.select_word(self.first_shown + max(0, bisect_right(self.stops, x) - 1))
        else:
            self.edited.select_all()
        return True

    def drag(self, x: float, y: float) -> bool:
        self._to_row(y)
        if self._clicks == 1:
            self.edited.go(self._place_at(x), select=True)
        return True

    def _to_row(self, y: float) -> None:
        row = self._top + int((y - self._upper) // self._row_height)
        self.first_shown, self.stops = self._rows[min(max(0, row), len(self._rows) - 1)]

    def _place_at(self, x: float) -> int:
        """The place between two characters that is nearest to a point; beyond the edges the next hidden one."""
        stops = self.stops
        if x < stops[0] - 1:
            return self.first_shown - 1
        if x > stops[-1] + PAD:
            return self.first_shown + len(stops)
        return self.first_shown + min(range(len(stops)), key=lambda k: abs(stops[k] - x))

    def draw(self, surface: pygame.Surface, theme: Theme, *, focused: bool) -> None:
        self.draw_base(surface, theme, focused=focused)
        x, y, w, h = self.area
        left, text = x + PAD, self.text
        palette, fill = theme.palette, theme.canvas.fill_rect
        self._row_height, room = self._lay_out(theme, left, w - 2 * PAD - 4)
        height, cursor = self._row_height, self._cursor_row
        self._top = max(0, min(max(self._top, cursor - room + 1), cursor, len(self._rows) - room))
        self._upper = y + (h - room * height) / 2
        for row, (first, stops) in enumerate(self._rows[self._top : self._top + room], self._top):
            top, last = self._upper + (row - self._top) * height, first + len(stops) - 1
            begin, end, place = (
                stops[min(max(first, k), last) - first] for k in (*self.edited.span, self.edited.cursor)
            )
            if begin < end and focused:
                fill(surface, palette.bar_full, begin - 1, top, end - begin + 2, height)
            line, colour = (text[first:last].rstrip("\n"), palette.text) if text else (self.prompt, palette.faint)
            width = None if text else w - 2 * PAD
            theme.text(surface, line, left, top + (height - TEXT_SIZE) / 2, size=TEXT_SIZE, colour=colour, width=width)
            if focused and row == cursor:
                fill(surface, palette.accent, place - 1, top + 1, 1.5, height - 2)

    def _lay_out(self, theme: Theme, left: float, room: float) -> tuple[float, int]:
        """Measure the lines; the height of each, px, and how many have room."""
        self._scroll(theme, room)
        self._measure(theme, left, room)
        self._rows = [(self.first_shown, self.stops)]
        return TEXT_SIZE + 6.0, 1

    @property
    def _cursor_row(self) -> int:
        return bisect_right([first for first, _ in self._rows], self.edited.cursor) - 1

    def _scroll(self, theme: Theme, room: float) -> None:
        text, cursor = self.text, self.edited.cursor
        self.first_shown = min(self.first_shown, cursor)
        while theme.width(text[self.first_shown : cursor], TEXT_SIZE) > room:
            self.first_shown += 1
        while self.first_shown > 0 and theme.width(text[self.first_shown - 1 :], TEXT_SIZE) <= room:
            self.first_shown -= 1

    def _measure(self, theme: Theme, left: float, room: float) -> str:
        """Measure the visible part of the text: ``stops`` gets the places between its characters, px."""
        self.stops = [left]
        for last in range(self.first_shown + 1, len(self.text) + 1):
            width = theme.width(self.text[self.first_shown : last].rstrip("\n"), TEXT_SIZE)
            if width > room:
                break
            self.stops.append(left + width)
        return self.text[self.first_shown : self.first_shown + len(self.stops) - 1]


class TextArea(TextEntry):
    """A text in as many lines as have room, wrapped at words; up and down move by lines, and at the ends the focus.

    Enter begins a new line.
    """

    def _press(self, event: pygame.Event) -> bool:
        if chord(event).removeprefix("shift+") not in {"return", "kp_enter"}:
            return super()._press(event)
        self.edited.put("\n")
        return True

    def nudge(self, action: str) -> bool:
        row = self._cursor_row
        to = row + {"up": -1, "down": 1}.get(action, 0)
        if to == row or not 0 <= to < len(self._rows):
            return False
        (here, _), (first, stops) = self._rows[row], self._rows[to]
        self.edited.go(first + min(self.edited.cursor - here, self._last(first, stops)))
        return True

    def _last(self, first: int, stops: list[float]) -> int:
        """The last place of a line: the place behind its space begins the next line."""
        end = first + len(stops) - 1
        return max(0, len(stops) - 1 - (end < len(self.text) or self.text[first:end].endswith("\n")))

    def _place_at(self, x: float) -> int:
        places = range(self._last(self.first_shown, self.stops) + 1)
        return self.first_shown + min(places, key=lambda k: abs(self.stops[k] - x))

    def _lay_out(self, theme: Theme, left: float, room: float) -> tuple[float, int]:
        self._rows, self.first_shown = [], 0
        while self.first_shown < len(self.text) + (self.text[-1:] in ("", "\n")):
            shown = self._measure(theme, left, room)
            if "\n" in shown:
                self.stops = self.stops[: shown.index("\n") + 2]
            elif self.first_shown + len(shown) < len(self.text) and " " in shown:
                self.stops = self.stops[: shown.rindex(" ") + 2]
            self._rows.append((self.first_shown, self.stops))
            self.first_shown += max(1, len(self.stops) - 1)
        height = TEXT_LINE * theme.scales[0]
        return height, max(1, int((self.area[3] - 4) // height))


class EditedText:
    """A text under edit. ``cursor``: before which character it is; up to ``anchor`` it is selected.

    ``longest``: most characters; ``was_full``: whether the last typed text did not fit.
    """

    def __init__(self, text: str, longest: int, most_lines: int = 1) -> None:
        self.text = text
        self.longest, self.most_lines = longest, most_lines
        self.cursor = self.anchor = len(text)
        self.was_full = False
        self.past: list[tuple[str, int, int]] = []  #: what undo leads back to: text, cursor, anchor
        self._typed_to = -1  # where a word ends that is being typed: undone as a whole

    @property
    def span(self) -> tuple[int, int]:
        """The first selected character, and the first one behind."""
        return min(self.cursor, self.anchor), max(self.cursor, self.anchor)

    @property
    def selected(self) -> str:
        return self.text[slice(*self.span)]

    def go(self, place: int, *, select: bool = False) -> None:
        """Put the cursor before a character; ``select``: select up to it."""
        self.cursor = min(max(0, place), len(self.text))
        if not select:
            self.anchor = self.cursor

    def step(self, direction: int, *, word: bool = False, select: bool = False) -> None:
        """Go to the right (1) or left (-1): by a character, a word, or to the end of what was selected."""
        first, last = self.span
        if first < last and not (word or select):
            self.go(last if direction > 0 else first)
        else:
            self.go(self._beyond(direction) if word else self.cursor + direction, select=select)

    def select_all(self) -> None:
        self.anchor, self.cursor = 0, len(self.text)

    def select_word(self, place: int) -> None:
        """Select the word, or the gap between two words, around a place."""
        place = min(place, len(self.text) - 1)
        kind = [0 if char.isspace() else 1 if char.isalnum() else 2 for char in self.text]
        first = last = max(0, place)
        while first > 0 and kind[first - 1] == kind[place]:
            first -= 1
        while last < len(kind) and kind[last] == kind[place]:
            last += 1
        self.anchor, self.cursor = first, last

    def put(self, typed: str) -> None:
        """Replace the selection by a text, as much of it as fits; line ends beyond the most lines become spaces."""
        first, last = self.span
        breaks = self.most_lines - 1 - (self.text[:first] + self.text[last:]).count("\n")
        lines = re.split(r"[\r\n]+", typed if breaks > 0 else typed.strip("\r\n"))
        line = " ".join(["\n".join(lines[: breaks + 1]), *lines[breaks + 1 :]]).replace("\t", " ")
        line = "".join(char for char in line if char == "\n" or char.isprintable())
        room = max(0, self.longest - len(self.text) + last - first)
        self.was_full, line = len(line) > room, line[:room]
        goes_on = len(line) == 1 and not line.isspace() and first == last == self._typed_to
        if line != self.selected and not goes_on:
            self.past.append((self.text, self.cursor, self.anchor))
        self.text = self.text[:first] + line + self.text[last:]
        self.go(first + len(line))
        self._typed_to = self.cursor if len(line) == 1 else -1

    def undo(self) -> None:
        """Take back the last word typed, with the space before it, or the last other change."""
        self._typed_to = -1
        if self.past:
            self.text, self.cursor, self.anchor = self.past.pop()

    def erase(self, direction: int, *, word: bool = False) -> None:
        """Delete the selection; else the character, or the word, at the right (1) or left (-1)."""
        if self.cursor == self.anchor:
            self.step(direction, word=word, select=True)
        self.put("")

    def _beyond(self, direction: int) -> int:
        """The end of the next word at the right (1), or the start of the one at the left (-1)."""
        place, behind = self.cursor, 0 if direction > 0 else 1
        end = len(self.text) if direction > 0 else 0
        while place != end and not self.text[place - behind].isalnum():
            place += direction
        while place != end and self.text[place - behind].isalnum():
            place += direction
        return place
