"""The display list: numbers that painter.js paints once a picture."""

from __future__ import annotations

from array import array

(
    TARGET, CANVAS, FREE, CLIP, IMAGE, STRETCH, FILL, SHIFT, UNSHIFT, POLYGON, DISC, RING, LINE, FRAME, TEXT,
) = range(1, 16)  # fmt: skip
"""Kinds of entries, each followed by its numbers (painter.js says which)."""

SCREEN = 1
"""The number of the canvas that the player sees."""


class DisplayList:
    """``numbers``: what is to be painted next. ``target``: the number of the canvas on which the next entry paints."""

    def __init__(self) -> None:
        self.numbers = array("d")
        self.target = 0
        self.freed: list[int] = []
        self.count = SCREEN

    def canvas(self, width: int, height: int, *, opaque: bool) -> int:
        """The number of a new canvas."""
        number = self.freed.pop() if self.freed else self.count + 1
        self.count = max(self.count, number)
        self.numbers.extend((CANVAS, number, width, height, opaque))
        self.target = number
        return number

    def free(self, number: int) -> None:
        """Give a canvas back."""
        self.numbers.extend((FREE, number))
        self.freed.append(number)
        if self.target == number:
            self.target = 0

    def clear(self) -> None:
        """Start the next picture."""
        del self.numbers[:]


LIST = DisplayList()
