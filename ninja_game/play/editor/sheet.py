"""The picture of the level under edit, of which only changed parts are drawn again, and the marks over it.

Marks are grids, lines to switches, routes, signs of findings.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache, partial
from itertools import pairwise
from math import ceil, hypot
from typing import NamedTuple

import pygame

from ninja_game.editor.draft import Draft, changed_cells
from ninja_game.editor.playtests import PathPoints, PlaytestMap
from ninja_game.editor.specs import BODY_PART, SWITCH_PART, has_switch, object_type_name, points
from ninja_game.formats.messages import LevelMessage, Moment, parse_messages
from ninja_game.levels.findings import Finding
from ninja_game.play.editor.palette_view import ObjectPictures, ObjectSprites
from ninja_game.sim import kinds
from ninja_game.sim.grid import Cell, Point, middle_of
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec
from ninja_game.sim.loader import grid_tiles
from ninja_game.sim.rules import CELL, STRIDE
from ninja_game.ui.canvas import WIDTH, Canvas, Colour, Lens
from ninja_game.ui.theme import Palette
from ninja_game.view.sprites.drawing import DrawTarget, is_near, shared_book
from ninja_game.view.sprites.tile_sheet import TileSheet, rects_around, scrolled

_FRONT = {kinds.GOLD: 1, kinds.MINE: 1, kinds.NINJA: 3} | {kind.number: 2 for kind in kinds.KINDS if kind.moves}
"""Order of drawing: higher numbers lie in front."""

_MANY = 60  # more rectangles than this are merged into one
COVERED_ALPHA = 4  # opacity in eighths of an object behind a tile


class LevelSheet:
    """The picture of a draft, drawn again only where it changes.

    ``surface``: the picture, without the pointer. ``canvas``: from px of the level to px of the sheet.
    ``flat``: to px from the level's own corner, which do not change when another part is shown; used for marks. The
    next ``paint`` draws what ``show`` and the other methods have set.
    """

    def __init__(self, canvas: Canvas, palette: Palette) -> None:
        self.palette = palette
        self.flat = Lens(canvas.window, canvas.scale, (0, 0))
        self.pictures = ObjectPictures(DrawTarget(self.flat, palette, shared_book(canvas.scale, palette.base)))
        self.draft: Draft | None = None
        self._looks: dict[ObjectSpec, ObjectSprites] = {}
        self._order: list[ObjectSprites] = []
        self._rects: list[pygame.Rect] = []
        self.marks: dict[Hashable, LevelMark] = {}
        self._grid: list[tuple[tuple[int, ...], pygame.Rect]] = []
        self._dirty: list[pygame.Rect] = []
        self.canvas = canvas
        self.surface: pygame.Surface
        self._tiles: TileSheet
        self.look(canvas)

    def look(self, canvas: Canvas) -> None:
        """Show another part of the level; after a change of scale, grid lines and marks must be set again."""
        book = shared_book(canvas.scale, self.palette.base)
        left, top = self.canvas.origin
        self.canvas, self.target = canvas, DrawTarget(canvas, self.palette, book)
        self._seen = pygame.Rect((-canvas.origin[0], -canvas.origin[1]), canvas.size)
        if self.draft and canvas.scale == self.flat.scale:
            self._tiles.scroll(canvas, grid_tiles(self.draft.level))
            unchanged = scrolled(self.surface, canvas.origin[0] - left, canvas.origin[1] - top)
            self._dirty += rects_around(unchanged.move(self._seen.topleft), self._seen)
            return
        self.surface, self._tiles = pygame.Surface(canvas.size), TileSheet(canvas, self.palette.tile)
        if canvas.scale != self.flat.scale:
            self.flat = Lens(canvas.window, canvas.scale, (0, 0))
            self.pictures.target = DrawTarget(self.flat, self.palette, book)
            self.marks, self._looks = {}, {}
        draft, self.draft = self.draft, None
        if draft:
            self.show(draft)

    def show(self, draft: Draft) -> None:
        before, self.draft = self.draft, draft
        if before is None:
            self._tiles.show(grid_tiles(draft.level))
            self._dirty.append(self._seen)
        else:
            self._change_tiles(before, draft)
        if before is None or before.objects != draft.objects:
            self._change_objects(draft)

    def _change_tiles(self, before: Draft, draft: Draft) -> None:
        changed = changed_cells(before, draft)
        grid = grid_tiles(draft.level) if changed else []
        for column, row in changed:
            self._tiles.draw(column, row, grid[(row + 1) * STRIDE + column + 1])
            self._dirty.append(self.flat.rect(CELL * column, CELL * row, CELL, CELL))
        # A tile hides the whole object in its cell, even what lies outside of the cell.
        covered = set(changed)
        self._dirty += [mark.rect for mark in self._order if covered and not covered.isdisjoint(mark.cells)]

    def _change_objects(self, draft: Draft) -> None:
        before = self._looks
        sprites = before | self.pictures.sprites_of(spec for spec in draft.objects if spec not in before)
        self._looks = {spec: sprites[spec] for spec in draft.objects}
        self._order = [sprites[spec] for spec in sorted(self._looks, key=lambda obj: _FRONT.get(obj.kind, 0))]
        self._rects = [sprite.rect for sprite in self._order]
        self._dirty += [sprites[spec].rect for spec in before.keys() ^ self._looks.keys()]

    def show_marks(self, marks: dict[Hashable, LevelMark]) -> None:
        """Show these marks. Marks with equal keys are the same mark."""
        changed = [self.marks[key] for key in self.marks.keys() - marks.keys()]
        changed += [marks[key] for key in marks.keys() - self.marks.keys()]
        self.marks = marks
        self._dirty += [rect for mark in changed for rect in mark.rects]

    def show_grid(self, lines: Iterable[GridLine]) -> None:
        self._grid = []
        for line in lines:
            colour = (*self.palette.accent[:3], 150) if line.is_middle else (*self.palette.text[:3], 60)
            area = (line.at, CELL, 0, CELL * ROWS) if line.upright else (CELL, line.at, CELL * COLUMNS, 0)
            left, top, width, height = self.flat.rect(*area)
            self._grid.append((colour, pygame.Rect(left, top, width + 1, height + 1)))
        self._dirty.append(self._seen)

    def paint(self) -> list[pygame.Rect]:
        """Draw all changes; the px of the sheet that changed."""
        dirty = united(area.clip(self._seen) for area in self._dirty)
        self._dirty = []
        for area in dirty:
            self._repaint_area(area)
        return [area.move(self.canvas.origin) for area in dirty]

    def _repaint_area(self, flat: pygame.Rect) -> None:
        surface, target = self.surface, self.target
        area = flat.move(self.canvas.origin)
        if self.draft is None:
            return
        surface.set_clip(area)
        surface.fill(self.palette.background)
        target.begin(surface)
        near = flat.collidelistall(self._rects)
        for number in near:
            self._order[number].draw(target)
        if self._tiles.on_tiles([area]):
            surface.blit(self._tiles.surface, area, area, pygame.BLEND_PREMULTIPLIED)
        for number in near:
            if any(self.draft.tile(cell) == 1 for cell in self._order[number].cells):
                self._order[number].draw(target, alpha=COVERED_ALPHA)
        if self._grid:
            # A layer of its own, so that crossing lines do not add up.
            grid = pygame.Surface(area.size, pygame.SRCALPHA)
            for colour, line in self._grid:
                grid.fill(colour, line.move(-flat.x, -flat.y))
            surface.blit(grid, area)
        for mark in self.marks.values():
            if flat.collidelist(mark.rects) >= 0:
                mark.draw(target)
        surface.set_clip(None)


def united(rects: Iterable[pygame.Rect]) -> list[pygame.Rect]:
    """Fewer rectangles that cover the same px: overlapping ones are merged, and so are more than _MANY."""
    waiting = [rect.copy() for rect in rects if rect]
    if len(waiting) > _MANY:
        return [waiting[0].unionall(waiting[1:])]
    merged: list[pygame.Rect] = []
    while waiting:
        rect = waiting.pop()
        touching = rect.collidelistall(merged)
        if touching:
            for number in reversed(touching):
                rect.union_ip(merged.pop(number))
            waiting.append(rect)
        else:
            merged.append(rect)
    return merged


MIDDLE = (396.0, 300.0)
SIGN = 7.0  # half the height of a finding's sign, px
SIGN_AWAY = 14.0  # from its cause, across and up, px


class GridLine(NamedTuple):
    """A vertical or horizontal line at a distance from the left or upper edge, px; a middle line is in every grid."""

    upright: bool
    at: float
    is_middle: bool = False


class Grid(NamedTuple):
    """Lines every ``step`` px from the level's corner, moved by ``shift``; no lines if ``step`` is 0."""

    name: str
    step: float
    shift: float = 0.0

    def lines(self) -> Iterator[GridLine]:
        if not self.step:
            return
        for upright, middle in ((True, MIDDLE[0]), (False, MIDDLE[1])):
            length = 2 * (middle - CELL)
            step = length / 4 if self.step < 0 else self.step
            for number in range(ceil(length / step)):
                at = CELL + self.shift + number * step
                if CELL < at < CELL + length and at != middle:
                    yield GridLine(upright, at)
            yield GridLine(upright, middle, is_middle=True)


GRIDS = (
    Grid("off", 0), Grid("cells", 24), Grid("half cells", 12), Grid("quarters", 6), Grid("2 cells", 48),
    Grid("4 cells", 96), Grid("cells + 1/2", 24, 12), Grid("2 cells + 1/2", 48, 12), Grid("4 cells + 1/2", 96, 12),
    Grid("level / 4", -1),
)  # fmt: skip


class LevelMark(NamedTuple):
    """A line or a sign over the level. ``rects``: the flat px that it may cover."""

    draw: Callable[[DrawTarget], object]
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


def route_mark(canvas: Canvas, colour: Colour, route: PathPoints) -> LevelMark:
    """The visible part of a run's route, with a dot at its end."""
    near = [point for point in route if is_near(*point)]
    if len(near) < 2:
        return LevelMark(lambda _: None, ())

    def draw(target: DrawTarget) -> None:
        places = [target.canvas.exact(*point) for point in near]
        pygame.draw.lines(target.surface, colour, closed=False, points=places, width=target.canvas.px(1.4))
        target.disc(colour, *near[-1], 3.0)

    x, y = [point[0] for point in near], [point[1] for point in near]
    box = canvas.rect(min(x) - 5, min(y) - 5, max(x) - min(x) + 10, max(y) - min(y) + 10)
    return LevelMark(draw, (box.inflate(8, 8),))


def sign_mark(canvas: Canvas, palette: Palette, at: Point) -> LevelMark:
    """The sign of a finding: a triangle with an exclamation mark, above its cause and to the right, or below it."""
    x, y = min(at[0] + SIGN_AWAY, WIDTH - SIGN), at[1] + (SIGN_AWAY if at[1] < 2 * CELL else -SIGN_AWAY)
    corners = [(x, y - SIGN), (x + SIGN, y + SIGN - 1), (x - SIGN, y + SIGN - 1)]

    def draw(target: DrawTarget) -> None:
        target.canvas.polygon(target.surface, palette.outline, corners)
        inner = [(x + (px - x) * 0.72, y + 1 + (py - y - 1) * 0.72) for px, py in corners]
        target.canvas.polygon(target.surface, palette.gold_light, inner)
        target.line(palette.outline, x, y - 2.4, x, y + 1.6, 1.6)
        target.disc(palette.outline, x, y + 4.0, 0.9)

    return LevelMark(draw, (canvas.rect(x - 11, y - 11, 22, 22),))


def message_mark(canvas: Canvas, palette: Palette, at: Point) -> LevelMark:
    """The sign of a message: a bubble with three dots."""
    x, y = at

    def draw(target: DrawTarget) -> None:
        for colour, by in ((palette.outline, 1.4), (palette.panel, 0.0)):
            target.canvas.polygon(target.surface, colour, [(x - 5 - by, y), (x + 3 + by, y), (x - 4 - by, y + 9 + by)])
            target.canvas.fill_rect(target.surface, colour, x - 9 - by, y - 8 - by, 18 + 2 * by, 11 + 2 * by, 3)
        for dot in (-4.5, 0.0, 4.5):
            target.disc(palette.accent, x + dot, y - 2.5, 1.3)

    return LevelMark(draw, (canvas.rect(x - 12, y - 11, 24, 24),))


@lru_cache(maxsize=4)
def message_places(draft: Draft) -> Mapping[Point, int]:
    """The centres of the cells with messages, and beside the ninja or the object of other moments, px.

    Each with the number of its first message. Cached: the status line asks in every frame.
    """
    places: dict[Point, int] = {}
    for number, message in enumerate(parse_messages(draft.says)):
        if at := message.place:
            places.setdefault(at, number)
        elif at := said_at(draft, message):
            places.setdefault((at[0] + 16, at[1] - 18), number)
    return places


def message_near(draft: Draft, x: float, y: float) -> int | None:
    """The number of the message with its bubble, or its cell, at a point, px."""
    near = (number for (a, b), number in message_places(draft).items() if max(abs(x - a), abs(y - b)) <= CELL / 2)
    return next(near, None)


_SAID_AT = {
    Moment.START: ("ninja", BODY_PART), Moment.SWITCH: ("exit", SWITCH_PART), Moment.GOLD: ("gold", BODY_PART),
    Moment.LOCK: ("locked door", SWITCH_PART), Moment.TRAP: ("trap door", SWITCH_PART),
}  # fmt: skip


def things_of(draft: Draft, when: Moment) -> list[Point]:
    """Places of the objects whose touch is the moment ``when`` of a message, px; none for other moments."""
    name, part = _SAID_AT.get(when, ("", BODY_PART))
    places = [points(spec) for spec in draft.objects if object_type_name(spec) == name]
    return [place[part] for place in places if part in place]


def said_at(draft: Draft, message: LevelMessage) -> Point | None:
    """The object that the ninja has touched when a message comes, px; None if that is unknown."""
    things = [] if message.number else things_of(draft, message.when)
    return next((at for at in things if message.is_about(*at)), None)


def visit_mark(canvas: Canvas, palette: Palette, cell: Cell, share: float) -> LevelMark:
    area, (r, g, b, _) = (CELL * cell[0], CELL * cell[1], CELL, CELL), palette.accent
    colour = r, g, b, round(40 + 140 * share)
    return LevelMark(lambda target: target.canvas.fill_rect(target.surface, colour, *area), (canvas.rect(*area),))


def death_mark(canvas: Canvas, palette: Palette, at: Point) -> LevelMark:
    (x, y), size = at, 5.0

    def draw(target: DrawTarget) -> None:
        for colour, width in ((palette.outline, 4.4), (palette.bad, 2.2)):
            for side in (-size, size):
                target.line(colour, x - side, y - size, x + side, y + size, width)

    return LevelMark(draw, (canvas.rect(x - 10, y - 10, 20, 20),))


def finding_points(level: Level, finding: Finding) -> list[Point]:
    places = list(map(middle_of, finding.cells))
    for number in finding.records:
        parts = points(level.objects[number]) if number < len(level.objects) else {}
        place = parts.get(SWITCH_PART if finding.about_switch else BODY_PART)
        places += [place] if place else []
    return [(min(max(x, 12.0), 780.0), min(max(y, 12.0), 588.0)) for x, y in places]


def level_marks(
    canvas: Canvas, palette: Palette, draft: Draft, before: Mapping[Hashable, LevelMark], *, lines: bool,
    routes: Sequence[tuple[PathPoints, Colour]], playtests: PlaytestMap, signs: Sequence[Point],
    messages: Sequence[Point], axes: Sequence[tuple[Point, Point]],
) -> dict[Hashable, LevelMark]:  # fmt: skip
    """All marks by their contents: equal keys, equal marks. Those of ``before`` are used again."""
    marks: dict[Hashable, LevelMark] = {}

    def add(key: Hashable, make: Callable[[], LevelMark]) -> None:
        marks[key] = before[key] if key in before else make()

    most = max(playtests.visits.values(), default=1)
    for cell, count in playtests.visits.items():
        share = round(count / most, 1)
        add(("visit", cell, share), partial(visit_mark, canvas, palette, cell, share))
    for place in filter(lambda point: is_near(*point), playtests.deaths):
        add(("death", place), partial(death_mark, canvas, palette, place))
    for a, b in axes:
        add(("axis", a, b), partial(line_mark, canvas, palette.accent, a, b))
    for spec in draft.objects if lines else ():
        if has_switch(spec):
            places = points(spec)
            if len(places) == 2 and all(is_near(*point) for point in places.values()):
                line = partial(line_mark, canvas, palette.switch, places[SWITCH_PART], places[BODY_PART], 0.8)
                add(("switch", spec), line)
    for route, colour in routes:
        add(("route", id(route), str(colour)), partial(route_mark, canvas, colour, route))
    for at in messages:
        add(("message", at), partial(message_mark, canvas, palette, at))
    for at in signs[:100]:
        add(("sign", at), partial(sign_mark, canvas, palette, at))
    return marks
