"""From the 792 x 600 logical px of the stage to the px of a window of any size, drawn crisp, never stretched."""

from __future__ import annotations

from collections.abc import Sequence

import pygame

WIDTH, HEIGHT = 792, 600
"""Logical size of the stage, px."""

Point = tuple[float, float]
Colour = str | tuple[int, int, int] | tuple[int, int, int, int] | pygame.Color


class Canvas:
    """The part of a window that shows the stage: the largest rectangle of its shape in the middle.

    ``stage_size``: logical px. ``scale``: px per logical px. ``origin``: px of the stage's upper left corner.
    ``size``: px of the stage.

    >>> Canvas((1584, 1200)).point(10, 20)
    (20, 40)
    """

    def __init__(self, window: tuple[int, int], stage_size: Point = (WIDTH, HEIGHT)) -> None:
        self.window = (max(1, window[0]), max(1, window[1]))
        width, height = stage_size
        self.scale = min(self.window[0] / width, self.window[1] / height)
        self.size = (max(1, round(width * self.scale)), max(1, round(height * self.scale)))
        self.origin = ((self.window[0] - self.size[0]) // 2, (self.window[1] - self.size[1]) // 2)

    @property
    def stage(self) -> pygame.Rect:
        """The visible part of the stage in the window, px."""
        return pygame.Rect(self.origin, self.size)

    def px(self, length: float) -> int:
        """A length in px, at least 1 for any positive one."""
        return max(1, round(length * self.scale)) if length > 0 else 0

    def point(self, x: float, y: float) -> tuple[int, int]:
        """The px of a logical point."""
        return self.origin[0] + round(x * self.scale), self.origin[1] + round(y * self.scale)

    def exact(self, x: float, y: float) -> Point:
        """A logical point in px with its fraction."""
        return self.origin[0] + x * self.scale, self.origin[1] + y * self.scale

    def rect(self, x: float, y: float, w: float, h: float) -> pygame.Rect:
        """A logical rectangle in px; neighbours share their edges, whatever the scale."""
        left, top = self.point(x, y)
        right, bottom = self.point(x + w, y + h)
        return pygame.Rect(left, top, right - left, bottom - top)

    def logical(self, px: tuple[int, int]) -> Point:
        """The logical point under a px, such as the mouse's."""
        return (px[0] - self.origin[0]) / self.scale, (px[1] - self.origin[1]) / self.scale

    # --- shapes, anti-aliased, in logical px ---

    def fill_rect(
        self, surface: pygame.Surface, colour: Colour, x: float, y: float, w: float, h: float, radius: float = 0
    ) -> pygame.Rect:
        """A filled rectangle; ``radius`` rounds its corners. A colour with alpha below 255 lets shine through."""
        rect = self.rect(x, y, w, h)
        colour = pygame.Color(colour)
        if colour.a < 255:
            veil = pygame.Surface(rect.size, pygame.SRCALPHA)
            pygame.draw.rect(veil, colour, veil.get_rect(), border_radius=round(radius * self.scale))
            surface.blit(veil, rect)
        else:
            pygame.draw.rect(surface, colour, rect, border_radius=round(radius * self.scale))
        return rect

    def frame_rect(
        self, surface: pygame.Surface, colour: Colour, x: float, y: float, w: float, h: float,
        width: float = 1, radius: float = 0,
    ) -> pygame.Rect:  # fmt: skip
        """The outline of a rectangle, inside of it."""
        rect = self.rect(x, y, w, h)
        pygame.draw.rect(surface, colour, rect, width=self.px(width), border_radius=round(radius * self.scale))
        return rect

    def line(self, surface: pygame.Surface, colour: Colour, a: Point, b: Point, width: float = 1) -> pygame.Rect:
        return pygame.draw.aaline(surface, colour, self.exact(*a), self.exact(*b), self.px(width))

    def circle(
        self, surface: pygame.Surface, colour: Colour, centre: Point, radius: float, width: float = 0
    ) -> pygame.Rect:
        """A disc, or a ring of some ``width``."""
        ring = self.px(width) if width else 0
        return pygame.draw.aacircle(surface, colour, self.point(*centre), max(1, round(radius * self.scale)), ring)

    def polygon(self, surface: pygame.Surface, colour: Colour, points: Sequence[Point]) -> pygame.Rect:
        corners = [self.exact(x, y) for x, y in points]
        rect = pygame.draw.polygon(surface, colour, corners)
        for a, b in zip(corners, (*corners[1:], corners[0]), strict=True):
            rect.union_ip(pygame.draw.aaline(surface, colour, a, b))
        return rect


def _drawn_limb(surface: pygame.Surface, colour: Colour, points: Sequence[Point], radii: Sequence[float]) -> None:
    """A line through points (px), round at each of them and as thick there as its radius says; no edge is smoothed."""
    circle, polygon = pygame.draw.circle, pygame.draw.polygon
    before = None
    for (x, y), radius in zip(points, radii, strict=True):
        circle(surface, colour, (x, y), radius)
        if before:
            bx, by, begin = before
            dx, dy = x - bx, y - by
            length = (dx * dx + dy * dy) ** 0.5
            if length > 0:
                nx, ny = -dy / length, dx / length
                ax, ay, cx, cy = nx * begin, ny * begin, nx * radius, ny * radius
                polygon(surface, colour, ((bx + ax, by + ay), (x + cx, y + cy), (x - cx, y - cy), (bx - ax, by - ay)))
        before = x, y, radius


draw_limb = getattr(pygame.draw, "limb", _drawn_limb)
"""The page has it as one shape: a text is made of some hundred, a figure of twenty."""


class Lens(Canvas):
    """A part of the stage, at any scale. ``origin``: px where the stage's upper left corner would be.

    >>> Lens((100, 50), 4, (-400, -40)).logical((0, 0))
    (100.0, 10.0)
    """

    def __init__(self, window: tuple[int, int], scale: float, origin: tuple[int, int]) -> None:
        super().__init__(window)
        self.scale, self.origin = scale, origin
        whole = pygame.Rect(origin, (round(WIDTH * scale), round(HEIGHT * scale)))
        self._seen = whole.clip(pygame.Rect((0, 0), self.window))
        self.size = self._seen.size

    @property
    def stage(self) -> pygame.Rect:
        """The visible part of the stage in the window, px."""
        return self._seen.copy()
