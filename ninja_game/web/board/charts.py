"""The drawings of a board's pages: paths over a level, how a record fell, a run's speed and keys, leads."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from ninja_game.formats.run_time import seconds_text
from ninja_game.sim.inputs import MOVES
from ninja_game.sim.rules import TICKS_PER_SECOND
from ninja_game.ui.theme import run_colour
from ninja_game.web.pages.frame import Markup, css_colour, joined, tag
from ninja_game.web.pages.gallery import PICTURE_HEIGHT, PICTURE_WIDTH

# A chart, px, before scaling to the page.
_WIDTH, _HEIGHT, _MARGIN = 640, 200, 12
BESIDE, BELOW, _RIGHT = 72, 28, _WIDTH - _MARGIN  # room for the labels; the right end

PLACE = "place-"  # the anchor of a numbered place in a picture
MARK_APART = 14  # least px between two numbers

_FLOOR, DEEP = 130, 240  # px from the top: lower end of the speeds, and of all
_LANES = 152, 176, 200  # of the keys, px from the top
ROW_TICKS, _MAX_ROWS = 10 * TICKS_PER_SECOND, 6  # a row of speeds and keys; a long run has longer ones
_MAX_COLUMNS = 400  # columns of a row
LABELS_APART = 26  # least px between two numbers of splits


def step_chart(
    points: Sequence[tuple[float, float]],
    names: Sequence[str],
    text: Callable[[float], str],
    days: tuple[str, str],
    label: str,
) -> Markup:
    """A line that keeps each value until the next one: (moment, value) in order, with a label for each point.

    ``text``: of a value; ``days``: of the first and the last moment; ``label``: the line's text for screen readers.
    """
    x, y = np.array(points, np.float64).T
    low, high = float(y.min()), float(y.max())
    floor = _HEIGHT - BELOW
    x = BESIDE + (_RIGHT - BESIDE) * _share(x)
    y = floor - (floor - _MARGIN) * _share(y)
    moves = "".join(f"H{left:.1f}V{up:.1f}" for left, up in zip(x[1:], y[1:], strict=True))
    line = tag("path", d=f"M{x[0]:.1f} {y[0]:.1f}{moves}H{_RIGHT}", class_="record")
    dots = [
        tag("circle", tag("title", name), cx=f"{left:.1f}", cy=f"{up:.1f}", r="4")
        for left, up, name in zip(x, y, names, strict=True)
    ]
    ends = zip(days, (BESIDE, _RIGHT), ("start", "end"), strict=True)
    dates = (tag("text", day, x=at, y=_HEIGHT - 4, text_anchor=anchor) for day, at, anchor in ends)
    return _chart(label, _HEIGHT, *_scale(text, low, high, floor), *dates, line, *dots)


def _chart(label: str, height: int, *contents: Markup) -> Markup:
    """A chart; ``label``: its text for screen readers."""
    return tag("svg", *contents, viewBox=f"0 0 {_WIDTH} {height}", class_="chart", role="img", aria_label=label)


def _scale(
    text: Callable[[float], str], low: float, high: float, floor: float, top: float = _MARGIN
) -> Iterator[Markup]:
    """Lines across a chart with their values beside them: the least one at ``floor``, the greatest one at ``top``."""
    for share in (0.0, 0.5, 1.0):
        up = floor - (floor - top) * share
        yield tag("path", d=f"M{BESIDE} {up:.0f}H{_RIGHT}", class_="grid")
        yield _beside(text(low + share * (high - low)), up)


def _beside(text: str, up: float) -> Markup:
    return tag("text", text, x=BESIDE - 8, y=f"{up + 4:.0f}", text_anchor="end")


def _seconds(start: int, end: int, px_per_tick: float, below: int) -> Iterator[Markup]:
    """The full seconds of these ticks, ``px_per_tick`` px each; not more than have room."""
    step = TICKS_PER_SECOND * -(-2 * (end - start) // ROW_TICKS)
    for tick in range(-(-start // step) * step, end, step):
        left = f"{BESIDE + px_per_tick * (tick - start):.0f}"
        yield tag("text", f"{tick // TICKS_PER_SECOND} s", x=left, y=below, text_anchor="middle")


def _share(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Each value scaled from the least one, 0, to the greatest, 1."""
    share: NDArray[np.float64] = (values - values.min()) / (np.ptp(values) or 1.0)
    return share


def _marks(places: Sequence[tuple[float, float]]) -> Iterator[Markup]:
    """Numbers at places; one that would cover an earlier one shows only while a link to it is active."""
    numbers: list[tuple[float, float]] = []
    for number, (x, y) in enumerate(places, 1):
        free = all(abs(x - left) > MARK_APART or abs(y - top) > MARK_APART for left, top in numbers)
        numbers += [(x, y)] * free
        at = f"{x:.0f}", f"{y:.0f}"
        text = tag("text", number, x=at[0], y=f"{y + 5:.0f}", text_anchor="middle")
        ring = tag("circle", cx=at[0], cy=at[1], r="14")
        yield tag("g", ring, text, id=f"{PLACE}{number}", class_="mark" if free else "mark covered")


def paths(picture: str, runs: Sequence[tuple[str, str]], places: Sequence[tuple[float, float]] = ()) -> Markup:
    """Runs, each by name with its ``path_data``, over the picture of their level; the first on top.

    ``places``: px of the marks, numbered from 1.
    """
    image = tag("image", href=picture, width=PICTURE_WIDTH, height=PICTURE_HEIGHT)
    lines = [
        tag("path", tag("title", name), d=moves, class_="way", stroke=css_colour(run_colour(number)))
        for number, (name, moves) in enumerate(runs)
    ]
    label = f"The level with the paths of {', '.join(name for name, _ in runs)}"
    box = f"0 0 {PICTURE_WIDTH} {PICTURE_HEIGHT}"
    names = [tag("li", swatch(number), joined(" ", name)) for number, (name, _) in enumerate(runs)]
    drawn = tag(
        "svg", image, *reversed(lines), *_marks(places), viewBox=box, class_="paths", role="img", aria_label=label
    )
    return joined(drawn, tag("ul", *names, class_="facts"))


def swatch(number: int) -> Markup:
    line = tag("path", d="M1 7H21", stroke=css_colour(run_colour(number)), class_="way")
    return tag("svg", line, viewBox="0 0 22 14", width="22", height="14", aria_hidden="true")


def signed(ticks: int) -> str:
    """A delay in seconds, with its sign."""
    return ("-" if ticks < 0 else "+") + seconds_text(abs(ticks))


def speed_and_keys(speeds: NDArray[np.float64], inputs: bytes, splits: Sequence[int]) -> list[Markup]:
    """A run in rows of at least ten seconds: the ninja's speed (px/tick), and below it the keys that are down.

    ``speeds``: float64 (ticks,); ``splits``: their ticks, which are numbered from 1.
    """
    keys = np.frombuffer(inputs, np.uint8)[: len(speeds)]
    length = min(len(speeds), max(ROW_TICKS, -(-len(speeds) // _MAX_ROWS)))
    px_per_tick = (_RIGHT - BESIDE) / length
    step = -(-length // _MAX_COLUMNS)
    top = float(speeds.max()) or 1.0
    rows = []
    for start in range(0, len(speeds), length):
        end = min(start + length, len(speeds))
        columns = np.arange(0, end - start, step)
        x = BESIDE + px_per_tick * columns
        y = _FLOOR - (_FLOOR - 2 * _MARGIN) * np.maximum.reduceat(speeds[start:end], columns) / top
        points = "L".join(f"{left:.1f} {up:.0f}" for left, up in zip(x, y, strict=True))
        drawn = [*_scale("{:.1f}".format, 0, top, _FLOOR, 2 * _MARGIN), *_numbers(splits, start, end, px_per_tick)]
        drawn += [*_seconds(start, end, px_per_tick, DEEP - 6), tag("path", d=f"M{points}", class_="speed")]
        down = np.bitwise_or.reduceat(keys[start:end], columns)
        for (name, key), lane in zip(MOVES, _LANES, strict=True):
            changes = np.flatnonzero(np.diff(down & key != 0, prepend=False, append=False))
            spans = changes.reshape(-1, 2) * px_per_tick * step
            strokes = "".join(f"M{BESIDE + left:.1f} {lane}h{right - left:.1f}" for left, right in spans.tolist())
            drawn += [_beside(name.capitalize(), lane), tag("path", d=strokes, class_="keys")]
        span = f"{seconds_text(start)} s to {seconds_text(end)} s, at most {speeds[start:end].max():.1f} px per tick"
        rows.append(_chart(f"Speed and keys from {span}", DEEP, *drawn))
    return rows


def _numbers(splits: Sequence[int], start: int, end: int, px_per_tick: float) -> Iterator[Markup]:
    """The splits in a row of a chart; a number is left out that would cover the one before."""
    last = 0.0
    for number, tick in enumerate(splits, 1):
        if start <= tick < end:
            left = BESIDE + px_per_tick * (tick - start)
            yield tag("path", d=f"M{left:.1f} {2 * _MARGIN}V{_LANES[-1] + 8}", class_="split")
            if left - last >= LABELS_APART:
                last = left
                yield tag("text", number, x=f"{left:.0f}", y=_MARGIN + 6, text_anchor="middle")


def lead_chart(ticks: Sequence[int], late: Sequence[tuple[int, Sequence[int | None]]], label: str) -> Markup:
    """Lines of how many ticks some runs are later at these ticks of another one.

    ``late``: for each run the number of its colour and its delays; None leaves a gap.
    """
    leads_at_all = [0, *(lead for _, leads in late for lead in leads if lead is not None)]
    low, high = min(leads_at_all), max(leads_at_all)
    floor = _HEIGHT - BELOW
    up = (floor - _MARGIN) / ((high - low) or 1)
    px_per_tick = (_RIGHT - BESIDE) / (ticks[-1] or 1)
    drawn = [
        *_scale(lambda lead: f"{lead / TICKS_PER_SECOND:.2f}", low, high, floor),
        *_seconds(0, ticks[-1], px_per_tick, _HEIGHT - 6),
    ]
    for number, leads in reversed(late):
        moves, gap = "", True
        for tick, lead in zip(ticks, leads, strict=True):
            if lead is not None:
                moves += f"{'M' if gap else 'L'}{BESIDE + px_per_tick * tick:.1f} {floor - up * (lead - low):.0f}"
            gap = lead is None
        drawn.append(tag("path", d=moves, class_="way", stroke=css_colour(run_colour(number))))
    return _chart(label, _HEIGHT, *drawn)
