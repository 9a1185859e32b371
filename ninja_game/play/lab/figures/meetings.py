"""The figures about crowds that meet: every pair by five lists an object, and bullets that read the grid only."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

from ninja_game.play.lab.figure import FIELD, Control, Figure, FigureSetting, Sheet, choice, slider
from ninja_game.play.lab.figures.crowd import FIVE_CELLS, Crowd
from ninja_game.sim.grid import cell_at, grid_move
from ninja_game.sim.memory.object_fields import Object


class FiveCells(Figure):
    """The scan for all pairs in slow motion."""

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
        return [
            slider("Objects", (10, 200, 10), self, "count"),
            slider("Tests a tick", (1, 40, 1), self, "speed"),
        ]

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
        found, count = set(self.found), self.count
        return [
            ("objects", str(count)),
            ("tests so far", f"{len(self.tested)}{', done' if self.done else ''}"),
            ("tests of all pairs", f"{count * (count - 1) // 2} (n x n: {count * count})"),
            ("pairs found", f"{len(found)} of {len(self.truth)}"),
            ("found twice", str(len(self.found) - len(found))),
            ("missed", str(len(self.truth - found)) if self.done else "not done yet"),
        ]

    def draw(self, sheet: Sheet) -> None:
        """The five cells of the present test, the pairs found."""
        p = sheet.palette
        if self.tested and not self.done:
            cell = self.tested[-1][0].cell
            for offset in FIVE_CELLS:
                sheet.shade(cell + offset, p.switch if offset else p.good, 90)
        sheet.grid()
        for o in self.crowd.objects:
            sheet.circle(p.faint, o.x, o.y, self.crowd.radius, 1.2)
        for a, b in self.found:
            one, two = self.crowd.world.objects[a], self.crowd.world.objects[b]
            sheet.line(p.accent, (one.x, one.y), (two.x, two.y), 3)
        if self.tested and not self.done:
            one, two = self.tested[-1]
            sheet.line(p.ninja, (one.x, one.y), (two.x, two.y), 1.5)


class Bullets(Figure):
    """Many bullets against a few targets, with and without filing the bullets."""

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
            slider("Bullets", (100, 3000, 100), self, "count"),
            choice("Filed too", (("no", False), ("yes", True)), self, "filed"),
        ]

    def demonstrate(self, tick: int) -> None:
        """Filed for three seconds, then not."""
        self.filed = tick // 120 % 2 == 1

    def tick(self) -> None:
        """All fly on; every bullet asks the nine cells for targets."""
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
                # Whoever walks the lists meets the other bullets too.
                self.tests += sum(1 for _ in bullets.neighbours(cell)) - 1
            for target in targets.neighbours(cell):
                self.tests += 1
                self.hits += (o.x - target.x) ** 2 + (o.y - target.y) ** 2 < targets.radius**2

    def numbers(self) -> list[tuple[str, str]]:
        """What a tick costs."""
        return [
            ("bullets, targets", f"{self.count}, {len(self.targets.objects)}"),
            ("hits in this tick", str(self.hits)),
            ("list changes", str(self.list_changes)),
            ("objects looked at", str(self.tests)),
        ]

    def draw(self, sheet: Sheet) -> None:
        p = sheet.palette
        sheet.grid()
        for o in self.targets.objects:
            sheet.circle(p.switch, o.x, o.y, self.targets.radius, 1.5)
        size = max(2, round(2 * sheet.canvas.scale))
        for o in self.bullets.objects:
            sheet.surface.fill(p.bad if self.filed else p.ninja, (*sheet.canvas.point(o.x, o.y), size, size))
