"""The figures about grids of objects: loose against normal, and bullets."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import combinations, pairwise
from random import Random
from typing import NamedTuple

from ninja_game.play.lab.figure import FIELD, FIGURE_AREA, Control, Figure, FigureSetting, Sheet
from ninja_game.sim.grid import cell_at, grid_insert, grid_move
from ninja_game.sim.objects.dispatch import NINE_CELLS
from ninja_game.sim.rules import STRIDE
from ninja_game.sim.schema.object_fields import Object
from ninja_game.sim.schema.world_fields import World

_LEFT, _TOP = FIELD.left, FIELD.top
_RIGHT, _BOTTOM = _LEFT + FIGURE_AREA[2] / FIELD.zoom, _TOP + FIGURE_AREA[3] / FIELD.zoom

FIVE_CELLS = (0, 1, STRIDE - 1, STRIDE, STRIDE + 1)
"""The rest of the own list, and the lists right, below left, below, below right: every pair of neighbours once."""


class Work(NamedTuple):
    """The cost of a tick: insertions and removals in lists, and tests of two objects."""

    list_changes: int
    tests: int


class Crowd:
    """``count`` discs of ``radius`` px that move, in the loose grid of their own world."""

    def __init__(self, count: int, radius: float, *, speed: float = 1.5, seed: int = 1) -> None:
        rng = Random(seed)  # noqa: S311 - presentation
        self.radius = radius
        self.world = World()
        self.world.objects += [Object() for _ in range(count)]
        self.velocities = [(0.0, 0.0)]
        for slot in range(1, count + 1):
            o = self.world.objects[slot]
            o.slot = slot
            o.x, o.y = rng.uniform(_LEFT + 10, _RIGHT - 10), rng.uniform(_TOP + 10, _BOTTOM - 10)
            self.velocities.append((rng.uniform(-speed, speed), rng.uniform(-speed, speed)))
            grid_insert(self.world, o)

    @property
    def objects(self) -> list[Object]:
        return self.world.objects[1:]

    def neighbours(self, cell: int, offsets: tuple[int, ...] | list[int] = NINE_CELLS) -> Iterator[Object]:
        """The objects in the lists of the cells around an object, in the lists' order."""
        for offset in offsets:
            slot = self.world.heads[cell + offset]
            while slot:
                yield self.world.objects[slot]
                slot = self.world.objects[slot].next

    def cells_of(self, o: Object) -> frozenset[int]:
        """The cells that an object's box touches: those that list it in a normal grid."""
        r = self.radius
        return frozenset(cell_at(o.x + dx, o.y + dy) for dx in (-r, r) for dy in (-r, r))

    def move(self) -> tuple[Work, Work]:
        """Simulate a tick: the work with the loose grid, and with a normal one."""
        loose = normal = 0
        for o in self.objects:
            before = self.cells_of(o)
            self.step(o)
            # One removal and one insertion if the cell has changed.
            loose += 2 * grid_move(self.world, o)
            normal += len(before ^ self.cells_of(o))
        filed = Counter(cell for o in self.objects for cell in self.cells_of(o))
        normal_tests = sum(filed[cell] - 1 for o in self.objects for cell in self.cells_of(o))
        loose_tests = sum(1 for o in self.objects for _ in self.neighbours(o.cell))
        return Work(loose, loose_tests - len(self.objects)), Work(normal, normal_tests)

    def step(self, o: Object) -> None:
        vx, vy = self.velocities[o.slot]
        o.x, o.y = o.x + vx, o.y + vy
        if not _LEFT + self.radius < o.x < _RIGHT - self.radius:
            vx, o.x = -vx, min(max(o.x, _LEFT + self.radius), _RIGHT - self.radius)
        if not _TOP + self.radius < o.y < _BOTTOM - self.radius:
            vy, o.y = -vy, min(max(o.y, _TOP + self.radius), _BOTTOM - self.radius)
        self.velocities[o.slot] = vx, vy

    def meet(self, a: Object, b: Object) -> bool:
        return (a.x - b.x) ** 2 + (a.y - b.y) ** 2 < (2 * self.radius) ** 2

    def five_cell_pairs(self) -> Iterator[tuple[Object, Object]]:
        """All pairs that can touch, each once: for every object the rest of its list, then four neighbours' lists."""
        for cell, head in enumerate(self.world.heads):
            slot = head
            while slot:
                o = self.world.objects[slot]
                rest = o.next
                while rest:
                    yield o, self.world.objects[rest]
                    rest = self.world.objects[rest].next
                for other in self.neighbours(cell, FIVE_CELLS[1:]):
                    yield o, other
                slot = o.next


PLOTTED_COUNTS = (25, 50, 100, 200, 400)  # the numbers of objects in the plot

CHART = (_LEFT + 460, _TOP + 270, 240.0, 140.0)  # the plot's area, px of the world


@cache
def mean_work(count: int, radius: float) -> tuple[Work, Work]:
    """The mean work per tick with ``count`` objects, in the loose and the normal grid."""
    crowd, ticks = Crowd(count, radius), 8
    works = [crowd.move() for _ in range(ticks)]
    loose, normal = (Work(*(sum(work[grid][part] for work in works) // ticks for part in (0, 1))) for grid in (0, 1))
    return loose, normal


class LooseGrid(Figure):
    """Moving objects; the work with both grids is counted side by side."""

    name = "grids"
    view = FIELD
    start = (_LEFT + 300, _TOP + 180)
    count, radius = FigureSetting(60, "fill"), FigureSetting(8, "resize")
    plot = 0

    def reset(self) -> None:
        super().reset()
        self.fill()
        self.works = Work(0, 0), Work(0, 0)

    def fill(self) -> None:
        self.crowd = Crowd(self.count, self.radius)

    def resize(self) -> None:
        self.crowd.radius = self.radius

    def controls(self) -> Sequence[Control]:
        return [
            self.slider("Objects", (10, 400, 10), "count"),
            self.slider("Radius, px", (2, 11, 1), "radius"),
            self.choice("Plot", (("changes", 0), ("tests", 1)), "plot"),
        ]

    def demonstrate(self, tick: int) -> None:
        super().demonstrate(tick)
        if tick % 120 == 0:
            self.count = (30, 60, 120)[tick // 120 % 3]

    def tick(self) -> None:
        self.works = self.crowd.move()

    def cells_tested(self) -> tuple[set[int], set[int]]:
        """The cells that a body at the handle tests: in the loose grid, in the normal one."""
        probe = Object()
        probe.x, probe.y = self.x, self.y
        return {self.cell + offset for offset in NINE_CELLS}, set(self.crowd.cells_of(probe))

    def numbers(self) -> list[tuple[str, str]]:
        (loose, normal), (nine, four) = self.works, self.cells_tested()
        in_nine = sum(o.cell in nine for o in self.crowd.objects)
        in_four = sum(bool(self.crowd.cells_of(o) & four) for o in self.crowd.objects)
        return [
            ("", "loose / normal"),
            ("list changes in this tick", f"{loose.list_changes} / {normal.list_changes}"),
            ("tests, if all ask for all", f"{loose.tests} / {normal.tests}"),
            ("cells that the handle asks", f"{len(nine)} / {len(four)}"),
            ("objects that it tests", f"{in_nine} / {in_four}"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        nine, four = self.cells_tested()
        for cell in nine:
            sheet.shade(cell, palette.switch, 60)
        for cell in four:
            sheet.shade(cell, palette.good, 90)
        sheet.grid()
        for o in self.crowd.objects:
            sheet.circle(palette.gold if o.cell in nine else palette.faint, o.x, o.y, self.crowd.radius, 1.2)
            if o.next:
                other = self.crowd.world.objects[o.next]
                sheet.arrow(palette.accent, (o.x, o.y), (other.x, other.y), 1.2)
        sheet.circle(palette.ninja, self.x, self.y, self.crowd.radius, 2.5)
        self._draw_plot(sheet)

    def _draw_plot(self, sheet: Sheet) -> None:
        palette, (x, y, w, h) = sheet.palette, CHART
        sheet.canvas.fill_rect(sheet.surface, palette.panel, x - 6, y - 22, w + 16, h + 44, 4)
        rows = [mean_work(count, self.radius) for count in PLOTTED_COUNTS]
        most = max(1, *(work[self.plot] for row in rows for work in row))
        for grid, colour in ((0, palette.switch), (1, palette.accent)):
            points = [
                (x + w * count / PLOTTED_COUNTS[-1], y + h - h * row[grid][self.plot] / most)
                for count, row in zip(PLOTTED_COUNTS, rows, strict=True)
            ]
            for start, end in pairwise(points):
                sheet.line(colour, start, end, 2)
            sheet.text(("loose", "normal")[grid], x + 30 + 80 * grid, y - 12, size=9, colour=colour)
        sheet.line(palette.faint, (x, y + h), (x + w, y + h))
        sheet.text(f"a tick: up to {most}", x + w - 55, y - 12, size=8)
        sheet.text(f"objects: up to {PLOTTED_COUNTS[-1]}", x + w - 55, y + h + 11, size=8)


class FiveCells(Figure):
    """All touching pairs of a crowd, each found once: an object looks into its own cell and four of its neighbours."""

    name = "pairs"
    view = FIELD
    count = FigureSetting(60)
    speed: float = 4

    def reset(self) -> None:
        super().reset()
        self.crowd = Crowd(self.count, 11)
        self.pairs: Iterator[tuple[Object, Object]] = self.crowd.five_cell_pairs()
        self.tested: list[tuple[Object, Object]] = []
        self.found: list[tuple[int, int]] = []
        self.done = False
        objects = self.crowd.objects
        self.truth = {(a.slot, b.slot) for a, b in combinations(objects, 2) if self.crowd.meet(a, b)}

    def controls(self) -> Sequence[Control]:
        return [self.slider("Objects", (10, 200, 10), "count"), self.slider("Tests a tick", (1, 40, 1), "speed")]

    def demonstrate(self, tick: int) -> None:
        if self.done and tick % 80 == 0:
            self.count = self.count % 120 + 30

    def tick(self) -> None:
        for _ in range(int(self.speed)):
            pair = next(self.pairs, None)
            if pair is None:
                self.done = True
                return
            self.tested.append(pair)
            if self.crowd.meet(*pair):
                a, b = sorted((pair[0].slot, pair[1].slot))
                self.found.append((a, b))

    def numbers(self) -> list[tuple[str, str]]:
        pairs, count = set(self.found), self.count
        return [
            ("objects", str(count)),
            ("tests so far", f"{len(self.tested)}{', done' if self.done else ''}"),
            ("tests of all pairs", f"{count * (count - 1) // 2} (n x n: {count * count})"),
            ("pairs found", f"{len(pairs)} of {len(self.truth)}"),
            ("found twice", str(len(self.found) - len(pairs))),
            ("missed", str(len(self.truth - pairs)) if self.done else "not done yet"),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        if self.tested and not self.done:
            cell = self.tested[-1][0].cell
            for offset in FIVE_CELLS:
                sheet.shade(cell + offset, palette.switch if offset else palette.good, 90)
        sheet.grid()
        for o in self.crowd.objects:
            sheet.circle(palette.faint, o.x, o.y, self.crowd.radius, 1.2)
        for a, b in self.found:
            one, two = self.crowd.world.objects[a], self.crowd.world.objects[b]
            sheet.line(palette.accent, (one.x, one.y), (two.x, two.y), 3)
        if self.tested and not self.done:
            one, two = self.tested[-1]
            sheet.line(palette.ninja, (one.x, one.y), (two.x, two.y), 1.5)


class Bullets(Figure):
    """Many bullets against a few targets, with and without the bullets in the grid."""

    name = "bullets"
    view = FIELD
    count = FigureSetting(1000)
    filed = False

    def reset(self) -> None:
        super().reset()
        self.targets = Crowd(60, 10, speed=0.5)
        self.bullets = Crowd(self.count, 1, speed=4, seed=2)
        self.hits = self.list_changes = self.tests = 0

    def controls(self) -> Sequence[Control]:
        return [
            self.slider("Bullets", (100, 3000, 100), "count"),
            self.choice("Filed too", (("no", False), ("yes", True)), "filed"),
        ]

    def demonstrate(self, tick: int) -> None:
        """With the grid for three seconds, then without."""
        self.filed = tick // 120 % 2 == 1

    def tick(self) -> None:
        """All objects move; every bullet looks for targets in nine cells."""
        targets, bullets = self.targets, self.bullets
        self.hits = self.list_changes = self.tests = 0
        for o in targets.objects:
            targets.step(o)
            self.list_changes += 2 * grid_move(targets.world, o)
        for o in bullets.objects:
            bullets.step(o)
            cell = cell_at(o.x, o.y)
            if self.filed:
                self.list_changes += 2 * grid_move(bullets.world, o)
                # The lists contain the other bullets too.
                self.tests += sum(1 for _ in bullets.neighbours(cell)) - 1
            for target in targets.neighbours(cell):
                self.tests += 1
                self.hits += (o.x - target.x) ** 2 + (o.y - target.y) ** 2 < targets.radius**2

    def numbers(self) -> list[tuple[str, str]]:
        return [
            ("bullets, targets", f"{self.count}, {len(self.targets.objects)}"),
            ("hits in this tick", str(self.hits)),
            ("list changes", str(self.list_changes)),
            ("objects looked at", str(self.tests)),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        sheet.grid()
        for o in self.targets.objects:
            sheet.circle(palette.switch, o.x, o.y, self.targets.radius, 1.5)
        size = max(2, round(2 * sheet.canvas.scale))
        for o in self.bullets.objects:
            sheet.surface.fill(
                palette.bad if self.filed else palette.ninja, (*sheet.canvas.point(o.x, o.y), size, size)
            )
