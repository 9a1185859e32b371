"""The picture of an ASCII level: 23 framed rows of 31 characters, and the place of each cell in the file.

Merging picture and list decides which line describes which drawn object, and their order. ``Problems`` collects all
mistakes and reports them together, so that a level maker can fix them in one go.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ninja_game.errors import LevelError
from ninja_game.formats.ascii.legend import ODD_TILE, SYMBOL_OF_CHAR, TILE_CHARS, TILE_OF_CHAR, Symbol, visible_glyphs
from ninja_game.formats.ascii.object_lines import ListedObject, OddTile
from ninja_game.formats.ascii.places import READING_ORDER, quoted
from ninja_game.sim.grid import Cell, middle_of
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec

_SHOWN = 20
_ENOUGH = 1000


class LevelTextError(LevelError):
    """The first mistake of a level, with the others in ``further``; the message has a line for each."""

    further: tuple[LevelError, ...] = ()

    def __str__(self) -> str:
        lines = [super().__str__(), *map(str, self.further[: _SHOWN - 1])]
        left = len(self.further) - (_SHOWN - 1)
        if left > 0:
            lines.append(f"... and {left} more")
        return "\n".join(lines)


class Problems:
    """Collects the mistakes in one file."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.mistakes: list[LevelError] = []

    def add(
        self, what: str, line: int, column: int = 0, *, found: str = "", expected: str = "", hint: str = ""
    ) -> None:
        """Record a mistake at a line and column (from 1)."""
        self.mistakes.append(LevelError(what, self.file, line, column, found, expected, hint))

    def add_error(self, error: LevelError, line: int) -> None:
        """Record an error that was raised without file and line."""
        error.file, error.line = self.file, line
        self.mistakes.append(error)

    @property
    def full(self) -> bool:
        """Whether there are so many mistakes that further checks waste time."""
        return len(self.mistakes) >= _ENOUGH

    def raise_if_any(self) -> None:
        """Raise the recorded mistakes in the order of their lines; do nothing without any."""
        if self.mistakes:
            first, *others = sorted(self.mistakes, key=lambda error: (error.line, error.column))
            joined = LevelTextError(**vars(first))
            joined.further = tuple(others)
            raise joined


FRAME = "|"
ROW_START = re.compile(r"\s*+(\d*+)\s*+\|", re.ASCII)
ROW_END = re.compile(r"\|\s*+\d*+\s*+$", re.ASCII)  # the end of a row, even if its left frame is missing
_ROW = re.compile(r"\s*+(\d*+)\s*+\|(.*)\|\s*+(\d*+)\s*+", re.ASCII)

_LOOKS_LIKE = {
    "/": "s or q, the 45° slopes",
    "\\": "a or w, the 45° slopes",
    "O": "o (gold)",
    "0": "o (gold)",
    "-": "_ (lower half), or ^ (one-way up)",
    "=": "_ (lower half), or ^ (one-way up)",
    "V": "v (one-way down), or W (thwump down)",
    "A": "^ (one-way up), or M (thwump up)",
    "N": "n (floor guard), or @ (ninja)",
    "$": "o (gold)",
    "\t": "blanks or dots",
}


class Picture(NamedTuple):
    """The drawn cells of a level. ``rows``: 23 texts of 31 characters; ``lines``, ``columns``: their places."""

    rows: tuple[str, ...]
    lines: tuple[int, ...]
    columns: tuple[int, ...]

    def char(self, cell: Cell) -> str:
        return self.rows[cell[1] - 1][cell[0] - 1]

    def where(self, cell: Cell) -> tuple[int, int]:
        """Line and column (from 1) of a cell in the file."""
        return self.lines[cell[1] - 1], self.columns[cell[1] - 1] + cell[0] - 1

    def tiles(self) -> list[int]:
        """713 tile ids, column by column; cells of objects are empty, and an odd tile counts as empty here."""
        return [TILE_OF_CHAR.get(self.rows[j][i], 0) for i in range(COLUMNS) for j in range(ROWS)]


def read_picture(lines: Sequence[tuple[int, str]], end: int, problems: Problems) -> Picture | None:
    """Read the picture from numbered lines that begin like rows; None, with mistakes recorded, if it is wrong.

    ``end``: the line for reports of a missing row.
    """
    before = len(problems.mistakes)
    rows: list[tuple[str, int, int]] = []
    misnumbered = False
    for number, (line, text) in enumerate(lines[:ROWS], 1):
        # After one wrong number all following numbers are wrong, too.
        misnumbered = misnumbered or not _check_number(line, text, number, problems)
        row = _read_row(line, text, number, problems)
        if row is not None:
            rows.append((row[0], line, row[1]))
    if len(lines) != ROWS and not misnumbered:
        amount, line = ("many", lines[ROWS][0]) if len(lines) > ROWS else ("few", end)
        expected = f"{ROWS} rows, each |{COLUMNS} characters|"
        problems.add(f"the picture has too {amount} rows", line, found=f"{len(lines)}", expected=expected)
    if len(problems.mistakes) > before:
        return None
    texts, numbers, columns = zip(*rows, strict=True)
    return Picture(texts, numbers, columns)


def _check_number(line: int, text: str, number: int, problems: Problems) -> bool:
    """Whether a row has its own number or none; a wrong number is recorded as a mistake."""
    match = _ROW.fullmatch(text)
    for label in match.group(1, 3) if match else ():
        if label and (len(label) > 2 or int(label) != number):
            hint = "a row is missing or stands twice above; the numbers may be left out"
            problems.add("wrong row number", line, found=quoted(label), expected=str(number), hint=hint)
            return False
    return True


def _read_row(line: int, text: str, number: int, problems: Problems) -> tuple[str, int] | None:
    """Text and column of a row, whose mistakes are recorded; None without both frame bars."""
    match = _ROW.fullmatch(text)
    if match is None:
        column = len(text) + 1
        tail = text.rpartition(FRAME)[2]
        if not ROW_START.match(text):
            start = len(text) - len(text.lstrip()) + 1
            problems.add("a picture row without its left frame", line, start, expected=f"'{FRAME}' before the cells")
        elif text.count(FRAME) > 1:
            hint = "nothing but the row's number may follow the frame"
            problems.add("a picture row with something after its frame", line, found=quoted(tail.strip()), hint=hint)
        else:
            problems.add("a picture row without its right frame", line, column, expected=f"'{FRAME}' at the end")
        return None
    cells, start = match.group(2), match.start(2) + 1
    if len(cells) != COLUMNS:
        more = COLUMNS - len(cells)
        column = start + min(len(cells), COLUMNS)
        hint = f"{abs(more)} too {'few' if more > 0 else 'many'}"
        what, found = f"row {number} of the picture has the wrong width", f"{len(cells)} characters"
        problems.add(what, line, column, found=found, expected=f"{COLUMNS}", hint=hint)
    for offset, char in enumerate(cells[:COLUMNS]):
        if char not in TILE_OF_CHAR and char not in SYMBOL_OF_CHAR and char != ODD_TILE:
            meant = _similar(char)
            hint = f"did you mean {meant}?" if meant else "'ninja-game convert --legend' writes the legend"
            what, expected = "a character that is not in the legend", "a tile or an object"
            problems.add(what, line, start + offset, found=repr(char), expected=expected, hint=hint)
    return cells, start


def _similar(char: str) -> str:
    """A hint at the character that an unknown one in the picture may be meant to be."""
    if char in _LOOKS_LIKE:
        return _LOOKS_LIKE[char]
    other = char.swapcase()
    return f"{other} ({SYMBOL_OF_CHAR[other].name})" if other in SYMBOL_OF_CHAR else ""


_NEEDED_LINES = {
    "5": "launch pad {cell} normal 0.6,-0.8",
    "Z": "zap drone {cell} wander-cw right",
    "L": "laser drone {cell} wander-cw right",
    "C": "chaingun drone {cell} wander-cw right",
    "&": "locked door 20,14 left switch {cell}",
    "!": "trap door 20,14 left switch {cell}",
}
"""An example line for each drawn object that needs a line."""


def merge_picture_and_list(
    picture: Picture, objects: Sequence[ListedObject], tiles: Sequence[OddTile], problems: Problems
) -> Level:
    """Make the level: first drawn objects that no line mentions (ninjas, then in reading order), then the list.

    Mistakes are recorded in ``problems``; the level is useless then.
    """
    mentioned, conflicts = _mentioned(picture, objects, problems)
    drawn: list[tuple[Cell, Symbol]] = []
    for cell in READING_ORDER:
        symbol = SYMBOL_OF_CHAR.get(picture.char(cell))
        if symbol is None or cell in mentioned:
            continue
        if cell in conflicts:
            placed, wanted = conflicts[cell]
            what = f"picture and list disagree at {cell[0]},{cell[1]}"
            expected = f"{_named(wanted)}, as line {placed.line} says"
            problems.add(what, *picture.where(cell), found=_named(symbol), expected=expected)
        elif symbol.values is None:
            example = _NEEDED_LINES[symbol.char].format(cell=f"{cell[0]},{cell[1]}")
            problems.add(
                f"{_named(symbol)} without its line",
                *picture.where(cell),
                hint=f"add a line below the picture, such as: {example}",
            )
        else:
            drawn.append((cell, symbol))
    specs = _drawn_specs(picture, drawn, problems) + [placed.spec for placed in objects]
    return Level(tuple(_tiles(picture, tiles, problems)), tuple(specs))


def _mentioned(
    picture: Picture, objects: Iterable[ListedObject], problems: Problems
) -> tuple[set[Cell], dict[Cell, tuple[ListedObject, Symbol]]]:
    """Cells with a drawn object that a line describes; cells where a line has another form of the same kind."""
    mentioned: set[Cell] = set()
    conflicts: dict[Cell, tuple[ListedObject, Symbol]] = {}
    for placed in objects:
        for part in visible_glyphs(placed.spec):
            cell, symbol = (part.column, part.row), SYMBOL_OF_CHAR[part.char]
            char = picture.char(cell)
            if char == part.char:
                mentioned.add(cell)
            elif char in ". ":
                line, column = picture.where(cell)
                what = f"{_named(symbol)} at {part.column},{part.row} is not in the picture"
                hint = f"draw {part.char} in line {line}, column {column}, or correct the place"
                problems.add(what, placed.line, placed.column, hint=hint)
            elif char in SYMBOL_OF_CHAR and SYMBOL_OF_CHAR[char].kind == symbol.kind:
                conflicts[cell] = placed, symbol
    return mentioned, conflicts


def _named(symbol: Symbol) -> str:
    return f"{symbol.char} ({symbol.name})"


def point_of(cell: Cell, symbol: Symbol) -> tuple[float, float]:
    """The place of a drawn object, px."""
    x, y = middle_of(cell)
    return x + symbol.dx, y + symbol.dy


def _drawn_specs(picture: Picture, drawn: Sequence[tuple[Cell, Symbol]], problems: Problems) -> list[ObjectSpec]:
    """Records of the objects that need no line."""
    exits = [cell for cell, symbol in drawn if symbol.char == "X"]
    switches = [cell for cell, symbol in drawn if symbol.char == "x"]
    if (len(exits), len(switches)) not in ((0, 0), (1, 1)):
        first, other = (exits, "x, its switch") if exits else (switches, "X, its exit")
        problems.add(
            "exits and switches that no line mentions and that make no pair",
            *picture.where(first[0]),
            found=f"{len(exits)} X and {len(switches)} x",
            hint="say which belong together in lines such as: exit 29,21 switch 3,4"
            if exits and switches
            else f"draw {other}, or add a line such as: exit 29,21 switch 3.5,4",
        )
    ninjas: list[ObjectSpec] = []
    others: list[ObjectSpec] = []
    for cell, symbol in drawn:
        if symbol.kind == EXIT:
            if symbol.char == "X" and switches:
                switch = point_of(switches[0], SYMBOL_OF_CHAR["x"])
                others.append(ObjectSpec(EXIT, (*point_of(cell, symbol), *switch)))
        else:
            spec = ObjectSpec(symbol.kind, (*point_of(cell, symbol), *(symbol.values or ())))
            (ninjas if symbol.kind == NINJA else others).append(spec)
    return ninjas + others


def _tiles(picture: Picture, listed: Iterable[OddTile], problems: Problems) -> list[int]:
    """The 713 tile ids, odd ones from their lines."""
    tiles = picture.tiles()
    seen: set[Cell] = set()
    for tile in listed:
        (column, row), mistake = tile.cell, ""
        if not (1 <= column <= COLUMNS and 1 <= row <= ROWS):
            mistake, hint = "a tile line for a border cell", "only 1,1 to 31,23 have tiles of the level"
        elif tile.cell in seen:
            mistake, hint = "a second tile line for one cell", "keep one"
        elif 0 <= tile.id < len(TILE_CHARS):
            mistake, hint = f"tile {tile.id} has a character", f"draw {TILE_CHARS[tile.id]} in the picture instead"
        elif picture.char(tile.cell) != ODD_TILE:
            mistake, hint = "a tile line for a cell that is not marked", f"draw {ODD_TILE} in the picture there"
        seen.add(tile.cell)
        if mistake:
            problems.add(mistake, tile.line, tile.column, found=f"{column},{row}", hint=hint)
            continue
        tiles[(column - 1) * ROWS + row - 1] = tile.id
    for cell in READING_ORDER:
        if picture.char(cell) == ODD_TILE and cell not in seen:
            hint = f"add a line below the picture: tile {cell[0]},{cell[1]} id 70, or draw another character"
            problems.add("an odd tile without its line", *picture.where(cell), found=repr(ODD_TILE), hint=hint)
    return tiles
