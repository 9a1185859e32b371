"""The figure about projection: how a tile pushes a body out."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from ninja_game.editor.brush import tile_name
from ninja_game.formats.ascii.legend import TILE_CHARS
from ninja_game.play.lab.figure import Call, Control, Figure, FigureSetting, Sheet, View, room_world, watch
from ninja_game.play.lab.figures.cells import BODIES
from ninja_game.sim.collision.box import collide_box
from ninja_game.sim.collision.circle import collide_circle
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.grid import cell_index
from ninja_game.sim.memory.plain import restore_plain, save_plain
from ninja_game.sim.rules import RADIUS
from ninja_game.ui.canvas import Point

COLUMN, ROW = 8, 5
"""The cell that holds the tile."""

PUSH = "push_from_tile"
STAGES = ("collide_circle", "collide_box", "collide_corner")
"""Functions that read edges; a push out of one of them has looked at no shape."""

SHAPE_TESTS = ("collide_own_tile", "collide_vertical", "collide_horizontal", "collide_diagonal", "collide_tile")


class Push(NamedTuple):
    """What happened to a body. ``points``: where it was before, between and after its pushes, px."""

    points: list[Point]
    calls: list[Call]

    @property
    def ran(self) -> list[str]:
        """The rules that ran for a shape, outermost first; of a death no more than that it came."""
        calls = (call for call in self.calls if call.depth and call.caller not in ("kill", "emit_death", "emit"))
        return [call.name for call in calls if call.name not in (PUSH, "note_normal", "cell_at")]

    @property
    def by_edge(self) -> int:
        """Pushes by an edge alone."""
        return sum(call.name in (PUSH, "push_from_corner") and call.caller in STAGES for call in self.calls)

    @property
    def shape_tests(self) -> int:
        """Tests against a tile's shape."""
        return sum(call.name in SHAPE_TESTS and call.caller in STAGES for call in self.calls)


class Projection(Figure):
    """Drag the body into a tile: what pushes it, which way, how far."""

    name = "projection"
    view = View(24 * (COLUMN - 2), 24 * (ROW - 1), 4.5)
    start = (24 * COLUMN + 6.0, 24 * ROW - 2.0)
    tile = FigureSetting(2, "rebuild")
    box = False

    def reset(self) -> None:
        super().reset()
        self.by_edge = self.shape_tests = 0
        self.rebuild()

    def rebuild(self) -> None:
        rows = [["."] * 14 for _ in range(9)]
        rows[ROW - 1][COLUMN - 1] = TILE_CHARS[self.tile]
        self.tiles, self.world = room_world(["".join(row) for row in rows])

    def controls(self) -> Sequence[Control]:
        return [
            self.slider("Tile", (1, 33, 1), "tile", lambda number: tile_name(int(number))),
            self.choice("Body", BODIES, "box"),
        ]

    def demonstrate(self, tick: int) -> None:
        """Round the tile; another one every six seconds."""
        if tick % 240 == 0:
            self.tile = 1 + tick // 240 * 4 % 33
        super().demonstrate(tick)

    def push(self) -> Push:
        """Collide the body with the world, which stays as it is."""
        w = self.world
        before = save_plain(w)
        n = w.ninja
        n.x = n.prev_x = self.x
        n.y = n.prev_y = self.y
        n.box = int(self.box)
        _, calls = watch(collide_box if self.box else collide_circle, self.tiles, w)
        restore_plain(w, before)
        points = [(self.x, self.y)]
        for call in calls:
            if call.name == PUSH:
                points.append((points[-1][0] + call.arguments["qx"], points[-1][1] + call.arguments["qy"]))
        return Push(points, calls)

    def tick(self) -> None:
        """Count what this place costs."""
        push = self.push()
        self.by_edge += push.by_edge
        self.shape_tests += push.shape_tests

    def numbers(self) -> list[tuple[str, str]]:
        push = self.push()
        (x, y), (to_x, to_y) = push.points[0], push.points[-1]
        pushes = [call.arguments for call in push.calls if call.name == PUSH]
        normals = ", ".join(f"({each['mx']:.2f}, {each['my']:.2f})" for each in pushes)
        return [
            ("pair", f"{tile_name(self.tile)} with {'box' if self.box else 'circle'}"),
            ("rules that ran", " > ".join(push.ran[:2]) or "none: every edge is off"),
            ("", " > ".join(push.ran[2:])),
            ("pushes", f"{len(pushes)}, in all ({to_x - x:+.2f}, {to_y - y:+.2f}) px"),
            ("normals", normals or "none"),
            ("here", f"by edge alone {push.by_edge}, shape tests {push.shape_tests}"),
            ("since the reset", f"by edge alone {self.by_edge}, shape tests {self.shape_tests}"),
        ]

    def draw(self, sheet: Sheet) -> None:
        """The tile, the body before and after, candidates, pushes."""
        p = sheet.palette
        sheet.tiles(self.tiles)
        sheet.grid()
        sheet.edges(self.world)
        push = self.push()
        for call in push.calls:
            for a, b in candidates(call):
                sheet.arrow(p.faint, (self.x, self.y), (self.x + a, self.y + b), 2)
        x, y = push.points[-1]
        sheet.body(p.faint, self.x, self.y, RADIUS, box=self.box, width=1.5)
        sheet.body(p.good if len(push.points) > 1 else p.ninja, x, y, RADIUS, box=self.box, width=3)
        for start, end in pairwise(push.points):
            sheet.arrow(p.accent, start, end, 3)
        cell = cell_index(COLUMN, ROW)
        sheet.circle(p.faint, CENTRE_X[cell], CENTRE_Y[cell], 0.6)


def candidates(call: Call) -> list[Point]:
    """The ways out that a test of a shape was given, px: along an axis of the grid."""
    given = call.arguments
    if call.name == "collide_vertical":
        return [(0.0, given["oy"] * given["hy"])]
    if call.name == "collide_horizontal":
        return [(given["ox"] * given["hx"], 0.0)]
    if call.name == "collide_tile":
        return [(given["a"], given["b"])]
    return []
