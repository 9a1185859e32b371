"""The figure about edge states: paint tiles and see what every cell says of its four sides."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.editor.brush import tile_name
from ninja_game.formats.ascii.legend import TILE_CHARS
from ninja_game.play.lab.figure import Control, Figure, FigureSetting, Sheet, room_world
from ninja_game.sim.collision.tiles import (
    CENTRE_X,
    CENTRE_Y,
    COLUMN,
    EXISTS,
    FACE,
    NEIGHBOUR_OFFSET,
    ROW,
    UNIT_X,
    UNIT_Y,
)
from ninja_game.sim.grid import cell_at
from ninja_game.sim.objects.door import write_edges

FACES = ("none", "partial", "full")
STATES = ("off", "interesting", "solid")
SIDES: Sequence[tuple[str, object]] = (("right", 0), ("down", 1), ("left", 2), ("up", 3))


class EdgeStates(Figure):
    """Paint tiles; every edge shows its state, and the chosen one says why."""

    name = "edges"
    start = (180.0, 156.0)
    tile: float = 1
    side = 1
    is_open = FigureSetting(False, "move_door")

    def reset(self) -> None:
        super().reset()
        self.rows = [list(row) for row in self.room]
        self._rebuild()

    def _rebuild(self) -> None:
        self.tiles, self.world = room_world(["".join(row) for row in self.rows], self.objects)
        self.move_door()

    def move_door(self) -> None:
        """Open or close it as is wanted."""
        write_edges(self.world, self.world.objects[self._door], not self.is_open)

    @property
    def _door(self) -> int:
        """The slot of the only object that has edges."""
        return next(slot for slot in range(1, self.world.slots_used) if self.world.objects[slot].edge_1)

    def controls(self) -> Sequence[Control]:
        return [
            self.slider("Tile to paint", (0, 33, 1), "tile", lambda number: tile_name(int(number))),
            self.choice("Side", SIDES, "side"),
            self.choice("Door", (("closed", False), ("open", True)), "is_open"),
        ]

    def press(self, x: float, y: float) -> None:
        """Paint the cell; one that has the tile already becomes empty."""
        self.drag(x, y)
        row, column = ROW[self.cell] - 1, COLUMN[self.cell] - 1
        if 0 <= row < len(self.rows) and 0 <= column < len(self.rows[0]) and self.rows[row][column] != "&":
            wanted = TILE_CHARS[int(self.tile)]
            self.rows[row][column] = "." if self.rows[row][column] == wanted else wanted
            self._rebuild()

    def nudge(self, dx: int, dy: int) -> None:
        self.drag(self.x + 24 * dx, self.y + 24 * dy)

    def demonstrate(self, tick: int) -> None:
        """Another side every second, the door now and then."""
        self.side, self.is_open = tick // 40 % 4, tick // 80 % 2 == 1
        self.drag(180.0 + 24 * (tick // 160 % 3), 156.0)

    @property
    def cell(self) -> int:
        return cell_at(self.x, self.y)

    def numbers(self) -> list[tuple[str, str]]:
        neighbour = self.cell + NEIGHBOUR_OFFSET[self.side]
        own = FACE[4 * self.tiles.tiles[self.cell] + self.side]
        other = FACE[4 * self.tiles.tiles[neighbour] + (self.side ^ 2)]
        states = [self.world.edges[4 * cell + side] for cell in range(len(EXISTS)) if EXISTS[cell] for side in range(4)]
        return [
            ("cell", f"column {COLUMN[self.cell]}, row {ROW[self.cell]}: {tile_name(self.tiles.tiles[self.cell])}"),
            ("1. its own face there", FACES[own]),
            ("2. the neighbour's face", FACES[other] if EXISTS[neighbour] else "there is no neighbour"),
            ("3. the state", STATES[self.world.edges[4 * self.cell + self.side]]),
            ("in the level", ", ".join(f"{states.count(state)} {name}" for state, name in enumerate(STATES))),
        ]

    def draw(self, sheet: Sheet) -> None:
        p = sheet.palette
        sheet.tiles(self.tiles)
        sheet.grid()
        sheet.edges(self.world)
        x, y = CENTRE_X[self.cell], CENTRE_Y[self.cell]
        sheet.shade(self.cell, p.good, 90)
        sheet.arrow(p.good, (x, y), (x + 17 * UNIT_X[self.side], y + 17 * UNIT_Y[self.side]), 3)
        door = self.world.objects[self._door]
        cell, side = divmod(door.edge_1, 4)
        middle = CENTRE_X[cell] + 12 * UNIT_X[side], CENTRE_Y[cell] + 12 * UNIT_Y[side]
        sheet.text("door", middle[0], middle[1] - 18, colour=p.lock)
