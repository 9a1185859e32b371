"""The cost of a run, and the limit of work that an untrusted run may cause.

Work is counted, never timed: ticks, each at a cost that the level fixes. So a verdict depends on the run, the level and
the rules only, and is the same on every machine and on both memories.
"""

from __future__ import annotations

from ninja_game.errors import BudgetError
from ninja_game.sim.inputs import MAX_TICKS
from ninja_game.sim.kinds import KINDS
from ninja_game.sim.level import Level, check_level, makes_object

RUN_BUDGET = 320_000_000
"""Work of one run: the longest that N records on the largest level, a million ticks of 310 objects; 5 s compiled."""

PAGE_BUDGET = 3_000_000  # work of a run that a page judges, on its one thread: 10,000 ticks of 290 objects

PAGE_TICK_COST = 2_000
"""Most that a level may cost that a page opens: more objects would hold its thread; those of N cost up to 280."""

TURN_WORK = 15_000
"""Work between two pictures, where a window or a page shows a run: some 5 to 10 ms on the plain memory."""

PLAIN_WORK = 3_000_000
"""Work that the plain memory does in one to two seconds, as long as it takes to load compiled kernels."""

DATASET_MIB = 100
"""Size of the observations of demonstrations; arrays of them take four times as much memory. Here, so that the
command's help needs no Gymnasium."""

NO_LIMIT = 2**63  # the budget of what the player played here

NINJA_COST = 10  # Work of a tick without objects: the ninja's own. One is what most objects cost, some 10 ns compiled.

_COSTS = {kind.number: kind.cost for kind in KINDS}


def tick_cost(level: Level) -> int:
    """The most work that a tick of a level can be. Raises LevelError as ``check_level`` does."""
    try:
        return NINJA_COST + sum(_COSTS.get(spec.kind, 1) for spec in level.objects if makes_object(spec))
    except (AttributeError, TypeError):
        check_level(level)  # here, since it takes ten times as long as the sum
        raise


def affordable_ticks(level: Level, budget: int = RUN_BUDGET) -> int:
    """The number of ticks of a level that a budget pays for: at least one."""
    return min(MAX_TICKS, max(1, budget // tick_cost(level)))


def over_budget(level: Level, ticks: int, budget: int) -> BudgetError:
    """The error for a run that is not over after all the ticks that its budget pays for."""
    cost = tick_cost(level)
    found = f"{ticks:,} ticks of {cost:,} each, not over after {affordable_ticks(level, budget):,}"
    hint = "shorten its inputs if they go on after its end"
    option = f"--budget {ticks * cost} lets it run"
    expected = f"at most {budget:,}"
    return BudgetError("the run costs too much work", found=found, expected=expected, hint=hint, option=option)
