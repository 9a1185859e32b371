"""The picture of an ASCII level: 23 framed rows of 31 characters, and where in the file each cell is drawn."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ninja_game.formats.ascii.legend import ODD_TILE, SYMBOL_OF_CHAR, TILE_OF_CHAR
from ninja_game.formats.ascii.places import shown
from ninja_game.formats.ascii.problems import Problems
from ninja_game.sim.level import COLUMNS, ROWS

Cell = tuple[int, int]
"""Column 1…31, row 1…23."""

FRAME = "|"
ROW_START = re.compile(r"\s*+(\d*+)\s*+\|", re.ASCII)
ROW_END = re.compile(r"\|\s*+\d*+\s*+$", re.ASCII)
"""The end of a row, which may have lost its left frame."""
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
    """The drawn cells of a level. ``rows``: 23 texts of 31 characters; ``lines``, ``columns``: where each begins."""

    rows: tuple[str, ...]
    lines: tuple[int, ...]
    columns: tuple[int, ...]

    def char(self, cell: Cell) -> str:
        """The character of a cell."""
        return self.rows[cell[1] - 1][cell[0] - 1]

    def where(self, cell: Cell) -> tuple[int, int]:
        """Line and column (from 1) in the file at which a cell is drawn."""
        return self.lines[cell[1] - 1], self.columns[cell[1] - 1] + cell[0] - 1

    def cells(self) -> Iterator[Cell]:
        """All cells in reading order."""
        return ((column, row) for row in range(1, ROWS + 1) for column in range(1, COLUMNS + 1))

    def tiles(self) -> list[int]:
        """713 tile ids, column by column; objects stand in empty cells, an odd tile counts as empty here."""
        return [TILE_OF_CHAR.get(self.rows[j][i], 0) for i in range(COLUMNS) for j in range(ROWS)]


def read_picture(lines: Sequence[tuple[int, str]], end: int, problems: Problems) -> Picture | None:
    """The picture of numbered lines that begin like rows; None, with the mistakes noted, if it is not in order.

    ``end``: the line where a missing row would be reported.
    """
    before = len(problems.found)
    rows: list[tuple[str, int, int]] = []
    misnumbered = False
    for number, (line, text) in enumerate(lines[:ROWS], 1):
        # After one wrong number all others are wrong too.
        misnumbered = misnumbered or not _check_number(line, text, number, problems)
        row = _read_row(line, text, number, problems)
        if row is not None:
            rows.append((row[0], line, row[1]))
    if len(lines) != ROWS and not misnumbered:
        problems.add(
            "the picture has too many rows" if len(lines) > ROWS else "the picture has too few rows",
            lines[ROWS][0] if len(lines) > ROWS else end,
            found=f"{len(lines)}",
            expected=f"{ROWS} rows, each |{COLUMNS} characters|",
        )
    if len(problems.found) > before:
        return None
    texts, numbers, columns = zip(*rows, strict=True)
    return Picture(texts, numbers, columns)


def _check_number(line: int, text: str, number: int, problems: Problems) -> bool:
    """Whether a row has no other number than its own; a wrong one is noted."""
    match = _ROW.fullmatch(text)
    for label in match.group(1, 3) if match else ():
        if label and (len(label) > 2 or int(label) != number):
            hint = "a row is missing or stands twice above; the numbers may be left out"
            problems.add("wrong row number", line, found=shown(label), expected=str(number), hint=hint)
            return False
    return True


def _read_row(line: int, text: str, number: int, problems: Problems) -> tuple[str, int] | None:
    """Text and column of a row; its mistakes are noted, None if it has no two frame bars."""
    match = _ROW.fullmatch(text)
    if match is None:
        column = len(text) + 1
        tail = text.rpartition(FRAME)[2]
        if not ROW_START.match(text):
            start = len(text) - len(text.lstrip()) + 1
            problems.add("a picture row without its left frame", line, start, expected=f"'{FRAME}' before the cells")
        elif text.count(FRAME) > 1:
            hint = "nothing but the row's number may follow the frame"
            problems.add("a picture row with something after its frame", line, found=shown(tail.strip()), hint=hint)
        else:
            problems.add("a picture row without its right frame", line, column, expected=f"'{FRAME}' at the end")
        return None
    cells, start = match.group(2), match.start(2) + 1
    if len(cells) != COLUMNS:
        more = COLUMNS - len(cells)
        column = start + min(len(cells), COLUMNS)
        hint = f"{abs(more)} too {'few' if more > 0 else 'many'}"
        problems.add(f"row {number} of the picture has the wrong width", line, column,
                     found=f"{len(cells)} characters", expected=f"{COLUMNS}", hint=hint)  # fmt: skip
    for offset, char in enumerate(cells[:COLUMNS]):
        if char not in TILE_OF_CHAR and char not in SYMBOL_OF_CHAR and char != ODD_TILE:
            hint = (
                f"did you mean {_similar(char)}?"
                if _similar(char)
                else "'ninja-game convert --legend' writes the legend"
            )
            problems.add("a character that is not in the legend", line, start + offset, found=repr(char), hint=hint,
                         expected="a tile or an object")  # fmt: skip
    return cells, start


def _similar(char: str) -> str:
    """What an unknown character in the picture was perhaps meant to be, in words."""
    if char in _LOOKS_LIKE:
        return _LOOKS_LIKE[char]
    other = char.swapcase()
    return f"{other} ({SYMBOL_OF_CHAR[other].name})" if other in SYMBOL_OF_CHAR else ""
