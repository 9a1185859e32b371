"""The figures about edge states: the four sides of a cell, doors, and drones that follow edges."""

from __future__ import annotations

from collections.abc import Sequence
from math import sin

from ninja_game.editor.palette import tile_name
from ninja_game.formats.ascii.legend import DIRECTION_WORDS, TILE_CHARS
from ninja_game.formats.ascii.object_lines import MOVEMENTS
from ninja_game.play.lab.figure import ELSEWHERE, Control, Figure, FigureSetting, Sheet, Stage, room_world
from ninja_game.play.lab.projection import Push, pushed
from ninja_game.sim.collision import tiles
from ninja_game.sim.collision.rays import ray_tiles, sees
from ninja_game.sim.grid import Point, cell_at
from ninja_game.sim.kinds import DOOR, DRONE
from ninja_game.sim.objects.door import write_edges
from ninja_game.sim.objects.drone import ROTATIONS, first_open
from ninja_game.sim.rules import DRONE_RADIUS, RADIUS
from ninja_game.sim.schema.object_fields import Object

FACES = ("none", "partial", "full")
_DIRECTIONS = tuple(DIRECTION_WORDS)
EDGE_WORDS = ("off", "interesting", "solid")
_SIDES: Sequence[tuple[str, object]] = (("right", 0), ("down", 1), ("left", 2), ("up", 3))


class EdgeStates(Figure):
    """Paint tiles; every edge shows its state, and the chosen edge also the reason."""

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
        write_edges(self.world, self.world.objects[self._door], not self.is_open)

    @property
    def _door(self) -> int:
        """The slot of the only object that has edges."""
        return next(slot for slot in range(1, self.world.slots_used) if self.world.objects[slot].edge_1)

    def controls(self) -> Sequence[Control]:
        return [
            self.slider("Tile to paint", (0, 33, 1), "tile", lambda number: tile_name(int(number))),
            self.choice("Side", _SIDES, "side"),
            self.choice("Door", (("closed", False), ("open", True)), "is_open"),
        ]

    def press(self, x: float, y: float) -> None:
        """Paint the cell; a cell with the same tile becomes empty."""
        self.drag(x, y)
        row, column = tiles.ROW[self.cell] - 1, tiles.COLUMN[self.cell] - 1
        if 0 <= row < len(self.rows) and 0 <= column < len(self.rows[0]) and self.rows[row][column] != "&":
            char = TILE_CHARS[int(self.tile)]
            self.rows[row][column] = "." if self.rows[row][column] == char else char
            self._rebuild()

    def nudge(self, dx: int, dy: int) -> None:
        self.drag(self.x + 24 * dx, self.y + 24 * dy)

    def demonstrate(self, tick: int) -> None:
        """Choose another side every second, and sometimes the door."""
        self.side, self.is_open = tick // 40 % 4, tick // 80 % 2 == 1
        self.drag(180.0 + 24 * (tick // 160 % 3), 156.0)

    def numbers(self) -> list[tuple[str, str]]:
        column, row = tiles.COLUMN[self.cell], tiles.ROW[self.cell]
        tile = self.tiles.ids[self.cell]
        neighbour = self.cell + tiles.NEIGHBOUR_OFFSET[self.side]
        face = tiles.FACE[4 * tile + self.side]
        other = tiles.FACE[4 * self.tiles.ids[neighbour] + (self.side ^ 2)]
        cells = [cell for cell, exists in enumerate(tiles.EXISTS) if exists]
        states = [self.world.edges[4 * cell + side] for cell in cells for side in range(4)]
        return [
            ("cell", f"column {column}, row {row}: {tile_name(tile)}"),
            ("1. its own face there", FACES[face]),
            ("2. the neighbour's face", FACES[other] if tiles.EXISTS[neighbour] else "there is no neighbour"),
            ("3. the state", EDGE_WORDS[self.world.edges[4 * self.cell + self.side]]),
            ("in the level", ", ".join(f"{states.count(state)} {name}" for state, name in enumerate(EDGE_WORDS))),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        sheet.tiles(self.tiles)
        sheet.grid()
        sheet.edges(self.world)
        x, y = tiles.CENTRE_X[self.cell], tiles.CENTRE_Y[self.cell]
        sheet.shade(self.cell, palette.good, 90)
        sheet.arrow(palette.good, (x, y), (x + 17 * tiles.UNIT_X[self.side], y + 17 * tiles.UNIT_Y[self.side]), 3)
        door = self.world.objects[self._door]
        cell, side = divmod(door.edge_1, 4)
        middle = tiles.CENTRE_X[cell] + 12 * tiles.UNIT_X[side], tiles.CENTRE_Y[cell] + 12 * tiles.UNIT_Y[side]
        sheet.text("door", middle[0], middle[1] - 18, colour=palette.lock)


class Doors(EdgeStates):
    """Drag a body to a door: what the door's two edge states mean for the body, a ray and a drone."""

    name = "doors"
    start = (199.0, 108.0)
    turret: Point = (60.0, 104.0)

    def controls(self) -> Sequence[Control]:
        return super().controls()[2:]

    press = Figure.press
    nudge = Figure.nudge

    def demonstrate(self, tick: int) -> None:
        self.is_open = tick // 80 % 2 == 1
        self.drag(self.start[0] + 12 * sin(tick / 20), self.start[1])

    @property
    def body(self) -> Push:
        return pushed(self.tiles, self.world, self.x, self.y)

    def ray(self) -> tuple[bool, Point]:
        """Whether the turret sees the body, and where its ray ends, px."""
        n = self.world.ninja
        n.x, n.y = self.body.points[-1]
        seen, *end = sees(self.tiles, self.world, *self.turret, n.x, n.y)
        _, *wall = ray_tiles(self.tiles, self.world, *self.turret, n.x, n.y)
        return bool(seen), (end[0], end[1]) if seen else (wall[0], wall[1])

    def drone_goes(self) -> str:
        """The direction that a drone chooses in the doorway, coming from the left."""
        drone = next(o for o in self.world.objects if o.kind == DRONE)
        drone.direction = 0
        return _DIRECTIONS[first_open(self.world, drone, drone.movement)]

    def numbers(self) -> list[tuple[str, str]]:
        door, points = self.world.objects[self._door], self.body.points
        return [
            ("left cell's state", EDGE_WORDS[self.world.edges[door.edge_1]]),
            ("right cell's state", EDGE_WORDS[self.world.edges[door.edge_2]]),
            ("the body is pushed", f"({points[-1][0] - self.x:+.1f}, {points[-1][1] - self.y:+.1f}) px"),
            ("the turret sees it", "yes" if self.ray()[0] else "no"),
            ("the drone goes", self.drone_goes()),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        sheet.tiles(self.tiles)
        sheet.grid()
        sheet.edges(self.world)
        seen, end = self.ray()
        sheet.arrow(palette.good if seen else palette.bad, self.turret, end, 1.5)
        sheet.circle(palette.bad, *self.turret, 4)
        sheet.body(palette.faint, self.x, self.y, RADIUS, box=False, width=1.5)
        sheet.body(palette.ninja, *self.body.points[-1], RADIUS, box=False, width=3)
        drone = next(o for o in self.world.objects if o.kind == DRONE)
        sheet.circle(palette.switch, drone.x, drone.y, DRONE_RADIUS, 2)
        side = _DIRECTIONS.index(self.drone_goes())
        goal = drone.x + 20 * tiles.UNIT_X[side], drone.y + 20 * tiles.UNIT_Y[side]
        sheet.arrow(palette.switch, (drone.x, drone.y), goal, 3)
        sheet.text("drone", drone.x - 32, drone.y - 14)
        sheet.text("turret", self.turret[0], self.turret[1] - 12)


class WalkingEnemies(Figure):
    """Open and close doors: drones choose their direction by the edges around their cell."""

    name = "drones"
    start = (180.0, 90.0)
    movement = FigureSetting("surface-cw")

    def reset(self) -> None:
        super().reset()
        drones = [f"zap drone {place} {self.movement} right" for place in ("3,2", "5,4", "13,7")]
        self.stage = Stage(self.room, [*self.objects, *drones, ELSEWHERE])
        self.decided: dict[int, tuple[int, int, int]] = {}

    def controls(self) -> Sequence[Control]:
        return [self.choice("Movement", [(name.replace("-", " "), name) for name in MOVEMENTS], "movement")]

    def of_kind(self, kind: int) -> list[Object]:
        world = self.stage.world
        return [world.objects[slot] for slot in range(1, world.slots_used) if world.objects[slot].kind == kind]

    def press(self, x: float, y: float) -> None:
        self.drag(x, y)

        def distance(door: Object) -> float:
            cell = door.edge_1 // 4
            return abs(tiles.CENTRE_X[cell] - x) + abs(tiles.CENTRE_Y[cell] - y)

        self.toggle(min(self.of_kind(DOOR), key=distance))

    def drag(self, x: float, y: float) -> None:
        """Dragging does nothing; only a press does."""

    def toggle(self, door: Object) -> None:
        door.switched = not door.switched
        write_edges(self.stage.world, door, not door.switched)

    def demonstrate(self, tick: int) -> None:
        """A door every two seconds, another movement every eight."""
        if tick % 320 == 0:
            self.movement = list(MOVEMENTS)[tick // 320 % len(MOVEMENTS)]
        elif tick % 80 == 0:
            self.toggle(self.of_kind(DOOR)[tick // 80 % 2])

    def tick(self) -> None:
        """One tick; record the directions that the deciding drones have tried."""
        before = {o.slot: (o.cell, o.direction) for o in self.of_kind(DRONE)}
        self.stage.step()
        for call in self.stage.calls:
            if call.name == "first_open":
                slot = int(call.arguments["o"])
                self.decided[slot] = (*before[slot], int(call.arguments["movement"]))

    def tried(self, o: Object) -> list[tuple[int, int]]:
        """The directions that a drone tried at its last decision, with the edge states that it read there."""
        if o.slot not in self.decided:
            return []
        cell, direction, movement = self.decided[o.slot]
        tries = []
        for rotation in ROTATIONS[4 * movement : 4 * movement + 4]:
            candidate = (max(direction, 0) + rotation) % 4
            tries.append((candidate, self.stage.world.edges[4 * cell + candidate]))
            if tiles.NEIGHBOUR_OFFSET[candidate] + cell == cell_at(o.goal_x, o.goal_y):
                break
        return tries

    def numbers(self) -> list[tuple[str, str]]:
        rows = []
        for number, o in enumerate(self.of_kind(DRONE), 1):
            tried = ", ".join(f"{_DIRECTIONS[direction]} {EDGE_WORDS[state]}" for direction, state in self.tried(o))
            rows.append((f"drone {number} tried", tried or "nothing yet"))
        opened = sum(bool(door.switched) for door in self.of_kind(DOOR))
        return [
            *rows,
            ("doors open", f"{opened} of {len(self.of_kind(DOOR))}"),
            ("tick", str(self.stage.simulation.tick)),
        ]

    def draw(self, sheet: Sheet) -> None:
        palette = sheet.palette
        self.stage.draw(sheet)
        sheet.grid()
        sheet.edges(self.stage.world)
        for number, o in enumerate(self.of_kind(DRONE), 1):
            sheet.circle(palette.switch, o.x, o.y, DRONE_RADIUS, 1.5)
            sheet.text(str(number), o.x, o.y - 15)
            if o.slot in self.decided:
                x, y = tiles.CENTRE_X[self.decided[o.slot][0]], tiles.CENTRE_Y[self.decided[o.slot][0]]
                for direction, state in self.tried(o):
                    tip = x + 11 * tiles.UNIT_X[direction], y + 11 * tiles.UNIT_Y[direction]
                    sheet.arrow(palette.bad if state else palette.good, (x, y), tip, 1.5)
