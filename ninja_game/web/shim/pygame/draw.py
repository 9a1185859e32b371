"""Shapes. Each gives the rectangle of the px that it may have changed, as pygame-ce does."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from math import ceil, floor
from typing import Any

from .color import packed
from .display_list import DISC, FILL, FRAME, LINE, POLYGON, RING
from .rect import Rect, make
from .surface import Surface


def _clipped(surface: Surface, x: int, y: int, right: int, bottom: int) -> Rect:
    """The part of a box that is drawn; of no size where that is nothing."""
    x1, y1, x2, y2 = surface._bounds
    if x1 <= x and y1 <= y and right <= x2 and bottom <= y2:
        return make(x, y, right - x, bottom - y)
    surface.overdrawn = True
    x1, y1, x2, y2 = max(x, x1), max(y, y1), min(right, x2), min(bottom, y2)
    return make(x1, y1, x2 - x1, y2 - y1) if x1 < x2 and y1 < y2 else make(x, y, 0, 0)


def polygon(surface: Surface, color: Any, points: Sequence[Any], width: int = 0) -> Rect:
    """A filled polygon, or its outline."""
    if width:
        return lines(surface, color, True, points, width)
    flat = [*map(int, chain.from_iterable(points))]
    xs, ys = flat[::2], flat[1::2]
    entries = surface.entries()
    entries.extend((POLYGON, packed(color), len(xs)))
    entries.extend(flat)
    return _clipped(surface, min(xs), min(ys), max(xs) + 1, max(ys) + 1)


def circle(surface: Surface, color: Any, center: Any, radius: float, width: int = 0) -> Rect:
    """A disc, or a ring of some ``width`` inwards, about the corner between four px."""
    x, y, r = int(center[0]), int(center[1]), int(radius)
    if r < 1:
        return make(x, y, 0, 0)
    if 0 < width < r:
        surface.entries().extend((RING, packed(color), x, y, r, width))
    else:
        surface.entries().extend((DISC, packed(color), x, y, r))
    return _clipped(surface, x - r, y - r, x + r, y + r)


def aacircle(surface: Surface, color: Any, center: Any, radius: float, width: int = 0) -> Rect:
    """A disc, or a ring of some ``width`` inwards, about the middle of a px."""
    x, y, r = int(center[0]), int(center[1]), int(radius)
    if r < 1:
        return make(x, y, 0, 0)
    if 0 < width < r:
        surface.entries().extend((RING, packed(color), x + 0.5, y + 0.5, r + 0.5, width))
    else:
        surface.entries().extend((DISC, packed(color), x + 0.5, y + 0.5, r + 0.5))
    return _clipped(surface, x - r, y - r, x + r + 1, y + r + 1)


def rect(surface: Surface, color: Any, rect: Any, width: int = 0, border_radius: int = 0) -> Rect:
    """A filled rectangle, or its outline of some ``width`` inwards; corners may be round."""
    x, y, w, h = Rect(rect) if rect.__class__ is not Rect else rect
    area = _clipped(surface, x, y, x + w, y + h)
    if not area.w:
        return make(x, y, 0, 0)
    if border_radius > 0 and min(w, h) >= 2:
        thick = max(w // 2, h // 2) if width > min(w, h) // 2 else width
        surface.entries().extend((FRAME, packed(color), x, y, w, h, thick, min(border_radius, w / 2, h / 2)))
    elif 0 < 2 * width < min(area.w, area.h):
        surface.entries().extend((FRAME, packed(color), x, y, w, h, width, 0))
    else:
        surface.entries().extend((FILL, packed(color), *area))
    return area


def line(surface: Surface, color: Any, start: Any, end: Any, width: int = 1) -> Rect:
    """A line of whole px, ``width`` px across or down."""
    ax, ay, bx, by = int(start[0]), int(start[1]), int(end[0]), int(end[1])
    if width < 1:
        return make(ax, ay, 0, 0)
    half = width // 2
    more = (half - 1 + width % 2, half) if width > 1 else (0, 0)
    steep = abs(ax - bx) <= abs(ay - by)
    left, right, top, bottom = min(ax, bx), max(ax, bx), min(ay, by), max(ay, by)
    if steep:
        left, right = left - more[0], right + more[1]
    else:
        top, bottom = top - more[0], bottom + more[1]
    shift = 0.5 + (more[1] - more[0]) / 2
    x, y = (shift, 0.5) if steep else (0.5, shift)
    surface.entries().extend((LINE, packed(color), ax + x, ay + y, bx + x, by + y, width))
    area = _clipped(surface, left, top, right + 1, bottom + 1)
    return area if area.w else make(ax, ay, 0, 0)


def lines(surface: Surface, color: Any, closed: bool, points: Sequence[Any], width: int = 1) -> Rect:
    """Lines from point to point."""
    ends = [*points[1:], points[0]] if closed else points[1:]
    area: Rect | None = None
    for start, end in zip(points, ends, strict=False):
        drawn = line(surface, color, start, end, width)
        area = drawn if area is None or not area.w else area.union(drawn) if drawn.w else area
    return area or make(int(points[0][0]), int(points[0][1]), 0, 0)


def aaline(surface: Surface, color: Any, start: Any, end: Any, width: int = 1) -> Rect:
    """A smooth line, ``width`` px across or down."""
    (ax, ay), (bx, by) = start, end
    width = max(1, width)
    steep = abs(ax - bx) < abs(ay - by)
    # An even line lies half a px further right or down.
    shift = 0.5 + (1 - width % 2) / 2
    x, y = (shift, 0.5) if steep else (0.5, shift)
    surface.entries().extend((LINE, packed(color), ax + x, ay + y, bx + x, by + y, width))
    half = width / 2
    dx, dy = (half, 0) if steep else (0, half)
    area = _clipped(
        surface,
        floor(min(ax, bx) - dx),
        floor(min(ay, by) - dy),
        ceil(max(ax, bx) + dx) + 1,
        ceil(max(ay, by) + dy) + 1,
    )
    return area if area.w else make(int(ax), int(ay), 0, 0)
