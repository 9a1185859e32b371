"""A known run that a memory must reproduce before it judges other runs.

Other software can spoil the arithmetic of a process: by settings of a compiler, by modes of the processor, by foreign
machine code. A level with every kind of object and most shapes of tiles, played eight times with different keys, shows
that in some milliseconds.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from functools import cache
from hashlib import sha256

from ninja_game.backend.worlds import Worlds
from ninja_game.errors import NinjaGameError
from ninja_game.sim.digest import replay_digest
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.level import TILES, Level, ObjectSpec

DIGEST = "a9b523980fd14511af830676f2ff771f63e63377f06c53930c18638b709954e3"
"""The digest of all runs, on every machine. After a wanted change of a rule `python3 tools/dev.py golden` writes it."""

RUNS = 8  # number of runs; the last one uses the box
_TICKS = 400  # most ticks of a run

_OBJECTS = (
    (5, 132, 156), (0, 468, 516), (0, 588, 180), (0, 228, 156), (1, 540, 396), (1, 636, 372), (1, 204, 204),
    (2, 156, 348, 1, 0), (2, 684, 156, -1, 0), (2, 204, 204, 0, -1), (3, 372, 228), (4, 108, 132, 1),
    (4, 372, 300, 1), (6, 588, 156, 1, 1, 2, 1), (6, 564, 396, 1, 0, 0, 2), (6, 540, 252, 0, 1, 2, 0),
    (6, 492, 372, 1, 0, 1, 0), (7, 84, 372, 3), (7, 324, 180, 3), (7, 660, 252, 3), (8, 732, 444, 1),
    (8, 228, 180, 2), (8, 636, 492, 1), (9, 612, 468, 0, 1, 9, 8, 0, 0, 0), (9, 84, 300, 1, 1, 5, 17, 0, 0, 0),
    (9, 684, 156, 1, 0, 18, 8, 1, 0, 0), (10, 468, 396), (11, 492, 372, 180, 372), (11, 228, 396, 708, 276),
    (12, 396, 228), (12, 228, 84),
)  # fmt: skip
"""Kind and values of the objects."""


@cache
def known_level() -> Level:
    """The level of the known runs."""
    tiles = tuple(n % 34 if n % 7 == 0 else 0 for n in range(TILES))
    return Level(tiles, tuple(ObjectSpec(kind, tuple(values)) for kind, *values in _OBJECTS))


class SelfTestError(NinjaGameError):
    """The known run ends differently: no result of this process can be trusted."""


def check_self_test(open_world: Callable[[Level, bool], Worlds], memory: str) -> None:
    """Raise SelfTestError unless the known run ends as it must.

    ``open_world``: makes a new world in a level, with the box or not; ``memory``: the memory's name in messages.
    """
    digest = self_test_digest(open_world)
    if digest != DIGEST:
        raise SelfTestError(
            f"the {memory} memory does not compute the world of N here, so nothing is judged: a known run gives "
            f"{digest[:12]}…, expected {DIGEST[:12]}…; empty the folder of compiled code, or choose another --memory"
        )


def self_test_digest(open_world: Callable[[Level, bool], Worlds]) -> str:
    """Hash the known runs: the ninja's places, and all that the worlds show at the end."""
    digest = sha256()
    for number in range(RUNS):
        world = open_world(known_level(), number == RUNS - 1)
        places = world.run(known_keys(number)).places
        digest.update(struct.pack(f"<{len(places)}d", *places))
        digest.update(replay_digest(world.world()).encode())
    return digest.hexdigest()


def known_keys(number: int) -> bytes:
    """Make the keys of a run: all combinations, each held for 1 to 20 ticks."""
    keys = bytearray()
    while len(keys) < _TICKS:
        number = (number * 1103515245 + 12345) % 2**31
        keys += bytes([b"\0\1\2\1\2\3\5\6\4\6\5\6"[(number >> 16) % 12]] * (1 + (number >> 20) % 20))
    return with_press_bits(bytes(keys[:_TICKS]))
