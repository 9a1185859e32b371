"""The figure about the grid of objects: loose against normal."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import pairwise

from ninja_game.play.lab.figure import FIELD, Control, Figure, FigureSetting, Sheet, choice, slider
from ninja_game.play.lab.figures.crowd import LEFT, TOP, Crowd, Work
from ninja_game.sim.grid import cell_at
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.objects.dispatch import NINE_CELLS

MEASURED = (25, 50, 100, 200, 400)
"""Numbers of objects at which the plot is measured."""

CHART = (LEFT + 460, TOP + 270, 240.0, 140.0)
"""Where the plot lies, px of the world."""


@cache
def measured(count: int, radius: float) -> tuple[Work, Work]:
    """What a tick costs on average, loose and normal, with so many objects."""
    crowd, ticks = Crowd(count, radius), 8
    works = [crowd.move() for _ in range(ticks)]
    loose, normal = (Work(*(sum(work[grid][part] for work in works) // ticks for part in (0, 1))) for grid in (0, 1))
    return loose, normal


class LooseGrid(Figure):
    """Objects fly about; both ways of filing them are counted side by side."""

    name = "grids"
    view = FIELD
    start = (LEFT + 300, TOP + 180)
    count, radius = FigureSetting(60, "fill"), FigureSetting(8, "resize")
    plot = 0

    def reset(self) -> None:
        super().reset()
        self.fill()
        self.works = Work(0, 0), Work(0, 0)

    def fill(self) -> None:
        self.crowd = Crowd(self.count, self.radius)

    def resize(self) -> None:
        """The same objects, as large as is wanted."""
        self.crowd.radius = self.radius

    def controls(self) -> Sequence[Control]:
        return [
            slider("Objects", (10, 400, 10), self, "count"),
            slider("Radius, px", (2, 11, 1), self, "radius"),
            choice("Plot", (("changes", 0), ("tests", 1)), self, "plot"),
        ]

    def demonstrate(self, tick: int) -> None:
        super().demonstrate(tick)
        if tick % 120 == 0:
            self.count = (30, 60, 120)[tick // 120 % 3]

    def tick(self) -> None:
        self.works = self.crowd.move()

    def asked(self) -> tuple[set[int], set[int]]:
        """The cells that a body at the handle asks: in the loose grid, in the normal one."""
        probe = Object()
        probe.x, probe.y = self.x, self.y
        cell = cell_at(self.x, self.y)
        return {cell + offset for offset in NINE_CELLS}, set(self.crowd.cells_of(probe))

    def numbers(self) -> list[tuple[str, str]]:
        (loose, normal), (nine, four) = self.works, self.asked()
        in_nine = sum(o.cell in nine for o in self.crowd.objects)
        in_four = sum(bool(self.crowd.cells_of(o) & four) for o in self.crowd.objects)
        return [
            ("", "loose / normal"),
            ("list changes in this tick", f"{loose.list_changes} / {normal.list_changes}"),
            ("tests, if all ask for all", f"{loose.tests} / {normal.tests}"),
            ("cells that the handle asks", f"{len(nine)} / {len(four)}"),
            ("objects that it is told of", f"{in_nine} / {in_four}"),
        ]

    def draw(self, sheet: Sheet) -> None:
        p = sheet.palette
        nine, four = self.asked()
        for cell in nine:
            sheet.shade(cell, p.switch, 60)
        for cell in four:
            sheet.shade(cell, p.good, 90)
        sheet.grid()
        for o in self.crowd.objects:
            sheet.circle(p.gold if o.cell in nine else p.faint, o.x, o.y, self.crowd.radius, 1.2)
            if o.next:
                other = self.crowd.world.objects[o.next]
                sheet.arrow(p.accent, (o.x, o.y), (other.x, other.y), 1.2)
        sheet.circle(p.ninja, self.x, self.y, self.crowd.radius, 2.5)
        self._draw_plot(sheet)

    def _draw_plot(self, sheet: Sheet) -> None:
        p, (x, y, w, h) = sheet.palette, CHART
        sheet.canvas.fill_rect(sheet.surface, p.panel, x - 6, y - 22, w + 16, h + 44, 4)
        rows = [measured(count, self.radius) for count in MEASURED]
        most = max(1, *(work[self.plot] for row in rows for work in row))
        for grid, colour in ((0, p.switch), (1, p.accent)):
            points = [
                (x + w * count / MEASURED[-1], y + h - h * row[grid][self.plot] / most)
                for count, row in zip(MEASURED, rows, strict=True)
            ]
            for start, end in pairwise(points):
                sheet.line(colour, start, end, 2)
            sheet.text(("loose", "normal")[grid], x + 30 + 80 * grid, y - 12, size=9, colour=colour)
        sheet.line(p.faint, (x, y + h), (x + w, y + h))
        sheet.text(f"a tick: up to {most}", x + w - 55, y - 12, size=8)
        sheet.text(f"objects: up to {MEASURED[-1]}", x + w - 55, y + h + 11, size=8)
