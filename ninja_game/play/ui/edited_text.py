"""A line of text with a cursor and a selection, as it is edited in a field."""

from __future__ import annotations

import re


class EditedText:
    """``cursor``: before which character it is; what lies between it and ``anchor`` is selected.

    ``longest``: how many characters fit in.
    """

    def __init__(self, text: str, longest: int) -> None:
        self.text = text
        self.longest = longest
        self.cursor = self.anchor = len(text)
        self._past: list[tuple[str, int, int]] = []

    @property
    def span(self) -> tuple[int, int]:
        """The first selected character, and the first one behind."""
        return min(self.cursor, self.anchor), max(self.cursor, self.anchor)

    @property
    def selected(self) -> str:
        """What is selected."""
        return self.text[slice(*self.span)]

    def go(self, place: int, *, select: bool = False) -> None:
        """Put the cursor before a character; ``select``: what lies between is selected too."""
        self.cursor = min(max(0, place), len(self.text))
        if not select:
            self.anchor = self.cursor

    def step(self, way: int, *, word: bool = False, select: bool = False) -> None:
        """Go to the right (1) or left (-1): by a character, a word, or to the end of what was selected."""
        first, last = self.span
        if first < last and not (word or select):
            self.go(last if way > 0 else first)
        else:
            self.go(self._beyond(way) if word else self.cursor + way, select=select)

    def select_all(self) -> None:
        """Select everything."""
        self.anchor, self.cursor = 0, len(self.text)

    def select_word(self, place: int) -> None:
        """Select the word, or what stands between two words, around a place."""
        place = min(place, len(self.text) - 1)
        kind = [_kind(each) for each in self.text]
        first = last = max(0, place)
        while first > 0 and kind[first - 1] == kind[place]:
            first -= 1
        while last < len(kind) and kind[last] == kind[place]:
            last += 1
        self.anchor, self.cursor = first, last

    def put(self, typed: str) -> None:
        """Instead of what is selected comes a text, as much of it as fits in; line ends are blanks."""
        first, last = self.span
        line = re.sub(r"[\r\n\t]+", " ", typed.strip("\r\n"))
        line = "".join(char for char in line if char.isprintable())
        line = line[: max(0, self.longest - len(self.text) + last - first)]
        if line != self.selected:
            self._past.append((self.text, self.cursor, self.anchor))
        self.text = self.text[:first] + line + self.text[last:]
        self.go(first + len(line))

    def undo(self) -> None:
        """Take back what was typed or taken out last."""
        if self._past:
            self.text, self.cursor, self.anchor = self._past.pop()

    def erase(self, way: int, *, word: bool = False) -> None:
        """Take out what is selected; else the character, or the word, at the right (1) or left (-1)."""
        if self.cursor == self.anchor:
            self.step(way, word=word, select=True)
        self.put("")

    def _beyond(self, way: int) -> int:
        """The end of the next word at the right (1), or the begin of the one at the left (-1)."""
        place, behind = self.cursor, 0 if way > 0 else 1
        end = len(self.text) if way > 0 else 0
        while place != end and not self.text[place - behind].isalnum():
            place += way
        while place != end and self.text[place - behind].isalnum():
            place += way
        return place


def _kind(char: str) -> int:
    return 0 if char.isspace() else 1 if char.isalnum() else 2
