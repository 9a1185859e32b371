"""From the 792 x 600 logical px of the stage to the px of a window of any size, drawn sharply, never stretched."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO
from math import log

import pygame

from ninja_game.sim.grid import Point

WIDTH, HEIGHT = 792, 600  # logical size of the stage, px

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
        """The logical point of a px, such as the mouse's."""
        return (px[0] - self.origin[0]) / self.scale, (px[1] - self.origin[1]) / self.scale

    # --- shapes, anti-aliased, in logical px ---

    def fill_rect(
        self, surface: pygame.Surface, colour: Colour, x: float, y: float, w: float, h: float, radius: float = 0
    ) -> pygame.Rect:
        """A filled rectangle; ``radius`` rounds its corners. A colour with alpha below 255 is transparent."""
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
        self,
        surface: pygame.Surface,
        colour: Colour,
        x: float,
        y: float,
        w: float,
        h: float,
        width: float = 1,
        radius: float = 0,
    ) -> pygame.Rect:
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
    """A line through points (px), with a radius at each of them and round ends; without anti-aliasing."""
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
"""A page has its own function: a text is made of some hundred such lines, a figure of twenty."""


class Lens(Canvas):
    """A part of the stage, at any scale. ``origin``: px of the stage's upper left corner, which may be outside.

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


MAX_SCALE = 8.0  # px of the window per px of the level, at most
_MARGIN = 0.3  # share of the picture at each side in which a followed place moves the picture
_STILL = 3  # less movement of the mouse than this, px, is a click


class Camera:
    """The part of a level in a picture of some size (``window``, px); the mouse zooms and moves it.

    One notch of the wheel multiplies the zoom by ``step``, up to ``most``, 0: to MAX_SCALE.
    """

    def __init__(self, step: float = 1.25, most: float = 0.0) -> None:
        self._step, self._most = step, most
        self.held: tuple[int, int] | None = None  #: the place of a drag, px
        self.moved = False  #: whether the drag has moved
        self.show_all()

    @property
    def render_key(self) -> tuple[object, ...]:
        return self.zoom, self.centre

    def canvas(self, window: tuple[int, int]) -> Canvas:
        """From px of the level to px of a picture of this size."""
        whole = Canvas(window)
        if self.zoom == 1.0:
            return whole
        scale = whole.scale * self.zoom
        x, y = self.centre
        return Lens(window, scale, (_origin(window[0], WIDTH, x, scale), _origin(window[1], HEIGHT, y, scale)))

    def show_all(self) -> None:
        self.zoom = 1.0  #: 1: all of the level
        self.centre: Point = (WIDTH / 2, HEIGHT / 2)  #: the place in the middle, px of the level

    def zoom_at(self, window: tuple[int, int], px: tuple[int, int], notches: float) -> None:
        """Zoom; the level's place under a px stays there as far as possible."""
        x, y = self.canvas(window).logical(px)
        most = self._most or max(1.0, MAX_SCALE / Canvas(window).scale)
        steps = round(log(self.zoom, self._step)) + notches
        self.zoom = min(most, max(1.0, round(self._step**steps, 9)))  # twice as large is 2.0
        scale = Canvas(window).scale * self.zoom
        self._look_at(window, x - (px[0] - window[0] / 2) / scale, y - (px[1] - window[1] / 2) / scale)

    def move(self, window: tuple[int, int], dx: float, dy: float) -> None:
        scale = self.canvas(window).scale
        self._look_at(window, self.centre[0] - dx / scale, self.centre[1] - dy / scale)

    def grab(self, px: tuple[int, int]) -> None:
        self.held, self.moved = px, False

    def drag(self, window: tuple[int, int], px: tuple[int, int]) -> None:
        """Drag the level to the mouse, once that has moved farther than a click may."""
        if self.held:
            dx, dy = px[0] - self.held[0], px[1] - self.held[1]
            self.moved = self.moved or max(abs(dx), abs(dy)) > _STILL
            if self.moved:
                self.move(window, dx, dy)
                self.held = px

    def follow(self, window: tuple[int, int], x: float, y: float) -> None:
        """Scroll until a place of the level is well inside of the picture."""
        scale = self.canvas(window).scale
        reach = [length / scale * (0.5 - _MARGIN) for length in window]
        cx, cy = self.centre
        self._look_at(window, min(max(cx, x - reach[0]), x + reach[0]), min(max(cy, y - reach[1]), y + reach[1]))

    def _look_at(self, window: tuple[int, int], x: float, y: float) -> None:
        """Centre a place, without a gap beside the level."""
        scale = Canvas(window).scale * self.zoom
        half_w, half_h = window[0] / scale / 2, window[1] / scale / 2
        self.centre = (
            min(max(x, half_w), WIDTH - half_w) if half_w < WIDTH / 2 else WIDTH / 2,
            min(max(y, half_h), HEIGHT - half_h) if half_h < HEIGHT / 2 else HEIGHT / 2,
        )


def _origin(window: int, length: float, centre: float, scale: float) -> int:
    """The level's corner, px: centred if it is smaller than the window, else without a gap."""
    whole = round(length * scale)
    if whole <= window:
        return (window - whole) // 2
    return min(0, max(window - whole, round(window / 2 - centre * scale)))


def png_of(surface: pygame.Surface) -> bytes:
    png = BytesIO()
    pygame.image.save(surface, png, "picture.png")
    return png.getvalue()
