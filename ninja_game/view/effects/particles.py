"""Particles: small pictures without physics that move along a line, change and vanish (presentation.md §5)."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from math import atan2, cos, degrees

from ninja_game.ui.theme import Palette, mixed
from ninja_game.view.sprites.drawing import DrawTarget, drawn_within
from ninja_game.view.sprites.sketch import Sketch, star
from ninja_game.view.sprites.static_sprites import gold_streak, lightning

MAX_PARTICLES = 100  # most in front of the ninja, and behind it; the oldest is removed first


@dataclass(slots=True)
class Particle:
    """(x, y): start, px; (dx, dy): movement over its life; ``fall``: px that it sinks in that time. Times in ticks."""

    kind: str
    x: float
    y: float
    dx: float = 0.0
    dy: float = 0.0
    life: float = 10.0  #: length of its life
    size: float = 1.0
    variant: int = 0
    born: float = 0.0  #: the tick of its start
    fall: float = 0.0


class Particles:
    """The particles of a view. ``share_shown``: 0…1, share of them that are shown (reduced motion)."""

    def __init__(self) -> None:
        self.front: deque[Particle] = deque(maxlen=MAX_PARTICLES)
        self.rear: deque[Particle] = deque(maxlen=MAX_PARTICLES)
        self.share_shown = 1.0
        self._count = 0.0

    def clear(self) -> None:
        self.front.clear()
        self.rear.clear()

    def add(self, particle: Particle, *, rear: bool = False) -> None:
        """Show one more; only the share ``share_shown`` of many."""
        self._count += self.share_shown
        if self._count >= 1.0:
            self._count -= 1.0
            (self.rear if rear else self.front).append(particle)

    def expire(self, now: float) -> None:
        """Drop particles whose life is over."""
        for layer in (self.front, self.rear):
            while layer and now - layer[0].born > layer[0].life:
                layer.popleft()

    @staticmethod
    def draw(layer: deque[Particle], target: DrawTarget, now: float) -> None:
        """Draw a layer at a time in ticks."""
        for particle in layer:
            t = (now - particle.born) / particle.life
            if 0.0 <= t < 1.0:
                _PAINTERS[particle.kind](particle, target, t)


# --- painters: (particle, target, t), t from 0 to 1 over its life ---


def _eased(p: Particle, t: float) -> tuple[float, float]:
    """Fast at first, then slower."""
    way = 1 - (1 - t) * (1 - t)
    return p.x + p.dx * way, p.y + p.dy * way


def _turn(p: Particle, step: int = 10) -> int:
    return round(degrees(atan2(p.dy, p.dx)) / step) * step


def _cloud(role: str) -> Callable[[Particle, DrawTarget, float], None]:
    def paint(p: Particle, target: DrawTarget, t: float) -> None:
        x, y = _eased(p, t)
        step = min(7, int(t * 8 * p.size))
        target.sprite(puff(role, step, p.variant % 2).faded(max(1, 8 - int(7 * t))), x, y)

    return paint


def _streak(role: str, width: float) -> Callable[[Particle, DrawTarget, float], None]:
    def paint(p: Particle, target: DrawTarget, t: float) -> None:
        x, y = _eased(p, t)
        bx, by = _eased(p, max(0.0, t - 0.22))
        fall = 14.0 * p.size
        palette = target.palette
        colour = mixed(getattr(palette, role), palette.background, max(0.0, t - 0.6) * 2)
        target.line(colour, bx, by + fall * max(0.0, t - 0.22) ** 2, x, y + fall * t * t, width * (1 - 0.6 * t))

    return paint


def _ray(role: str, width: float) -> Callable[[Particle, DrawTarget, float], None]:
    def paint(p: Particle, target: DrawTarget, t: float) -> None:
        palette = target.palette
        colour = mixed(getattr(palette, role), palette.background, t)
        target.line(colour, p.x, p.y, p.x + p.dx, p.y + p.dy, width * (1 - t))

    return paint


def _zap(p: Particle, target: DrawTarget, t: float) -> None:
    key = lightning((p.variant + int(t * 6)) % 3).turned(_turn(p, 15)).faded(8 - int(5 * t))
    target.sprite(key, p.x + p.dx / 2, p.y + p.dy / 2)


def _fireball(p: Particle, target: DrawTarget, t: float) -> None:
    x, y = _eased(p, t)
    target.sprite(fireball(min(7, int(8 * t)), p.variant % 3).faded(8 - int(5 * t * t)), x, y)


def _burst(p: Particle, target: DrawTarget, t: float) -> None:
    target.sprite(burst_star(min(7, int(8 * t))).faded(max(1, 8 - int(8 * t))), p.x, p.y)


def _muzzle(p: Particle, target: DrawTarget, t: float) -> None:
    target.sprite(muzzle(min(7, int(8 * t))).turned(_turn(p)), p.x, p.y)


def _halo(p: Particle, target: DrawTarget, t: float) -> None:
    """A ring of light that widens and fades."""
    palette = target.palette
    colour = mixed(palette.exit_light, palette.background, t * t)
    target.disc(colour, p.x, p.y, 10 + 80 * p.size * (1 - (1 - t) ** 2), 5 * (1 - t))


def _confetti(p: Particle, target: DrawTarget, t: float) -> None:
    """A paper that flies up, turns and falls slowly."""
    x, y = _eased(p, t)
    turn, half = p.variant + 9 * t, 2.4 * p.size
    y += p.fall * t * t
    colour = getattr(target.palette, CONFETTI[p.variant % len(CONFETTI)])
    target.line(colour, x - half * cos(turn), y - half, x + half * cos(turn), y + half, 2.6 * (1 - t * t * t))


CONFETTI = "gold", "band", "exit", "gold_light", "electric", "bright"  # the colours of the papers, roles of the palette


def _charge(p: Particle, target: DrawTarget, t: float) -> None:
    """A drop that falls inward, faster and faster."""
    way = t * t
    x, y = p.x + p.dx * way, p.y + p.dy * way
    target.line(target.palette.weapon, x, y, x + p.dx * 0.12, y + p.dy * 0.12, 1.2)


_PAINTERS: dict[str, Callable[[Particle, DrawTarget, float], None]] = {
    "dust": _cloud("dust"),
    "smoke": _cloud("smoke"),
    "blood": _streak("blood", 1.4),
    "debris": _streak("dark", 1.0),
    "spark": _streak("ember", 0.9),
    "bolt": _streak("spark", 0.9),
    "shot": _ray("outline", 1.6),
    "bullet": _ray("dark", 1.2),
    "plunge": _ray("mine", 2.6),
    "zap": _zap,
    "fireball": _fireball,
    "burst": _burst,
    "gold": lambda p, target, t: target.sprite(gold_streak(min(8, int(9 * t))).faded(8 - int(4 * t)), p.x, p.y),
    "muzzle": _muzzle,
    "charge": _charge,
    "halo": _halo,
    "confetti": _confetti,
}
"""The function that draws each kind."""


@drawn_within(7)
def puff(s: Sketch, p: Palette, role: str, step: int, variant: int) -> None:
    """A small cloud that widens. ``step`` 0…7."""
    r = 1.1 + 0.55 * step
    colour = mixed(getattr(p, role), p.background, step / 9)
    for x, y, share in (
        ((0, 0, 0.8), (0.8, -0.3, 0.6), (-0.7, 0.3, 0.55)),
        ((0, 0, 0.75), (-0.6, -0.6, 0.6), (0.6, 0.5, 0.5)),
    )[variant % 2]:
        s.disc(colour, x * r, y * r, share * r)


@drawn_within(13)
def fireball(s: Sketch, p: Palette, step: int, variant: int) -> None:
    """A tongue of fire that grows and turns to smoke."""
    r = 3.5 + 0.9 * step
    outer = (p.ember, p.ember, p.ember, p.ember, p.smoke, p.smoke, p.smoke, p.smoke)[step]
    inner = (p.bright, p.flame, p.flame, p.flame, p.ember, p.ember, p.smoke, p.smoke)[step]
    shape = star(7 + variant, r, r * 0.62, 31 * variant + 9 * step)
    s.polygon(mixed(outer, p.background, max(0, step - 4) / 5), shape)
    s.disc(mixed(inner, p.background, max(0, step - 4) / 5), 0, 0, r * (0.55 - 0.05 * step))


@drawn_within(26)
def burst_star(s: Sketch, p: Palette, step: int) -> None:
    """The flash of an explosion: a star that grows and becomes hollow."""
    r = 9 + 1.9 * step
    s.polygon(p.ember, star(9, r, r * 0.5, 13 * step))
    s.polygon(p.flame, star(9, r * 0.82, r * 0.4, 13 * step + 20))
    s.disc(p.bright, 0, 0, r * 0.3)


@drawn_within(-2, -5, 12, 5)
def muzzle(s: Sketch, p: Palette, step: int) -> None:
    """A flash at a muzzle, to the right."""
    far = 10 - step
    s.polygon(p.ember, [(0, -2.4), (far * 0.5, -1.4), (far, 0), (far * 0.5, 1.4), (0, 2.4)])
    s.polygon(p.flame, [(0, -1.4), (far * 0.7, 0), (0, 1.4)])
