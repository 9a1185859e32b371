"""Moving objects in the world's own lists, and what another grid would have done with them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from random import Random
from typing import NamedTuple

from ninja_game.play.lab.figure import FIELD, FIGURE
from ninja_game.sim.grid import cell_at, grid_insert, grid_move
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.memory.schema import World
from ninja_game.sim.objects.dispatch import NINE_CELLS
from ninja_game.sim.rules import STRIDE

LEFT, TOP = FIELD.left, FIELD.top
RIGHT, BOTTOM = LEFT + FIGURE[2] / FIELD.zoom, TOP + FIGURE[3] / FIELD.zoom

FIVE_CELLS = (0, 1, STRIDE - 1, STRIDE, STRIDE + 1)
"""The rest of the own list, and the lists right, below left, below, below right: every pair of neighbours once."""


class Work(NamedTuple):
    """What a tick cost: insertions and removals in lists, and tests of two objects."""

    list_changes: int
    tests: int


class Crowd:
    """``count`` discs of ``radius`` px that fly about and are filed in the loose grid of a world of their own."""

    def __init__(self, count: int, radius: float, *, speed: float = 1.5, seed: int = 1) -> None:
        rng = Random(seed)  # noqa: S311 - presentation
        self.radius = radius
        self.world = World()
        self.world.objects += [Object() for _ in range(count)]
        self.velocities = [(0.0, 0.0)]
        for slot in range(1, count + 1):
            o = self.world.objects[slot]
            o.slot = slot
            o.x, o.y = rng.uniform(LEFT + 10, RIGHT - 10), rng.uniform(TOP + 10, BOTTOM - 10)
            self.velocities.append((rng.uniform(-speed, speed), rng.uniform(-speed, speed)))
            grid_insert(self.world, o)

    @property
    def objects(self) -> list[Object]:
        return self.world.objects[1:]

    def neighbours(self, cell: int, offsets: tuple[int, ...] | list[int] = NINE_CELLS) -> Iterator[Object]:
        """The objects in the lists of some cells about one, in the lists' order."""
        for offset in offsets:
            slot = self.world.heads[cell + offset]
            while slot:
                yield self.world.objects[slot]
                slot = self.world.objects[slot].next

    def cells_of(self, o: Object) -> frozenset[int]:
        """The cells that an object's box touches, as a normal grid files it."""
        r = self.radius
        return frozenset(cell_at(o.x + dx, o.y + dy) for dx in (-r, r) for dy in (-r, r))

    def move(self) -> tuple[Work, Work]:
        """Let a tick pass. What it cost the loose grid, and what it would have cost a normal one."""
        loose = normal = 0
        for o in self.objects:
            before = self.cells_of(o)
            self.step(o)
            # A removal and an insertion, if the cell is another one.
            loose += 2 * grid_move(self.world, o)
            normal += len(before ^ self.cells_of(o))
        filed = Counter(cell for o in self.objects for cell in self.cells_of(o))
        normal_tests = sum(filed[cell] - 1 for o in self.objects for cell in self.cells_of(o))
        loose_tests = sum(1 for o in self.objects for _ in self.neighbours(o.cell))
        return Work(loose, loose_tests - len(self.objects)), Work(normal, normal_tests)

    def step(self, o: Object) -> None:
        """Fly on; at the walls turn back."""
        vx, vy = self.velocities[o.slot]
        o.x, o.y = o.x + vx, o.y + vy
        if not LEFT + self.radius < o.x < RIGHT - self.radius:
            vx, o.x = -vx, min(max(o.x, LEFT + self.radius), RIGHT - self.radius)
        if not TOP + self.radius < o.y < BOTTOM - self.radius:
            vy, o.y = -vy, min(max(o.y, TOP + self.radius), BOTTOM - self.radius)
        self.velocities[o.slot] = vx, vy

    def meet(self, a: Object, b: Object) -> bool:
        """Whether two discs overlap."""
        return (a.x - b.x) ** 2 + (a.y - b.y) ** 2 < (2 * self.radius) ** 2

    def five_cell_pairs(self) -> Iterator[tuple[Object, Object]]:
        """All pairs that could meet, each once: for every object the rest of its list, then four neighbours' lists."""
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
