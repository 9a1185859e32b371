"""What is written over a level: time bar, name, messages, keys."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import hypot

import pygame

from ninja_game.files.shown_text import shown_text
from ninja_game.formats.run_time import rounded_text, seconds_text
from ninja_game.formats.sayings import THINGS, named_keys
from ninja_game.play.level.play import MUST, STAMP_TICKS, TAG_ROOM, LevelPlay, Phase, Things, tag_top
from ninja_game.play.level.sayings import FALL_HELP, WHY
from ninja_game.player.player_data import FIRST_PASS, NEW_ALL_GOLD, OF_A_LEVEL
from ninja_game.player.playthrough import Navigation
from ninja_game.player.progress import NO_MEDAL, Mark, next_par
from ninja_game.player.records import SELF
from ninja_game.sim.collision.tiles import FULL, SHAPE
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.sim.kinds import EXIT, SWITCH
from ninja_game.sim.level import ROWS
from ninja_game.sim.memory.schema import World
from ninja_game.sim.rules import CELL, LIFETIME
from ninja_game.ui.canvas import WIDTH, Point
from ninja_game.ui.input.bindings import MOVES
from ninja_game.ui.theme import Palette, Theme, mixed, wrapped
from ninja_game.ui.widgets import draw_medal, draw_stamp

_BAR_LEFT, _BAR_MIDDLE = 24.0, 12.0
_BAR_LONGEST = 630.0
"""Its length, px, with the lifetime that a level begins with, or more."""
_WARNING_TICKS, _LAST_TICKS = 1800, 800
_MARKED = "silver", "gold"
_FOOT_WIDTH = 744.0


_KEYS = (
    (0, KEY_LEFT, ((-3, 0), (2, -4), (2, 4))),
    (20, JUMP_HELD, ((0, -4), (4, 2), (-4, 2))),
    (40, KEY_RIGHT, ((3, 0), (-2, -4), (-2, 4))),
)
"""Where the keys of left, jump and right are drawn, their bits and their arrows."""


def bar_length(lifetime: float) -> float:
    """Length of the time bar, px, for a lifetime in ticks.

    >>> bar_length(900), bar_length(3600), bar_length(7200)
    (157.5, 630.0, 630.0)
    """
    return _BAR_LONGEST * min(1.0, max(0.0, lifetime / LIFETIME))


def trough(palette: Palette) -> pygame.Color:
    """What is behind the time bar."""
    return mixed(palette.tile, palette.outline, 0.8)


Box = tuple[list[str], float, float, float, float, float, float]
"""Lines of text; left, top and width of their panel; the height of a line, the margin, the size of the letters."""

KeyName = Callable[[str], str]
"""Gives what to press for an action."""


@dataclass(frozen=True)
class HudView:
    """What is written over a level now.

    ``lifetime``: ticks, for the time bar; ``label``: a word in its place; ``pars``: medals, and with which lifetime
    each is lost. ``foot``: texts at the left and the right of the border below, ``name``: what is at the
    left where a text lies there. ``keys``: those of the present tick,
    ``frame_ms``: of the last picture; None: not shown.
    ``said``: a text of the level, its tiles and the things of which it covers as little as can be, the place near which
    it should be, whether it may cover anything but rock: else it may lie in the border below, and whether it is about
    that place: then it lies beside it, whatever it covers, and points to it. ``moves``: the keys
    of each of its lines, ``letters``: what is on the keys of left, jump and right.
    ``named``: what it names, and where that is, px. ``message``: title and lines of a panel, and the level's tiles
    and the things of which it covers as little as can be; ``medal``: that of the pass, or "", ``stamp``: how far it has
    grown, 0…1, ``shine``: how far light has swept over it. ``seen``: how solid the panel is, 0…1.
    ``ninja``: where it is in play, px: what is said over it fades, ``softly`` or at once.
    """

    lifetime: float
    label: str
    foot: tuple[str, str]
    name: str = ""
    pars: Sequence[tuple[str, float]] = ()
    keys: int | None = None
    frame_ms: float | None = None
    said: tuple[str, tuple[int, ...], Things, Point | None, bool, bool] | None = None
    moves: Sequence[int] = ()
    letters: Sequence[str] = ()
    named: Sequence[tuple[str, float, float]] = ()
    message: tuple[str, Sequence[str], tuple[int, ...], Things] | None = None
    medal: str = ""
    stamp: float = 1.0
    shine: float = 1.0
    seen: float = 1.0
    ninja: Point | None = None
    softly: bool = True


class Hud:
    """Draws on a theme's canvas. Every method gives the px rectangle that it covered, or several small ones."""

    def __init__(self, theme: Theme) -> None:
        self.theme = theme

    def draw(self, surface: pygame.Surface, view: HudView) -> list[pygame.Rect]:
        """All of it; the px rectangles that it covers."""
        top = [self.label(surface, view.label)] if view.label else self.time_bar(surface, view.lifetime, view.pars)
        said = self.box(*view.said, keys=KEYS_WIDE if view.moves else 0) if view.said else None
        in_border = said is not None and said[2] == IN_BORDER
        written = top + self.foot(surface, "" if in_border else view.foot[0], view.foot[1])
        if said is not None and in_border:
            # It lies beside the text at the right, and leaves the rest to the level's own name.
            left = max(24.0, RIGHT - self.theme.width(view.foot[1], FOOT) - 14 - said[3])
            said = said[0], left, *said[2:]
            if left > NAME_FROM:
                written += self.foot(surface, self.theme.fit(view.name, left - 36, FOOT), "")
        if view.frame_ms is not None:
            written.append(self.frame_time(surface, view.frame_ms))
        if view.keys is not None:
            written.append(self.keys(surface, view.keys))
        written += [self.pointer(surface, *named) for named in view.named]
        if said is not None:
            seen = 1.0 if in_border else _clear_of(view.ninja, said, softly=view.softly)
            place = self.theme.canvas.rect(*_area(said))
            behind = _behind(surface, place, seen)
            if view.said and view.said[-1] and view.said[3]:
                written.append(self._tail(surface, said, view.said[3]))
            written.append(self.said(surface, said, () if in_border else view.moves, view.letters))
            _fade(surface, place, behind, seen)
        if view.message and view.seen > 0:
            written.append(self.message(surface, view, *view.message))
        return written

    def time_bar(
        self, surface: pygame.Surface, lifetime: float, pars: Sequence[tuple[str, float]] = ()
    ) -> list[pygame.Rect]:
        """The lifetime (ticks) as a bar, what gold added to the first in gold, and as seconds; medals where they end.

        It grows thick and red as it runs out.
        """
        palette, canvas = self.theme.palette, self.theme.canvas
        left = max(0.0, lifetime)
        danger = min(1.0, max(0.0, 1 - left / _WARNING_TICKS))
        thick = 5 + 8 * danger
        top = _BAR_MIDDLE - thick / 2
        frame = canvas.fill_rect(surface, trough(palette), _BAR_LEFT - 1, top - 1, _BAR_LONGEST + 2, thick + 2, 2)
        full = mixed(palette.bar_full, palette.bar_empty, danger)
        for colour, ticks in ((full, left), (palette.gold, left - LIFETIME)):
            if length := bar_length(ticks):
                canvas.fill_rect(surface, colour, _BAR_LEFT, top, length, thick, 1.5)
        for medal, ticks in pars:
            draw_medal(surface, self.theme, medal, _BAR_LEFT + bar_length(ticks), _BAR_MIDDLE, MARK)
        x = _BAR_LEFT + _BAR_LONGEST
        text = self.theme.text(
            surface, f"{rounded_text(int(left))} s left" + " to live" * (left < _LAST_TICKS), RIGHT, 7.4, size=9,
            colour=palette.on_tile, align="right", bold=True, width=RIGHT - x - 10,
        )  # fmt: skip
        return [frame.union(canvas.rect(x, 2, 8, 20)) if pars else frame, text.inflate(canvas.px(8), 4)]

    def label(self, surface: pygame.Surface, text: str) -> pygame.Rect:
        """A word in the time bar's place."""
        return self.theme.text(surface, text, 24, 7, size=10, colour=self.theme.palette.on_tile, bold=True)

    def foot(self, surface: pygame.Surface, left: str, right: str) -> list[pygame.Rect]:
        """A line in the border below the level; where both texts do not fit, the left one is shortened."""
        return self._border_line(surface, left, right, 582)

    def _border_line(self, surface: pygame.Surface, left: str, right: str, y: float) -> list[pygame.Rect]:
        theme, colour = self.theme, self.theme.palette.on_tile
        gap = 14 if left and right else 0
        # The right text grows only where that takes nothing from the left one.
        beside = min(_FOOT_WIDTH / 2, theme.lettering.width(left, FOOT))
        room = max(min(_FOOT_WIDTH, theme.lettering.width(right, FOOT)), _FOOT_WIDTH - beside - gap)
        rect = theme.text(surface, right, 768, y, size=FOOT, colour=colour, align="right", width=room)
        room = _FOOT_WIDTH - rect.width / theme.canvas.scale - gap
        return [rect, theme.text(surface, left, 24, y, size=FOOT, colour=colour, width=room)]

    def head(self, surface: pygame.Surface, left: str, right: str) -> list[pygame.Rect]:
        """A line in the border above the level, like ``foot`` below it."""
        return self._border_line(surface, left, right, 7)

    def frame_time(self, surface: pygame.Surface, ms: float) -> pygame.Rect:
        """What the last turn of the loop took, in the corner."""
        colour = self.theme.palette.on_tile
        rect = self.theme.text(surface, f"{ms:.1f} ms", 768, 566, size=8, colour=colour, align="right")
        return rect.inflate(self.theme.canvas.px(12), 2)

    def message(
        self, surface: pygame.Surface, view: HudView, title: str, lines: Sequence[str], tiles: tuple[int, ...],
        things: Things,
    ) -> pygame.Rect:  # fmt: skip
        """A panel: a title and lines under it; with a medal at its left, beside it the first line too, in large."""
        theme, medal = self.theme, view.medal
        below, beside = (26, PRIZE + 14) if medal else (0, 0)
        named, lines = (lines[0], lines[1:]) if medal else ("", lines)
        head = max(theme.width(title, TITLE, bold=True), theme.width(named, NAMED, bold=True))
        fits = [[line] if theme.width(line, LINE) < WIDE else wrapped(theme, line, WIDE, LINE) for line in lines]
        lines = [part for parts in fits for part in parts]
        w = max(220.0, head + beside, *(theme.width(line, LINE) for line in lines)) + 44
        h = 48.0 + 18 * len(lines) + below
        x, y = (WIDTH - w) / 2, UPPER
        if any(worth > MUST for worth in _hidden(things, x, y, w, h)):
            x, y, *_ = solid_place(tiles, w, h, things, rows=2)
        place = theme.canvas.rect(x, y, w, h)
        behind = _behind(surface, place, view.seen)
        rect = theme.panel(surface, x, y, w, h, 4)
        middle = x + w / 2
        if medal:
            # It grows a little too large, but never over the words beside it.
            at = middle - (head + 14) / 2, y + 9 + PRIZE / 2
            draw_stamp(surface, theme, medal, *at, PRIZE, view.stamp, view.shine)
        across = middle + beside / 2
        theme.text(surface, title, across, y + 9, size=TITLE, align="centre", bold=True)
        accent = theme.palette.accent
        theme.text(surface, named, across, y + 43, size=NAMED, colour=accent, align="centre", bold=True)
        for k, line in enumerate(lines):
            theme.text(surface, line, middle, y + 41 + below + 18 * k, size=LINE, align="centre")
        _fade(surface, place, behind, view.seen)
        return rect

    def pointer(self, surface: pygame.Surface, name: str, x: float, y: float) -> pygame.Rect:
        """A name with an arrow to what it names: above it, or below where that is at the upper edge."""
        theme, palette = self.theme, self.theme.palette
        way = -1 if y > TAG_ROOM else 1
        wide = theme.width(name, POINTER, bold=True) + 12
        left = min(max(x - wide / 2, 26), WIDTH - 26 - wide)
        tip, base, top = y + way * 17, y + way * 23, tag_top(y)
        box = theme.canvas.fill_rect(surface, palette.accent, left, top, wide, 16, 4)
        theme.canvas.polygon(surface, palette.accent, [(x - 6, base), (x + 6, base), (x, tip)])
        middle = left + wide / 2
        theme.text(surface, name, middle, top + 3, size=POINTER, colour=palette.panel, align="centre", bold=True)
        return box.inflate(theme.canvas.px(4), theme.canvas.px(18))

    def _tail(self, surface: pygame.Surface, box: Box, at: Point) -> pygame.Rect:
        """From a text's panel to the place that it is about."""
        x, y, w, h = _area(box)
        near = min(max(at[0], x + TAIL), x + w - TAIL), min(max(at[1], y + TAIL), y + h - TAIL)
        upright = not y < at[1] < y + h
        rects = []
        for colour, wide in ((self.theme.palette.panel_edge, TAIL), (self.theme.palette.panel, TAIL - 2)):
            dx, dy = (wide, 0) if upright else (0, wide)
            ends = (near[0] - dx, near[1] - dy), (near[0] + dx, near[1] + dy)
            rects.append(self.theme.canvas.polygon(surface, colour, [*ends, at]))
        return rects[0].union(self.theme.canvas.circle(surface, self.theme.palette.accent, at, 3)).inflate(2, 2)

    def box(
        self, text: str, tiles: tuple[int, ...], things: Things, eye: Point | None, covers: bool, near: bool = False, *,
        keys: float = 0.0,
    ) -> Box:  # fmt: skip
        """Where a text of the level lies: along the upper border, else the lower one, over what is solid.

        Where it would hide something there, or open space that it may not cover, it lies where it hides least; over
        nothing that it is to keep clear of, nor the ninja, or else in the border below, beside the gold. ``near``: at
        most two cells from ``eye``.
        """
        return _box(self.theme, text, tiles, things, eye, covers, near, keys)

    def said(
        self, surface: pygame.Surface, box: Box, moves: Sequence[int] = (), letters: Sequence[str] = ()
    ) -> pygame.Rect:
        """A text of the level in its panel, its lines behind the keys that they are about."""
        lines, left, y, w, high, margin, size = box
        rect = self.theme.panel(surface, *_area(box), 4)
        for k, line in enumerate(lines):
            top = y + margin + high * k
            if moves:
                self.keys(surface, moves[k], left + 14, top + 2, letters)
            x, align = (left + 14 + KEYS_WIDE, "left") if moves else (left + w / 2, "centre")
            self.theme.text(surface, line, x, top + (high - size) / 2, size=size, align=align)
        return rect

    def keys(
        self, surface: pygame.Surface, held: int, x: float = 366, y: float = 580, letters: Sequence[str] = ()
    ) -> pygame.Rect:
        """The three keys of an input: left, jump, right, with their letters where they have such, else with arrows.

        That of the present tick lies below the level.
        """
        palette, canvas = self.theme.palette, self.theme.canvas
        rect = pygame.Rect(0, 0, 0, 0)
        for place, (dx, bit, arrow) in enumerate(_KEYS):
            down = bool(held & bit)
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


def _area(box: Box) -> tuple[float, float, float, float]:
    """Left, top, width and height of a text's panel, px."""
    lines, left, y, w, high, margin, _ = box
    return left, y, w, high * len(lines) + 2 * margin - 1


def _away(point: Point, x: float, y: float, w: float, h: float) -> float:
    """How far a point is from a panel, px."""
    return hypot(max(x - point[0], 0.0, point[0] - x - w), max(y - point[1], 0.0, point[1] - y - h))


def _clear_of(ninja: Point | None, box: Box, *, softly: bool) -> float:
    """How solid a text's panel is, FAINT…1: the less, the nearer the ninja is to being hidden by it."""
    if ninja is None:
        return 1.0
    away = _away(ninja, *_area(box))
    share = (away - COVERED) / (CLEAR - COVERED) if softly else float(away >= CLEAR)
    return FAINT + (1 - FAINT) * min(1.0, max(0.0, share))


def _behind(surface: pygame.Surface, place: pygame.Rect, seen: float) -> pygame.Surface | None:
    """What a panel that is not solid is about to cover."""
    if seen >= 1:
        return None
    behind = pygame.Surface(place.size, pygame.SRCALPHA)
    behind.blit(surface, (0, 0), place)
    return behind


def _fade(surface: pygame.Surface, place: pygame.Rect, behind: pygame.Surface | None, seen: float) -> None:
    """Let what it covers be seen through a panel, as far as that is not solid."""
    if behind:
        behind.fill((round(255 * (1 - seen)),) * 4, special_flags=pygame.BLEND_RGBA_MULT)
        surface.blit(behind, place, special_flags=pygame.BLEND_PREMULTIPLIED)


def _hidden(things: Things, x: float, y: float, w: float, h: float) -> Iterator[int]:
    """What each thing is worth that a panel would hide."""
    return (worth for a, b, worth in things if -NEAR < a - x < w + NEAR and -NEAR < b - y < h + NEAR)


@lru_cache(maxsize=4)
def _box(
    theme: Theme, text: str, tiles: tuple[int, ...], things: Things, eye: Point | None, covers: bool, near: bool,
    keys: float,
) -> Box:  # fmt: skip
    """As ``Hud.box``. Kept, since a text is drawn in each picture and its place takes longer than all the rest."""
    high = SAID_LINE * theme.scales[0]
    if eye:
        things = (*things, (*eye, MUST))
    beside: list[tuple[int, Box]] = []
    for rows, width in ((0, 1), (0, 0.6), (0, 0.4)) if near else ((1, 1), (2, 1), (2, 0.6), (0, 1), (0, 0.6)):
        lines = text.split("\n") if keys else wrapped(theme, text, width * SAID_WIDE, SAID)
        lines = [theme.fit(line, SAID_WIDEST - keys, SAID) for line in lines]
        w = max(theme.width(line, SAID) for line in lines) + 28 + keys
        left, y, covered, hidden = solid_place(tiles, w, high * len(lines) + 19, things, eye, rows=rows, near=near)
        box = lines, left, y, w, high, 10.0, SAID
        if hidden < (MUST if keys else 1) and (covers or not rows or not covered):
            return box
        beside.append((hidden, box))
    if near:
        return min(beside)[1]
    text = text.replace("\n", "    ")
    size = min(SAID, SAID * BESIDE_GOLD / theme.width(text, SAID))
    w = theme.width(text, size) + 28
    return [text], (WIDTH - w) / 2, IN_BORDER, w, 17.0, 3.0, size


@lru_cache(maxsize=4)
def solid_place(
    tiles: tuple[int, ...], w: float, h: float, things: Things = (), eye: Point | None = None, *, rows: int = 0,
    near: bool = False,
) -> tuple[float, float, int, int]:  # fmt: skip
    """Upper left corner of a panel of that size, px, where it covers no thing, little gold and the least of any way.

    The third is how much it covers, the last how much of that are things, gold and the author's way. What is full is no
    way, open space far from all that is full hardly one. Of equal places it is the one nearest to ``eye``, or to the
    middle of the upper border. ``rows``: at the left, in the middle and at the right of so many heights only, from the
    upper border to the lower one; ``near``: around ``eye`` only, BESIDE px from it.
    """
    open_cells, ways = _ways(tiles)

    def cost(place: tuple[float, float]) -> tuple[int, float, int]:
        x, y = place
        columns, heights = (slice(int(a // CELL) - 1, int((a + b - 1) // CELL)) for a, b in ((x, w), (y, h)))
        area = (1 << heights.stop) - (1 << heights.start)
        covered = sum((cells & area).bit_count() for cells in open_cells[columns])
        covered += (ALONG - 1) * sum((cells & area).bit_count() for cells in ways[columns])
        hidden = sum(_hidden(things, x, y, w, h))
        far = hypot(x + w / 2 - eye[0], y + h / 2 - eye[1]) if eye else 0.0
        return covered + hidden, far or abs(x + w / 2 - WIDTH / 2) + y, hidden

    edge = CELL + 4
    lefts = [edge + k * (WIDTH - 2 * edge - w) / 8 for k in range(0, 9, 4 if rows else 1)]
    apart = (LOWEST - h - edge) / max(1, rows - 1) if rows else 6
    tops = [edge + k * apart for k in range(rows or int((LOWEST - h - edge) / 6))]
    if near and eye:
        ends = (eye[0], w, WIDTH - edge), (eye[1], h, LOWEST)
        lefts, tops = (
            [min(max(edge, at + k * (BESIDE + size / 2) / 4 - size / 2), end - size) for k in range(-4, 5)]
            for at, size, end in ends
        )
    places = [(x, y) for x in lefts for y in tops if not near or eye is None or _away(eye, x, y, w, h) >= BESIDE - 1]
    x, y = min(places, key=cost)
    covered, _, hidden = cost((x, y))
    return x, y, covered, hidden


@lru_cache(maxsize=4)
def _ways(tiles: tuple[int, ...]) -> tuple[list[int], list[int]]:
    """A number for each column of a level, a bit for each row: what is not full, and of that what lies along rock."""
    all_rows = (1 << ROWS) - 1
    full = [sum(1 << row for row in range(ROWS) if SHAPE[tiles[first + row]] == FULL)
            for first in range(0, len(tiles), ROWS)]  # fmt: skip
    along = [all_rows, *(a | b | c for a, b, c in zip(full, full[1:], full[2:], strict=False)), all_rows]
    edges = 1 | 1 << ROWS - 1
    return [~each & all_rows for each in full], [
        (near | near << 1 | near >> 1 | edges) & ~each & all_rows for near, each in zip(along, full, strict=True)
    ]


NEAR, ALONG = 16.0, 7
"""px that a panel keeps from the middle of a thing; open cells that weigh as much as a cell along rock."""

FADE_TICKS, SHINE_TICKS, END_ROOM = 8, 20, 36.0
"""In how many ticks the panel of an ended run fades in, and light sweeps over its medal; px to all sides of where the
run ended that it leaves free."""

FAINT, COVERED, CLEAR = 0.2, 10.0, 34.0
"""How solid the panel of a text is over the ninja; px from the ninja to it at which it is so, and solid."""

BESIDE, TAIL = 36.0, 8.0
"""px from a place to the panel of what is said about it: solid while the ninja is there; half its pointer's width."""

UPPER = 36.0
"""Where the panel of an ended run begins, in the middle, unless it would hide that end or an exit."""

LOWEST = 573.0
"""Where it ends at the latest: below it are the level's name and what a pass has brought."""

TITLE, NAMED, LINE, POINTER = 26.0, 15.0, 12.5, 9.5
"""Sizes in the panel of a passed level: its time, the medal, the rest; and of the names of things."""

WIDE = WIDTH - 150.0
"""A longer line of the panel is broken."""

MARK, RIGHT = 12.0, 768.0
"""Size of a medal on the time bar; right edge of what is written in the borders."""

PRIZE = 54.0
"""Size of the medal of a pass."""

POINTER_UP, POINTER_REACH = 24.0, 50.0
"""px from a thing to the middle of its pointer, and to where it ends."""

FOOT, IN_BORDER, BESIDE_GOLD, KEYS_WIDE, NAME_FROM = 11.0, 576.0, 490.0, 70.0, 90.0
"""Size of the lines in the borders; where what a level says is in a border; its width there; of keys; px from which on
there is room for a name beside it."""

SAID, SAID_LINE, SAID_WIDE, SAID_WIDEST = 15.0, 22.0, 440.0, 680.0
"""Size of what a level says, height of its lines, how wide they are at most, and how wide a single word."""

_TOOLS = {"quick_save": "save", "quick_load": "load", "rewind": "rewind", "slow": "slow", "step": "step"}
_TOOLS_NAMED = 600
"""Ticks of a practice run in which the keys of its tools are named: where they work, and not for ever."""

_THINGS = {"switch": SWITCH, "exit": EXIT}


def hud_view(play: LevelPlay) -> HudView:
    """What is written over a level now."""
    app, attempt, context = play.app, play.attempt, play.context
    key, settings = app.controls.name, app.settings
    gold = f"{attempt.gold} / {play.all_gold}"
    message = None
    text = "" if play.phase in {Phase.DEAD, Phase.PASSED} else play.sayings.text
    # The start's text stays where it is; who needs to see what keys do is stuck. Both may cover open space.
    covers = play.sayings.is_start or "\n" in text
    place = play.sayings.place
    where = context.level.tiles, play.things, place or play.eye, covers, place is not None
    said = (named_keys(text, key), *where) if text else None
    if play.phase is Phase.DEAD:
        cause, _, why = cause_of_death(play).partition(". ")
        message = cause.rstrip("."), [*filter(None, [why]), _after_death(play, key)], *_covering(play)
    if play.phase is Phase.PASSED:
        onward = "go on" if context.way_out is Navigation.EPISODE_END else context.onward
        keys = f"{key('confirm')}: {onward}    {key('retry')}: play again    {key('replay')}: replay"
        if not context.leads_on:
            keys = f"{key('confirm')}: play again    {key('replay')}: replay    {key('back')}: leave"
        time = f"{seconds_text(attempt.ended_tick)} s"
        title = f"Time {time}" if play.medal else f"Passed    time {time}"
        message = title, [*_reached(play), keys], *_covering(play)
    hint = _hint(play, key)
    name = shown_text(context.title)
    title = f"{name} ({play.aim})" if play.phase is Phase.READY and play.aim else name
    if (settings.game_speed < 100 or play.invincible or attempt.assisted) and not context.practice_mode:
        title += f"    {NO_MEDAL}"
    practice = "Practice" + (", slow motion" if play.tools.slow else "")
    return HudView(
        play.shown_lifetime,
        practice if context.practice_mode else "",
        (title, hint or f"gold {gold}"),
        name=shown_text(context.entry.title),
        pars=_pars_ahead(play),
        keys=play.keys if settings.show_keys and not hint else None,
        frame_ms=app.frame_ms if settings.show_frame_time else None,
        said=said,
        moves=[sum(bit for name, bit in MOVES if f"{{{name}}}" in line) for line in text.split("\n") if "\n" in text],
        letters=[key(name) for name in ("left", "jump", "right")],
        message=message,
        named=() if message else named_in(attempt.simulation.world, play.sayings.named),
        medal=play.medal,
        stamp=play.stamp,
        shine=1.0 if settings.reduced_motion else (play.after_end + play.fraction - STAMP_TICKS) / SHINE_TICKS,
        seen=1.0 if settings.reduced_motion else min(1.0, (play.after_end + play.fraction) / FADE_TICKS),
        ninja=play.ninja_place(),
        softly=not settings.reduced_motion,
    )


def _pars_ahead(play: LevelPlay) -> list[tuple[str, float]]:
    """The medals that this try can still bring, in a level that was passed, each with the lifetime at its par."""
    pars, attempt = play.context.pars, play.attempt
    if pars is None or not play.aim or play.phase is Phase.PASSED:
        return []
    tick = attempt.simulation.tick
    ahead = ((medal, attempt.lifetime - (pars.par(medal) - tick)) for medal in _MARKED)
    return [(medal, ticks) for medal, ticks in ahead if 0 < ticks < min(attempt.lifetime, LIFETIME)]


def _covering(play: LevelPlay) -> tuple[tuple[int, ...], Things]:
    """The tiles and things of which the panel of an ended run covers little; never where it ended, nor an exit."""
    x, y = play.eye or (0.0, 0.0)
    end = [(x + dx, y + dy, 9 * MUST) for dx in (-END_ROOM, 0, END_ROOM) for dy in (-END_ROOM, 0, END_ROOM)]
    exits = [(o.x, o.y, 9 * MUST) for o in play.attempt.simulation.world.objects[1:] if o.kind == EXIT]
    return play.context.level.tiles, (*end, *exits, *play.things)


def _reached(play: LevelPlay) -> list[str]:
    """The medal; what the next one needs; the gold of a passed run, what that has brought, and what it leaves."""
    attempt, pars = play.attempt, play.context.pars
    following = (
        [next_par(pars, Mark(attempt.ended_tick, 0)) or "The best medal there is. Well run!"]
        if pars and play.medal
        else []
    )
    gold = f"{attempt.gold} of {play.all_gold} gold" if attempt.gold < play.all_gold else f"All {play.all_gold} gold"
    medal = [f"{play.medal.capitalize()} medal"] if play.medal else []
    clock = [f"{rounded_text(attempt.lifetime)} s left on the clock, for the next level"] * play.context.carries_clock
    # Of a first pass all is new, and the medal and the gold are said already.
    first = FIRST_PASS in play.notices
    news = [each for each in play.notices if each != NEW_ALL_GOLD and not (first and each in OF_A_LEVEL)]
    return [*medal, *following, "    ".join([gold, *news]), *clock]


def named_in(world: World, names: Sequence[str] = THINGS) -> list[tuple[str, float, float]]:
    """What a level names, and where it is until it is used: never over the ninja."""
    return [
        (name, o.x, o.y)
        for name in names
        for o in world.objects[1:]
        if o.kind == _THINGS[name] and not (o.kind == SWITCH and world.objects[o.partner].is_open)
        if hypot(o.x - world.ninja.x, o.y - POINTER_UP - world.ninja.y) > POINTER_REACH
    ]


def _hint(play: LevelPlay, key: KeyName) -> str:
    """What to press now; "" in play and after it."""
    if play.phase is Phase.READY:
        show_tutorial = play.show_tutorial and not play.sayings.text
        return _ready_hint(key, practice_mode=play.context.practice_mode, show_tutorial=show_tutorial)
    if play.tools.stepping:
        return f"{key('step')}: one tick    {key('confirm')} or any move: go on"
    named = play.phase is not Phase.PASSED and play.attempt.simulation.tick < _TOOLS_NAMED
    if play.context.practice_mode and named:
        return "    ".join(f"{key(action)}: {name}" for action, name in _TOOLS.items())
    return ""


def _after_death(play: LevelPlay, key: KeyName) -> str:
    """What to press after a death."""
    again = f"{key('confirm')} or {key('jump')}: try again"
    return f"{again}    {key('replay')}: watch it" + f"    {key('skip')}: get help" * play.is_stuck


def _ready_hint(key: KeyName, *, practice_mode: bool, show_tutorial: bool) -> str:
    begin = f"{key('confirm')} or any move to start"
    if show_tutorial:
        return f"{key('left')} and {key('right')} to run    {key('jump')} to jump, hold it to go higher    {begin}"
    if practice_mode:
        return f"{begin}    {key('overlay_hitboxes')} to {key('overlay_thinkers')}: look inside"
    return begin


def cause_of_death(play: LevelPlay) -> str:
    if play.attempt.own_hand:
        return "You gave up."
    if play.killer != SELF:
        return f"Killed by a {play.killer}." + f" {WHY[play.killer]}" * play.sayings.helps
    if play.crushed:
        return "You were crushed."
    if play.attempt.lifetime <= 0:
        return "Out of time."
    return "You hit the ground too hard." + f" {FALL_HELP}" * play.sayings.helps
