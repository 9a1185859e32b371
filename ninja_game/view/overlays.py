"""Overlays that show how the world works: hit boxes, grid, edges, lines of sight, cells, thinkers. They only read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import pygame

from ninja_game.sim import rules
from ninja_game.sim.collision.rays import ray_tiles, sees
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, EXISTS
from ninja_game.sim.kinds import DOOR, DRONE, KIND_OF, LAUNCHER, SWITCH, TURRET
from ninja_game.sim.objects.dispatch import NINE_CELLS
from ninja_game.sim.rules import CELL, HALF, INTERESTING, OFF, RADIUS, STRIDE
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World
from ninja_game.sim.states import AUTOMATIC, WEAPON_ZAP
from ninja_game.simulation import Simulation
from ninja_game.ui.canvas import HEIGHT, WIDTH, Canvas
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.drawing import DrawTarget, is_near

OVERLAY_ACTIONS = (
    "overlay_hitboxes", "overlay_grid", "overlay_edges", "overlay_rays", "overlay_cells", "overlay_thinkers",
)  # fmt: skip
_HIT_BOXES, _GRID, _EDGES, _RAYS, _CELLS, _THINKERS = OVERLAY_ACTIONS

_SIDES: tuple[tuple[float, float, float, float], ...] = (
    (10.6, -11, 10.6, 11), (-11, 10.6, 11, 10.6), (-10.6, -11, -10.6, 11), (-11, -10.6, 11, -10.6),
)  # fmt: skip
"""A line just inside each side of a cell: each cell has its own edge states."""

_THINKER = 9.0  # radius of the ring around a thinker, px

_MIN_SIZE = 1.0  # half size, px, of a shape that is a point: the tip of a rocket


@dataclass(frozen=True)
class HitShape:
    """A circle (``round``) or square about a point, px; ``half``: its radius or half side."""

    x: float
    y: float
    half: float
    round: bool
    lethal: bool = False  #: whether touching it kills
    ninja: bool = False  #: whether it is the ninja
    vx: float = 0.0  #: px/tick
    vy: float = 0.0


class Overlays:
    """The overlays that are switched on."""

    def __init__(self) -> None:
        self.on: set[str] = set()
        self._sheet: pygame.Surface | None = None
        self._sheet_of: tuple[object, ...] = ()

    def toggle(self, action: str) -> bool:
        """Switch the overlay of an action on or off; False for an action without one."""
        if action not in OVERLAY_ACTIONS:
            return False
        self.on ^= {action}
        return True

    def draw(self, target: DrawTarget, simulation: Simulation) -> None:
        """Draw the overlays over the level."""
        if not self.on:
            return
        world = simulation.world
        if self.on & {_GRID, _EDGES}:
            self._draw_sheet(target, world)
        if _CELLS in self.on:
            _draw_cells(target, world)
        if _RAYS in self.on:
            _draw_rays(target, simulation)
        if _THINKERS in self.on:
            _draw_thinkers(target, world)
        if _HIT_BOXES in self.on:
            for shape in hit_shapes(world):
                _draw_shape(target, shape)
        if self.on & {_GRID, _EDGES}:
            # The sheet covers everything: one rectangle to restore, not hundreds.
            target.covered[:] = [target.canvas.stage]

    def _draw_sheet(self, target: DrawTarget, world: World) -> None:
        """Grid and edges seldom change: they are drawn once and copied."""
        state = (target.canvas, target.palette.name, _GRID in self.on, _EDGES in self.on, bytes(world.edges))
        if self._sheet is None or state != self._sheet_of:
            self._sheet_of = state
            self._sheet = pygame.Surface(target.canvas.window, pygame.SRCALPHA)
            if _GRID in self.on:
                _paint_grid(self._sheet, target.canvas, target.palette)
            if _EDGES in self.on:
                _paint_edges(self._sheet, target.canvas, target.palette, world)
        target.surface.blit(self._sheet, (0, 0))


def _paint_grid(sheet: pygame.Surface, canvas: Canvas, palette: Palette) -> None:
    colour = (*palette.text[:3], 70)
    for x in range(0, WIDTH + 1, int(CELL)):
        pygame.draw.line(sheet, colour, canvas.point(x, 0), canvas.point(x, HEIGHT))
    for y in range(0, HEIGHT + 1, int(CELL)):
        pygame.draw.line(sheet, colour, canvas.point(0, y), canvas.point(WIDTH, y))


def _paint_edges(sheet: pygame.Surface, canvas: Canvas, palette: Palette, world: World) -> None:
    """Solid edges full, interesting ones thin with dots at the ends; off is not drawn."""
    for cell in range(len(EXISTS)):
        if not EXISTS[cell]:
            continue
        for side, (ax, ay, bx, by) in enumerate(_SIDES):
            state = world.edges[4 * cell + side]
            if state == OFF:
                continue
            colour = palette.accent if state == INTERESTING else palette.switch
            x, y = CENTRE_X[cell], CENTRE_Y[cell]
            width = canvas.px(0.8 if state == INTERESTING else 1.6)
            pygame.draw.line(sheet, colour, canvas.point(x + ax, y + ay), canvas.point(x + bx, y + by), width)


def _tint(target: DrawTarget, colour: pygame.Color, alpha: int, cell: int, inset: float = 0) -> None:
    if not EXISTS[cell]:
        return
    x, y, w = CENTRE_X[cell] - HALF + inset, CENTRE_Y[cell] - HALF + inset, CELL - 2 * inset
    target.covered.append(target.canvas.fill_rect(target.surface, (colour.r, colour.g, colour.b, alpha), x, y, w, w))


def _draw_cells(target: DrawTarget, world: World) -> None:
    """The nine cells whose objects are asked; stronger, those whose tiles are touched; the cells of objects."""
    n = world.ninja
    if EXISTS[n.cell]:
        for offset in NINE_CELLS:
            _tint(target, target.palette.switch, 40, n.cell + offset)
        for cell in touched_cells(n.x, n.y, n.cell):
            _tint(target, target.palette.accent, 70, cell, 2)
    for slot in range(1, world.slots_used):
        o = world.objects[slot]
        if o.in_grid and EXISTS[o.cell]:
            _tint(target, target.palette.good, 60, o.cell, 7)


def touched_cells(x: float, y: float, cell: int) -> list[int]:
    """The cells whose tiles a circle at (x, y) can touch: its own, one up or down, one beside, one between."""
    cells = [cell]
    dx, dy = x - CENTRE_X[cell], y - CENTRE_Y[cell]
    if abs(dy) + RADIUS > HALF:
        cells.append(cell + STRIDE if dy > 0 else cell - STRIDE)
    if abs(dx) + RADIUS > HALF:
        side = 1 if dx > 0 else -1
        cells += [near + side for near in cells]
    return cells


def _draw_rays(target: DrawTarget, simulation: Simulation) -> None:
    """A line from each object that looks for the ninja: to the ninja in sight, else to the tile between."""
    world, tiles = simulation.world, simulation.tiles
    n = world.ninja
    for slot in range(1, world.id_count + 1):
        o = world.objects[slot]
        if not _looks(o):
            continue
        x, y = (o.base_x, o.base_y) if o.kind == LAUNCHER else (o.x, o.y)
        if not (x == x and y == y):  # noqa: PLR0124 - the test for NaN
            continue
        if sees(tiles, world, x, y, n.x, n.y)[0]:
            target.line(target.palette.bad, x, y, n.x, n.y, 0.8)
        else:
            stopped, end_x, end_y = ray_tiles(tiles, world, x, y, n.x, n.y)
            if stopped:
                target.line(target.palette.faint, x, y, end_x, end_y)
                target.disc(target.palette.faint, end_x, end_y, 1.5)


def _draw_thinkers(target: DrawTarget, world: World) -> None:
    """A ring around each thinker, a strong one with a dot for the next; lines in the order of turns."""
    row = list(thinkers(world))
    for number, o in enumerate(row):
        if is_near(o.x, o.y):
            ink, width = (target.palette.switch, 0.8) if number else (target.palette.accent, 2.0)
            target.disc(ink, o.x, o.y, _THINKER, width)
    for one, other in pairwise(row[:2]):
        target.disc(target.palette.accent, one.x, one.y, 2.0)
        target.line(target.palette.accent, one.x, one.y, other.x, other.y, 0.8)


def thinkers(world: World) -> Iterator[Object]:
    """The thinkers, one every fourth tick; the next one first (objects.md §2.4)."""
    slot = world.think_cursor
    for _ in range(world.slots_used if slot else 0):
        yield world.objects[slot]
        slot = world.objects[slot].ring_next
        if slot == world.think_cursor:
            return


def _looks(o: Object) -> bool:
    return o.kind in {TURRET, LAUNCHER} or (o.kind == DRONE and o.weapon != WEAPON_ZAP)


def _draw_shape(target: DrawTarget, shape: HitShape) -> None:
    canvas, palette, half = target.canvas, target.palette, shape.half
    colour = palette.good if shape.ninja else palette.bad if shape.lethal else palette.switch
    if shape.ninja:
        target.line(colour, shape.x, shape.y, shape.x + 6 * shape.vx, shape.y + 6 * shape.vy)
    if not (-50 < shape.x < 850 and -50 < shape.y < 650):
        return
    if shape.round:
        centre = canvas.point(shape.x, shape.y)
        radius = max(1, round(half * canvas.scale))
        rect = pygame.draw.aacircle(target.surface, colour, centre, radius, 1)
    else:
        rect = canvas.frame_rect(target.surface, colour, shape.x - half, shape.y - half, 2 * half, 2 * half, 0.5)
    target.covered.append(rect.inflate(2, 2))


def hit_shapes(world: World) -> Iterator[HitShape]:
    """The shapes of all objects in the grid, which can be touched; the ninja's last."""
    for slot in range(1, world.slots_used):
        o = world.objects[slot]
        if o.in_grid or (o.kind == SWITCH and not world.objects[o.partner].is_open):
            kind, half = KIND_OF[o.kind], _half(o)
            if half is not None:
                # Drones with a weapon do not hurt by touch.
                deadly = kind.by_touch and (o.kind != DRONE or o.weapon == WEAPON_ZAP)
                yield HitShape(o.x, o.y, max(half, _MIN_SIZE), kind.disc is not None, deadly)
    n = world.ninja
    yield HitShape(n.x, n.y, rules.RADIUS, not n.box, ninja=True, vx=n.x - n.prev_x, vy=n.y - n.prev_y)


def _half(o: Object) -> float | None:
    if o.kind == DOOR and o.mechanism != AUTOMATIC:
        return rules.DOOR_SWITCH_RADIUS
    kind = KIND_OF[o.kind]
    return kind.box if kind.disc is None else kind.disc
