"""A grey picture, drawn by a kernel, without a window, colours or decoration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import ceil, sqrt
from typing import Any, ClassVar, NamedTuple

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from ninja_game.backend.worlds import InitialObject
from ninja_game.errors import ArgumentError
from ninja_game.learn.observations.objects import OBSERVED, activity_of, is_there
from ninja_game.learn.observations.part import Array, Lookup, Part, PartContext, clamp, copy_values
from ninja_game.learn.observations.surroundings import cached_by_tiles, solidity
from ninja_game.sim import kinds
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, UNIT_X, UNIT_Y
from ninja_game.sim.rules import GRID_COLUMNS, GRID_ROWS, HALF, RADIUS, WORLD_HEIGHT, WORLD_WIDTH
from ninja_game.sim.schema.declare import fast, kernel
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.sim.states import DRONE_FIRING, WEAPON_LASER
from ninja_game.sim.traces import contact_place_of

_FAR = 2.0 * WORLD_WIDTH  # px; farther objects are not drawn
# px
DOOR_HALF = 4.0
BEAM_RADIUS = 2.0
CROSS_RADIUS = 4.0
EVERYWHERE = (-_FAR, _FAR, -_FAR, _FAR)
ROUNDING = 1.0e-6  # px by which rounding may move the border of an object


class Frame(NamedTuple):
    """The part of a picture to draw: columns ``first`` to ``last``, rows ``low`` to ``high``.

    ``width``: pixels per row; ``left``, ``top``: the picture's corner, px of the level; ``pixel_x``, ``pixel_y``: size
    of a pixel, px of the level; ``rounded``: whether shades are rounded.
    """

    width: int
    left: float
    top: float
    pixel_x: float
    pixel_y: float
    first: int
    last: int
    low: int
    high: int
    rounded: int


class PixelView(NamedTuple):
    """Size of pictures. ``frame``: the whole picture; ``across``, ``down``: pixels of tiles, with margins."""

    frame: Frame
    across: int
    down: int
    follows: int  #: whether the picture moves with the ninja
    ninja_shade: float  #: the ninja's grey


class DrawnObject(NamedTuple):
    """An object by its slot. ``size``: radius or half side, px; ``moves``: 1 if it moves; ``x``, ``y``: first place."""

    slot: int
    size: float
    box: int  #: 1: a square, 0: a disc
    shade: float  #: the grey, 0 to 255; normalised: 0 to 1
    moves: int
    x: float
    y: float


class Layers(NamedTuple):
    """Pictures without moving objects. ``changed`` (worlds): the picture must be redrawn; ``pictures``: one per world.

    ``later``: the last object drawn in each cell of each level; ``movers``, in ``bounds``: numbers of moving objects.
    """

    changed: Any
    pictures: Any
    later: Any
    bounds: Any
    movers: Any


@fast
def pixels_of(area: Any, frame: Frame) -> tuple[int, int, int, int]:
    """First and last column and row of a frame that an area, px from its corner, may cover.

    A pixel is covered if its middle is less than half a pixel (of its longer side) away.
    """
    left, right, top, bottom = area
    reach = 0.5 * max(frame.pixel_x, frame.pixel_y) + ROUNDING
    reach_x = min(reach, frame.pixel_x)
    reach_y = min(reach, frame.pixel_y)
    return (
        int(clamp((left - reach_x) / frame.pixel_x + 0.5, float(frame.first), frame.last + 1.0)),
        int(clamp((right + reach_x) / frame.pixel_x + 0.5, float(frame.first), frame.last + 1.0)) - 1,
        int(clamp((top - reach_y) / frame.pixel_y + 0.5, float(frame.low), frame.high + 1.0)),
        int(clamp((bottom + reach_y) / frame.pixel_y + 0.5, float(frame.low), frame.high + 1.0)) - 1,
    )


@fast
def paint(
    picture: Any, frame: Frame, x: float, y: float, half_x: float, half_y: float, disc: bool, shade: float
) -> None:
    """Paint a disc or box around (x, y), px of the level; its border gets a share of the shade."""
    pixel_x = frame.pixel_x
    pixel_y = frame.pixel_y
    x -= frame.left
    y -= frame.top
    if not (-_FAR < x < _FAR and -_FAR < y < _FAR):
        return
    first, last, low, high = pixels_of((x - half_x, x + half_x, y - half_y, y + half_y), frame)
    for row in range(low, high + 1):
        dy = abs((row + 0.5) * pixel_y - y)
        for column in range(first, last + 1):
            dx = abs((column + 0.5) * pixel_x - x)
            if disc:
                coverage = clamp(2.0 * (half_x - sqrt(dx * dx + dy * dy)) / (pixel_x + pixel_y) + 0.5, 0.0, 1.0)
            else:
                coverage = clamp((half_x - dx) / pixel_x + 0.5, 0.0, 1.0)
                coverage = coverage * clamp((half_y - dy) / pixel_y + 0.5, 0.0, 1.0)
            at = row * frame.width + column
            value = float(picture[at])
            value = value + (shade - value) * coverage
            picture[at] = float(int(value + 0.5)) if frame.rounded else value


@fast
def door_line_middle(o: Object) -> tuple[float, float]:
    """The middle of a door's line, px."""
    cell = o.edge_1 // 4
    side = o.edge_1 % 4
    return CENTRE_X[cell] + HALF * UNIT_X[side], CENTRE_Y[cell] + HALF * UNIT_Y[side]


@fast
def draw_object(o: Object, picture: Any, frame: Frame, size: float, box: bool, shade: float) -> None:
    """Paint an object that exists: the part that can be touched, a closed door's line, a beam, a crosshair."""
    if o.kind == kinds.DOOR:
        if o.edge_1 and activity_of(o) == 1.0:
            x, y = door_line_middle(o)
            upright = UNIT_X[o.edge_1 % 4] != 0.0
            half_x = DOOR_HALF if upright else HALF
            half_y = HALF if upright else DOOR_HALF
            paint(picture, frame, x, y, half_x, half_y, False, shade)
        return
    x, y = contact_place_of(o)
    if o.kind == kinds.EXIT and not o.is_open:
        shade = 0.5 * shade
    paint(picture, frame, x, y, size, size, not box, shade)
    if o.kind == kinds.TURRET and o.updating:
        paint(picture, frame, o.aim_x, o.aim_y, CROSS_RADIUS, CROSS_RADIUS, True, shade)
    if o.kind == kinds.DRONE and o.weapon == WEAPON_LASER and o.routine == DRONE_FIRING:
        dx = o.end_x - x
        dy = o.end_y - y
        length = sqrt(dx * dx + dy * dy)
        if length < _FAR:
            for step in range(int(length / BEAM_RADIUS)):
                part = step * BEAM_RADIUS / length
                paint(picture, frame, x + part * dx, y + part * dy, BEAM_RADIUS, BEAM_RADIUS, True, shade)


MAX_SIDE = 512
MIN_VIEW, MAX_VIEW = 48.0, WORLD_WIDTH
_SAMPLES = 4  # sampled points across a pixel of the tiles

NINJA_SHADE, SOLID_SHADE = 255, 100
SHADES = {
    kinds.GOLD: 190, kinds.BOUNCE_BLOCK: 130, kinds.LAUNCH_PAD: 145, kinds.TURRET: 205, kinds.FLOOR_GUARD: 220,
    kinds.DRONE: 225, kinds.ONE_WAY: 120, kinds.THWUMP: 215, kinds.DOOR: 160, kinds.LAUNCHER: 230, kinds.EXIT: 240,
    kinds.MINE: 210, kinds.SWITCH: 175,
}  # fmt: skip
"""0 is empty, 255 the ninja; 205 to 230 kill. A closed exit has half its shade."""
_STILL = {kinds.GOLD, kinds.MINE, kinds.EXIT, kinds.SWITCH, kinds.LAUNCH_PAD, kinds.ONE_WAY}
"""Kinds that never move, and change their looks only after an event (``PartContext.changed``)."""
PLAIN_SIZE = 6.0  # drawn radius, px, of objects that cannot be touched


@dataclass(frozen=True)
class Pixels(Part):
    """A picture in shades of grey, uint8 (``height``, ``width``); ``normalised=True``: float32, 0 to 1.

    ``view``: None: the whole level, scaled to that size; else the width of the picture in px of the level, with the
    ninja in the middle and the height by the picture's shape; outside the level all is solid. It shows tiles, closed
    doors, objects that exist (the part that can be touched), laser beams, crosshairs and the ninja.
    """

    name: ClassVar[str] = "pixels"

    width: int = 84
    height: int = 84
    view: float | None = None
    normalised: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        if not all(isinstance(side, int) and 1 <= side <= MAX_SIDE for side in (self.width, self.height)):
            raise ArgumentError(f"pixels are {self.width!r} x {self.height!r}; expected 1 to {MAX_SIDE} each")
        if self.view is not None and not MIN_VIEW <= self.view <= MAX_VIEW:
            raise ArgumentError(f"the view is {self.view!r} px; expected {MIN_VIEW:g} to {MAX_VIEW:g}, or None")

    @property
    def box(self) -> Box:
        shape = (self.height, self.width)
        return Box(0.0, 1.0, shape, np.float32) if self.normalised else Box(0, 255, shape, np.uint8)

    def tables(self, context: PartContext) -> tuple[Any, ...]:
        """Pictures of the tiles with a margin, and their size; the view; the objects with sizes and shades."""
        pixel_x = (self.view or WORLD_WIDTH) / self.width
        pixel_y = pixel_x if self.view else WORLD_HEIGHT / self.height
        across, down = ceil(WORLD_WIDTH / pixel_x - 1e-9), ceil(WORLD_HEIGHT / pixel_y - 1e-9)
        margins = [(side, side) if self.view else (0, 0) for side in (self.height, self.width)]
        factor = 1.0 / 255.0 if self.normalised else 1.0

        def picture(number: int) -> NDArray[np.float64]:
            tiles = cached_by_tiles(solid_points, context, number, across, down, pixel_x, pixel_y)
            return np.rint(np.pad(tiles, margins, constant_values=_SAMPLES**2) * (SOLID_SHADE / _SAMPLES**2)) * factor

        def drawn(o: InitialObject) -> DrawnObject:
            size, box = sizes[o.kind]
            return DrawnObject(o.slot, size, box, SHADES[o.kind] * factor, o.kind not in _STILL, o.x, o.y)

        def movers(number: int) -> list[int]:
            return [place for place, o in enumerate(context.objects(number, *SHADES)) if o.kind not in _STILL]

        def later(number: int) -> NDArray[np.int16]:
            grid = np.full((2 * GRID_ROWS, 2 * GRID_COLUMNS), -1, np.int16)
            for place, o in enumerate(context.objects(number, *SHADES)):
                reach = sizes[o.kind][0] + max(pixel_x, pixel_y) + 2.0 * ROUNDING
                left, right, top, bottom = cell_bounds((o.x - reach, o.x + reach, o.y - reach, o.y + reach))
                if o.kind in _STILL:
                    grid[top : bottom + 1, left : right + 1] = place
            return grid

        sizes = {kind.number: (kind.disc or kind.box or PLAIN_SIZE, kind.box is not None) for kind in OBSERVED}
        sizes[kinds.DOOR] = HALF, False
        layers = np.zeros((1, 1) if self.view else (context.count, self.length), self.box.dtype)
        right, bottom = self.width - 1, self.height - 1
        frame = Frame(self.width, 0.0, 0.0, pixel_x, pixel_y, 0, right, 0, bottom, int(not self.normalised))
        width, height = across + 2 * margins[1][0], down + 2 * margins[0][0]
        return (
            observe_pixels,
            context.values(picture, self.box.dtype),
            PixelView(frame, width, height, int(self.view is not None), NINJA_SHADE * factor),
            Layers(context.changed, layers, context.values(later, np.int16), *context.rows(movers, int)),
            *context.rows(lambda number: list(map(drawn, context.objects(number, *SHADES))), DrawnObject),
        )


@dataclass(frozen=True)
class Image(Pixels):
    """``Pixels`` with one channel, (``height``, ``width``, 1), the shape that convolutions expect."""

    name: ClassVar[str] = "image"

    @property
    def box(self) -> Box:
        flat = super().box
        return Box(flat.low[..., np.newaxis], flat.high[..., np.newaxis], dtype=flat.dtype.type)


def solid_points(
    context: PartContext, number: int, across: int, down: int, pixel_x: float, pixel_y: float
) -> NDArray[np.uint8]:
    """Count the solid points of each pixel (down, across); outside the world all is solid."""
    width, height = pixel_x / _SAMPLES, pixel_y / _SAMPLES
    points = solidity(context, number, across * _SAMPLES, down * _SAMPLES, (width, height))
    points[:, int(WORLD_WIDTH / width) :] = 1
    points[int(WORLD_HEIGHT / height) :] = 1
    return np.asarray(points.reshape(down, _SAMPLES, across, _SAMPLES).sum((1, 3)), np.uint8)


@kernel
def observe_pixels(
    maps: Sequence[TileMap], level_of: Array, worlds: Sequence[World], indices: Array, first: int, last: int,
    out: Array, offset: int, tiles: Lookup, view: PixelView, layers: Layers, bounds: Lookup, things: Lookup,
) -> None:  # fmt: skip
    """Draw the pictures of some worlds: the tiles, copied; the objects in the order of their slots; the ninja.

    Without a view, ``layers`` has the tiles and the objects that never move; they are redrawn after a change. Moving
    objects are drawn over them; where one may overlap an object that is drawn later, that area is drawn again in order.
    With a view, the picture moves by whole pixels.
    """
    whole = view.frame
    width = whole.width
    height = whole.high + 1
    pixel_x = whole.pixel_x
    pixel_y = whole.pixel_y
    for k in range(first, last):
        index = indices[k]
        level = level_of[index]
        w = worlds[index]
        start = bounds[2 * level]
        end = bounds[2 * level + 1]
        picture = out[index][offset:]
        if view.follows:
            column = int(clamp(w.ninja.x / pixel_x, 0.0, view.across - 2.0 * width)) + width - width // 2
            row = int(clamp(w.ninja.y / pixel_y, 0.0, view.down - 2.0 * height)) + height - height // 2
            column = min(column, view.across - width)
            row = min(row, view.down - height)
            corner = (level * view.down + row) * view.across + column
            left = (column - width) * pixel_x
            top = (row - height) * pixel_y
            frame = Frame(width, left, top, pixel_x, pixel_y, 0, whole.last, 0, whole.high, whole.rounded)
            for line in range(height):
                line_start = line * width
                source = corner + line * view.across
                copy_values(picture[line_start : line_start + width], tiles[source : source + width], width)
            draw_objects(w, picture, frame, things, start, end, EVERYWHERE, True)
        else:
            corner = level * view.down * view.across
            frame = whole
            layer = layers.pictures[index]
            if layers.changed[index]:
                copy_values(layer, tiles[corner : corner + width * height], width * height)
                draw_objects(w, layer, frame, things, start, end, EVERYWHERE, False)
            copy_values(picture[: width * height], layer, width * height)
            for turn in range(2):
                for place in range(layers.bounds[2 * level], layers.bounds[2 * level + 1]):
                    number = start + layers.movers[place]
                    o = w.objects[things[number].slot]
                    size = things[number].size
                    covered = is_covered(number - start, level, layers.later, area_of(o, size, 0.0))
                    if not covered and turn == 0:
                        draw_object(o, picture, frame, size, things[number].box == 1, things[number].shade)
                    elif covered and turn == 1:
                        redraw_under(o, size, w, picture, frame, tiles[corner:], things, start, end)
        paint(picture, frame, w.ninja.x, w.ninja.y, RADIUS, RADIUS, True, view.ninja_shade)


@fast
def redraw_under(
    o: Any, size: float, w: Any, picture: Any, frame: Any, tiles: Any, things: Any, start: int, end: int
) -> None:
    """Draw the area of an object again: its tiles, then all objects near it in order."""
    first_column, last_column, first_row, last_row = pixels_of(area_of(o, size, 0.0), frame)
    width = last_column + 1 - first_column
    for line in range(first_row, last_row + 1):
        line_start = line * frame.width + first_column
        line_end = line_start + width
        copy_values(picture[line_start:line_end], tiles[line_start:line_end], width)
    x, y = frame.pixel_x, frame.pixel_y
    part = Frame(frame.width, 0.0, 0.0, x, y, first_column, last_column, first_row, last_row, frame.rounded)
    near = area_of(o, size, max(x, y) + 2.0 * ROUNDING)
    draw_objects(w, picture, part, things, start, end, near, True)


@fast
def draw_objects(
    w: World, picture: Any, frame: Frame, things: Any, first: int, last: int, area: Any, moving: bool
) -> None:
    """Draw the objects that exist and may lie in an area, with or without ``moving`` ones."""
    left, right, top, bottom = area
    for number in range(first, last):
        moves = things[number].moves
        if moving or not moves:
            o = w.objects[things[number].slot]
            size = things[number].size
            x = things[number].x
            y = things[number].y
            here = area_of(o, size, 0.0) if moves else (x - size, x + size, y - size, y + size)
            overlaps = left < here[1] and here[0] < right and top < here[3] and here[2] < bottom
            if overlaps and is_there(w, o):
                draw_object(o, picture, frame, size, things[number].box == 1, things[number].shade)


@fast
def area_of(o: Object, size: float, gap: float) -> tuple[float, float, float, float]:
    """Left, right, top and bottom of a moving object's drawing, px, with a margin ``gap``."""
    x, y = door_line_middle(o) if o.kind == kinds.DOOR else contact_place_of(o)
    dx = 0.0
    dy = 0.0
    if o.kind == kinds.TURRET and o.updating:
        dx = o.aim_x - x
        dy = o.aim_y - y
    if o.kind == kinds.DRONE and o.weapon == WEAPON_LASER and o.routine == DRONE_FIRING:
        dx = o.end_x - x
        dy = o.end_y - y
    reach = size + gap
    return (
        x + clamp(dx, -_FAR, 0.0) - reach,
        x + clamp(dx, 0.0, _FAR) + reach,
        y + clamp(dy, -_FAR, 0.0) - reach,
        y + clamp(dy, 0.0, _FAR) + reach,
    )


@fast
def is_covered(place: int, level: int, later: Any, area: Any) -> bool:
    """Whether an object of the layer that is drawn later may lie in this object's area."""
    left, right, top, bottom = cell_bounds(area)
    for row in range(top, bottom + 1):
        for column in range(left, right + 1):
            if later[(level * 2 * GRID_ROWS + row) * 2 * GRID_COLUMNS + column] > place:
                return True
    return False


@fast
def cell_bounds(area: Any) -> tuple[int, int, int, int]:
    """First and last column and row of the cells that an area, px, touches."""
    left, right, top, bottom = area
    return (
        int(clamp(left / HALF, 0.0, 2.0 * GRID_COLUMNS - 1.0)),
        int(clamp(right / HALF, 0.0, 2.0 * GRID_COLUMNS - 1.0)),
        int(clamp(top / HALF, 0.0, 2.0 * GRID_ROWS - 1.0)),
        int(clamp(bottom / HALF, 0.0, 2.0 * GRID_ROWS - 1.0)),
    )
