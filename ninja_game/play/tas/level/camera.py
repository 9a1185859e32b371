"""Which part of the level is seen: all of it, or larger, around a place that moves."""

from __future__ import annotations

from math import log

from ninja_game.play.ui.canvas import HEIGHT, WIDTH, Canvas, Lens, Point

STEP = 1.25
"""One notch of the wheel."""
LARGEST = 8.0
"""px of the window a px of the level, at most."""
_MARGIN = 0.3
"""The part of the picture, at each side, in which what is followed moves the picture."""


class Camera:
    """``zoom``: 1: all of the level. ``centre``: what is in the middle, px of the level."""

    def __init__(self) -> None:
        self.zoom = 1.0
        self.centre: Point = WIDTH / 2, HEIGHT / 2

    @property
    def render_key(self) -> tuple[object, ...]:
        """All that a picture depends on."""
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
        """Show all of the level."""
        self.zoom = 1.0
        self.centre = WIDTH / 2, HEIGHT / 2

    def zoom_at(self, window: tuple[int, int], px: tuple[int, int], notches: float) -> None:
        """Show it larger or smaller; what is under a px stays there as far as that is possible."""
        canvas = self.canvas(window)
        x, y = canvas.logical(px)
        most = max(1.0, LARGEST / Canvas(window).scale)
        steps = round(log(self.zoom, STEP)) + notches
        self.zoom = min(most, max(1.0, STEP**steps))
        scale = Canvas(window).scale * self.zoom
        self._look_at(window, x - (px[0] - window[0] / 2) / scale, y - (px[1] - window[1] / 2) / scale)

    def move(self, window: tuple[int, int], dx: float, dy: float) -> None:
        """Move the picture by this many px."""
        scale = self.canvas(window).scale
        self._look_at(window, self.centre[0] - dx / scale, self.centre[1] - dy / scale)

    def follow(self, window: tuple[int, int], x: float, y: float) -> None:
        """Have a place of the level well inside of the picture."""
        scale = self.canvas(window).scale
        reach = [length / scale * (0.5 - _MARGIN) for length in window]
        cx, cy = self.centre
        self._look_at(window, min(max(cx, x - reach[0]), x + reach[0]), min(max(cy, y - reach[1]), y + reach[1]))

    def _look_at(self, window: tuple[int, int], x: float, y: float) -> None:
        """Have a place in the middle, but nothing beside the level in the picture."""
        scale = Canvas(window).scale * self.zoom
        half_w, half_h = window[0] / scale / 2, window[1] / scale / 2
        self.centre = (
            min(max(x, half_w), WIDTH - half_w) if half_w < WIDTH / 2 else WIDTH / 2,
            min(max(y, half_h), HEIGHT - half_h) if half_h < HEIGHT / 2 else HEIGHT / 2,
        )


def _origin(window: int, length: float, centre: float, scale: float) -> int:
    """Where the level begins, px: in the middle if it is smaller than the window, else without a gap."""
    whole = round(length * scale)
    if whole <= window:
        return (window - whole) // 2
    return min(0, max(window - whole, round(window / 2 - centre * scale)))
