"""The one table of the kinds of objects: number, name, record, fields, contact. All other tables derive from it.

How to add a kind: docs/new-kind.md.
"""

from __future__ import annotations

from typing import NamedTuple

from ninja_game.sim import rules
from ninja_game.sim.schema import object_fields as fields

GOLD, BOUNCE_BLOCK, LAUNCH_PAD, TURRET, FLOOR_GUARD, NINJA, DRONE = range(7)
ONE_WAY, THWUMP, DOOR, LAUNCHER, EXIT, MINE = range(7, 13)  # numbers of the level string (objects.md §5)

NO_KIND, SWITCH, INERT = -1, -2, -3
"""A record that creates nothing, an exit's switch, an object that does nothing. No record can name them."""


class Kind(NamedTuple):
    """What the rest of the game needs to know of a kind of objects.

    Doors with a switch are touched there, within ``rules.DOOR_SWITCH_RADIUS``.
    """

    number: int  #: type number in level strings, below 0 for kinds that only the game makes
    name: str  #: shown to people
    value_count: int  #: values of a record; with another number the object is inert (objects.md §2.1)
    fields: type  #: its class in the schema
    disc: float | None = None  #: radius of the disc that the ninja touches, px; a door's: of an automatic one
    box: float | None = None  #: half side of the square that the ninja touches, px; without both it cannot be touched
    killer: str = ""  #: name as a cause of death; "": it never kills
    by_touch: bool = False  #: whether touching it kills
    moves: bool = False  #: whether it is drawn in every frame, not once with the walls
    traced: bool = True  #: whether traces show it
    used: str = ""  #: the field that is 1 once it was taken, set off, opened or switched, if any
    cost: int = 1  #: its greatest work in a tick; above 1 for kinds that cast rays or never sleep


KINDS = (
    Kind(GOLD, "gold", 2, fields.Gold, disc=rules.GOLD_RADIUS, used="taken"),
    Kind(BOUNCE_BLOCK, "bounce block", 2, fields.BounceBlock, box=rules.BLOCK_HALF, moves=True),
    Kind(LAUNCH_PAD, "launch pad", 4, fields.LaunchPad, disc=rules.PAD_RADIUS),
    Kind(TURRET, "gauss turret", 2, fields.Turret, killer="gauss turret", moves=True, cost=10),
    Kind(
        FLOOR_GUARD, "floor guard", 3, fields.FloorGuard,
        disc=rules.GUARD_RADIUS, killer="floor guard", by_touch=True, moves=True, cost=2,
    ),
    Kind(NINJA, "ninja", 2, fields.Header, traced=False),
    Kind(
        DRONE, "drone", 6, fields.Drone,
        disc=rules.DRONE_RADIUS, killer="zap drone", by_touch=True, moves=True, cost=2,
    ),
    Kind(ONE_WAY, "one-way platform", 3, fields.OneWay, box=rules.ONE_WAY_HALF),
    Kind(THWUMP, "thwump", 3, fields.Thwump, box=rules.THWUMP_HALF, killer="thwump", by_touch=True, moves=True, cost=2),
    Kind(DOOR, "door", 9, fields.Door, disc=rules.AUTOMATIC_DOOR_RADIUS, used="switched"),
    Kind(
        LAUNCHER, "homing launcher", 2, fields.Launcher,
        disc=rules.ROCKET_RADIUS, killer="homing rocket", by_touch=True, moves=True, cost=10,
    ),
    Kind(EXIT, "exit", 4, fields.Exit, disc=rules.EXIT_RADIUS, used="is_open"),
    Kind(MINE, "mine", 2, fields.Mine, disc=rules.MINE_RADIUS, killer="mine", by_touch=True, used="exploded"),
    Kind(SWITCH, "exit switch", 0, fields.Switch, disc=rules.SWITCH_RADIUS, traced=False),
    Kind(INERT, "inert object", 0, fields.Header, traced=False),
)  # fmt: skip
"""Every kind: those of the level string in the order of their numbers, then the game's own."""

KIND_OF = {kind.number: kind for kind in KINDS}
KIND_NAMES = tuple(kind.name for kind in KINDS if kind.number >= 0)
VALUE_COUNTS = tuple(kind.value_count for kind in KINDS if kind.number >= 0)
"""``value_count`` of the kinds of the level string, by number."""

ENEMIES = tuple(kind.number for kind in KINDS if kind.killer and kind.moves)  # kinds that move or shoot, and kill
MOVING_ENEMIES = tuple(kind.number for kind in KINDS if kind.by_touch and kind.moves)
"""The enemies that kill by touch, not only by shots; for a launcher the touch is that of its rocket."""
