"""Drawings of particles. ``step`` counts from 0 (new) to 7 (nearly gone)."""

from __future__ import annotations

from ninja_game.play.ui.palette import Palette, mixed
from ninja_game.play.view.sprites.drawing import drawing
from ninja_game.play.view.sprites.sketch import Sketch, star


@drawing(7)
def puff(s: Sketch, p: Palette, role: str, step: int, variant: int) -> None:
    """A cloudlet that widens. ``step`` 0…7."""
    r = 1.1 + 0.55 * step
    colour = mixed(getattr(p, role), p.background, step / 9)
    for x, y, share in (
        ((0, 0, 0.8), (0.8, -0.3, 0.6), (-0.7, 0.3, 0.55)),
        ((0, 0, 0.75), (-0.6, -0.6, 0.6), (0.6, 0.5, 0.5)),
    )[variant % 2]:
        s.disc(colour, x * r, y * r, share * r)


@drawing(13)
def fireball(s: Sketch, p: Palette, step: int, variant: int) -> None:
    """A tongue of fire that swells and turns to smoke."""
    r = 3.5 + 0.9 * step
    outer = (p.ember, p.ember, p.ember, p.ember, p.smoke, p.smoke, p.smoke, p.smoke)[step]
    inner = (p.bright, p.flame, p.flame, p.flame, p.ember, p.ember, p.smoke, p.smoke)[step]
    shape = star(7 + variant, r, r * 0.62, 31 * variant + 9 * step)
    s.polygon(mixed(outer, p.background, max(0, step - 4) / 5), shape)
    s.disc(mixed(inner, p.background, max(0, step - 4) / 5), 0, 0, r * (0.55 - 0.05 * step))


@drawing(26)
def burst_star(s: Sketch, p: Palette, step: int) -> None:
    """The flash of an explosion: a star that grows and goes hollow."""
    r = 9 + 1.9 * step
    s.polygon(p.ember, star(9, r, r * 0.5, 13 * step))
    s.polygon(p.flame, star(9, r * 0.82, r * 0.4, 13 * step + 20))
    s.disc(p.bright, 0, 0, r * 0.3)


@drawing(-2, -5, 12, 5)
def muzzle(s: Sketch, p: Palette, step: int) -> None:
    """A flash at a muzzle, to the right."""
    far = 10 - step
    s.polygon(p.ember, [(0, -2.4), (far * 0.5, -1.4), (far, 0), (far * 0.5, 1.4), (0, 2.4)])
    s.polygon(p.flame, [(0, -1.4), (far * 0.7, 0), (0, 1.4)])
