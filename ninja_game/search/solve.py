"""Find a run to the exit and shorten it on all threads; the best run so far can be read at any time.

With one job the same seed does the same work in the same order: the clock only decides when it ends.
"""

from __future__ import annotations

import gc
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from contextlib import suppress
from functools import cache, cached_property
from math import inf
from threading import Event, Lock

from ninja_game.backend.kernel_cache import are_cached
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.replay.text import Replay
from ninja_game.search.best_first import MORE, expand
from ninja_game.search.certificate import UnverifiedRunError, with_plain_triggers
from ninja_game.search.gold_beam import GoldBeam
from ninja_game.search.heuristics import Heuristics
from ninja_game.search.legs import piece_numbers
from ninja_game.search.local_search import local_search
from ninja_game.search.nodes import Resolution, open_start
from ninja_game.search.route import LEG_NODES, Route
from ninja_game.search.searching import Search
from ninja_game.search.spans import RunShortener
from ninja_game.search.task import (
    FOUND_BOUND,
    GIVEN_BOUND,
    GIVEN_ROUTE_TURNS,
    GOLD_BEAM_TICKS,
    OTHER_ROUTE_TICKS,
    OTHER_ROUTE_TURNS,
    OTHER_ROUTES,
    SEARCH_COST,
    SLICE,
    Report,
    SharedProgress,
    Task,
    WorkPlan,
    plan_first_run,
)


class _Job:
    """One of the solver's threads: the searches of its turn, one after the other, with its own memory and seed."""

    def __init__(self, state: SharedProgress, number: int) -> None:
        task = state.task
        self.state = state
        self.number = number
        self.seed = task.seed * 1000 + number
        self.work = 0.0
        self.plan = WorkPlan()
        self.start = open_start(task.level, box=task.body == "box")
        self.heuristics = Heuristics(self.start.maps, self.start.worlds)
        self._gold_beam: GoldBeam | None = None
        self._turn = self._routes_tried = 2 * number
        self.shortener = RunShortener(
            self.start, self.heuristics, gold=task.gold_wanted, seed=self.seed, submit=state.submit, spend=self._spend
        )

    def run(self) -> None:
        """Find a run, look for other routes, shorten; until the end."""
        state, plan = self.state, self.plan
        if not state.runs:
            self._find()
        route_turns = GIVEN_ROUTE_TURNS if state.task.first else OTHER_ROUTE_TURNS
        while not self._over and state.runs:
            self._turn += 1
            if state.task.gold_wanted:
                self._shorten_with_gold()
            elif self._early or (self.work > 0 and self._turn % route_turns == 2):
                self._search_other_route()
            else:
                # Mostly the best run; now and then another one that may have more potential.
                follows_run = state.task.first and not state.task.others
                rank = (0, 1, 0, 2, 0)[self._turn % 5] if not follows_run else 0
                with state.lock:
                    inputs = state.runs[min(rank, len(state.runs) - 1)]
                if state.task.first and not self.work:
                    inputs = self.shortener.search_locally(inputs, plan.first_local)
                inputs = self.shortener.search_spans(inputs, plan.spans)
                self.shortener.search_locally(inputs, plan.local)

    def compile(self) -> None:
        """Compile all kernels by doing a little of everything."""
        self.run()
        best = self.state.runs[0]
        self.shortener.compile(best)
        self._search.begin(OTHER_ROUTES[0], seed=0, bound=len(best), backed_up=True)

    @property
    def _early(self) -> bool:
        """Whether this part of the time only looks for other routes; a given run has no such part."""
        task = self.state.task
        return not task.first and self.work < self.plan.routes_until * task.work_planned

    def _spend(self, played: int, cost: float) -> bool:
        self.work += cost
        self.state.count(played, "shortening")
        return self._over

    @property
    def _over(self) -> bool:
        return self.state.is_over or bool(self.state.task.work and self.work >= self.state.task.work)

    @cached_property
    def _search(self) -> Search:
        nodes = int(min(1_500_000, max(100_000, self.state.task.work_planned / 80)))
        return Search(self.start, self.heuristics, nodes=nodes)

    @cached_property
    def _leg_search(self) -> Search:
        return Search(self.start, self.heuristics, nodes=LEG_NODES)

    def _find(self) -> None:
        route = Route(self._leg_search, gold=self.state.task.gold_wanted, seed=self.seed * 1000 + 1)
        if self.state.task.gold_wanted:
            self._follow(route, inf)
            return
        for resolution, ticks, turn in plan_first_run(self.number):
            if self._over or self.state.runs:
                return
            if turn:
                self._follow(route, ticks)  # switch by switch: for long ways
            self._search_once(resolution, ticks, seed=turn, bound=0)

    def _shorten_with_gold(self) -> None:
        """Shorten a run with gold by a beam search of legs, then by a local search; submit the results."""
        best = self.state.runs[0]
        if self._gold_beam is None:
            self._gold_beam = GoldBeam(self._leg_search, best, seed=self.seed)
        elif len(best) < self._gold_beam.ticks:
            self._gold_beam.add_run(best)
        until = self.work + GOLD_BEAM_TICKS * SEARCH_COST

        def spend(played: int) -> bool:
            return self._spend(played, played * SEARCH_COST)

        while self.work < until and not spend(0):
            run = self._gold_beam.search_depths(spend)
            if run:
                self.state.submit(run)
        best, plan = self.state.runs[0], self.plan
        self.shortener.search_spans(self.shortener.search_locally(best, plan.local), plan.spans_with_gold)

    def _follow(self, route: Route, ticks: float) -> None:
        """Search a run in legs for this many ticks, and submit it if one is found."""
        doing = f" of {route.gold} gold" if route.gold else ""
        until = self.work + ticks * SEARCH_COST
        first = not self.state.runs

        def spend(played: int) -> bool:
            self.work += played * SEARCH_COST
            self.state.count(played, f"{route.most}{doing}" if doing else "searching")
            return self._over or self.work >= until or bool(self.state.runs and first)

        run = None
        while not run and not spend(0):
            run = route.step(spend)
        pieces = self.heuristics.gold_ids
        never = [id_ for piece, id_ in enumerate(pieces) if not route.ever_taken >> piece & 1] if route.gold else None
        last = [pieces[piece] for piece in piece_numbers(route.last_taken)]
        self.state.note_unreached(route.search.untouched, route.most, never, last)
        if run:
            self.state.submit(run)

    def _search_other_route(self) -> None:
        """Search a run from the start that may take another route than the best run; shorten the result."""
        turn, self._routes_tried = self._routes_tried, self._routes_tried + 1
        resolution = OTHER_ROUTES[turn % len(OTHER_ROUTES)]
        with self.state.lock:
            shortest = len(self.state.runs[0])
        resolution = resolution._replace(slack=resolution.slack * shortest)
        follows_run, early = bool(self.state.task.first), self._early
        bound = shortest + max(4, int(shortest * (GIVEN_BOUND if follows_run else FOUND_BOUND)))
        other_run = self._search_once(
            resolution, OTHER_ROUTE_TICKS, seed=100 + turn, bound=bound, backed_up=resolution.slack > 0.0
        )
        if not early and not other_run:
            return
        run = self.shortener.search_locally(other_run or self.state.runs[0], self.plan.local)
        if not early and len(run) < shortest * (1.0 + FOUND_BOUND):
            self.shortener.search_spans(run, self.plan.spans)

    def _search_once(
        self, resolution: Resolution, ticks: int, *, seed: int, bound: int, backed_up: bool = False
    ) -> bytes | None:
        search, first = self._search, not self.state.runs
        search.begin(resolution, seed=self.seed * 1000 + seed, bound=bound, backed_up=backed_up)
        ended = MORE
        while ended == MORE and search.ticks < ticks and not self._over:
            before = search.ticks
            ended = search.run(min(SLICE, ticks - before))
            self.work += (search.ticks - before) * SEARCH_COST
            self.state.count(search.ticks - before, "searching")
            if first and (self.state.runs or search.best()):
                break
        if not self.state.runs:
            self.state.note_unreached(search.untouched)
        best = search.best()
        if not best:
            return None
        self.state.submit(best)
        return best


SMALL_LEVEL = "0" * 713 + "|5^100,566!11^160,564,130,564!0^115,566"
"""The level that is played to compile kernels; machine code does not depend on the level."""


_COMPILING = Lock()


def is_solver_compiled() -> bool:
    """Whether this machine has machine code of the solver, so that it only has to be loaded."""
    return bool(compile_once.cache_info().currsize) or are_cached((expand, local_search), checked=False)


def compile_solver() -> None:
    """Compile all kernels by solving a small level first, so that no clock runs while Numba works.

    This happens once in a process; a second thread waits for the first. Raises MemoryUnavailableError without Numba.
    """
    with _COMPILING:
        compile_once()


@cache
def compile_once() -> None:
    for gold in (0, -1):
        _Job(SharedProgress(Task(parse_level_string(SMALL_LEVEL), gold=gold, work=30_000), None), 0).compile()


def solve(
    task: Task,
    *,
    report: Report | None = None,
    on_better: Callable[[Replay], None] | None = None,
    stop: Event | None = None,
) -> Replay | None:
    """The best run to the exit found within the time, None if there is none.

    ``report`` is called a few times a second, ``on_better`` with every verified run that is shorter than those before.
    ``task.first``: a run to start from; it is only improved, and ``on_better`` gets it first. ``stop``: ends the search
    when it is set. Raises LevelError for a level that cannot be played, MemoryUnavailableError without Numba,
    UnverifiedRunError for a first run that does not reach the exit.
    """
    compile_solver()
    state = SharedProgress(task, report, on_better=on_better, cancelled=stop or Event())
    if task.first:
        state.submit(with_plain_triggers(task.level, task.first, body=task.body, gold=task.gold_wanted))
    for other in task.others:
        with suppress(UnverifiedRunError):
            state.submit(with_plain_triggers(task.level, other, body=task.body, gold=task.gold_wanted))
    try:
        _work(state)
    finally:
        gc.collect()  # a job and its shortener refer to each other, and hold up to 1 GB
    return state.best


def _work(state: SharedProgress) -> None:
    jobs = [_Job(state, number) for number in range(state.task.jobs)]
    if len(jobs) == 1:
        jobs[0].run()
        return
    with ThreadPoolExecutor(len(jobs)) as pool:
        running = {pool.submit(job.run) for job in jobs}
        try:
            while running:
                done, running = wait(running, timeout=0.2, return_when=FIRST_COMPLETED)
                for job in done:
                    job.result()
        finally:
            state.stop.set()
