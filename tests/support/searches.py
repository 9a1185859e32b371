"""What tests of the tab of searches share: a search asked for, waited for and stopped, and its results."""

import numpy as np
import pygame

from ninja_game.search.formula.task import SpanResult
from ninja_game.tas_editor.span_results import SpanResults
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from tests.support.tas_driver import TasDriver


def wish(at: TasDriver, name: str) -> None:
    at.choose("Presets")
    at.choose(name)


def results_of(tab: SearchTab) -> SpanResults:
    assert tab.results is not None
    return tab.results


def is_in(at: TasDriver, results: SpanResults, found: SpanResult) -> bool:
    """Whether the run has the keys of a result up to its goal."""
    end = results.task.first + found.ticks
    return at.editor.track.inputs[:end] == found.inputs[:end]


def ended(at: TasDriver, tab: SearchTab) -> SpanResults:
    """Wait for the end of the search."""
    results = results_of(tab)
    at.wait(lambda: not results.running, "the end")
    at.frames(2)  # the list is that of the end
    return results


def stopped(at: TasDriver, tab: SearchTab) -> SpanResults:
    at.choose("Stop")
    return ended(at, tab)


def searched(at: TasDriver, tab: SearchTab) -> SpanResults:
    """Search until there is something better than the run, or a miss, then stop."""
    at.wait(lambda: bool(tab.better), "something better")
    return stopped(at, tab)


def row(at: TasDriver, tab: SearchTab, index: int, *, click: bool = True) -> None:
    x, y, _, h = tab.list.row_area(index)
    at.mouse(x + 60, y + h / 2, click=click)


def speed(at: TasDriver, tick: int) -> float:
    column = at.session.timeline.column
    return float(np.hypot(column("x")[tick] - column("prev_x")[tick], column("y")[tick] - column("prev_y")[tick]))


def selected(at: TasDriver, first: int, ticks: int) -> None:
    """By keys: go to a tick, select this many, ask for a search of them."""
    at.press("escape")
    at.editor.go(first)
    for _ in range(ticks - 1):
        at.chord("down", pygame.KMOD_LSHIFT)
    at.press("f")
