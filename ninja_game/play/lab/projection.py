"""Figures about bodies: how a tile pushes a body out, the speed after that, and why a circle passes a ledge."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import cos, sin
from typing import NamedTuple

from ninja_game.backend.plain import restore_plain, save_plain
from ninja_game.editor.palette import tile_name
from ninja_game.formats.ascii.legend import TILE_CHARS
from ninja_game.formats.ascii.reader import room_level
from ninja_game.play.lab.cells import BODY_CHOICES
from ninja_game.play.lab.figure import ELSEWHERE, Call, Control, Figure, FigureSetting, Sheet, View, room_world, traced
from ninja_game.sim.collision.box import collide_box
from ninja_game.sim.collision.circle import collide_circle
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y
from ninja_game.sim.grid import Point, cell_index
from ninja_game.sim.level import BODIES as BODY_NAMES
from ninja_game.sim.rules import RADIUS
from ninja_game.sim.schema.world_fields import TileMap, World
from ninja_game.simulation import Simulation

_COLUMN, _ROW = 8, 5

PUSH_RULE = "push_from_tile"
STAGES = ("collide_circle", "collide_box", "collide_corner")
"""Functions that read edges; a push by one of them has not looked at a shape."""

SHAPE_TESTS = ("collide_own_tile", "collide_vertical", "collide_horizontal", "collide_diagonal", "collide_tile")


class Push(NamedTuple):
    """The pushes of a body out of tiles. ``points``: its positions before, between and after them, px."""

    points: list[Point]
    calls: list[Call]

    @property
    def rules_run(self) -> list[str]:
        """The rules that ran for a shape, outermost first; for a death only the event."""
        calls = (call for call in self.calls if call.depth and call.caller not in ("kill", "emit_death", "emit"))
        return [call.name for call in calls if call.name not in (PUSH_RULE, "note_normal", "cell_at")]

    @property
    def edge_pushes(self) -> int:
        return sum(call.name in (PUSH_RULE, "push_from_corner") and call.caller in STAGES for call in self.calls)

    @property
    def shape_tests(self) -> int:
        return sum(call.name in SHAPE_TESTS and call.caller in STAGES for call in self.calls)


def pushed(tiles: TileMap, w: World, x: float, y: float, *, box: bool = False) -> Push:
    """Collide a body at (x, y) with a world; the world is restored."""
    before = save_plain(w)
    n = w.ninja
    n.x = n.prev_x = x
    n.y = n.prev_y = y
    n.box = int(box)
    _, calls = traced(collide_box if box else collide_circle, tiles, w)
    restore_plain(w, before)
    points = [(x, y)]
    for call in calls:
        if call.name == PUSH_RULE:
            points.append((points[-1][0] + call.arguments["qx"], points[-1][1] + call.arguments["qy"]))
    return Push(points, calls)


class Projection(Figure):
    """Drag the body into a tile: which rule pushes it, in which direction, how far."""

    name = "projection"
    view = View(24 * (_COLUMN - 2), 24 * (_ROW - 1), 4.5)
    start = (24 * _COLUMN + 6.0, 24 * _ROW - 2.0)
    tile = FigureSetting(2, "rebuild")
    box = False

    def reset(self) -> None:
        super().reset()
        self.edge_pushes = self.shape_tests = 0
        self.rebuild()

    def rebuild(self) -> None:
        rows = [["."] * 14 for _ in range(9)]
        rows[_ROW - 1][_COLUMN - 1] = TILE_CHARS[self.tile]
        self.tiles, self.world = room_world(["".join(row) for row in rows])

    def controls(self) -> Sequence[Control]:
        return [
            self.slider("Tile", (1, 33, 1), "tile", lambda number: f"{number:.0f} of 33"),
            self.choice("Body", BODY_CHOICES, "box"),
        ]

    def demonstrate(self, tick: int) -> None:
        """Move around the tile; take another tile every six seconds."""
        if tick % 240 == 0:
            self.tile = 1 + (4 * (tick // 240) + 1) % 33
        super().demonstrate(tick)

    def push(self) -> Push:
        return pushed(self.tiles, self.world, self.x, self.y, box=self.box)

    def tick(self) -> None:
        push = self.push()
        self.edge_pushes += push.edge_pushes
        self.shape_tests += push.shape_tests

    def numbers(self) -> list[tuple[str, str]]:
        push = self.push()
        (x, y), (to_x, to_y) = push.points[0], push.points[-1]
        pushes = [call.arguments for call in push.calls if call.name == PUSH_RULE]
        normals = ", ".join(f"({contact['mx']:.2f}, {contact['my']:.2f})" for contact in pushes)
        return [
            ("pair", f"{tile_name(self.tile)} with {'box' if self.box else 'circle'}"),
            ("rules that ran", " > ".join(push.rules_run[:2]) or "none: every edge is off"),
            ("", " > ".join(push.rules_run[2:])),
            ("pushes", f"{len(pushes)}, in all ({to_x - x:+.2f}, {to_y - y:+.2f}) px"),
            ("normals", normals or "none"),
            ("here", f"by edge alone {push.edge_pushes}, shape tests {push.shape_tests}"),
            ("since the reset", f"by edge alone {self.edge_pushes}, shape tests {self.shape_tests}"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        sheet.tiles(self.tiles)
        sheet.grid()
        sheet.edges(self.world)
        push = self.push()
        for call in push.calls:
            for a, b in candidates(call):
                sheet.arrow(palette.faint, (self.x, self.y), (self.x + a, self.y + b), 2)
        x, y = push.points[-1]
        sheet.body(palette.faint, self.x, self.y, RADIUS, box=self.box, width=1.5)
        sheet.body(palette.good if len(push.points) > 1 else palette.ninja, x, y, RADIUS, box=self.box, width=3)
        for start, end in pairwise(push.points):
            sheet.arrow(palette.accent, start, end, 3)
        cell = cell_index(_COLUMN, _ROW)
        sheet.circle(palette.faint, CENTRE_X[cell], CENTRE_Y[cell], 0.6)


class Response(Projection):
    """Drag the tip of the velocity: a body moves by it into a tile; the velocity and the contact after that."""

    name = "response"
    view = View(24 * (_COLUMN - 2), 24 * (_ROW - 1) - 12, 4.5)
    start = (24 * _COLUMN + 6.0, 24 * _ROW - 5.0)
    origin: Point = (24 * _COLUMN - 12.0, 24 * _ROW - 16.0)

    def demonstrate(self, tick: int) -> None:
        super().demonstrate(tick)
        self.drag(self.start[0] + 12 * sin(tick / 20), self.start[1] - 5 * cos(tick / 20))

    @property
    def contacts(self) -> list[str]:
        """The meaning of each contact normal for the rules, in the order of the pushes."""
        normals = [call.arguments for call in self.push().calls if call.name == "note_normal"]
        return ["wall" if push["my"] == 0.0 else "floor" if push["my"] < 0.0 else "a push only" for push in normals]

    def numbers(self) -> list[tuple[str, str]]:
        push, (x, y) = self.push(), self.origin
        to_x, to_y = push.points[-1]
        crushed = any(call.name == "kill" for call in push.calls)
        return [
            ("speed before", f"({self.x - x:+.2f}, {self.y - y:+.2f}) px/tick"),
            ("pushes, in all", f"{len(push.points) - 1}, ({to_x - self.x:+.2f}, {to_y - self.y:+.2f}) px"),
            ("speed after", f"({to_x - x:+.2f}, {to_y - y:+.2f}) px/tick"),
            ("contacts", "crushed: a push of over 8.9 px" if crushed else ", ".join(self.contacts) or "none"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette, push = sheet.palette, self.push()
        sheet.tiles(self.tiles)
        sheet.grid()
        for colour, place in (
            (palette.faint, self.origin),
            (palette.faint, (self.x, self.y)),
            (palette.good, push.points[-1]),
        ):
            sheet.body(colour, *place, RADIUS, box=self.box)
        sheet.arrow(palette.ninja, self.origin, (self.x, self.y), 3)
        for start, end in pairwise(push.points):
            sheet.arrow(palette.accent, start, end, 3)
        sheet.arrow(palette.good, self.origin, push.points[-1], 3)


class Bodies(Figure):
    """A circle and a box fly at the same ledge. ``paths``: the centres of both after each tick, px."""

    name = "bodies"
    view = View(72, 72, 3)
    start = (120.0, 132.0)
    ledge = 144.0
    ticks, speed = 20, 4.0

    def reset(self) -> None:
        super().reset()
        level = room_level(self.room, [ELSEWHERE])
        self.runs = [Simulation(level, body=body) for body in BODY_NAMES]
        self.saved = [run.save() for run in self.runs]
        self.fly()

    def drag(self, x: float, y: float) -> None:
        super().drag(min(x, self.start[0] + 30), y)
        self.fly()

    def fly(self) -> None:
        self.paths: list[list[Point]] = []
        for run, state in zip(self.runs, self.saved, strict=True):
            run.restore(state)
            n = run.world.ninja
            n.x, n.y, n.prev_x, n.prev_y = self.x, self.y, self.x - self.speed, self.y
            path = [(n.x, n.y)]
            for _ in range(self.ticks):
                run.step(right=True)
                path.append((n.x, n.y))
            self.paths.append(path)

    def numbers(self) -> list[tuple[str, str]]:
        ends = [path[-1] for path in self.paths]
        rows = [
            (name, f"{'over the ledge' if y < self.ledge else 'stopped'}, at {x:.1f}, {y:.1f} px")
            for name, (x, y) in zip(BODY_NAMES, ends, strict=True)
        ]
        height = self.y + RADIUS - self.ledge
        return [
            ("its lower end at first", f"{abs(height):.1f} px {'below' if height > 0 else 'above'} the ledge"),
            *rows,
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        sheet.tiles(self.runs[0].tiles)
        sheet.grid()
        for box, (path, colour) in enumerate(zip(self.paths, (palette.good, palette.bad), strict=True)):
            for start, end in pairwise(path):
                sheet.line(colour, start, end, 2)
            sheet.body(colour, *path[-1], RADIUS, box=bool(box), width=3)
        sheet.body(palette.ninja, self.x, self.y, RADIUS, box=False, width=1.5)


def candidates(call: Call) -> list[Point]:
    """The possible directions out, along an axis of the grid, that a test of a shape was given, px."""
    arguments = call.arguments
    if call.name == "collide_vertical":
        return [(0.0, arguments["oy"] * arguments["hy"])]
    if call.name == "collide_horizontal":
        return [(arguments["ox"] * arguments["hx"], 0.0)]
    if call.name == "collide_tile":
        return [(arguments["a"], arguments["b"])]
    return []
