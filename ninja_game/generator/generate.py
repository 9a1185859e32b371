"""Generate a level: compose, let the solver pass it, measure, add or spare hazards, until it is as hard as wanted.

The same seed, difficulty and version give the same level on every machine: all work is counted in ticks, never timed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from random import Random
from threading import Event

from ninja_game.batch.difficulty import TRIES, difficulty
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.replay.text import Replay
from ninja_game.generator.compose import compose
from ninja_game.generator.layouts import LAYOUTS
from ninja_game.generator.naming import AUTHOR, name_for
from ninja_game.generator.obstacles import mines_beside, nearest_hazard
from ninja_game.generator.scene import Point, Scene
from ninja_game.runs.run import run_level
from ninja_game.search.certificate import UnverifiedRunError, verified_run
from ninja_game.search.solve import Task, solve
from ninja_game.sim.level import Level

EASIEST, HARDEST = 1, 10
"""What may be asked for: the number that the difficulty of the level is to have, about."""

FIND_TICKS, SHORTEN_TICKS = 5_000_000, 3_000_000
"""Work of the solver on one attempt, and on its changed hazards."""
ATTEMPTS = 9
"""Attempts that the solver looks at; of those it passes the nearest to what is wanted is taken."""
ROUNDS = 14
"""Changes of the hazards of one attempt."""
TRIES_TO_COMPOSE = 400


@dataclass(frozen=True)
class Generated:
    """A level with its certificate. ``difficulty``: measured; ``attempts``: how many the solver looked at."""

    name: str
    comment: str
    level: Level
    run: Replay
    difficulty: float
    attempts: int

    @property
    def author(self) -> str:
        """Who made it."""
        return AUTHOR

    @property
    def text(self) -> str:
        """The level as an ASCII file."""
        return write_ascii_level(self.level, name=self.name, author=AUTHOR, comment=self.comment)


@dataclass(frozen=True)
class Budget:
    """How much work is done: see the constants; ``tries`` as ``difficulty`` has them."""

    find: int = FIND_TICKS
    shorten: int = SHORTEN_TICKS
    attempts: int = ATTEMPTS
    rounds: int = ROUNDS
    tries: int = TRIES


DEFAULT = Budget()


def generate(
    seed: int | str,
    wanted: int,
    *,
    budget: Budget | None = None,
    report: Callable[[str], None] = lambda _: None,
    stop: Event | None = None,
) -> Generated | None:
    """The level of a seed that is about ``wanted`` hard, None if no attempt of the seed can be passed or if stopped.

    ``report`` gets a line now and then. Raises MemoryUnavailableError without Numba.
    """
    budget = budget or DEFAULT
    stop = stop or Event()
    best: Generated | None = None
    looked_at = 0
    rng = Random(f"{seed}/{wanted}")  # noqa: S311 - not for secrets
    plans = [rng.choice(list(LAYOUTS)) for _ in range(TRIES_TO_COMPOSE)]
    for number, plan in enumerate(plans):
        if looked_at >= budget.attempts or stop.is_set():
            break
        rng = Random(f"{seed}/{wanted}/{number}")  # noqa: S311
        scene = compose(plan, rng, wanted)
        if scene is None:
            continue
        looked_at += 1
        report(f"attempt {looked_at} of at most {budget.attempts}: {plan}")
        found = _certified(scene, rng, wanted, budget, stop)
        if found is None or stop.is_set():
            continue
        run, measured = found
        name = name_for(plan, rng)
        comment = f"seed {seed}, difficulty {wanted}: measured {measured:.1f}"
        made = Generated(name, comment, scene.level, run, measured, looked_at)
        if best is None or abs(measured - wanted) < abs(best.difficulty - wanted):
            best = made
        if _near(measured, wanted):
            break
    return best and replace(best, attempts=looked_at)


def _near(measured: float, wanted: int) -> bool:
    """Whether a measured difficulty is what was asked for."""
    return abs(measured - wanted) <= max(0.5, 0.15 * wanted)


def _certified(scene: Scene, rng: Random, wanted: int, budget: Budget, stop: Event) -> tuple[Replay, float] | None:
    """A run through a scene whose hazards are changed until it is as hard as wanted, and how hard it is then."""
    run = solve(Task(scene.level, work=budget.find), stop=stop)
    if run is None:
        return None
    measured = difficulty(scene.level, run.inputs, tries=budget.tries)
    spared = False
    for _ in range(budget.rounds):
        if _near(measured, wanted) or stop.is_set():
            break
        path = path_of(scene.level, run)
        before = list(scene.hazards)
        if measured < wanted:
            more = mines_beside(scene, path, rng)
            if not more:
                break
            scene.hazards.append(more)
        else:
            number = nearest_hazard(scene, path)
            if number is None:
                break
            del scene.hazards[number]
            spared = True
        try:
            changed = verified_run(scene.level, run.inputs)
        except UnverifiedRunError:
            scene.hazards = before
            continue
        then = difficulty(scene.level, changed.inputs, tries=budget.tries)
        # What makes it worse than it was, the other way, is taken back.
        if abs(then - wanted) > abs(measured - wanted) and (then > measured) == (measured < wanted):
            scene.hazards = before
            continue
        run, measured = changed, then
    if spared:
        shorter = solve(Task(scene.level, work=budget.shorten, first=run.inputs), stop=stop)
        if shorter and shorter.end_tick < run.end_tick:
            run, measured = shorter, difficulty(scene.level, shorter.inputs, tries=budget.tries)
    return run, round(measured, 2)


def path_of(level: Level, run: Replay) -> Sequence[Point]:
    """Where the ninja is in each tick of a run, px."""
    return [(x, y) for x, y in run_level(level, run.inputs).positions.tolist()]
