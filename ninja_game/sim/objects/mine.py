"""Mine (objects.md §8.9)."""

from __future__ import annotations

from math import sqrt

from ..death import kill
from ..events import MINE_EXPLODED, emit
from ..grid import unfile
from ..memory import fast
from ..rules import MINE_RADIUS, RADIUS
from ..schema import Mine, World
from ..states import EXPLOSIVE


@fast
def touch_mine(w: World, o: Mine, slot: int) -> None:
    """Disc contact: the ninja dies and the mine is gone, in that order."""
    n = w.ninja
    dx = o.x - n.x
    dy = o.y - n.y
    if sqrt(dx * dx + dy * dy) < MINE_RADIUS + RADIUS:
        kill(w, EXPLOSIVE, -dx, -dy, o.x, o.y)
        o.spent = 1
        unfile(w, o)
        emit(w, MINE_EXPLODED, slot, o.x, o.y, 0.0, 0.0)
