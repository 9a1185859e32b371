"""Discs, boxes and objects painted into a picture of grey pixels, with soft rims.

A picture is row ``index`` of ``out`` from column ``offset`` on. A *frame* says where its pixels lie: (width, height,
left, top, pixel_x, pixel_y), its size in pixels, its corner and the size of a pixel in px of the level.
"""

from __future__ import annotations

from math import sqrt
from typing import Any

from ninja_game.learn.observations.object_facts import moment_of, place_of
from ninja_game.learn.observations.part import clamp
from ninja_game.sim import kinds
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, UNIT_X, UNIT_Y
from ninja_game.sim.memory.declare import fast
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.rules import HALF, WORLD_WIDTH
from ninja_game.sim.states import DRONE_FIRING, WEAPON_LASER

FAR = 2.0 * WORLD_WIDTH
"""px; nothing farther from a picture is drawn."""
DOOR_HALF, BEAM_RADIUS, CROSS_RADIUS = 4.0, 2.0, 4.0
"""px."""


@fast
def paint(
    out: Any, index: int, offset: int, frame: Any, x: float, y: float, half_x: float, half_y: float, disc: bool,
    shade: float, whole: int,
) -> None:  # fmt: skip
    """Paint a disc or a box about (x, y), px of the level; its rim gets a share of the shade. ``whole``: rounded."""
    width, height, left, top, pixel_x, pixel_y = frame
    x -= left
    y -= top
    if not (-FAR < x < FAR and -FAR < y < FAR):
        return
    first = int(clamp((x - half_x) / pixel_x - 0.5, 0.0, width - 1.0))
    last = int(clamp((x + half_x) / pixel_x + 0.5, -1.0, width - 1.0))
    low = int(clamp((y - half_y) / pixel_y - 0.5, 0.0, height - 1.0))
    high = int(clamp((y + half_y) / pixel_y + 0.5, -1.0, height - 1.0))
    for row in range(low, high + 1):
        dy = abs((row + 0.5) * pixel_y - y)
        for column in range(first, last + 1):
            dx = abs((column + 0.5) * pixel_x - x)
            if disc:
                coverage = clamp(2.0 * (half_x - sqrt(dx * dx + dy * dy)) / (pixel_x + pixel_y) + 0.5, 0.0, 1.0)
            else:
                coverage = clamp((half_x - dx) / pixel_x + 0.5, 0.0, 1.0)
                coverage = coverage * clamp((half_y - dy) / pixel_y + 0.5, 0.0, 1.0)
            at = offset + row * width + column
            value = float(out[index, at])
            value = value + (shade - value) * coverage
            out[index, at] = float(int(value + 0.5)) if whole else value


@fast
def draw_object(
    o: Object, out: Any, index: int, offset: int, frame: Any, size: float, box: bool, shade: float, whole: int
) -> None:
    """Paint an object that is there: what one touches of it, a closed door's line, a beam, a crosshair."""
    if o.kind == kinds.DOOR:
        if o.edge_1 and moment_of(o) == 1.0:
            cell = o.edge_1 // 4
            side = o.edge_1 % 4
            x = CENTRE_X[cell] + HALF * UNIT_X[side]
            y = CENTRE_Y[cell] + HALF * UNIT_Y[side]
            upright = UNIT_X[side] != 0.0
            half_x = DOOR_HALF if upright else HALF
            half_y = HALF if upright else DOOR_HALF
            paint(out, index, offset, frame, x, y, half_x, half_y, False, shade, whole)
        return
    x, y = place_of(o)
    if o.kind == kinds.EXIT and not o.is_open:
        shade = 0.5 * shade
    paint(out, index, offset, frame, x, y, size, size, not box, shade, whole)
    if o.kind == kinds.TURRET and o.updating:
        paint(out, index, offset, frame, o.aim_x, o.aim_y, CROSS_RADIUS, CROSS_RADIUS, True, shade, whole)
    if o.kind == kinds.DRONE and o.weapon == WEAPON_LASER and o.routine == DRONE_FIRING:
        dx = o.end_x - x
        dy = o.end_y - y
        length = sqrt(dx * dx + dy * dy)
        if length < FAR:
            for step in range(int(length / BEAM_RADIUS)):
                part = step * BEAM_RADIUS / length
                paint(
                    out, index, offset, frame, x + part * dx, y + part * dy, BEAM_RADIUS, BEAM_RADIUS, True,
                    shade, whole,
                )  # fmt: skip
