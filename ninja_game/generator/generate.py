"""Generate a level: compose it, let the solver pass it, measure it, change hazards until it is as hard as wanted.

The same seed, difficulty and version give the same level on every machine: work is counted in ticks, never in time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from random import Random
from threading import Event

from ninja_game.batch.difficulty import TRIES, difficulty
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.replay.text import Replay
from ninja_game.generator.compose import compose
from ninja_game.generator.gold import lay_trails
from ninja_game.generator.layouts import LAYOUTS, name_for
from ninja_game.generator.obstacles import hazards_beside, nearest_hazard
from ninja_game.generator.packed import named_level
from ninja_game.generator.scene import Scene
from ninja_game.runs.level_design import design_findings, measure_design
from ninja_game.runs.run import run_level
from ninja_game.search.certificate import UnverifiedRunError, verified_run
from ninja_game.search.solve import solve
from ninja_game.search.task import Task
from ninja_game.sim.grid import Point
from ninja_game.sim.level import Level

# Difficulties that can be asked for.
EASIEST = 1
HARDEST = 10

MORE_ATTEMPTS = 4  # factor of the attempts while none is about as hard as wanted; its square while none is passed
TRIES_TO_COMPOSE = 400


@dataclass(frozen=True)
class Generated:
    """A level with its certificate. ``difficulty``: the measured one."""

    named: NamedLevel
    run: Replay
    difficulty: float


@dataclass(frozen=True)
class Effort:
    """Amounts of work. ``tries``: as in ``difficulty``."""

    find: int = 1_500_000  #: work of the solver on one attempt
    shorten: int = 1_000_000  #: work on the attempt after its hazards were changed
    attempts: int = 3  #: for the solver; of those that it passes, the nearest to the wanted difficulty is taken
    rounds: int = 22  #: most changes of the hazards of an attempt
    tries: int = TRIES


DEFAULT = Effort()  # the amounts of work by default


def generate(
    seed: int | str,
    wanted: int,
    *,
    effort: Effort | None = None,
    report: Callable[[str], None] = lambda _: None,
    stop: Event | None = None,
) -> Generated | None:
    """Generate the level of a seed, about ``wanted`` hard; None if stopped, or if no attempt of the seed can be passed.

    ``report`` gets a line now and then. Raises MemoryUnavailableError without Numba.
    """
    effort = effort or DEFAULT
    stop = stop or Event()
    best: tuple[tuple[bool, bool, float], Generated] | None = None
    looked_at = 0
    for number in range(TRIES_TO_COMPOSE):
        far = best is None or best[0][0]
        times = 1 if not far else MORE_ATTEMPTS if best else MORE_ATTEMPTS**2
        if looked_at >= effort.attempts * times or stop.is_set():
            break
        rng = Random(f"{seed}/{wanted}/{number}")  # noqa: S311 - not for secrets
        plan = plan_of(seed if looked_at < effort.attempts else str(seed), rng)
        scene = compose(plan, rng, wanted)
        if scene is None:
            continue
        looked_at += 1
        report(f"attempt {looked_at}: {plan}")
        certified = _certified(scene, rng, wanted, effort, stop)
        if certified is None or stop.is_set():
            continue
        run, measured = certified
        lacking = len(list(design_findings(measure_design(scene.level, run.inputs))))
        named = named_level(name_for(plan, rng), scene.level, seed, wanted, measured)
        generated = Generated(named, run, measured)
        rank = not _is_near(measured, wanted, 2), lacking > 0, abs(measured - wanted)
        if best is None or rank < best[0]:
            best = rank, generated
        if _is_near(measured, wanted) and not lacking:
            break
    return best and best[1]


def plan_of(seed: int | str, rng: Random) -> str:
    """Choose the ground plan of an attempt: fifteen seeds in a row have fifteen plans."""
    layouts = list(LAYOUTS)
    return layouts[seed % len(layouts)] if isinstance(seed, int) else rng.choice(layouts)


def _is_near(measured: float, wanted: int, times: int = 1) -> bool:
    """Whether a measured difficulty is close enough to the wanted one, within ``times`` the usual tolerance."""
    return abs(measured - wanted) <= times * max(0.5, 0.15 * wanted)


def _certified(scene: Scene, rng: Random, wanted: int, effort: Effort, stop: Event) -> tuple[Replay, float] | None:
    """Change the hazards of a scene until it is as hard as wanted; gives a run through it and its difficulty."""
    run = solve(Task(scene.level, work=effort.find), stop=stop)
    if run is None:
        return None
    lay_trails(scene, path_of(scene.level, run), rng)
    run = verified_run(scene.level, run.inputs)
    measured = difficulty(scene.level, run.inputs, tries=effort.tries)
    eased = False
    for _ in range(effort.rounds):
        if _is_near(measured, wanted) or stop.is_set():
            break
        path = path_of(scene.level, run)
        before = list(scene.hazards)
        if measured < wanted:
            more = hazards_beside(scene, path, wanted, rng)
            if not more:
                break
            scene.hazards.append(more)
        else:
            number = nearest_hazard(scene, path)
            if number is None:
                break
            del scene.hazards[number]
            eased = True
        try:
            changed = verified_run(scene.level, run.inputs)
        except UnverifiedRunError:
            scene.hazards = before
            continue
        then = difficulty(scene.level, changed.inputs, tries=effort.tries)
        # Undo a change that overshoots so far that the level is farther from the wanted difficulty than before.
        if abs(then - wanted) > abs(measured - wanted) and (then > measured) == (measured < wanted):
            scene.hazards = before
            continue
        run, measured = changed, then
    if eased:
        shorter = solve(Task(scene.level, work=effort.shorten, first=run.inputs), stop=stop)
        if shorter and shorter.end_tick < run.end_tick:
            run = shorter
            measured = difficulty(scene.level, shorter.inputs, tries=effort.tries)
    return run, round(measured, 2)


def path_of(level: Level, run: Replay) -> Sequence[Point]:
    """The place of the ninja in each tick of a run, px."""
    return [(x, y) for x, y in run_level(level, run.inputs).positions.tolist()]
