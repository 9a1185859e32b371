"""What lies over the level under edit: grids, lines to switches, routes, signs of findings."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise
from math import ceil, hypot
from typing import NamedTuple

import pygame

from ninja_game.editor.certify import Route
from ninja_game.editor.draft import Draft
from ninja_game.editor.specs import BODY, SWITCH, has_switch, points
from ninja_game.levels.findings import Finding
from ninja_game.play.ui.canvas import Canvas, Colour, Point
from ninja_game.play.ui.theme import Palette
from ninja_game.play.view.sprites.drawing import DrawTarget, is_near
from ninja_game.sim.level import Level

MIDDLE = (396.0, 300.0)
SIGN = 7.0
"""Half the height of a finding's sign, px."""


class Grid(NamedTuple):
    """Lines every ``step`` px from the level's corner, moved by ``shift``; 0: none."""

    name: str
    step: float
    shift: float = 0.0

    def lines(self) -> Iterator[tuple[bool, float, bool]]:
        """Each line: whether upright, where (px), whether one of the two middle lines, which every grid has."""
        if not self.step:
            return
        for upright, middle in ((True, MIDDLE[0]), (False, MIDDLE[1])):
            length = 2 * (middle - 24.0)
            step = length / 4 if self.step < 0 else self.step
            for number in range(ceil(length / step)):
                at = 24.0 + self.shift + number * step
                if 24.0 < at < 24.0 + length and at != middle:
                    yield upright, at, False
            yield upright, middle, True


GRIDS = (
    Grid("off", 0), Grid("cells", 24), Grid("half cells", 12), Grid("quarters", 6), Grid("2 cells", 48),
    Grid("4 cells", 96), Grid("cells + 1/2", 24, 12), Grid("2 cells + 1/2", 48, 12), Grid("4 cells + 1/2", 96, 12),
    Grid("level / 4", -1),
)  # fmt: skip
"""The ten grids (game.md §6)."""


class LevelMark(NamedTuple):
    """Something drawn over the level: a line, a sign. ``rects``: the px that it may cover."""

    draw: Callable[[DrawTarget], None]
    rects: tuple[pygame.Rect, ...]


def _rects(canvas: Canvas, a: Point, b: Point) -> Iterator[pygame.Rect]:
    """Small rectangles that together cover a line."""
    pieces = max(1, ceil(hypot(b[0] - a[0], b[1] - a[1]) / 60))
    ends = [(a[0] + (b[0] - a[0]) * k / pieces, a[1] + (b[1] - a[1]) * k / pieces) for k in range(pieces + 1)]
    for (ax, ay), (bx, by) in pairwise(ends):
        x, y = canvas.point(min(ax, bx), min(ay, by))
        yield pygame.Rect(x, y, *(canvas.px(abs(d)) for d in (bx - ax, by - ay))).inflate(8, 8)


def line_mark(canvas: Canvas, colour: Colour, a: Point, b: Point, width: float = 0) -> LevelMark:
    return LevelMark(lambda target: target.line(colour, *a, *b, width), tuple(_rects(canvas, a, b)))


def route_mark(canvas: Canvas, colour: Colour, route: Route) -> LevelMark:
    """The route of a run, with a dot at its end."""
    shown = [point for point in route if is_near(*point)]

    def draw(target: DrawTarget) -> None:
        places = [target.canvas.exact(*point) for point in shown]
        pygame.draw.lines(target.surface, colour, closed=False, points=places, width=target.canvas.px(1.4))
        target.disc(colour, *shown[-1], 3.0)

    x, y = [point[0] for point in shown], [point[1] for point in shown]
    box = canvas.rect(min(x), min(y), max(x) - min(x), max(y) - min(y))
    return LevelMark(draw, (box.inflate(20, 20),))


def sign_mark(canvas: Canvas, palette: Palette, at: Point) -> LevelMark:
    """The sign that something is odd here: a triangle with a stroke and a dot."""
    x, y = at[0], at[1] - 4.0
    corners = [(x, y - SIGN), (x + SIGN, y + SIGN - 1), (x - SIGN, y + SIGN - 1)]

    def draw(target: DrawTarget) -> None:
        target.canvas.polygon(target.surface, palette.outline, corners)
        inner = [(x + (px - x) * 0.72, y + 1 + (py - y - 1) * 0.72) for px, py in corners]
        target.canvas.polygon(target.surface, palette.gold_light, inner)
        target.line(palette.outline, x, y - 2.4, x, y + 1.6, 1.6)
        target.disc(palette.outline, x, y + 4.0, 0.9)

    return LevelMark(draw, (canvas.rect(x - 9, y - 9, 18, 18),))


def finding_points(level: Level, finding: Finding) -> list[Point]:
    places = [(24.0 * column + 12.0, 24.0 * row + 12.0) for column, row in finding.cells]
    for number in finding.records:
        found = points(level.objects[number]) if number < len(level.objects) else {}
        place = found.get(SWITCH if finding.about_switch else BODY)
        places += [place] if place else []
    return [(min(max(x, 12.0), 780.0), min(max(y, 12.0), 588.0)) for x, y in places]


def level_marks(
    canvas: Canvas, palette: Palette, draft: Draft, before: Mapping[Hashable, LevelMark], *, lines: bool,
    routes: Sequence[tuple[Route, Colour]], signs: Sequence[Point], axes: Sequence[tuple[Point, Point]],
) -> dict[Hashable, LevelMark]:  # fmt: skip
    """All marks by what they show: equal keys, equal marks. Those of ``before`` are used again."""
    marks: dict[Hashable, LevelMark] = {}

    def add(key: Hashable, make: Callable[[], LevelMark]) -> None:
        marks[key] = before[key] if key in before else make()

    for a, b in axes:
        add(("axis", a, b), partial(line_mark, canvas, palette.accent, a, b))
    for spec in draft.objects if lines else ():
        if has_switch(spec):
            found = points(spec)
            if len(found) == 2 and all(is_near(*point) for point in found.values()):
                line = partial(line_mark, canvas, palette.switch, found[SWITCH], found[BODY], 0.8)
                add(("switch", spec), line)
    for route, colour in routes:
        if len(route) > 1:
            add(("route", id(route), str(colour)), partial(route_mark, canvas, colour, route))
    for at in signs[:100]:
        add(("sign", at), partial(sign_mark, canvas, palette, at))
    return marks
