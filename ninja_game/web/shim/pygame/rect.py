"""Rectangles of whole px."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from typing import Any


class Rect:
    """Upper left corner ``x``, ``y`` and size ``w``, ``h``; fractions are truncated."""

    __slots__ = ("h", "w", "x", "y")

    def __init__(self, *values: Any) -> None:
        if len(values) == 1:
            values = tuple(values[0])
        if len(values) == 2:
            values = (*values[0], *values[1])
        x, y, w, h = values
        self.x, self.y, self.w, self.h = int(x), int(y), int(w), int(h)

    def __iter__(self) -> Iterator[int]:
        return iter((self.x, self.y, self.w, self.h))

    def __getitem__(self, index: Any) -> Any:
        return (self.x, self.y, self.w, self.h)[index]

    def __eq__(self, other: object) -> bool:
        try:
            return tuple(self) == tuple(other)  # type: ignore[arg-type]
        except TypeError:
            return NotImplemented

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        return self.w != 0 and self.h != 0

    right = property(lambda self: self.x + self.w, lambda self, value: setattr(self, "x", int(value) - self.w))
    bottom = property(lambda self: self.y + self.h, lambda self, value: setattr(self, "y", int(value) - self.h))
    size = property(lambda self: (self.w, self.h))
    topleft = property(lambda self: (self.x, self.y), lambda self, corner: Rect.__init__(self, corner, self.size))

    def copy(self) -> Rect:
        return make(self.x, self.y, self.w, self.h)

    def move(self, x: Any, y: float = 0) -> Rect:
        if x.__class__ is tuple:
            x, y = x
        rect = _new(Rect)
        rect.x, rect.y, rect.w, rect.h = self.x + int(x), self.y + int(y), self.w, self.h
        return rect

    def inflate(self, x: float, y: float) -> Rect:
        x, y = int(x), int(y)
        return make(self.x - int(x / 2), self.y - int(y / 2), self.w + x, self.h + y)

    def union(self, other: Any) -> Rect:
        left, top, w, h = other
        x, y = min(self.x, left), min(self.y, top)
        return make(x, y, max(self.x + self.w, left + w) - x, max(self.y + self.h, top + h) - y)

    def union_ip(self, other: Any) -> None:
        self.x, self.y, self.w, self.h = self.union(other)

    def unionall(self, others: Any) -> Rect:
        return reduce(Rect.union, others, self.copy())

    def clip(self, other: Any) -> Rect:
        left, top, w, h = other
        x, y = max(self.x, left), max(self.y, top)
        right, bottom = min(self.x + self.w, left + w), min(self.y + self.h, top + h)
        if x >= right or y >= bottom:
            return make(self.x, self.y, 0, 0)
        return make(x, y, right - x, bottom - y)

    def colliderect(self, other: Rect) -> bool:
        return bool(self.collidelistall((other,)))

    def collidelistall(self, others: Sequence[Rect]) -> list[int]:
        x, y, right, bottom = self.x, self.y, self.x + self.w, self.y + self.h
        boxes = enumerate((rect.x, rect.y, rect.w, rect.h) for rect in others) if self else ()
        return [k for k, (a, b, w, h) in boxes if a < right and x < a + w and b < bottom and y < b + h and w and h]

    def collidelist(self, others: Any) -> int:
        return next(iter(self.collidelistall(others)), -1)

    def collidepoint(self, x: Any, y: float = 0) -> bool:
        if x.__class__ is tuple:
            x, y = x
        return bool(self.x <= x < self.x + self.w and self.y <= y < self.y + self.h)

    def contains(self, other: Any) -> bool:
        left, top, w, h = other
        across = self.x <= left < self.x + self.w >= left + w
        return bool(across and self.y <= top < self.y + self.h >= top + h)


# Other names of the same slots, which are read without a call.
for _name, _slot in ("left", "x"), ("top", "y"), ("width", "w"), ("height", "h"):
    setattr(Rect, _name, getattr(Rect, _slot))

_new = Rect.__new__


def make(x: int, y: int, w: int, h: int) -> Rect:
    """A rectangle of four whole numbers, without checks."""
    rect = _new(Rect)
    rect.x, rect.y, rect.w, rect.h = x, y, w, h
    return rect
