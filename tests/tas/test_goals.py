"""What people want of a span: formulas that the run itself fulfils at the span's end."""

from pathlib import Path

import numpy as np
import pytest

from ninja_game.errors import ArgumentError
from ninja_game.formats.load import load_replays
from ninja_game.runs.splits import run_splits
from ninja_game.search.formula.task import SpanTask, SpanWorlds
from ninja_game.tas.files import open_run
from ninja_game.tas.goals import PRESETS, SearchedSpan, collect, collect_too, reach_exit, same_end, whole_run
from ninja_game.tas.session import TasSession
from tests.support.own_pack import PACK

RUN = PACK / "certificates" / "00-4-every-switch.exit.replay.txt"


@pytest.fixture(name="session")
def session_of_a_run(tmp_path: Path) -> TasSession:
    return TasSession(open_run(RUN), tmp_path)


@pytest.mark.parametrize(
    "make", [make for *_, make in PRESETS if make not in (collect, collect_too, reach_exit, whole_run)]
)
@pytest.mark.parametrize("span", [(0, 40), (100, 150), (300, 333)])
def test_the_run_itself_is_there_at_the_end_of_the_span(
    session: TasSession, make: object, span: tuple[int, int]
) -> None:
    wanted = make(SearchedSpan(session, *span))  # type: ignore[operator]
    origin = session.origin
    task = SpanTask(origin.level, session.track.inputs, *span, *wanted[:4])
    trials = SpanWorlds(task, 1).try_all(task.base[:, np.newaxis])
    assert 0 < trials.ticks[0] <= task.length


def test_gold_that_is_left_is_collected(session: TasSession) -> None:
    taken = [split for split in run_splits(load_replays(RUN)[0]).splits if split.event == "gold-taken"]
    for piece in taken:
        goal = collect(SearchedSpan(session, max(0, piece.tick - 20), piece.tick + 1)).goal
        assert goal != f"taken({piece.object_id})"


def test_the_rest_follows_where_the_run_reaches_the_exit(session: TasSession) -> None:
    assert same_end(SearchedSpan(session, 0, 40)).rest
    session.change(session.track.replaced(100, len(session.track), []))
    assert not same_end(SearchedSpan(session, 0, 40)).rest


def test_a_span_behind_the_run_is_refused(session: TasSession) -> None:
    with pytest.raises(ArgumentError, match="the span ends in tick"):
        same_end(SearchedSpan(session, 0, len(session.track) + 500))


def test_a_piece_is_taken_too_on_the_way_to_the_same_place(session: TasSession) -> None:
    span = SearchedSpan(session, 0, 40)
    wanted = collect_too(span)
    assert wanted.goal.startswith(collect(span).goal.split("(")[0])
    assert " and distance(" in wanted.goal
    assert (wanted.rest, wanted.last) == (True, 80)
    task = SpanTask(session.origin.level, session.track.inputs, 0, 80, *wanted[:4], behind=40)
    assert bytes(SpanWorlds(task, 1).rest) == bytes(key & 7 for key in session.track.inputs[40:])


def test_the_exit_is_looked_for_from_a_tick_on(session: TasSession) -> None:
    end = session.timeline.end[0]
    assert reach_exit(SearchedSpan(session, 20, 40))[::4] == ("won", end)
    session.change(session.track.replaced(100, len(session.track), []))
    assert reach_exit(SearchedSpan(session, 90, 95))[::4] == ("won", 290)
