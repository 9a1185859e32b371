"""Every drawing, shape by shape, against `golden/drawings.txt`: pictures are compared with a tolerance.

`python3 tools/dev.py accept-pictures` writes the file again. Numbers are logical px, colours are roles of the palette.
"""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from hashlib import sha256
from importlib import import_module
from inspect import signature
from itertools import chain, product
from pathlib import Path
from pkgutil import walk_packages
from random import Random
from typing import Any
from unittest.mock import DEFAULT, MagicMock, NonCallableMock, patch

import pygame

from ninja_game import play, view
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.states import BULLET, EXPLOSIVE
from ninja_game.simulation import Simulation
from ninja_game.ui import scenery
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import MOODS, PALETTES, Palette
from ninja_game.view.ninja import figure
from ninja_game.view.ninja.figure import DANCES, Pose, air_pose, paint_figure, run_pose
from ninja_game.view.ninja.ninja_animation import draw_ragdoll
from ninja_game.view.ninja.ragdoll import Ragdoll
from ninja_game.view.sprites import relief
from ninja_game.view.sprites.drawing import Drawing, DrawTarget, SpriteBook
from ninja_game.view.sprites.sketch import Sketch
from tests.support.draw_log import px, role_of
from tests.support.recorded import hold_against

GOLDEN = Path(__file__).parent / "golden" / "drawings.txt"
CLASSIC = PALETTES["classic"]
SHAPES = ("polygon", "box", "framed_box", "disc", "ring", "stroke", "limb")
VALUES: dict[str, tuple[Any, ...]] = {
    **dict.fromkeys(("active", "awake", "chasing", "flicker", "pressed", "seeker", "spin", "used"), (0, 1)),
    **dict.fromkeys(("mechanism", "mood", "variant"), (0, 1, 2)),
    **dict.fromkeys(("flame_phase", "look", "weapon"), (0, 1, 2, 3)),
    "colour": ("ninja",), "heat": (0, 5), "role": ("dust", "smoke"), "step": (0, 3, 7),
    "warning": ("rocket", "weapon", "chase", "turret"),
}  # fmt: skip
"""What the parameters of drawings are, by their names."""


def shapes(paint: Callable[..., None], palette: Palette, *values: Any) -> list[str]:
    """The lines of what is painted with these parameters."""
    lines: list[str] = []

    def word(value: Any) -> str:
        if isinstance(value, pygame.Color):
            return role_of(value, palette)
        given = value if isinstance(value, list | tuple) else [value]
        points = given if given and isinstance(given[0], tuple) else [given]
        return " ".join(px(*point) for point in points)

    def noted(name: str) -> Callable[..., None]:
        return lambda _, *given: lines.append(f"  {name} {'  '.join(map(word, given))}")

    with ExitStack() as stack:
        for name in SHAPES:
            stack.enter_context(patch.object(Sketch, name, noted(name)))
        paint(Sketch(1, (0, 0, 0, 0)), palette, *values)
    return lines


def drawings() -> Iterator[tuple[str, Drawing[Any]]]:
    """All drawings of the front end by name."""
    for module in (
        *walk_packages(play.__path__, "ninja_game.play."),
        *walk_packages(view.__path__, "ninja_game.view."),
    ):
        for each in vars(import_module(module.name)).values():
            if isinstance(each, Drawing) and each.paint.__module__ == module.name:
                yield each.paint.__name__, each


def lines_of_drawings() -> Iterator[str]:
    marked = replace(CLASSIC, danger_by_shape=True)
    for name, drawing in sorted(drawings(), key=lambda named: named[0]):
        yield f"{name} reaches {px(*drawing.extent)}"
        for values in product(*(VALUES[each] for each in [*signature(drawing.paint).parameters][2:])):
            plain, by_shape = (shapes(drawing.paint, palette, *values) for palette in (CLASSIC, marked))
            yield from (f"{name}{values}", *plain)
            if by_shape != plain:
                yield from (f"{name}{values}, danger by shape", *by_shape)


def painted(pose: Pose, facing: int, velocity: tuple[float, float], *, banded: bool) -> list[str]:
    paint = partial(paint_figure, colour=CLASSIC.ninja, banded=banded)
    return shapes(paint, CLASSIC, pose, facing, velocity)


def lines_of_the_ninja() -> Iterator[str]:
    poses = {name: pose for name, pose in vars(figure).items() if isinstance(pose, Pose)}
    poses |= {f"run {k}/12, {speed} px/tick": run_pose(k / 12, speed) for k in range(12) for speed in (1, 5)}
    poses |= {f"air {vy} px/tick": air_pose(vy) for vy in (-4, -2.5, -1.5, -0.5, 0, 1, 2, 3)}
    for number, dance in enumerate(DANCES):
        for tick in range(0, 60, 4):
            pose, turn = dance.at(tick)
            poses[f"dance {number} after {tick} ticks, turned {turn:.1f}"] = pose.placed(-1 if tick % 8 else 1, turn)
    for name, pose in poses.items():
        yield f"{name}: {' '.join(px(*joint) for joint in pose)}"
    for name in ("STAND", "RISE", "HANDSTAND"):
        for facing, velocity, banded in ((1, (0.0, 0.0), True), (-1, (5.0, -3.0), True), (1, (0.0, 0.0), False)):
            yield f"{name} facing {facing}, {velocity} px/tick, banded {banded}"
            yield from painted(poses[name], facing, velocity, banded=banded)
    yield "all joints in one place"
    heap = Pose(*[(0.0, 0.0)] * 7)
    yield from painted(heap, 1, (0.0, 0.0), banded=True)


def lines_of_the_corpse() -> Iterator[str]:
    target = DrawTarget(Canvas((792, 600)), CLASSIC, SpriteBook(1, CLASSIC))
    run = Simulation(Level(objects=(ObjectSpec(NINJA, (396.0, 300.0)),)))
    at = figure.STAND.moved(396, 300)
    for kind, facing in ((BULLET, 1), (EXPLOSIVE, -1)):
        doll = Ragdoll(at, at, (1.0, -1.0), facing, Random(3), lambda *_: None)
        doll.shove(kind, (6.0, -3.0), 296, 300)
        for _ in range(12):
            doll.step(run.tiles, run.world)
        yield f"corpse facing {facing}, in pieces {doll.dismembered}"
        yield from shapes(lambda _, palette, doll: draw_ragdoll(target, doll, 0.5, palette.ninja), CLASSIC, doll)


def lines_of_the_grounds() -> Iterator[str]:
    """The calls that paint scenery, grain and relief: how many of each sort, and a digest, as they are hundreds."""

    def numbers(value: Any) -> str:
        if isinstance(value, NonCallableMock):
            return ""
        return px(value) if isinstance(value, int | float) else " ".join(map(numbers, value))

    for palette in (CLASSIC, *MOODS):
        noted: dict[str, list[str]] = {}
        sheet = MagicMock(**{"canvas.scale": 1.5, "surface.size": (1188, 900)})
        with patch.multiple(scenery, pygame=DEFAULT) as painted, patch.multiple(relief, pygame=DEFAULT) as lit:
            ground: Any = scenery.scenery_sheet.__wrapped__(palette)
            ground.copy.return_value.width = 396
            with patch.multiple(relief, scenery_sheet=MagicMock(return_value=ground), grain=scenery.grain.__wrapped__):
                relief.add_relief(sheet, palette)
            calls = chain(painted["pygame"].mock_calls, lit["pygame"].mock_calls, sheet.mock_calls)
        for name, given, _ in calls:
            noted.setdefault(name.rpartition(".")[2], []).append(numbers(given))
        for name, lines in noted.items():
            yield f"{palette.name}: {len(lines)} {name} {sha256(repr(lines).encode()).hexdigest()[:8]}"


def test_every_drawing_is_as_recorded() -> None:
    lines = lines_of_drawings(), lines_of_the_ninja(), lines_of_the_corpse(), lines_of_the_grounds()
    hold_against(GOLDEN, [*chain(*lines)])
