"""All drawings on one picture, recorded as `tests/play/golden/drawings.png`.

Look at it critically after a change of any drawing: would a player buy this?
"""

import pygame

from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import Palette, Theme
from ninja_game.view.effects import particles
from ninja_game.view.ninja.figure import (
    _FALL,
    DANCES,
    FLOAT,
    LEAP,
    RISE,
    SKID,
    SLIDE,
    STAND,
    Pose,
    ninja_sprite,
    run_pose,
)
from ninja_game.view.sprites import moving_sprites as moving, static_sprites as static
from ninja_game.view.sprites.drawing import SpriteBook, SpriteKey

SCALE = 3.0
CELL = 150, 138
COLUMNS = 12
MARGIN = 24

Shown = tuple[str, list[tuple[SpriteKey, float, float]]]
"""A label, and drawings with where their points lie, px from the middle of the cell."""


def one(label: str, key: SpriteKey, at: tuple[float, float] = (0, 0)) -> Shown:
    """A cell with a single drawing."""
    return label, [(key, *at)]


def drone(label: str, weapon: int, *, seeker: int = 0, chasing: int = 0, heat: int = 0, mood: int = 0) -> Shown:
    """A drone with its eye, and its barrel if it has one."""
    body = moving.drone(weapon, seeker, chasing, heat if weapon == 1 else 0)
    parts: list[tuple[SpriteKey, float, float]] = [(body, 0, 3)]
    if weapon == 2:
        parts.append((moving.barrel(0, heat), 0, 3))
    parts.append((moving.eye(mood), 4.5, 3))
    return label, parts


THINGS: list[Shown] = [
    one("gold", static.gold()),
    *(one(f"gold taken {k}", static.gold_streak(k), at=(0, 14)) for k in (2, 5)),
    one("mine", static.mine()),
    one("exit, closed", static.exit_door(0)), one("exit, opening", static.exit_door(4)),
    one("exit, open", static.exit_door(8)),
    one("switch", static.exit_switch(0)), one("switch, pressed", static.exit_switch(1)),
    one("door, closed", static.door(0, 0)), one("door, half", static.door(0, 4)),
    one("door, open", static.door(0, 8)),
    one("lock, closed", static.door(1, 0)), one("lock, opening", static.door(1, 4)),
    one("lock, open", static.door(1, 8)),
    one("key", static.door_switch(1, 0)), one("key, used", static.door_switch(1, 1)),
    one("trap, closing", static.door(2, 4)), one("trap, closed", static.door(2, 0)),
    one("snare", static.door_switch(2, 0)), one("snare, used", static.door_switch(2, 1)),
    one("pad", static.launch_pad(0)), one("pad, sprung", static.launch_pad(8)),
    one("pad, slanted", static.launch_pad(0).turned(45)),
    one("one-way", static.one_way()), one("one-way, left", static.one_way().turned(-90)),
    one("turret", static.turret_base(0)), one("turret, locked", static.turret_base(8)),
    *(one(f"crosshair, {name}", static.crosshair(k)) for k, name in enumerate(("far", "mid", "near", "locked"))),
    one("launcher", static.launcher_base(0)), one("launcher, ready", static.launcher_base(8)),
    ("rocket", [*((moving.flame(6 - k).faded(2 + k), 2.6 * k - 14, 0) for k in range(6)), (moving.rocket(1), 12, 0)]),
    one("block", moving.bounce_block(0)), one("block, awake", moving.bounce_block(1)),
    one("thwump", moving.thwump(0, 0)), one("thwump, falling", moving.thwump(1, 1)),
    one("thwump, rising", moving.thwump(2, 0)), one("thwump, left", moving.thwump(0, 0).turned(90)),
    one("guard", moving.floor_guard(0, 0)), one("guard, running", moving.floor_guard(1, 1)),
    drone("zap drone", 0), drone("seeker", 0, seeker=1), drone("seeker, chasing", 0, seeker=1, chasing=1, mood=1),
    drone("laser drone", 1), drone("laser, charging", 1, heat=5, mood=2), drone("laser, firing", 1, heat=8, mood=2),
    drone("chaingun drone", 2), drone("chaingun, firing", 2, heat=8, mood=2),
    one("laser burst", moving.impact_burst(8)), one("lightning", static.lightning(0)),
    one("fireball", particles.fireball(2, 0)), one("fireball, late", particles.fireball(6, 1).faded(5)),
    one("explosion", particles.burst_star(3)), one("muzzle flash", particles.muzzle(1)),
    one("dust", particles.puff("dust", 2, 0)), one("smoke", particles.puff("smoke", 5, 1).faded(6)),
]  # fmt: skip
"""Every thing in every state that looks different."""

POSES: list[tuple[str, Pose, float]] = [
    ("stand", STAND, 0), ("skid", SKID, 3), ("slide", SLIDE, 0), ("leap", LEAP, 3), ("rise", RISE, 1),
    ("float", FLOAT, 2), ("fall", _FALL, 2),
    *((f"run {k}/6", run_pose(k / 6, 5.0), 5) for k in range(6)),
    *((f"dance {k + 1}", dance.at(9)[0].placed(1, dance.at(9)[1]), 0) for k, dance in enumerate(DANCES)),
]  # fmt: skip
"""The ninja's poses, with the speed that makes its band fly."""


def paint_things(palette: Palette) -> pygame.Surface:
    """The table of things, and below it the ninja."""
    first = -(-len(THINGS) // COLUMNS) * COLUMNS
    rows = -(-(first + len(POSES)) // COLUMNS)
    sheet = pygame.Surface((2 * MARGIN + COLUMNS * CELL[0], 2 * MARGIN + rows * CELL[1]))
    sheet.fill(palette.background)
    theme = Theme(palette, Canvas((1188, 900)))
    book = SpriteBook(SCALE, palette)
    for place in [*range(len(THINGS)), *range(first, first + len(POSES))]:
        x = MARGIN + place % COLUMNS * CELL[0] + CELL[0] // 2
        y = MARGIN + place // COLUMNS * CELL[1] + CELL[1] // 2 - 12
        if place < len(THINGS):
            label, parts = THINGS[place]
            for key, dx, dy in parts:
                book.sprite(key).blit(sheet, (round(x + dx * SCALE), round(y + dy * SCALE)))
        else:
            label, pose, speed = POSES[place - first]
            ninja_sprite(SCALE, palette, pose, 1, (speed, 0), colour=palette.ninja).blit(sheet, (x, y))
        text = theme.lettering.rendered(label, 9, palette.faint)
        sheet.blit(text, (x - text.get_width() // 2, y + CELL[1] // 2 - 8))
    return sheet
