"""The figure about rays: which cells a ray visits, what stops it, what it sees, what a loose grid misses."""

from __future__ import annotations

from collections.abc import Sequence
from math import dist

from ninja_game.play.lab.figure import Control, Figure, Sheet, room_world, values_of, watch
from ninja_game.sim.collision.rays import cast, ray_circle, ray_tiles, sees
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, EXISTS
from ninja_game.sim.grid import cell_at
from ninja_game.sim.rules import GOLD_RADIUS, RADIUS
from ninja_game.ui.canvas import Point

NINJA: Point = (292.0, 172.0)


class RayCast(Figure):
    """Drag both ends of a ray."""

    name = "rays"
    start = (330.0, 190.0)
    moves = "end"

    def reset(self) -> None:
        super().reset()
        self.from_x, self.from_y = 60.0, 70.0
        self.tiles, self.world = room_world(self.room, self.objects)
        self.world.ninja.x, self.world.ninja.y = NINJA

    def controls(self) -> Sequence[Control]:
        return [self.choice("Arrows move", (("the end", "end"), ("the start", "start")), "moves")]

    def press(self, x: float, y: float) -> None:
        self.moves = "start" if dist((x, y), (self.from_x, self.from_y)) < dist((x, y), (self.x, self.y)) else "end"
        self.drag(x, y)

    def drag(self, x: float, y: float) -> None:
        kept = self.x, self.y
        super().drag(x, y)
        if self.moves == "start":
            self.from_x, self.from_y = self.x, self.y
            self.x, self.y = kept

    def nudge(self, dx: int, dy: int) -> None:
        x, y = (self.from_x, self.from_y) if self.moves == "start" else (self.x, self.y)
        self.drag(x + dx, y + dy)

    def demonstrate(self, tick: int) -> None:
        self.moves = "end"
        super().demonstrate(tick)

    @property
    def direction(self) -> Point:
        """Where the ray points: a vector of length 1."""
        length = dist((self.from_x, self.from_y), (self.x, self.y)) or 1.0
        return (self.x - self.from_x) / length, (self.y - self.from_y) / length

    @property
    def visited(self) -> list[int]:
        """The cells of the ray, in the order in which the world's own function visits them."""
        cells = values_of("cell", cast, self.tiles, self.world, self.from_x, self.from_y, *self.direction)
        return [cell for cell in cells if EXISTS[cell]]

    def asked(self) -> tuple[list[int], bool, Point]:
        """The cells whose shapes were asked, whether something stopped the ray, and where, px."""
        ray = self.from_x, self.from_y, self.x, self.y
        (stopped, x, y), calls = watch(ray_tiles, self.tiles, self.world, *ray)
        cells = [cell_at(call.arguments["cx"], call.arguments["cy"]) for call in calls if call.name == "ray_tile"]
        tiles = self.tiles.tiles
        return [cell for cell in cells if tiles[cell]], bool(stopped), (x, y)

    def met(self) -> tuple[list[int], list[int]]:
        """The slots of the gold that the ray really meets before it stops: in cells that it visits, and in others."""
        cells, (_, stopped, end) = set(self.visited), self.asked()
        reach = dist((self.from_x, self.from_y), end) if stopped else 1e9
        found: tuple[list[int], list[int]] = ([], [])
        for slot in range(1, self.world.id_count + 1):
            o = self.world.objects[slot]
            hit, x, y = ray_circle(self.from_x, self.from_y, *self.direction, o.x, o.y, GOLD_RADIUS)
            if hit and dist((self.from_x, self.from_y), (x, y)) <= reach:
                found[o.cell not in cells].append(slot)
        return found

    def numbers(self) -> list[tuple[str, str]]:
        asked, stopped, (x, y) = self.asked()
        ray = self.from_x, self.from_y, self.x, self.y
        inside, missed = self.met()
        return [
            ("cells visited", str(len(self.visited))),
            ("shapes asked", str(len(asked))),
            ("stopped at", f"{x:.1f}, {y:.1f} px" if stopped else "nothing: it leaves the grid"),
            ("sees the ninja", "yes" if sees(self.tiles, self.world, *ray)[0] else "no"),
            ("gold met in those cells", str(len(inside))),
            ("gold met but missed", f"{len(missed)}: a loose grid files it elsewhere"),
        ]

    def draw(self, sheet: Sheet) -> None:
        p = sheet.palette
        asked, stopped, end = self.asked()
        for number, cell in enumerate(self.visited, 1):
            sheet.shade(cell, p.accent if cell in asked else p.good, 80)
            sheet.text(str(number), CENTRE_X[cell] - 8, CENTRE_Y[cell] - 8, size=8, colour=p.faint)
        sheet.tiles(self.tiles)
        sheet.grid()
        sheet.edges(self.world, self.visited)
        inside, missed = self.met()
        for slot in range(1, self.world.id_count + 1):
            o = self.world.objects[slot]
            if o.x or o.y:
                sheet.circle(p.gold, o.x, o.y, GOLD_RADIUS, 0 if slot in inside + missed else 1.5)
                if slot in missed:
                    sheet.text("missed", o.x, o.y - 11, size=8, colour=p.bad)
        n = self.world.ninja
        sheet.circle(p.ninja, n.x, n.y, RADIUS, 2)
        start = self.from_x, self.from_y
        sheet.arrow(p.bad, start, end if stopped else (self.x, self.y), 2)
        sheet.circle(p.bad, *start, 3)
        sheet.circle(p.bad, self.x, self.y, 4, 1.5)
