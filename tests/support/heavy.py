"""The costliest level that there is room for, and runs on it: what costs much and takes little text."""

from ninja_game.sim.kinds import BOUNCE_BLOCK, NINJA
from ninja_game.sim.level import TILES, Level, ObjectSpec
from ninja_game.sim.schema.world_fields import CAPACITY

START = 396.0, 566.0


def heavy_level(blocks: int = CAPACITY - 2) -> Level:
    """A ninja that touches this many bounce blocks at once: all of them stay awake."""
    block = ObjectSpec(BOUNCE_BLOCK, (START[0] + 19.5, START[1]))
    return Level((0,) * TILES, (ObjectSpec(NINJA, START), *[block] * blocks))
