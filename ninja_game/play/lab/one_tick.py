"""The figure about one tick: the real world, phase by phase, in slow motion."""

from __future__ import annotations

from collections.abc import Sequence

from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.play.lab.figure import Call, Control, Figure, Sheet, Stage
from ninja_game.sim.collision.tiles import EXISTS
from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, with_press_bit
from ninja_game.sim.kinds import KIND_OF
from ninja_game.sim.objects.dispatch import NINE_CELLS
from ninja_game.view.overlays import touched_cells

PHASES: dict[str, tuple[int, str]] = {
    "update_objects": (1, "the update set, newest first"),
    "think": (2, "one object thinks"),
    "tick_ninja": (3, "the ninja moves"),
    "touch_objects": (4, "asks nine cells"),
    "collide_circle": (5, "asks touched cells"),
    "evaluate_floor": (6, "judges its floor"),
    "probe_walls": (6, "feels for a wall"),
    "think_in_air": (7, "reads the keys, in the air"),
    "think_on_ground": (7, "reads the keys, on the ground"),
}
"""The rules that begin a phase of a tick; the phase's number and what it does."""

_SHOWN = 7
_KEYS: Sequence[tuple[str, object]] = (
    ("by itself", -1), ("none", 0), ("left", KEY_LEFT), ("right", KEY_RIGHT), ("jump", JUMP_HELD),
    ("jump right", KEY_RIGHT + JUMP_HELD), ("jump left", KEY_LEFT + JUMP_HELD),
)  # fmt: skip
LAB_INPUTS = read_inputs([(1, ".*10 R*30 RJ*20 R*30 L*40 LJ*25 L*30 .*10")]).keys


class OneTick(Figure):
    """Every call of a rule in one tick of a small level, in order, with its arguments and result."""

    name = "tick"
    keys = -1
    speed: float = 4

    def reset(self) -> None:
        super().reset()
        self.stage = Stage(self.room, self.objects)
        self.speed = 4
        self._next()

    def _next(self) -> None:
        """Simulate a tick and show its first call."""
        tick = self.stage.simulation.tick
        jump_held = self.stage.world.ninja.jump_held
        self.stage.step(LAB_INPUTS[tick % len(LAB_INPUTS)] if self.keys < 0 else with_press_bit(self.keys, jump_held))
        self.at = 0.0

    def controls(self) -> Sequence[Control]:
        speed = self.slider("Calls a second", (0, 400, 1), "speed", lambda calls: f"{calls:.0f}" if calls else "paused")
        return [self.choice("Keys", _KEYS, "keys"), speed]

    def press(self, x: float, y: float) -> None:
        self.nudge(1, 0)

    def drag(self, x: float, y: float) -> None:
        """Dragging does nothing; only a press does."""

    def nudge(self, dx: int, dy: int) -> None:
        """Right: the next call; left: the call before, in this tick; down: the next tick. The figure then waits."""
        self.speed = 0
        self.at = max(0.0, self.at + min(dx, 0))
        self._forward(len(self.calls) if dy > 0 else max(dx, 0))

    def demonstrate(self, tick: int) -> None:
        self.speed = 12 if tick % 480 < 320 else 400

    def _forward(self, calls: float) -> None:
        self.at += calls
        if self.at >= len(self.calls):
            self._next()

    def tick(self) -> None:
        self._forward(self.speed / 40)

    @property
    def calls(self) -> list[Call]:
        """The calls of the tick without the smallest ones: lookups of cells, bookkeeping of the memory."""
        return [call for call in self.stage.calls if call.depth and call.name not in ("cell_at", "pressed", "solid_at")]

    @property
    def phase(self) -> tuple[int, str]:
        """The number of the present phase, 0 before the first one, and what it does."""
        names = [call.name for call in self.calls[: int(self.at) + 1]]
        return next((PHASES[name] for name in reversed(names) if name in PHASES), (0, "a tick begins"))

    def numbers(self) -> list[tuple[str, str]]:
        first = max(0, int(self.at) - _SHOWN + 4)
        rows = []
        for number, call in enumerate(self.calls[first : first + _SHOWN - 2], first):
            o = self.stage.world.objects[int(call.arguments["o"])] if "o" in call.arguments else None
            about = f" ({KIND_OF[o.kind].name})" if o is not None and o.kind in KIND_OF else ""
            mark = ">" if number == int(self.at) else ""
            rows.append((f"{mark} {number + 1} of {len(self.calls)}", f"{'. ' * (call.depth - 1)}{call.name}{about}"))
        world = self.stage.world
        events = ", ".join(EVENT_NAMES[event.kind] for event in world.events[: world.event_count])
        phase, doing = self.phase
        return [(f"tick {world.tick}", f"{phase}. {doing}" if phase else doing), *rows, ("events", events or "none")]

    def draw(self, sheet: Sheet) -> None:
        palette, w = sheet.palette, self.stage.world
        self.stage.draw(sheet)
        call = self.calls[min(int(self.at), len(self.calls) - 1)]
        n = w.ninja
        number, _ = self.phase
        if number == 4 and EXISTS[n.cell]:
            for offset in NINE_CELLS:
                sheet.shade(n.cell + offset, palette.switch, 60)
        elif number == 5:
            for cell in touched_cells(n.x, n.y, n.cell):
                sheet.shade(cell, palette.good, 90)
        sheet.grid()
        if "o" in call.arguments:
            o = w.objects[int(call.arguments["o"])]
            sheet.circle(palette.accent, o.x, o.y, 15, 2.5)
        elif number >= 3:
            sheet.circle(palette.accent, n.x, n.y, 15, 2.5)
