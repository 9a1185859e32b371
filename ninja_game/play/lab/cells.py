"""Figures about cells: their numbers, the cells that a body touches, that the ninja asks, that a ray visits."""

from __future__ import annotations

from collections.abc import Sequence
from math import dist, floor

from ninja_game.backend.plain import restore_plain, save_plain
from ninja_game.play.lab.figure import CORNER, Control, Figure, Sheet, View, room_world, traced, values_of
from ninja_game.sim.collision.rays import cast_ray, ray_circle, ray_tiles, sees
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, COLUMN, EXISTS, ROW
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.grid import Point, cell_at
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.objects.dispatch import NINE_CELLS, touch_objects
from ninja_game.sim.rules import CELL, GOLD_RADIUS, GRID_COLUMNS, GRID_ROWS, RADIUS, STRIDE
from ninja_game.view.overlays import hit_shapes, touched_cells

BODY_CHOICES: Sequence[tuple[str, object]] = (("circle", False), ("box", True))


class GridOfCells(Figure):
    """Drag a point: the division that gives its cell, and the numbers of the cells around it."""

    name = "grid"
    view = View(-CELL, -CELL, 1.5)
    start = (163.0, 88.0)

    def numbers(self) -> list[tuple[str, str]]:
        cell = self.cell
        return [
            ("point", f"{self.x:.1f}, {self.y:.1f} px"),
            ("column", f"floor({self.x:.1f} / {CELL:g}) = {floor(self.x / CELL)}"),
            ("row", f"floor({self.y:.1f} / {CELL:g}) = {floor(self.y / CELL)}"),
            ("number in the list", str(cell) if cell else "0: there is no cell"),
            ("right of it, below it", f"{cell} + 1 = {cell + 1}, {cell} + {STRIDE} = {cell + STRIDE}" if cell else "-"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette, own = sheet.palette, self.cell
        shade_border(sheet)
        sheet.grid()
        for cell in [own + offset for offset in NINE_CELLS if own and EXISTS[own + offset]]:
            sheet.shade(cell, palette.switch if cell != own else palette.good, 90)
            sheet.text(str(cell), CENTRE_X[cell], CENTRE_Y[cell] - 6, size=10)
        sheet.text("no cells", 7.5 * 24, -12)
        sheet.circle(palette.ninja, self.x, self.y, 2.5)


def shade_border(sheet: Sheet) -> None:
    """Shade the outermost cells, which are always solid."""
    for cell in range(len(EXISTS)):
        if EXISTS[cell] and (COLUMN[cell] in (0, GRID_COLUMNS - 1) or ROW[cell] in (0, GRID_ROWS - 1)):
            sheet.shade(cell, sheet.palette.tile, 150)
    sheet.text("border", 7.5 * 24, 12, colour=sheet.palette.on_tile)


class CellsTouched(Figure):
    """Drag a body: its own cell, the cells that it touches, their neighbours, the border."""

    name = "cells"
    start = (163.0, 112.0)
    box = False

    def controls(self) -> Sequence[Control]:
        return [self.choice("Body", BODY_CHOICES, "box")]

    def drag(self, x: float, y: float) -> None:
        super().drag(max(x, CELL + RADIUS), max(y, CELL + RADIUS))

    def numbers(self) -> list[tuple[str, str]]:
        cell, touched = self.cell, touched_cells(self.x, self.y, self.cell)
        names = [f"({COLUMN[number]}, {ROW[number]})" for number in touched]
        return [
            ("centre", f"{self.x:.1f}, {self.y:.1f} px"),
            ("current cell", f"column {COLUMN[cell]}, row {ROW[cell]}, index {cell}"),
            ("from its middle", f"{self.x - CENTRE_X[cell]:+.1f}, {self.y - CENTRE_Y[cell]:+.1f} px"),
            ("cells touched", f"{len(touched)}: {' '.join(names)}"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        shade_border(sheet)
        for offset in NINE_CELLS:
            sheet.shade(self.cell + offset, palette.switch, 40)
        for number, cell in enumerate(touched_cells(self.x, self.y, self.cell)):
            sheet.shade(cell, palette.accent if number else palette.good, 110)
        sheet.grid()
        sheet.body(palette.ninja, self.x, self.y, RADIUS, box=self.box)
        sheet.circle(palette.ninja, self.x, self.y, 1.5)


class NineCells(Figure):
    """Drag the ninja: the nine cells it asks, in their order, and which objects are notified."""

    name = "nine-cells"
    view = CORNER
    start = (155.0, 100.0)

    def reset(self) -> None:
        super().reset()
        self.tiles, self.world = room_world(self.room, self.objects)

    def objects_tested(self) -> tuple[list[int], list[str]]:
        """The slots of the notified objects, in order, and the events; the world is restored."""
        w = self.world
        before = save_plain(w)
        w.ninja.x, w.ninja.y = self.x, self.y
        w.ninja.cell = self.cell
        _, calls = traced(touch_objects, w)
        events = [EVENT_NAMES[event.kind] for event in w.events[: w.event_count]]
        restore_plain(w, before)
        return [int(call.arguments["o"]) for call in calls if call.name == "touch"], events

    def numbers(self) -> list[tuple[str, str]]:
        slots, events = self.objects_tested()
        names = [KIND_NAMES[self.world.objects[slot].kind] for slot in slots]
        return [
            ("objects in the level", str(self.world.id_count)),
            ("objects asked", f"{len(slots)}: {', '.join(names)}" if slots else "0"),
            ("events", ", ".join(events) or "none"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        centre = self.cell
        sheet.tiles(self.tiles)
        for number, offset in enumerate(NINE_CELLS, 1):
            cell = centre + offset
            sheet.shade(cell, palette.switch if offset else palette.good, 60)
            sheet.text(str(number), CENTRE_X[cell] - 8, CENTRE_Y[cell] - 7, size=9, colour=palette.faint)
        sheet.grid()
        slots, _ = self.objects_tested()
        for shape in hit_shapes(self.world):
            if not shape.ninja:
                sheet.body(
                    palette.bad if shape.lethal else palette.gold, shape.x, shape.y, shape.half, box=not shape.round
                )
        for number, slot in enumerate(slots, 1):
            o = self.world.objects[slot]
            sheet.circle(palette.good, o.x, o.y, 8.5, 2)
            sheet.text(str(number), o.x, o.y, size=10)
        sheet.body(palette.ninja, self.x, self.y, RADIUS, box=False)


_NINJA: Point = (292.0, 172.0)


class RayCast(Figure):
    """Drag the end of a ray: the cells that it visits, the shapes that are tested, the hit."""

    name = "rays"
    start = (330.0, 190.0)
    moves = "end"

    def reset(self) -> None:
        super().reset()
        self.from_x, self.from_y = 60.0, 70.0
        self.tiles, self.world = room_world(self.room, self.objects)
        self.world.ninja.x, self.world.ninja.y = _NINJA

    def controls(self) -> Sequence[Control]:
        return [self.choice("Arrows move", (("the end", "end"), ("the start", "start")), "moves")]

    def press(self, x: float, y: float) -> None:
        self.moves = "start" if dist((x, y), (self.from_x, self.from_y)) < dist((x, y), (self.x, self.y)) else "end"
        self.drag(x, y)

    def drag(self, x: float, y: float) -> None:
        place = self.x, self.y
        super().drag(x, y)
        if self.moves == "start":
            self.from_x, self.from_y = self.x, self.y
            self.x, self.y = place

    def nudge(self, dx: int, dy: int) -> None:
        x, y = (self.from_x, self.from_y) if self.moves == "start" else (self.x, self.y)
        self.drag(x + dx, y + dy)

    def demonstrate(self, tick: int) -> None:
        self.moves = "end"
        super().demonstrate(tick)

    @property
    def direction(self) -> Point:
        """The direction of the ray: a vector of length 1."""
        length = dist((self.from_x, self.from_y), (self.x, self.y)) or 1.0
        return (self.x - self.from_x) / length, (self.y - self.from_y) / length

    @property
    def visited(self) -> list[int]:
        """The cells of the ray, in the order in which the world's own function visits them."""
        cells = values_of("cell", cast_ray, self.tiles, self.world, self.from_x, self.from_y, *self.direction)
        return [cell for cell in cells if EXISTS[cell]]

    def shapes_tested(self) -> tuple[list[int], bool, Point]:
        """The cells whose shapes were tested, whether the ray was stopped, and where, px."""
        ray = self.from_x, self.from_y, self.x, self.y
        (stopped, x, y), calls = traced(ray_tiles, self.tiles, self.world, *ray)
        cells = [cell_at(call.arguments["cx"], call.arguments["cy"]) for call in calls if call.name == "ray_tile"]
        tiles = self.tiles.ids
        return [cell for cell in cells if tiles[cell]], bool(stopped), (x, y)

    def met(self) -> tuple[list[int], list[int]]:
        """The slots of the gold that the ray hits before it stops: in cells that it visits, and in others."""
        cells, (_, stopped, end) = set(self.visited), self.shapes_tested()
        reach = dist((self.from_x, self.from_y), end) if stopped else 1e9
        pairs: tuple[list[int], list[int]] = ([], [])
        for slot in range(1, self.world.id_count + 1):
            o = self.world.objects[slot]
            hit, x, y = ray_circle(self.from_x, self.from_y, *self.direction, o.x, o.y, GOLD_RADIUS)
            if hit and dist((self.from_x, self.from_y), (x, y)) <= reach:
                pairs[o.cell not in cells].append(slot)
        return pairs

    def numbers(self) -> list[tuple[str, str]]:
        tested, stopped, (x, y) = self.shapes_tested()
        ray = self.from_x, self.from_y, self.x, self.y
        inside, missed = self.met()
        return [
            ("cells visited", str(len(self.visited))),
            ("shapes asked", str(len(tested))),
            ("stopped at", f"{x:.1f}, {y:.1f} px" if stopped else "nothing: it leaves the grid"),
            ("sees the ninja", "yes" if sees(self.tiles, self.world, *ray)[0] else "no"),
            ("gold met in those cells", str(len(inside))),
            ("gold met but missed", f"{len(missed)}: a loose grid files it elsewhere"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        tested, stopped, end = self.shapes_tested()
        for number, cell in enumerate(self.visited, 1):
            sheet.shade(cell, palette.accent if cell in tested else palette.good, 80)
            sheet.text(str(number), CENTRE_X[cell] - 8, CENTRE_Y[cell] - 8, size=8, colour=palette.faint)
        sheet.tiles(self.tiles)
        sheet.grid()
        sheet.edges(self.world, self.visited)
        inside, missed = self.met()
        for slot in range(1, self.world.id_count + 1):
            o = self.world.objects[slot]
            if o.x or o.y:
                sheet.circle(palette.gold, o.x, o.y, GOLD_RADIUS, 0 if slot in inside + missed else 1.5)
                if slot in missed:
                    sheet.text("missed", o.x, o.y - 11, size=8, colour=palette.bad)
        n = self.world.ninja
        sheet.circle(palette.ninja, n.x, n.y, RADIUS, 2)
        start = self.from_x, self.from_y
        sheet.arrow(palette.bad, start, end if stopped else (self.x, self.y), 2)
        sheet.circle(palette.bad, *start, 3)
        sheet.circle(palette.bad, self.x, self.y, 4, 1.5)
