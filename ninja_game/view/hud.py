"""Texts and bars over a level: time bar, name, messages, keys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import pygame

from ninja_game.formats.messages import LevelMessage
from ninja_game.formats.run_time import rounded_text
from ninja_game.sim.grid import Point
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.sim.level import COLUMNS, ROWS
from ninja_game.sim.rules import CELL, LIFETIME
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.medals import draw_medal, draw_stamp
from ninja_game.ui.theme import Area, Palette, Theme, mixed, wrapped
from ninja_game.view.places import MAY, MUST, TAG_ROOM, Things, away_from, hidden_by, points_in, solid_place, tag_top

_BAR_LEFT, _BAR_MIDDLE = 24.0, 12.0  # left end and middle, px
_BAR_LENGTH = 630.0  # px, for the lifetime at a level's start or more
_WARNING_TICKS = 1800  # below this lifetime the time bar turns red
_LAST_TICKS = 800  # below this lifetime a text warns
_MARK_SIZE = 12.0  # px, a medal on the time bar

_FOOT_SIZE = 11.0  # letters of the lines in the borders
_FOOT_WIDTH = 744.0  # px
_RIGHT = CELL * (COLUMNS + 1)  # right edge of texts in the borders, px
_NAME_FROM = 90.0  # free px beside a text in the border that the level's name needs

_MESSAGE_SIZE = 15.0  # letters of a level's message
_MESSAGE_LINE = 22.0  # height of its lines, px
_MESSAGE_WIDTH = 440.0  # where its lines are broken, px
_MESSAGE_MAX_WIDTH = 680.0  # where a single word ends, px
_KEYS_WIDTH = 70.0  # room for keys before a line, px
BORDER_MESSAGE_TOP = CELL * (ROWS + 1)  # top of a message in the border below, px
_BESIDE_GOLD = 490.0  # its width there, px
_FAINT = 0.2  # opacity of its panel over the ninja
_COVERED, CLEAR_AWAY = 10.0, 34.0  # distance to the ninja with opacity _FAINT, and with 1, px
_TAIL = 8.0  # half the width of its pointer, px

_POINTER_SIZE = 9.5  # letters of the names of things
_TITLE_SIZE = 26.0  # letters of an ended run's time or cause of death
_MEDAL_SIZE = 15.0  # letters of its medal
_LINE_SIZE = 12.5  # letters of the other lines of its panel
_LINE_MAX_WIDTH = WIDTH - 150.0  # longer lines of the panel are broken, px
END_MEDAL_SIZE = 54.0  # size of the medal in the panel, px
_UPPER = 36.0  # top of the panel, unless it would hide an exit or the end of the run, px

_KEYS = (
    (0, KEY_LEFT, ((-3, 0), (2, -4), (2, 4))),
    (20, JUMP_HELD, ((0, -4), (4, 2), (-4, 2))),
    (40, KEY_RIGHT, ((3, 0), (-2, -4), (-2, 4))),
)
"""The keys left, jump and right: their x, bits and arrows."""


def bar_length(lifetime: float) -> float:
    """Length of the time bar, px, for a lifetime in ticks.

    >>> bar_length(900), bar_length(3600), bar_length(7200)
    (157.5, 630.0, 630.0)
    """
    return _BAR_LENGTH * min(1.0, max(0.0, lifetime / LIFETIME))


def trough(palette: Palette) -> pygame.Color:
    """The background of the time bar."""
    return mixed(palette.tile, palette.outline, 0.8)


class Box(NamedTuple):
    """The panel of a text, px. ``line_height``: height of a line; ``size``: of the letters."""

    lines: list[str]
    x: float
    y: float
    width: float
    line_height: float
    margin: float  #: between edge and text
    size: float

    @property
    def area(self) -> tuple[float, float, float, float]:
        """Left, top, width and height, px."""
        return self.x, self.y, self.width, self.line_height * len(self.lines) + 2 * self.margin - 1


class PlacedMessage(NamedTuple):
    """A message of a level, and what it should not cover."""

    text: str
    tiles: tuple[int, ...]  #: tiles and things to cover as little of as possible
    things: Things
    place: Point | None  #: the place that it is about, px
    covers: bool  #: whether it may cover open space too; else it may lie in the border below
    frame: Area | None = None  #: of its place, px: it lies beside that and points to it; of an event without size
    taken: Area | None = None  #: where another text was when it came, px
    moves: tuple[int, ...] = ()  #: the keys of each line


def placed_message(
    text: str,
    tiles: tuple[int, ...],
    things: Things,
    near: LevelMessage | None,
    spot: Point | None,
    event: Point | None = None,
    *,
    of_start: bool,
) -> PlacedMessage:
    """A text beside the place of ``near`` or that of its ``event``, else near ``spot``, and never over that, all in px.

    Where nothing is at the place of ``near``, it points to the floor below that, within its frame.
    ``spot``: where the ninja was when it came. ``of_start``: it stays in place, and may cover open space.
    """
    seen = (*things, (*spot, MUST)) if spot else things
    if near is None or near.place is None:
        if event:
            return PlacedMessage(text, tiles, seen, event, of_start, (*event, 0, 0))
        return PlacedMessage(text, tiles, things, spot, of_start)
    (x, y), (half_w, half_h) = near.middle, near.reach
    is_thing = any(hidden_by(things, *near.place, 0, 0))
    place = near.place if is_thing else _standing_below(tiles, near.place, y + half_h)
    return PlacedMessage(text, tiles, seen, place, of_start, (x - half_w, y - half_h, 2 * half_w, 2 * half_h))


def _standing_below(tiles: tuple[int, ...], at: Point, lowest: float) -> Point:
    """The middle of the cell on the floor below ``at``, px, the middle of a cell; ``at`` if no floor is that high."""
    first = ROWS * (int(at[0] // CELL) - 1)
    down = (*tiles[first : first + ROWS], 1)[int(at[1] // CELL) - 1 : int(lowest // CELL)]
    floor = next((rows for rows, tile in enumerate(down) if tile), 0)
    return at[0], at[1] + CELL * max(0, floor - 1)


class EndPanel(NamedTuple):
    """Title and lines of the panel of an ended run; tiles and things to cover as little of as possible."""

    title: str
    lines: Sequence[str]
    tiles: tuple[int, ...]
    things: Things


@dataclass(frozen=True)
class HudView:
    """The texts over a level now."""

    lifetime: float  #: ticks, for the time bar
    label: str  #: word to show instead of the bar
    foot: tuple[str, str]  #: texts at the left and the right of the border below
    name: str = ""  #: the left text there when a message lies in the border
    pars: Sequence[tuple[str, float]] = ()  #: medals, and the lifetime at which each is lost, ticks
    keys: int | None = None  #: keys of the present tick; None: not shown
    frame_ms: float | None = None  #: duration of the last picture; None: not shown
    message: PlacedMessage | None = None
    bubble: PlacedMessage | None = None  #: a message of a place, beside the other
    letters: Sequence[str] = ()  #: on the keys left, jump and right
    named: Sequence[tuple[str, float, float]] = ()  #: names of things, and their places, px
    end: EndPanel | None = None
    medal: str = ""  #: medal of the pass, or ""
    stamp: float = 1.0  #: size of the medal, 0…1
    shine: float = 1.0  #: progress of the light over the medal, 0…1
    end_opacity: float = 1.0  #: opacity of the end panel, 0…1
    ninja: Point | None = None  #: the ninja's place in play, px; a message over it fades
    softly: bool = True  #: whether that message fades slowly, not at once
    bubble_opacity: float = 1.0  #: apart from fading over the ninja, 0…1


class Hud:
    """Draws on a theme's canvas. Every method gives the px rectangle that it covered, or several small ones."""

    def __init__(self, theme: Theme, measures: Theme | None = None) -> None:
        self.theme = theme
        self._measures = measures or theme  #: the letters by which the places of texts are measured

    def draw(self, surface: pygame.Surface, view: HudView) -> list[pygame.Rect]:
        """Draw everything; the covered px rectangles."""
        top = [self.label(surface, view.label)] if view.label else self.time_bar(surface, view.lifetime, view.pars)
        texts = (view.message, 1.0), (view.bubble, view.bubble_opacity)
        shown = [(message, self.box(message), opacity) for message, opacity in texts if message]
        in_border = any(box.y == BORDER_MESSAGE_TOP for _, box, _ in shown)
        written = top + self.foot(surface, "" if in_border else view.foot[0], view.foot[1])
        if view.frame_ms is not None:
            written.append(self.frame_time(surface, view.frame_ms))
        if view.keys is not None:
            written.append(self.keys(surface, view.keys))
        written += [self.pointer(surface, *named) for named in view.named]
        for message, roomy, solid in shown:
            box, moves = roomy, message.moves
            opacity = solid * _clear_of(view.ninja, roomy, softly=view.softly)
            if box.y == BORDER_MESSAGE_TOP:
                # Beside a message at the right; the rest of the border is for the level's name.
                left = max(24.0, _RIGHT - self.theme.width(view.foot[1], _FOOT_SIZE) - 14 - box.width)
                box = roomy._replace(x=left)
                opacity, moves = solid, ()
                if left > _NAME_FROM:
                    written += self.foot(surface, self.theme.fit(view.name, left - 36, _FOOT_SIZE), "")
            place = self.theme.canvas.rect(*box.area)
            behind = _covered_picture(surface, place, opacity)
            if message.frame and message.place and solid == 1:
                written.append(self._tail(surface, box, message.place))
            written.append(self.draw_message(surface, box, moves, view.letters))
            _fade(surface, place, behind, opacity)
        if view.end and view.end_opacity > 0:
            written.append(self.end_panel(surface, view, view.end))
        return written

    def time_bar(
        self, surface: pygame.Surface, lifetime: float, pars: Sequence[tuple[str, float]] = ()
    ) -> list[pygame.Rect]:
        """The lifetime (ticks) as a bar and in seconds; time won by gold is golden; medals stand where they are lost.

        The bar grows thick and red as it runs out.
        """
        palette, canvas = self.theme.palette, self.theme.canvas
        left = max(0.0, lifetime)
        danger = min(1.0, max(0.0, 1 - left / _WARNING_TICKS))
        thick = 5 + 8 * danger
        top = _BAR_MIDDLE - thick / 2
        frame = canvas.fill_rect(surface, trough(palette), _BAR_LEFT - 1, top - 1, _BAR_LENGTH + 2, thick + 2, 2)
        full = mixed(palette.bar_full, palette.bar_empty, danger)
        for colour, ticks in ((full, left), (palette.gold, left - LIFETIME)):
            if length := bar_length(ticks):
                canvas.fill_rect(surface, colour, _BAR_LEFT, top, length, thick, 1.5)
        for medal, ticks in pars:
            draw_medal(surface, self.theme, medal, _BAR_LEFT + bar_length(ticks), _BAR_MIDDLE, _MARK_SIZE)
        x, ink = _BAR_LEFT + _BAR_LENGTH, palette.on_tile
        words = f"{rounded_text(int(left))} s left{' to live' if left < _LAST_TICKS else ''}"
        width = _RIGHT - x - 10
        text = self.theme.text(surface, words, _RIGHT, 7.4, size=9, colour=ink, align="right", bold=True, width=width)
        return [frame.union(canvas.rect(x, 2, 8, 20)) if pars else frame, text.inflate(canvas.px(8), 4)]

    def label(self, surface: pygame.Surface, text: str, size: float = 10.0) -> pygame.Rect:
        """A word instead of the time bar."""
        colour, y = self.theme.palette.on_tile, 12.5 - 0.55 * size
        return self.theme.text(surface, text, 24, y, size=size, colour=colour, bold=True, width=_FOOT_WIDTH)

    def foot(self, surface: pygame.Surface, left: str, right: str, size: float = _FOOT_SIZE) -> list[pygame.Rect]:
        """A line in the border below the level; if both texts do not fit, the left one is shortened."""
        return self._border_line(surface, left, right, 593 - size, size)

    def _border_line(self, surface: pygame.Surface, left: str, right: str, y: float, size: float) -> list[pygame.Rect]:
        theme, colour = self.theme, self.theme.palette.on_tile
        gap = 14 if left and right else 0
        # The right text grows only into free room.
        half_width = min(_FOOT_WIDTH / 2, theme.lettering.width(left, size))
        width = max(min(_FOOT_WIDTH, theme.lettering.width(right, size)), _FOOT_WIDTH - half_width - gap)
        rect = theme.text(surface, right, _RIGHT, y, size=size, colour=colour, align="right", width=width)
        width = _FOOT_WIDTH - rect.width / theme.canvas.scale - gap
        return [rect, theme.text(surface, left, 24, y, size=size, colour=colour, width=width)]

    def head(self, surface: pygame.Surface, left: str, right: str) -> list[pygame.Rect]:
        """A line in the border above the level, like ``foot`` below it."""
        return self._border_line(surface, left, right, 7, _FOOT_SIZE)

    def frame_time(self, surface: pygame.Surface, ms: float) -> pygame.Rect:
        """The time of the last turn of the loop, in the corner."""
        colour = self.theme.palette.on_tile
        rect = self.theme.text(surface, f"{ms:.1f} ms", _RIGHT, 566, size=8, colour=colour, align="right")
        return rect.inflate(self.theme.canvas.px(12), 2)

    def end_panel(self, surface: pygame.Surface, view: HudView, end: EndPanel) -> pygame.Rect:
        """A panel: a title and lines under it; with a medal at its left, and then the first line large beside it."""
        theme, medal = self.theme, view.medal
        title, lines, tiles, things = end
        below, beside = (26, END_MEDAL_SIZE + 14) if medal else (0, 0)
        named, lines = (lines[0], lines[1:]) if medal else ("", lines)
        head = max(theme.width(title, _TITLE_SIZE, bold=True), theme.width(named, _MEDAL_SIZE, bold=True))

        def fitting(line: str) -> list[str]:
            fits = theme.width(line, _LINE_SIZE) < _LINE_MAX_WIDTH
            return [line] if fits else wrapped(theme, line, _LINE_MAX_WIDTH, _LINE_SIZE)

        lines = [part for line in lines for part in fitting(line)]
        w = max(220.0, head + beside, *(theme.width(line, _LINE_SIZE) for line in lines)) + 44
        h = 48.0 + 18 * len(lines) + below
        x, y = (WIDTH - w) / 2, _UPPER
        if any(cost > MUST for cost in hidden_by(things, x, y, w, h)):
            x, y, *_ = solid_place(tiles, w, h, things, rows=2)
        place = theme.canvas.rect(x, y, w, h)
        behind = _covered_picture(surface, place, view.end_opacity)
        rect = theme.panel(surface, x, y, w, h, 4)
        middle = x + w / 2
        if medal:
            # It grows beyond its size for a moment, but never over the text beside it.
            at = middle - (head + 14) / 2, y + 9 + END_MEDAL_SIZE / 2
            draw_stamp(surface, theme, medal, *at, END_MEDAL_SIZE, view.stamp, view.shine)
        across = middle + beside / 2
        theme.text(surface, title, across, y + 9, size=_TITLE_SIZE, align="centre", bold=True)
        accent = theme.palette.accent
        theme.text(surface, named, across, y + 43, size=_MEDAL_SIZE, colour=accent, align="centre", bold=True)
        for k, line in enumerate(lines):
            theme.text(surface, line, middle, y + 41 + below + 18 * k, size=_LINE_SIZE, align="centre")
        _fade(surface, place, behind, view.end_opacity)
        return rect

    def pointer(self, surface: pygame.Surface, name: str, x: float, y: float) -> pygame.Rect:
        """A name with an arrow to its thing: above the thing, or below it at the upper edge."""
        theme, palette = self.theme, self.theme.palette
        side = -1 if y > TAG_ROOM else 1
        width = theme.width(name, _POINTER_SIZE, bold=True) + 12
        left = min(max(x - width / 2, 26), WIDTH - 26 - width)
        tip, base = y + side * 17, y + side * 23
        top = tag_top(y)
        box = theme.canvas.fill_rect(surface, palette.accent, left, top, width, 16, 4)
        theme.canvas.polygon(surface, palette.accent, [(x - 6, base), (x + 6, base), (x, tip)])
        middle = left + width / 2
        theme.text(surface, name, middle, top + 3, size=_POINTER_SIZE, colour=palette.panel, align="centre", bold=True)
        return box.inflate(theme.canvas.px(4), theme.canvas.px(18))

    def _tail(self, surface: pygame.Surface, box: Box, at: Point) -> pygame.Rect:
        """A pointer from a message's panel to its place."""
        x, y, w, h = box.area
        root = min(max(at[0], x + _TAIL), x + w - _TAIL), min(max(at[1], y + _TAIL), y + h - _TAIL)
        upright = not y < at[1] < y + h
        palette, canvas = self.theme.palette, self.theme.canvas
        rects = []
        for colour, half_width in ((palette.panel_edge, _TAIL), (palette.panel, _TAIL - 2)):
            dx, dy = (half_width, 0) if upright else (0, half_width)
            ends = (root[0] - dx, root[1] - dy), (root[0] + dx, root[1] + dy)
            rects.append(canvas.polygon(surface, colour, [*ends, at]))
        return rects[0].union(canvas.circle(surface, palette.accent, at, 3)).inflate(2, 2)

    def box(self, message: PlacedMessage) -> Box:
        """The place of a message: in the upper border, else in the lower one, over solid tiles.

        If it would hide something there, or open space that it may not cover, it lies where it hides least, but never
        over the ninja or what it must not hide, and else in the border below, beside the gold. A message with a place
        lies at most four cells from it, and hides as little of its frame as it can; one of an event up to twelve if
        it would hide an object nearer.
        """
        return _box(self._measures, message)

    def draw_message(
        self, surface: pygame.Surface, box: Box, moves: Sequence[int] = (), letters: Sequence[str] = ()
    ) -> pygame.Rect:
        """A message in its panel, each line behind the keys that it explains."""
        lines, left, y, w, line_height, margin, size = box
        rect, room = self.theme.panel(surface, *box.area, 4), _MESSAGE_MAX_WIDTH - (_KEYS_WIDTH if moves else 0)
        for k, line in enumerate(lines):
            top = y + margin + line_height * k
            if moves:
                self.keys(surface, moves[k], left + 14, top + 2, letters)
            x, align = (left + 14 + _KEYS_WIDTH, "left") if moves else (left + w / 2, "centre")
            self.theme.text(surface, line, x, top + (line_height - size) / 2, size=size, align=align, width=room)
        return rect

    def keys(
        self, surface: pygame.Surface, inputs: int, x: float = 366, y: float = 580, letters: Sequence[str] = ()
    ) -> pygame.Rect:
        """The three keys of an input: left, jump, right, with their letters if they have any, else with arrows.

        The keys of the present tick lie below the level.
        """
        palette, canvas = self.theme.palette, self.theme.canvas
        rect = pygame.Rect(0, 0, 0, 0)
        for place, (dx, bit, arrow) in enumerate(_KEYS):
            down = bool(inputs & bit)
            box = canvas.fill_rect(surface, palette.accent if down else palette.panel, x + dx, y, 18, 16, 3)
            canvas.frame_rect(surface, palette.panel_edge, x + dx, y, 18, 16, 1, 3)
            ink = palette.panel if down else palette.faint
            if letters and len(letters[place]) == 1:
                x_of, letter = x + dx + 9, letters[place]
                self.theme.text(surface, letter, x_of, y + 2, size=10, colour=ink, align="centre", bold=True, height=13)
            else:
                canvas.polygon(surface, ink, [(x + dx + 9 + px, y + 8 + py) for px, py in arrow])
            rect = box if not rect.width else rect.union(box)
        return rect


def _clear_of(ninja: Point | None, box: Box, *, softly: bool) -> float:
    """Opacity of a message's panel, _FAINT…1: lower, the nearer the ninja is to being hidden."""
    if ninja is None:
        return 1.0
    away = away_from(ninja, *box.area)
    share = (away - _COVERED) / (CLEAR_AWAY - _COVERED) if softly else float(away >= CLEAR_AWAY)
    return _FAINT + (1 - _FAINT) * min(1.0, max(0.0, share))


def _covered_picture(surface: pygame.Surface, place: pygame.Rect, opacity: float) -> pygame.Surface | None:
    """A copy of the picture under a panel that is not solid."""
    if opacity >= 1:
        return None
    behind = pygame.Surface(place.size, pygame.SRCALPHA)
    behind.blit(surface, (0, 0), place)
    return behind


def _fade(surface: pygame.Surface, place: pygame.Rect, behind: pygame.Surface | None, opacity: float) -> None:
    """Blend the copy of the picture into the panel, by the panel's opacity."""
    if behind:
        behind.fill((round(255 * (1 - opacity)),) * 4, special_flags=pygame.BLEND_RGBA_MULT)
        surface.blit(behind, place, special_flags=pygame.BLEND_PREMULTIPLIED)


@lru_cache(maxsize=4)
def _box(theme: Theme, message: PlacedMessage) -> Box:
    """As ``Hud.box``. Cached: the search for a place takes longer than all the rest of a picture."""
    text, tiles, things, place, covers, frame, taken, moves = message
    keys = _KEYS_WIDTH if moves else 0.0
    line_height, anchor = _MESSAGE_LINE * theme.scales[0], place if frame else None
    if place:
        things = (*things, (*place, MUST))
    for area, cost in ((frame, MAY), (taken, 9 * MUST)):
        things = (*things, *points_in(area, cost)) if area else things
    boxes: list[tuple[int, Box]] = []
    ways = [(1, 1, 1), (2, 1, 1), (2, 0.6, 1), (0, 1, 1), (0, 0.6, 1)]
    if frame:
        ways = [(0, share, reach) for reach in ((1,) if frame[2] else (1, 2, 3)) for share in (1, 0.6, 0.4, 0.3)]
    for rows, share, reach in ways:
        if reach > 1 and min(boxes)[0] < MUST:
            break
        lines = text.split("\n")
        if not keys:
            lines = [part for line in lines for part in wrapped(theme, line, share * _MESSAGE_WIDTH, _MESSAGE_SIZE)]
        lines = [theme.fit(line, _MESSAGE_MAX_WIDTH - keys, _MESSAGE_SIZE) for line in lines]
        width = min(max(theme.width(line, _MESSAGE_SIZE) for line in lines), _MESSAGE_MAX_WIDTH - keys) + 28 + keys
        left, y, covered, hidden = solid_place(
            tiles, width, line_height * len(lines) + 19, things, place, rows=rows, beside=anchor, reach=reach
        )
        box = Box(lines, left, y, width, line_height, 10.0, _MESSAGE_SIZE)
        if hidden < (MUST if keys else 1) and (covers or not rows or not covered):
            return box
        boxes.append((hidden, box))
    if anchor:
        return min(boxes)[1]
    text = text.replace("\n", "    ")
    size = min(_MESSAGE_SIZE, _MESSAGE_SIZE * _BESIDE_GOLD / theme.width(text, _MESSAGE_SIZE))
    width = theme.width(text, size) + 28
    return Box([text], (WIDTH - width) / 2, BORDER_MESSAGE_TOP, width, 17.0, 3.0, size)
