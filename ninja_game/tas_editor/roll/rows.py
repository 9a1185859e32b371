"""The rows of the roll and their columns. An unchanged row is not drawn again, wherever it is now."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import NamedTuple

import pygame

from ninja_game.sim.events import EVENT_NAMES
from ninja_game.sim.inputs import JUMP_HELD, JUMP_PRESSED, KEY_LEFT, KEY_RIGHT, with_press_bit
from ninja_game.sim.states import JUMPING
from ninja_game.tas_editor.roll.facts import FLOOR, WALL_LEFT, WALL_RIGHT, RowFacts, Values
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import Area, Palette, Theme, mixed

# Logical px.
HEAD = 16.0  # height of the heads
_ROW = 11.0  # height of a row
_BAR = 12.0  # width of the scroll bar


class Column(NamedTuple):
    """A column of the roll; one with a ``meaning`` may be hidden.

    ``width``: logical px; 0: the rest. ``decimals``: of a number. ``key``: the key shown.
    """

    name: str
    head: str
    width: float
    decimals: int = 0
    key: int = 0
    meaning: str = ""


ROLL_COLUMNS = (
    Column("tick", "tick", 28),
    Column("left", "L", 13, key=KEY_LEFT),
    Column("right", "R", 13, key=KEY_RIGHT),
    Column("jump", "J", 13, key=JUMP_HELD),
    Column("x", "x", 32, 2, meaning="x, px"),
    Column("y", "y", 32, 2, meaning="y, px"),
    Column("vx", "vx", 30, 3, meaning="Speed to the right, px a tick"),
    Column("vy", "vy", 30, 3, meaning="Speed downwards, px a tick"),
    Column("state", "state", 24, meaning="State"),
    Column("jump_timer", "jt", 13, meaning="Jump timer, ticks"),
    Column("contacts", "|_|", 14, meaning="Floor and walls"),
    Column("gold", "gold", 18, meaning="Gold taken"),
    Column("exit", "exit", 27, 1, meaning="Px to the exit's disc"),
    Column("events", "events", 0, meaning="Events and markers"),
)


class _Place(NamedTuple):
    """A column in the window: its first px, and its width in px."""

    column: Column
    left: int
    width: int


@dataclass(frozen=True)
class RollLayout:
    """Places in px of the window. ``rows``: the number visible; ``row``: the height of one."""

    heads: pygame.Rect
    body: pygame.Rect
    bar: pygame.Rect
    row: int
    rows: int
    places: tuple[_Place, ...]

    def row_at(self, y: int) -> int:
        """The number of the row at a px, from the first visible one: negative above it."""
        return (y - self.body.top) // self.row

    def column_at(self, x: int) -> Column:
        """The column at a px; outside of all the nearest one."""
        return next((place.column for place in self.places if x < place.left + place.width), self.places[-1].column)


def layout_of(canvas: Canvas, area: Area, hidden: Collection[str]) -> RollLayout:
    """Heads, rows and scroll bar in an area, logical px. All rows have the same height, whole px."""
    whole = canvas.rect(*area)
    head, bar = canvas.px(HEAD), canvas.px(_BAR)
    row = max(6, int(_ROW * canvas.scale))
    rows = max(1, (whole.height - head) // row)
    body = pygame.Rect(whole.left, whole.top + head, whole.width - bar, rows * row)
    columns = [column for column in ROLL_COLUMNS if column.name not in hidden]
    free = area[2] - _BAR - sum(column.width for column in columns)
    places, x = [], 0.0
    for column in columns:
        left, x = x, x + (column.width or free)
        first = round(left * canvas.scale)
        behind = min(round(x * canvas.scale), body.width)
        places.append(_Place(column, whole.left + first, behind - first))
    heads = pygame.Rect(whole.left, whole.top, whole.width, head)
    side = pygame.Rect(body.right, body.top, whole.right - body.right, whole.height - head)
    return RollLayout(heads, body, side, row, rows, tuple(places))


STATES = ("stand", "run", "skid", "jump", "fall", "slide", "dead", "won")


class EventWord(NamedTuple):
    """The word for an event. ``chip``: background's role in the palette; ``ink``: the letters'."""

    word: str
    chip: str = ""
    ink: str = "outline"


EVENTS = {
    "died": EventWord("died", "bad", "panel"),
    "won": EventWord("exit", "good", "panel"),
    "exit-opened": EventWord("switch", "exit_light"),
    "gold-taken": EventWord("gold", "gold_light"),
    "lock-opened": EventWord("lock", "exit_light"),
    "trap-closed": EventWord("trap", "warning"),
    "door-opened": EventWord("door"),
    "jumped": EventWord("jump"),
    "launched": EventWord("pad"),
    "wall-jumped": EventWord("wall jump"),
    "mine-exploded": EventWord("mine"),
    "landed": EventWord("land"),
    "rocket-exploded": EventWord("blast"),
    "laser-on": EventWord("laser"),
    "rocket-launched": EventWord("rocket"),
    "chaingun-shot": EventWord("shot"),
    "turret-fired": EventWord("turret"),
    "block-woken": EventWord("block"),
    "chase-started": EventWord("chase"),
    "door-closed": EventWord("door shut"),
    "guard-started": EventWord("guard"),
    "thwump-fell": EventWord("thwump"),
    "thwump-landed": EventWord("thwump"),
}
EVENTS |= {name: EventWord(name.replace("-", " ")) for name in sorted({*EVENT_NAMES} - EVENTS.keys())}
"""Words for events, the most important event first."""


Blit = tuple[pygame.Surface, tuple[int, int]]


class Digits:
    """The characters of numbers in one size and any colours. ``theme``: the one they are made for."""

    def __init__(self, theme: Theme, size: float) -> None:
        self.theme, self._size = theme, size
        self._pictures: dict[int, dict[str, tuple[pygame.Surface, float]]] = {}
        # Widths of texts are whole px; of many characters the mean is exact.
        widths = {char: (theme.width(char * 21, size) - theme.width(char, size)) / 20 for char in "0123456789.-"}
        # All digits have one width, so that columns align.
        widest = max(widths[char] for char in "0123456789")
        scale = theme.canvas.scale
        self._advance = {char: (widest if char.isdigit() else width) * scale for char, width in widths.items()}

    def _characters(self, colour: pygame.Color) -> dict[str, tuple[pygame.Surface, float]]:
        render = self.theme.lettering.rendered
        return {char: (render(char, self._size, colour), width) for char, width in self._advance.items()}

    def blits(self, text: str, right: int, y: int, colour: pygame.Color) -> list[Blit]:
        """Blits (picture, place) of a number that ends left of ``right``, px."""
        key = int(colour)
        if key not in self._pictures:
            self._pictures[key] = self._characters(colour)
        characters = self._pictures[key]
        blits: list[Blit] = []
        x = right + 0.5
        for character in reversed(text):
            picture, width = characters[character]
            x -= width
            blits.append((picture, (int(x), y)))
        return blits


_SIZE = 8.0  # size of the letters, logical px
MIN_NAME_ROOM = 20.0  # least room for a name, logical px
_MAX_LETTERS = 6
_KEY_LETTERS = {KEY_LEFT: "L", KEY_RIGHT: "R", JUMP_HELD: "J"}


class RowSheet:
    """The visible rows as one picture. Tick k is at row k modulo their number: scrolling moves none.

    ``mark``: the colour of the compared run.
    """

    def __init__(self, theme: Theme, layout: RollLayout, mark: pygame.Color) -> None:
        self.theme, self.layout, self.mark = theme, layout, mark
        self._picture = pygame.Surface(layout.body.size)
        self._drawn: list[RowFacts | None] = [None] * layout.rows
        self._digits = Digits(theme, _SIZE)
        self._grounds: dict[tuple[bool, ...], tuple[pygame.Surface, pygame.Color, pygame.Color]] = {}
        self._blits: list[Blit] = []
        self._margin = theme.canvas.px(2)
        self._lift = (layout.row - theme.lettering.rendered("0", _SIZE, theme.palette.text).get_height() + 1) // 2

    def draw(self, surface: pygame.Surface, rows: Sequence[RowFacts]) -> int:
        """Draw rows, one below the other, from the upper edge on; the number of changed ones."""
        layout = self.layout
        changed = [row for row in rows if self._drawn[row.tick % layout.rows] != row]
        for row in changed:
            self._drawn[row.tick % layout.rows] = row
            self._row(row, (row.tick % layout.rows) * layout.row)
        self._picture.fblits(self._blits)
        self._blits.clear()
        self._show(surface, rows)
        return len(changed)

    def _show(self, surface: pygame.Surface, rows: Sequence[RowFacts]) -> None:
        body, row = self.layout.body, self.layout.row
        split = (rows[0].tick % self.layout.rows) * row if rows else 0
        surface.blit(self._picture, body, (0, split, body.width, body.height - split))
        if split:
            surface.blit(self._picture, (body.left, body.bottom - split), (0, 0, body.width, split))
        below = body.top + len(rows) * row
        surface.fill(self.theme.palette.background, (body.left, below, body.width, body.bottom - below))

    def _row(self, row: RowFacts, y: int) -> None:
        palette, layout, fill = self.theme.palette, self.layout, self._picture.fill
        ground, ink, line = self._ground(row)
        self._picture.blit(ground, (0, y))
        for place in layout.places:
            left = place.left - layout.body.left
            if place.column.key:
                self._key(row, place, left, y, line)
                if row.differs & place.column.key:
                    self._difference(row, place, left, y)
            elif place.column.name == "tick":
                if row.name:
                    fill(palette.ghost, (left, y, place.width, layout.row))
                number = palette.panel if row.name else ink
                right = left + place.width - self._margin
                self._blits += self._digits.blits(str(row.tick), right, y + self._lift, number)
            elif place.column.name == "events":
                self._events(row, left, place.width, y, ink)
            elif row.values:
                self._value(row.values, place, left, y, ink)
        if row.name:
            fill(palette.ghost, (0, y, layout.body.width, 1))
        if row.changed:
            fill(palette.ember, (0, y, self.theme.canvas.px(2.5), layout.row))
        if row.cursor:
            frame = (0, y, layout.body.width, layout.row)
            pygame.draw.rect(self._picture, palette.accent, frame, max(1, layout.row // 11))

    def _ground(self, row: RowFacts) -> tuple[pygame.Surface, pygame.Color, pygame.Color]:
        """The background of a row with its lines between columns; the colours of its letters and lines."""
        kind = row.values is None, row.over or row.beyond, row.selected, row.tick % 10 == 0
        if kind not in self._grounds:
            palette, layout = self.theme.palette, self.layout
            colour, ink = _inks(palette, row)
            ground_colour = colour if row.values is None else mixed(colour, palette.good, 0.17)
            line = mixed(colour, palette.panel_edge, 0.55)
            ground = pygame.Surface((layout.body.width, layout.row), 0, self._picture)
            ground.fill(colour)
            for place in layout.places:
                left = place.left - layout.body.left
                if place.column.key or place.column.name == "tick":
                    ground.fill(ground_colour, (left, 0, place.width, layout.row))
                ground.fill(line, (left, 0, 1, layout.row))
            if row.tick % 10 == 0:
                ground.fill(line, (0, 0, layout.body.width, 1))
            self._grounds[kind] = ground, ink, line
        return self._grounds[kind]

    def _key(self, row: RowFacts, place: _Place, left: int, y: int, line: pygame.Color) -> None:
        key, palette, height = place.column.key, self.theme.palette, self.layout.row
        if not row.keys & key:
            return
        begins = not row.before & key
        margin = max(1, height // 8)
        gap = max(1, height // 11) if begins else 0
        colour = palette.accent if key == JUMP_HELD else palette.switch
        box = (left + 1 + margin, y + gap, place.width - 2 * margin - 1, height - gap)
        self._picture.fill(mixed(colour, line, 0.35) if row.over else colour, box)
        letter = _KEY_LETTERS[key] if begins else ""
        if key == JUMP_HELD and row.keys != with_press_bit(row.keys, row.before & JUMP_HELD):
            # A recording may jump without the press, and press without the jump.
            letter = "!" if row.keys & JUMP_PRESSED else "-"
        if letter:
            picture = self.theme.lettering.rendered(letter, _SIZE, palette.panel, bold=True)
            middle = left + 1 + (place.width - picture.get_width()) // 2
            self._blits.append((picture, (middle, y + self._lift)))

    def _difference(self, row: RowFacts, place: _Place, left: int, y: int) -> None:
        """At the right of a key's cell: a bar if the key is down only in the other run, hollow if only in ours."""
        px, height, fill = self.theme.canvas.px, self.layout.row, self._picture.fill
        width = px(4)
        x = left + place.width - width
        fill(self.mark, (x, y, width, height))
        if row.keys & place.column.key:
            edge = max(1, px(1))
            fill(self.theme.palette.panel, (x + edge, y, width - 2 * edge, height))

    def _value(self, values: Values, place: _Place, left: int, y: int, ink: pygame.Color) -> None:
        name, theme = place.column.name, self.theme
        if name == "state":
            word = theme.lettering.rendered(STATES[values.state], _SIZE, ink)
            self._blits.append((word, (left + theme.canvas.px(2), y + self._lift)))
        elif name == "contacts":
            self._contacts(values.contacts, place, left, y, ink)
        elif name != "jump_timer" or values.state == JUMPING:
            value = getattr(values, name)
            if value == 0:
                text, ink = "0", mixed(ink, theme.palette.panel, 0.5)
            else:
                text = short_number(value, place.column.decimals)
            self._blits += self._digits.blits(text, left + place.width - self._margin, y + self._lift, ink)

    def _contacts(self, contacts: int, place: _Place, left: int, y: int, ink: pygame.Color) -> None:
        thick, height = max(2, self.theme.canvas.px(2)), self.layout.row
        x, width, fill = left + 1 + thick, place.width - 2 * thick - 1, self._picture.fill
        if contacts & FLOOR:
            fill(ink, (x, y + height - thick, width, thick))
        if contacts & WALL_LEFT:
            fill(ink, (x, y + 1, thick, height - 1))
        if contacts & WALL_RIGHT:
            fill(ink, (x + width - thick, y + 1, thick, height - 1))

    def _events(self, row: RowFacts, left: int, width: int, y: int, ink: pygame.Color) -> None:
        """Events, the most important first, as far as there is room; the marker's name, with one event at most."""
        palette = self.theme.palette
        gap = self.theme.canvas.px(2)
        height = self.layout.row
        x, right = left + gap + 1, left + width
        events = [EVENTS[name] for name in sorted(row.events.split(), key=[*EVENTS].index)]
        if row.death:
            killer = row.death.partition(" at ")[0]
            room = (right - x - gap) / self.theme.canvas.scale
            events[0] = events[0]._replace(word=self.theme.fit(killer, room, _SIZE, bold=True))
        if row.lead is not None and events:
            events.insert(1, EventWord(f"{row.lead:+d}", "panel", "good" if row.lead >= 0 else "bad"))
        for event in events[:1] if row.name else events:
            dark = getattr(palette, event.ink) if event.chip else ink
            word = self.theme.lettering.rendered(event.word, _SIZE, dark, bold=bool(event.chip))
            if x + word.get_width() > right:
                break
            if event.chip:
                box = (x - gap, y + 1, word.get_width() + 2 * gap, height - 1)
                self._picture.fill(getattr(palette, event.chip), box)
            self._blits.append((word, (x, y + self._lift)))
            x += word.get_width() + 2 * gap
        room = (right - x - 2 * gap) / self.theme.canvas.scale
        if row.name and room >= MIN_NAME_ROOM:
            text = self.theme.fit(row.name, room, _SIZE, bold=True)
            name = self.theme.lettering.rendered(text, _SIZE, palette.panel, bold=True)
            right -= name.get_width() + 2 * gap
            self._picture.fill(palette.ghost, (right, y, left + width - right, height))
            self._blits.append((name, (right + gap, y + self._lift)))


def short_number(value: float, decimals: int) -> str:
    """A number in at most six characters: with fewer decimals if it is long, "-" if that is not enough."""
    text = f"{value:.{decimals}f}"
    if len(text) > _MAX_LETTERS:
        text = f"{value:.{max(0, decimals + _MAX_LETTERS - len(text))}f}"
    return text if len(text) <= _MAX_LETTERS and isfinite(value) else "-"


def _inks(palette: Palette, row: RowFacts) -> tuple[pygame.Color, pygame.Color]:
    ground, ink = palette.panel, palette.text
    if row.values is None:
        ground = mixed(ground, palette.tile, 0.45)
    elif row.over or row.beyond:
        ground = mixed(ground, palette.tile, 0.18)
    if row.over or row.beyond:
        ink = palette.faint
    if row.selected:
        ground = mixed(ground, palette.bar_full, 0.55)
    return ground, ink
