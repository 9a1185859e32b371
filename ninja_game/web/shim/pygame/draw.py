"""Shapes. Each gives the rectangle of the px that it may have changed, as pygame-ce does."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from math import ceil, floor
from typing import Any

from .color import packed
from .rect import Rect, make
from .surface import DISC, FILL, FRAME, LIMB, LINE, POLYGON, RING, STROKE, Surface


def _clipped(surface: Surface, x: int, y: int, right: int, bottom: int) -> Rect:
    """The drawn part of a box; of size 0 if there is none."""
    x1, y1, x2, y2 = surface._bounds
    if x1 <= x and y1 <= y and right <= x2 and bottom <= y2:
        return make(x, y, right - x, bottom - y)
    surface.overdrawn = True
    x1, y1 = max(x, x1), max(y, y1)
    x2, y2 = min(right, x2), min(bottom, y2)
    return make(x1, y1, x2 - x1, y2 - y1) if x1 < x2 and y1 < y2 else make(x, y, 0, 0)


def polygon(surface: Surface, color: Any, points: Sequence[Any]) -> Rect:
    flat = [*map(int, chain.from_iterable(points))]
    xs, ys = flat[::2], flat[1::2]
    entries = surface.entries()
    entries.extend((POLYGON, packed(color), len(xs)))
    entries.extend(flat)
    return _clipped(surface, min(xs), min(ys), max(xs) + 1, max(ys) + 1)


def limb(surface: Surface, color: Any, points: Sequence[Any], radii: Sequence[float]) -> None:
    """A line through points with a radius at each and round ends, which pygame-ce does not have."""
    xs, ys = zip(*points, strict=True)
    most = max(radii)
    if min(radii) == most:
        surface.entries().extend((STROKE, packed(color), len(xs), 2 * most, *chain.from_iterable(points)))
    else:
        surface.entries().extend((LIMB, packed(color), len(xs), *chain.from_iterable(zip(xs, ys, radii, strict=True))))
    _clipped(surface, *map(floor, (min(xs) - most, min(ys) - most, max(xs) + most + 1, max(ys) + most + 1)))


def circle(surface: Surface, color: Any, center: Any, radius: float, width: int = 0, smooth: int = 0) -> Rect:
    """Draw a disc or a ring. ``smooth``: 1 for a smooth one, whose middle and edge lie half a px further."""
    x, y, r = int(center[0]), int(center[1]), int(radius)
    if r < 1:
        return make(x, y, 0, 0)
    place = x + smooth / 2, y + smooth / 2, r + smooth / 2
    if 0 < width < r:
        surface.entries().extend((RING, packed(color), *place, width))
    else:
        surface.entries().extend((DISC, packed(color), *place))
    return _clipped(surface, x - r, y - r, x + r + smooth, y + r + smooth)


def aacircle(surface: Surface, color: Any, center: Any, radius: float, width: int = 0) -> Rect:
    return circle(surface, color, center, radius, width, smooth=1)


def rect(surface: Surface, color: Any, rect: Any, width: int = 0, border_radius: int = 0) -> Rect:
    x, y, w, h = Rect(rect) if rect.__class__ is not Rect else rect
    area = _clipped(surface, x, y, x + w, y + h)
    if not area:
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
    ax, ay, bx, by = int(start[0]), int(start[1]), int(end[0]), int(end[1])
    if width < 1:
        return make(ax, ay, 0, 0)
    half = width // 2
    more = (half - 1 + width % 2, half) if width > 1 else (0, 0)
    steep = abs(ax - bx) <= abs(ay - by)
    left, right = min(ax, bx), max(ax, bx)
    top, bottom = min(ay, by), max(ay, by)
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
    ends = [*points[1:], points[0]] if closed else points[1:]
    drawn = [line(surface, color, start, end, width) for start, end in zip(points, ends, strict=False)]
    areas = [rect for rect in drawn if rect.w]
    return areas[0].unionall(areas) if areas else make(int(points[0][0]), int(points[0][1]), 0, 0)


def aaline(surface: Surface, color: Any, start: Any, end: Any, width: int = 1) -> Rect:
    (ax, ay), (bx, by) = start, end
    width = max(1, width)
    steep = abs(ax - bx) < abs(ay - by)
    # An even line lies half a px further right or down.
    shift = 0.5 + (1 - width % 2) / 2
    x, y = (shift, 0.5) if steep else (0.5, shift)
    surface.entries().extend((LINE, packed(color), ax + x, ay + y, bx + x, by + y, width))
    if abs(ax - bx) < 1e-4 and abs(ay - by) < 1e-4:
        ax, ay = floor(ax + 0.5), floor(ay + 0.5)
        return _clipped(surface, ax, ay, ax + 1, ay + 1)
    if steep:
        top, bottom, left, right = _along(ay, ax, by, bx, width)
    else:
        left, right, top, bottom = _along(ax, ay, bx, by, width)
    area = _clipped(surface, left, top, right + 1, bottom + 1)
    return area if area.w else make(int(ax), int(ay), 0, 0)


def _along(ax: float, ay: float, bx: float, by: float, width: int) -> tuple[int, int, int, int]:
    """First and last px of a smooth line that is longer in x than in y: in x, then in y."""
    if ax > bx:
        ax, ay, bx, by = bx, by, ax, ay
    slope = (by - ay) / (bx - ax)
    first, last = int(ax), ceil(bx)
    one, two = ay + slope * (first - ax), by + slope * (last - bx)
    half = width // 2
    return first, last, floor(min(one, two)) - half + 1 - width % 2, ceil(max(one, two)) + half
