"""Drawings of the board's pages as SVG within them: a record over time, and paths over a level."""

from __future__ import annotations

from collections.abc import Sequence
from math import dist

import numpy as np
from numpy.typing import NDArray

from ninja_game.ui.theme import RUN_COLOURS
from ninja_game.web.pages.frame import Markup, joined, tag
from ninja_game.web.pages.gallery import PICTURE_HEIGHT, PICTURE_WIDTH

WIDTH, HEIGHT, MARGIN = 480, 150, 14
"""Size of the chart and its margin, px, before it is fitted to the page."""

MOST_POINTS, NEAREST = 400, 4.0
"""Points of a path that is drawn, and how far apart they are at least, px."""


def steps(points: Sequence[tuple[float, float]], top: str, bottom: str, said: str) -> Markup:
    """A line that keeps each value until the next one: (moment, value) in order; labels of its ends; what it says."""
    x, y = np.array(points, np.float64).T
    x = MARGIN + (WIDTH - 2 * MARGIN) * _share(x)
    y = HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN - 18) * _share(y)
    moves = "".join(f"H{left:.1f}V{up:.1f}" for left, up in zip(x[1:], y[1:], strict=True))
    line = tag("path", d=f"M{x[0]:.1f} {y[0]:.1f}{moves}H{WIDTH - MARGIN}", class_="record")
    dots = [tag("circle", cx=f"{left:.1f}", cy=f"{up:.1f}", r="4") for left, up in zip(x, y, strict=True)]
    labels = (
        tag("text", top, x=str(MARGIN), y="16"),
        tag("text", bottom, x=str(WIDTH - MARGIN), y="16", text_anchor="end"),
    )
    box = f"0 0 {WIDTH} {HEIGHT}"
    return tag("svg", line, *dots, *labels, viewBox=box, class_="chart", role="img", aria_label=said)


def _share(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Each value between the least one, 0, and the greatest, 1."""
    share: NDArray[np.float64] = (values - values.min()) / (np.ptp(values) or 1.0)
    return share


def paths(picture: str, runs: Sequence[tuple[str, str]]) -> Markup:
    """Runs, each by name with its ``path_data``, over the picture of their level; the first on top."""
    image = tag("image", href=picture, width=PICTURE_WIDTH, height=PICTURE_HEIGHT)
    lines = [
        tag("path", tag("title", name), d=way, class_="way", stroke=_colour(number))
        for number, (name, way) in enumerate(runs)
    ]
    said = f"The level with the paths of {', '.join(name for name, _ in runs)}"
    box = f"0 0 {PICTURE_WIDTH} {PICTURE_HEIGHT}"
    names = [tag("li", swatch(number), joined(" ", name)) for number, (name, _) in enumerate(runs)]
    drawn = tag("svg", image, *reversed(lines), viewBox=box, class_="paths", role="img", aria_label=said)
    return joined(drawn, tag("ul", *names, class_="facts"))


def swatch(number: int) -> Markup:
    line = tag("path", d="M1 7H21", stroke=_colour(number), class_="way")
    return tag("svg", line, viewBox="0 0 22 14", width="22", height="14", aria_hidden="true")


def _colour(number: int) -> str:
    ink = RUN_COLOURS[number % len(RUN_COLOURS)]
    return f"#{ink.r:02x}{ink.g:02x}{ink.b:02x}"


def path_data(positions: NDArray[np.float64]) -> str:
    """A path in whole px, without points that are near to the one before.

    >>> path_data(np.array([[24.2, 36.0], [25.0, 36.0], [40.0, 30.0]]))
    'M24 36l16-6'
    """
    whole = positions.round().astype(int)
    length = float(np.hypot(*np.diff(positions, axis=0).T).sum())
    apart = max(NEAREST, length / MOST_POINTS)
    first, *others = whole.tolist()
    kept = [first]
    for place in others:
        if dist(place, kept[-1]) >= apart:
            kept.append(place)
    moves = "".join(f"{x}{'' if y < 0 else ' '}{y} " for x, y in np.diff(kept, axis=0).tolist())
    return f"M{kept[0][0]} {kept[0][1]}" + (f"l{moves.rstrip()}" if moves else "")
