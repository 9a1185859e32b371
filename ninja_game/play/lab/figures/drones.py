"""The figure about walking enemies: drones follow edges, and so react to doors."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.formats.ascii.object_lines import MOVEMENTS
from ninja_game.play.lab.figure import ELSEWHERE, Control, Figure, FigureSetting, Sheet, Stage
from ninja_game.play.lab.figures.edges import DIRECTIONS, STATES
from ninja_game.sim.collision.tiles import CENTRE_X, CENTRE_Y, NEIGHBOUR_OFFSET, UNIT_X, UNIT_Y
from ninja_game.sim.grid import cell_at
from ninja_game.sim.kinds import DOOR, DRONE
from ninja_game.sim.memory.object_fields import Object
from ninja_game.sim.objects.door import write_edges
from ninja_game.sim.objects.drone import ROTATIONS
from ninja_game.sim.rules import DRONE_RADIUS


class WalkingEnemies(Figure):
    """Drones walk; click near a door to open or close it."""

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

    def _of_kind(self, kind: int) -> list[Object]:
        world = self.stage.world
        return [world.objects[slot] for slot in range(1, world.slots_used) if world.objects[slot].kind == kind]

    def press(self, x: float, y: float) -> None:
        """Open or close the door that is nearest."""
        self.drag(x, y)
        self.toggle(
            min(self._of_kind(DOOR), key=lambda o: abs(CENTRE_X[o.edge_1 // 4] - x) + abs(CENTRE_Y[o.edge_1 // 4] - y))
        )

    def drag(self, x: float, y: float) -> None:
        """Only a press does something."""

    def toggle(self, door: Object) -> None:
        """Open a closed door, close an open one."""
        door.switched = 1 - door.switched
        write_edges(self.stage.world, door, not door.switched)

    def demonstrate(self, tick: int) -> None:
        """A door every two seconds, another movement every eight."""
        if tick % 320 == 0:
            self.movement = list(MOVEMENTS)[tick // 320 % len(MOVEMENTS)]
        elif tick % 80 == 0:
            self.toggle(self._of_kind(DOOR)[tick // 80 % 2])

    def tick(self) -> None:
        """One tick; note what the drones that arrived have tried."""
        before = {o.slot: (o.cell, o.direction) for o in self._of_kind(DRONE)}
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
        found = []
        for rotation in ROTATIONS[4 * movement : 4 * movement + 4]:
            candidate = (max(direction, 0) + rotation) % 4
            found.append((candidate, self.stage.world.edges[4 * cell + candidate]))
            if NEIGHBOUR_OFFSET[candidate] + cell == cell_at(o.goal_x, o.goal_y):
                break
        return found

    def numbers(self) -> list[tuple[str, str]]:
        rows = []
        for number, o in enumerate(self._of_kind(DRONE), 1):
            tried = ", ".join(f"{DIRECTIONS[direction]} {STATES[state]}" for direction, state in self.tried(o))
            rows.append((f"drone {number} tried", tried or "nothing yet"))
        opened = sum(bool(door.switched) for door in self._of_kind(DOOR))
        return [
            *rows,
            ("doors open", f"{opened} of {len(self._of_kind(DOOR))}"),
            ("tick", str(self.stage.simulation.tick)),
        ]

    def draw(self, sheet: Sheet) -> None:
        """The game's own picture, the edges, what each drone tried."""
        p = sheet.palette
        self.stage.draw(sheet)
        sheet.grid()
        sheet.edges(self.stage.world)
        for number, o in enumerate(self._of_kind(DRONE), 1):
            sheet.circle(p.switch, o.x, o.y, DRONE_RADIUS, 1.5)
            sheet.text(str(number), o.x, o.y - 15)
            if o.slot in self.decided:
                x, y = CENTRE_X[self.decided[o.slot][0]], CENTRE_Y[self.decided[o.slot][0]]
                for direction, state in self.tried(o):
                    tip = x + 11 * UNIT_X[direction], y + 11 * UNIT_Y[direction]
                    sheet.arrow(p.bad if state else p.good, (x, y), tip, 1.5)
