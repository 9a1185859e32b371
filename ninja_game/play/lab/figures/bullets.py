"""The figure about bullets: they read the grid and need not be in it."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.play.lab.figure import Control, Figure, Setting, choice, slider
from ninja_game.play.lab.figures.crowd import Crowd
from ninja_game.play.lab.sheet import FIELD, Sheet
from ninja_game.sim.grid import cell_at, grid_move


class Bullets(Figure):
    """Many bullets against a few targets, with and without filing the bullets."""

    name = "bullets"
    view = FIELD
    count = Setting(1000)
    filed = False

    def reset(self) -> None:
        """Targets and bullets where they began."""
        super().reset()
        self.targets = Crowd(60, 10, speed=0.5)
        self.bullets = Crowd(self.count, 1, speed=4, seed=2)
        self.hits = self.list_changes = self.tests = 0

    def controls(self) -> Sequence[Control]:
        """How many, filed or not."""
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
        """Targets and bullets."""
        p = sheet.palette
        sheet.grid()
        for o in self.targets.objects:
            sheet.circle(p.switch, o.x, o.y, self.targets.radius, 1.5)
        size = max(2, round(2 * sheet.canvas.scale))
        for o in self.bullets.objects:
            sheet.surface.fill(p.bad if self.filed else p.ninja, (*sheet.canvas.point(o.x, o.y), size, size))
