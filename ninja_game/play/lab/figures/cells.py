"""Figures about cells: how they are numbered, which a body touches, and the nine that the ninja asks for objects."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor

from ninja_game.play.lab.figure import CORNER, Control, Figure, Sheet, View, room_world, watch
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, COLUMN, EXISTS, ROW
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import KIND_NAMES
from ninja_game.sim.memory.plain import restore_plain, save_plain
from ninja_game.sim.objects.dispatch import NINE_CELLS, touch_objects
from ninja_game.sim.rules import CELL, GRID_COLUMNS, GRID_ROWS, RADIUS, STRIDE
from ninja_game.view.overlays import hit_shapes, touched_cells

BODIES: Sequence[tuple[str, object]] = (("circle", False), ("box", True))


class GridOfCells(Figure):
    """Drag a point: the division that gives its cell, and the numbers of the cells around it."""

    name = "grid"
    view = View(-CELL, -CELL, 1.5)
    start = (163.0, 88.0)

    def numbers(self) -> list[tuple[str, str]]:
        cell = cell_at(self.x, self.y)
        return [
            ("point", f"{self.x:.1f}, {self.y:.1f} px"),
            ("column", f"floor({self.x:.1f} / {CELL:g}) = {floor(self.x / CELL)}"),
            ("row", f"floor({self.y:.1f} / {CELL:g}) = {floor(self.y / CELL)}"),
            ("number in the list", str(cell) if cell else "0: there is no cell"),
            ("right of it, below it", f"{cell} + 1 = {cell + 1}, {cell} + {STRIDE} = {cell + STRIDE}" if cell else "-"),
        ]

    def draw(self, sheet: Sheet) -> None:
        """Border, the cell and its eight neighbours with their numbers, the point."""
        p, own = sheet.palette, cell_at(self.x, self.y)
        shade_border(sheet)
        sheet.grid()
        for cell in [own + offset for offset in NINE_CELLS if own and EXISTS[own + offset]]:
            sheet.shade(cell, p.switch if cell != own else p.good, 90)
            sheet.text(str(cell), CENTRE_X[cell], CENTRE_Y[cell] - 6, size=10)
        sheet.text("no cells", 7.5 * 24, -12)
        sheet.circle(p.ninja, self.x, self.y, 2.5)


def shade_border(sheet: Sheet) -> None:
    """The outermost cells, which are always solid."""
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
        return [self.choice("Body", BODIES, "box")]

    def drag(self, x: float, y: float) -> None:
        """The border keeps bodies out."""
        super().drag(max(x, CELL + RADIUS), max(y, CELL + RADIUS))

    @property
    def cell(self) -> int:
        return cell_at(self.x, self.y)

    def numbers(self) -> list[tuple[str, str]]:
        cell, touched = self.cell, touched_cells(self.x, self.y, self.cell)
        names = [f"({COLUMN[each]}, {ROW[each]})" for each in touched]
        return [
            ("centre", f"{self.x:.1f}, {self.y:.1f} px"),
            ("current cell", f"column {COLUMN[cell]}, row {ROW[cell]}, index {cell}"),
            ("from its middle", f"{self.x - CENTRE_X[cell]:+.1f}, {self.y - CENTRE_Y[cell]:+.1f} px"),
            ("cells touched", f"{len(touched)}: {' '.join(names)}"),
        ]

    def draw(self, sheet: Sheet) -> None:
        """Border, neighbours, touched cells, own cell, body."""
        p = sheet.palette
        shade_border(sheet)
        for offset in NINE_CELLS:
            sheet.shade(self.cell + offset, p.switch, 40)
        for number, cell in enumerate(touched_cells(self.x, self.y, self.cell)):
            sheet.shade(cell, p.accent if number else p.good, 110)
        sheet.grid()
        sheet.body(p.ninja, self.x, self.y, RADIUS, box=self.box)
        sheet.circle(p.ninja, self.x, self.y, 1.5)


class NineCells(Figure):
    """Drag the ninja: the nine cells it asks, in their order, and which objects are notified."""

    name = "nine-cells"
    view = CORNER
    start = (155.0, 100.0)

    def reset(self) -> None:
        super().reset()
        self.tiles, self.world = room_world(self.room, self.objects)

    def objects_asked(self) -> tuple[list[int], list[str]]:
        """The slots of the notified objects, in order, and the events that follow; the world stays as it is."""
        w = self.world
        before = save_plain(w)
        w.ninja.x, w.ninja.y = self.x, self.y
        w.ninja.cell = cell_at(self.x, self.y)
        _, calls = watch(touch_objects, w)
        events = [EVENT_NAMES[event.kind] for event in w.events[: w.event_count]]
        restore_plain(w, before)
        return [int(call.arguments["o"]) for call in calls if call.name == "touch"], events

    def numbers(self) -> list[tuple[str, str]]:
        asked, events = self.objects_asked()
        names = [KIND_NAMES[self.world.objects[slot].kind] for slot in asked]
        return [
            ("objects in the level", str(self.world.id_count)),
            ("objects asked", f"{len(asked)}: {', '.join(names)}" if asked else "0"),
            ("events", ", ".join(events) or "none"),
        ]

    def draw(self, sheet: Sheet) -> None:
        """The cells with their numbers, the objects with theirs."""
        p = sheet.palette
        centre = cell_at(self.x, self.y)
        sheet.tiles(self.tiles)
        for number, offset in enumerate(NINE_CELLS, 1):
            cell = centre + offset
            sheet.shade(cell, p.switch if offset else p.good, 60)
            sheet.text(str(number), CENTRE_X[cell] - 8, CENTRE_Y[cell] - 7, size=9, colour=p.faint)
        sheet.grid()
        asked, _ = self.objects_asked()
        for shape in hit_shapes(self.world):
            if not shape.ninja:
                sheet.body(p.bad if shape.lethal else p.gold, shape.x, shape.y, shape.half, box=not shape.round)
        for number, slot in enumerate(asked, 1):
            o = self.world.objects[slot]
            sheet.circle(p.good, o.x, o.y, 8.5, 2)
            sheet.text(str(number), o.x, o.y, size=10)
        sheet.body(p.ninja, self.x, self.y, RADIUS, box=False)
