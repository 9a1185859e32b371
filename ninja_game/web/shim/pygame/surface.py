"""Surfaces: drawing on them adds numbers to a display list, which JavaScript paints once per picture.

A surface with only shapes on it is *fresh*: it has its own numbers. Its first blit copies them to the target; the
second one makes it a canvas of the page, whose numbers go to the common list from then on.
"""

from __future__ import annotations

from array import array
from operator import attrgetter
from typing import Any

from .color import packed
from .rect import Rect, _new, make

SRCALPHA = 0x10000
BLEND_RGBA_SUB, BLEND_RGBA_MULT, BLEND_PREMULTIPLIED = 7, 8, 17

# Up to these sizes a blit copies a fresh surface, instead of making it a canvas:
MAX_COPY_NUMBERS = 3000  # numbers
MAX_COPY_PX = 65536  # px
ONE_SHAPE = 8  # numbers of a simple shape, whatever its px
A_PART = 160  # numbers of a part of another fresh surface, such as a letter of a text, however often it is blitted

TARGET, CANVAS, FREE, CLIP, IMAGE, STRETCH, FILL, SHIFT, UNSHIFT = range(1, 10)
POLYGON, DISC, RING, LINE, FRAME, TEXT, STROKE, LIMB = range(10, 18)
"""Kinds of entries, each followed by its numbers (see painter.js)."""

SCREEN = 1  # the number of the canvas that the player sees


class DisplayList:
    """The commands for the page's painter, as ``numbers``. ``target``: the number of the next command's canvas."""

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
        self.numbers.extend((FREE, number))
        self.freed.append(number)
        if self.target == number:
            self.target = 0


LIST = DisplayList()


class Surface:
    """A picture of ``size`` px, black, or transparent with the flag SRCALPHA.

    ``opacity``: 0 to 1, of the whole picture. ``overdrawn``: whether a shape on it reaches beyond its edges.
    """

    def __init__(self, size: Any, flags: int = 0, depth: int = 0) -> None:
        self.w, self.h = int(size[0]), int(size[1])
        self.alpha = bool(flags & SRCALPHA)
        self._bounds = self._painted = (0, 0, self.w, self.h)
        self._number = 0
        self._own: array[float] | None = array("d")
        self._blits = 0
        self.opacity = 1.0
        self.overdrawn = False
        if not self.alpha:
            self.settle()

    def __del__(self) -> None:
        if self._number:
            LIST.free(self._number)

    def show(self, size: tuple[int, int]) -> None:
        """Become the visible picture."""
        self.w, self.h = size
        self.alpha = self.overdrawn = False
        self.opacity, self._own, self._blits = 1.0, None, 0
        self._bounds = self._painted = (0, 0, *size)
        self._number = LIST.target = SCREEN
        LIST.numbers.extend((CANVAS, SCREEN, *size, 1))

    def settle(self) -> int:
        """Become a canvas; its number."""
        if self._own is not None:
            own, self._own = self._own, None
            self._number = LIST.canvas(self.w, self.h, opaque=not self.alpha)
            LIST.numbers.extend(own)
        return self._number

    def entries(self) -> array[float]:
        """The list for the numbers of drawings on this surface."""
        if self._own is not None:
            return self._own
        numbers = LIST.numbers
        if LIST.target != self._number:
            LIST.target = self._number
            numbers.extend((TARGET, self._number))
        if self._bounds is not self._painted:
            if self._bounds != self._painted:
                numbers.extend((CLIP, *self.get_clip()))
            self._painted = self._bounds
        return numbers

    def get_size(self) -> tuple[int, int]:
        return self.w, self.h

    size = property(get_size)
    width = property(attrgetter("w"))
    height = property(attrgetter("h"))

    def get_rect(self, **place: Any) -> Rect:
        rect = make(0, 0, self.w, self.h)
        for name, value in place.items():
            setattr(rect, name, value)
        return rect

    def set_clip(self, rect: Any) -> None:
        whole = make(0, 0, self.w, self.h)
        clip = whole if rect is None else Rect(rect).clip(whole)
        self._bounds = (clip.x, clip.y, clip.x + clip.w, clip.y + clip.h)
        if self._own is not None and self._bounds != self._painted:
            self.settle()

    def get_clip(self) -> Rect:
        x1, y1, x2, y2 = self._bounds
        return make(x1, y1, x2 - x1, y2 - y1)

    def copy(self) -> Surface:
        twin = Surface((self.w, self.h), SRCALPHA * self.alpha)
        if self._own is not None and twin._own is not None:
            twin._own.extend(self._own)
            twin.overdrawn = self.overdrawn
        else:
            twin.blit(self, (0, 0))
        twin.opacity = self.opacity
        return twin

    # --- drawing ---

    def fill(self, colour: Any, rect: Any = None, special_flags: int = 0) -> Rect:
        """Replace the picture by a colour. With BLEND_RGBA_MULT: fade the whole picture."""
        if special_flags == BLEND_RGBA_MULT:
            self.opacity *= colour[3] / 255
            return self.get_rect()
        filled = self.get_rect() if rect is None else Rect(rect).clip(self.get_rect())
        area = filled.clip(self.get_clip())
        if area.w:
            if self._own is not None and rect is None:
                del self._own[:]
            number = packed(colour)
            if number & 255 or self._own is None or len(self._own):
                # A drawing that erases cannot be copied on top of another one.
                self.overdrawn = self.overdrawn or number & 255 < 255
                self.entries().extend((FILL, number, area.x, area.y, area.w, area.h))
        return filled if filled.w else make(0, 0, 0, 0)

    def scroll(self, dx: int, dy: int) -> None:
        before = self.copy()
        if self.alpha:
            self.fill((0, 0, 0, 0))
        self.blit(before, (dx, dy))

    def set_at(self, place: tuple[int, int], colour: Any) -> None:
        self.entries().extend((FILL, packed(colour), *place, 1, 1))

    def blit(self, source: Surface, dest: Any, area: Any = None, special_flags: int = 0) -> Rect:
        """Draw a picture, or an ``area`` of it, with its upper left corner at ``dest``; the covered rectangle."""
        # The most frequent call, some 200 times a picture: hence attributes instead of smaller functions.
        if dest.__class__ is Rect:
            left, top = dest.x, dest.y
        else:
            left, top = int(dest[0]), int(dest[1])
        x = y = 0
        w, h = source.w, source.h
        if area is not None:
            x, y, w, h = (area.x, area.y, area.w, area.h) if area.__class__ is Rect else Rect(area)
            if x < 0 or y < 0 or x + w > source.w or y + h > source.h:
                left, top, w, h = left + max(0, -x), top + max(0, -y), w + min(0, x), h + min(0, y)
                x, y = max(0, x), max(0, y)
                w, h = min(w, source.w - x), min(h, source.h - y)
        x1, y1, x2, y2 = self._bounds
        cut = left < x1 or top < y1 or left + w > x2 or top + h > y2
        if cut:
            right, bottom = min(left + w, x2), min(top + h, y2)
            x, y = x + max(0, x1 - left), y + max(0, y1 - top)
            left, top = max(left, x1), max(top, y1)
            w, h = right - left, bottom - top
        if w <= 0 or h <= 0:
            return make(int(dest[0]), int(dest[1]), 0, 0)
        sign = -1 if special_flags == BLEND_RGBA_SUB and source.settle() else 1  # an opacity below 0 subtracts
        if source._own is None or not self._copy(source, left, top, whole=not cut and area is None):
            if self._own is not None:
                self.settle()
            entries = LIST.numbers if LIST.target == self._number and self._bounds is self._painted else self.entries()
            entries.extend((IMAGE, source._number, x, y, w, h, left, top, sign * source.opacity))
        rect = _new(Rect)
        rect.x, rect.y, rect.w, rect.h = left, top, w, h
        return rect

    def _copy(self, source: Surface, left: int, top: int, *, whole: bool) -> bool:
        """Copy the numbers of a fresh picture if it is ``whole``, small and new; else settle it."""
        own = source._own
        assert own is not None  # noqa: S101 - it is fresh
        source._blits += 1
        small = len(own) <= ONE_SHAPE or (len(own) <= MAX_COPY_NUMBERS and source.w * source.h <= MAX_COPY_PX)
        once = source._blits == 1 or (self._own is not None and len(own) <= A_PART)
        if not (whole and small and once and source.opacity == 1.0) or source.overdrawn:
            source.settle()
            return False
        entries = self.entries()
        entries.extend((SHIFT, 1, left, top))
        entries.extend(own)
        entries.append(UNSHIFT)
        return True

    def scaled(self, size: Any) -> Surface:
        """The picture in another size. A fresh one made smaller stays sharp: its shapes are drawn in that size."""
        small = Surface(size, SRCALPHA * self.alpha)
        if self._own is not None and small._own is not None and self.opacity == 1.0 and small.w <= self.w:
            small._own.extend((SHIFT, small.w / self.w, 0, 0))
            small._own.extend(self._own)
            small._own.append(UNSHIFT)
            small.overdrawn = self.overdrawn
        else:
            number = self.settle()
            small.settle()
            small.entries().extend((STRETCH, number, self.w, self.h, small.w, small.h))
            small.opacity = self.opacity
        return small
