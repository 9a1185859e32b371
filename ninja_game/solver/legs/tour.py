"""In which order to fetch pieces of gold: a short open tour, by insertion and then by moving parts of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Distances = NDArray[np.float64]
"""Ticks from each stop (row) to each stop (column)."""

LONGEST_SEGMENT = 4
"""Stops that are moved together."""


def short_tour(start: Distances, between: Distances, end: Distances, order: Sequence[int] = ()) -> list[int]:
    """All stops in an order with a short way from the start over all of them to the end.

    ``start``, ``end``: ticks from the start to each stop, from each stop to the end; ``between``: from stop to stop.
    ``order``: stops in an order to begin with; those that it lacks are inserted where they cost least.
    """
    tour = list(order)
    missing = set(range(len(start))) - set(tour)
    while missing:
        # The nearest to what is in the tour first, so that a far one joins the neighbours it passes.
        costs = {stop: _best_place(stop, stop, tour, start, between, end) for stop in sorted(missing)}
        stop = min(costs, key=lambda stop: (costs[stop][0], stop))
        tour.insert(costs[stop][1], stop)
        missing.remove(stop)
    while _move_a_segment(tour, start, between, end):
        pass
    return tour


def _best_place(
    first: int, last: int, tour: list[int], start: Distances, between: Distances, end: Distances
) -> tuple[float, int]:
    """The least cost of a segment (its first and last stop) within a tour, and before which stop that is."""
    if not tour:
        return float(start[first] + end[last]), 0
    stops = np.array(tour)
    into = np.append(start[first], between[stops, first])
    out = np.append(between[last, stops], end[last])
    skipped = np.concatenate(([start[stops[0]]], between[stops[:-1], stops[1:]], [end[stops[-1]]]))
    added = into + out - skipped
    place = int(np.argmin(added))
    return float(added[place]), place


def _move_a_segment(tour: list[int], start: Distances, between: Distances, end: Distances) -> bool:
    """Move the first segments that are better elsewhere, also turned round; whether any was moved."""
    moved = False
    for length in range(1, min(LONGEST_SEGMENT, len(tour) - 1) + 1):
        for index in range(len(tour) - length + 1):
            segment = tour[index : index + length]
            rest = tour[:index] + tour[index + length :]
            before = start[segment[0]] if index == 0 else between[rest[index - 1], segment[0]]
            after = end[segment[-1]] if index == len(rest) else between[segment[-1], rest[index]]
            if index == 0:
                direct = start[rest[0]]
            elif index == len(rest):
                direct = end[rest[-1]]
            else:
                direct = between[rest[index - 1], rest[index]]
            present = float(before + after - direct)
            added, place = _best_place(segment[0], segment[-1], rest, start, between, end)
            turned_added, turned_place = _best_place(segment[-1], segment[0], rest, start, between, end)
            if length > 1:
                inside = float(between[segment[:-1], segment[1:]].sum())
                turned_added += float(between[segment[1:], segment[:-1]].sum()) - inside
            if min(added, turned_added) > present - 1.0:
                continue
            if turned_added < added:
                segment.reverse()
                place = turned_place
            tour[:] = rest[:place] + segment + rest[place:]
            moved = True
    return moved
