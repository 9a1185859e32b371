"""Common aims for the ticks of a span, as the goal and the measure of a search."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, floor
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ninja_game.errors import ArgumentError
from ninja_game.runs.splits import Split, run_splits
from ninja_game.search.formula.task import MAX_SPAN
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.tas.session import TasSession

EXIT_TICKS = 5 * TICKS_PER_SECOND  # least ticks in which the exit is searched, for a run that does not reach it
IMPROVES = IMPROVE, IMPROVE_GOLD = "improve", "improve with the gold"
"""Methods for a whole run: with any gold, or with as much as it has."""
_NEAR = 6.0  # px within which the ninja is at a place
SAME_PLACE, SAME_VELOCITY = 0.5, 0.05  # greatest distance between two equal ends, px and px/tick


class SpanGoal(NamedTuple):
    """Goal and measure as formulas, ``least`` and ``rest`` as in a SpanTask; ``last``: another end, 0: the span's.

    ``why``: a description of the ticks if they are not the selected ones; ``method``: the required one, "": any.
    """

    goal: str = ""
    measure: str = ""
    least: bool = False
    rest: bool = False
    last: int = 0
    why: str = ""
    method: str = ""


@dataclass(frozen=True)
class SearchedSpan:
    """The ticks ``first`` … ``last`` - 1 of a run under edit."""

    session: TasSession
    first: int
    last: int

    @cached_property
    def end(self) -> dict[str, float]:
        """The ninja's values after the last tick. Raises as ``places`` does."""
        tick, column = self.last - 1, self.session.timeline.column
        x, y = self.places(tick)[0].tolist()
        prev_x, prev_y, state, gold = (float(column(name)[tick]) for name in ("prev_x", "prev_y", "state", "gold"))
        return {"x": x, "y": y, "vx": x - prev_x, "vy": y - prev_y, "state": state, "gold": gold}

    def places(self, first: int) -> NDArray[np.float64]:
        """The ninja's places from tick ``first`` on to the span's end, (ticks, 2), px.

        Raises ArgumentError for a span that ends after the run.
        """
        timeline, tick = self.session.timeline, self.last - 1
        timeline.ensure(tick)
        if tick >= timeline.simulated_until:
            raise ArgumentError(f"the span ends in tick {tick}, the run in tick {len(self.session.track) - 1}")
        return timeline.positions[first : self.last]


def be_there(span: SearchedSpan) -> SpanGoal:
    end = span.end
    return SpanGoal(f"distance({end['x']:.6g}, {end['y']:.6g}) < {_NEAR:g}")


def go_beyond(span: SearchedSpan) -> SpanGoal:
    x = span.end["x"]
    # Rounded so that the run itself has passed the line at its end.
    if x >= span.places(max(0, span.first - 1))[0, 0]:
        return SpanGoal(f"x >= {floor(x * 1000) / 1000:.7g}")
    return SpanGoal(f"x <= {ceil(x * 1000) / 1000:.7g}")


def reach_exit(span: SearchedSpan) -> SpanGoal:
    """Reach the exit from the first tick of the span on, by any route, sooner than the run if that reaches it."""
    tick, outcome = span.session.timeline.end
    known = tick if outcome == "exit" else max(len(span.session.track), span.first + EXIT_TICKS)
    why = "up to the run's exit" if outcome == "exit" else "to the end, 5 s at least"
    return SpanGoal("won", last=min(max(known, span.first + 1), span.first + MAX_SPAN), why=why)


def whole_run(span: SearchedSpan) -> SpanGoal:
    """Shorten the whole run, as `ninja-game improve` does; a run that ends before the exit is led there first."""
    tick, _ = span.session.timeline.end
    return SpanGoal("won", last=tick + 1 if tick >= 0 else len(span.session.track), why="the whole run", method=IMPROVE)


def collect(span: SearchedSpan) -> SpanGoal:
    """Take the piece of gold nearest to the span's end that the run has not taken by then.

    Raises ArgumentError where there is none.
    """
    return SpanGoal(f"taken({_piece_left(span, span.last - 1)})")


def collect_too(span: SearchedSpan) -> SpanGoal:
    """Collect the nearest piece left beside the run's path, and be at its end, at most a second later.

    Raises ArgumentError where there is none.
    """
    rest = _is_passed(span)
    goal = f"taken({_piece_left(span, span.first)}) and {be_there(span).goal}"
    return SpanGoal(
        goal, rest=rest, last=min(span.last + TICKS_PER_SECOND, span.first + MAX_SPAN), why="and a second more"
    )


def _piece_left(span: SearchedSpan, first: int) -> int:
    """The id of the piece left at the end of the span that is nearest to the path from a tick on."""
    x, y = span.places(first).T
    splits = run_splits(span.session.recording(), ("gold-taken",)).splits
    taken = {split.object_id for split in splits if split.tick < span.last}
    pieces = [obj for obj in span.session.timeline.objects if obj[1] == GOLD and obj[0] not in taken]
    if not pieces:
        raise ArgumentError("no gold is left at the end of the span")
    return min(pieces, key=lambda obj: float(np.hypot(obj[2] - x, obj[3] - y).min()))[0]


def same_end(span: SearchedSpan) -> SpanGoal:
    """Be at the end of the span, place, velocity and state, earlier; the rest of the run follows unchanged."""
    end = span.end
    parts = [
        f"distance({end['x']:.6g}, {end['y']:.6g}) < {SAME_PLACE:g}",
        *(f"abs({_less(name, end[name])}) < {SAME_VELOCITY:g}" for name in ("vx", "vy")),
        f"state == {end['state']:.0f}",
        *([f"gold >= {end['gold']:.0f}"] if end["gold"] else []),
    ]
    return SpanGoal(" and ".join(parts), rest=_is_passed(span))


def same_state(span: SearchedSpan) -> SpanGoal:
    """Be exactly in the state of the end of the span, earlier: everything that decides later ticks, by its digest."""
    return SpanGoal(f"difference({span.last - 1}) == 0", rest=_is_passed(span))


def _is_passed(span: SearchedSpan) -> bool:
    """Whether the run reaches the exit behind the span."""
    tick, outcome = span.session.timeline.end
    return outcome == "exit" and tick >= span.last


class RunPiece(NamedTuple):
    """The ticks ``first`` … ``last`` - 1 of a run: its name in words, and the function that makes its goal."""

    first: int
    last: int
    name: str
    wanted: SpanGoal


MIN_PIECE_TICKS = 10  # ticks; a goal that is reached sooner belongs to the previous piece
GOALS = {"gold-taken": "taken({})", "exit-opened": "opened({})", "lock-opened": "opened({})", "won": "won"}


def span_pieces(span: SearchedSpan, splits: Sequence[Split]) -> list[RunPiece]:
    """The pieces of a span, from one piece of gold, switch or exit to the next; from the last one to the exit.

    ``splits``: the run's events of GOALS. If the run reaches the exit, its rest follows the last piece, and a span
    without an event has two halves. The whole run comes first: it has the most to gain.
    """
    first, pieces = span.first, list[RunPiece]()
    end, outcome = span.session.timeline.end
    passes = outcome == "exit"
    to_exit = not passes or span.last >= end
    for split in splits:
        if span.first <= split.tick < span.last + to_exit and split.tick - first + 1 >= MIN_PIECE_TICKS:
            goal, behind = GOALS[split.event].format(split.object_id), split.tick + 1
            rest = passes and behind <= end
            pieces.append(RunPiece(first, behind, f"To {split.name}", SpanGoal(goal, rest=rest)))
            first = behind
    if not passes and pieces:
        last = min(max(span.last, first + EXIT_TICKS), first + MAX_SPAN)
        pieces.append(RunPiece(first, last, "To exit", SpanGoal("won")))
    elif not to_exit and len(pieces) < 2:
        half = (span.first + span.last) // 2
        for bounds in pairwise((first, span.last) if pieces else (first, half, span.last)):
            if bounds[1] - bounds[0] >= MIN_PIECE_TICKS:
                wanted = same_end(SearchedSpan(span.session, *bounds))
                pieces.append(RunPiece(*bounds, f"To tick {bounds[1] - 1}", wanted))
    if len(pieces) < 2:
        pieces.clear()  # the span itself
    wanted = whole_run(span)
    return [RunPiece(0, wanted.last, "Whole run", wanted), *pieces]


PRESETS: tuple[tuple[str, str, Callable[[SearchedSpan], SpanGoal]], ...] = (
    ("Reach the exit sooner", "From tick {0} on, in any way", reach_exit),
    ("Whole run", "Shorten all of it; by routes of runs beside, too", whole_run),
    ("Same end, sooner", "The same place, speed and state; the rest follows", same_end),
    ("Same end exactly, sooner", "By the digest of all that decides what follows", same_state),
    ("Be there sooner", "Where the run is after tick {1}", be_there),
    ("Go beyond sooner", "Past the upright line of its place after tick {1}", go_beyond),
    ("Greatest speed", "As fast as can be after tick {1}", lambda span: SpanGoal(_alive(span.last), "speed")),
    ("Collect a piece", "The nearest gold that is left after tick {1}", collect),
    ("This piece too", "The nearest left on the way; then the same place", collect_too),
    ("Stay alive", "No death from tick {0} to {1}", lambda span: SpanGoal(_alive(span.last))),
)
"""Name, explanation ({0}: the first tick, {1}: the last), and the function that makes goal and measure."""


def _alive(last: int) -> str:
    return f"tick >= {last - 1} and not dead"


def _less(name: str, value: float) -> str:
    return f"{name} {'-' if value >= 0 else '+'} {abs(value):.4g}"
