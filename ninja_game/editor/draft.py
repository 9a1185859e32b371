"""A level at one moment of its editing."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import Any, Self

from ninja_game.editor.specs import object_type_name, points
from ninja_game.files.shown_text import counted
from ninja_game.formats.messages import parse_messages
from ninja_game.sim.grid import Cell, is_inside
from ninja_game.sim.level import COLUMNS, ROWS, TILES, Level, ObjectSpec

Tiles = dict[Cell, int]


@dataclass(frozen=True)
class Draft:
    """A level with the other contents of its file. Immutable: every operation gives another draft."""

    level: Level
    name: str = ""
    author: str = ""
    comment: str = ""
    teaches: str = ""  #: what the level teaches
    says: str = ""  #: its messages, as the header writes them

    @property
    def objects(self) -> tuple[ObjectSpec, ...]:
        return self.level.objects

    def as_json(self) -> list[object]:
        return [self.level.tiles, self.objects, self.name, self.author, self.comment, self.teaches, self.says]

    @classmethod
    def of_json(cls, kept: list[Any]) -> Self:
        """The inverse of ``as_json``. Raises one of DAMAGED for anything else."""
        tiles, objects, *texts = kept
        if len(tiles) != TILES:
            raise ValueError("a level with too few or too many tiles")
        specs = (ObjectSpec(int(kind), tuple(map(float, values)), str(text)) for kind, values, text in objects)
        draft = cls(Level(tuple(map(int, tiles)), tuple(specs)), *map(str, texts))
        parse_messages(draft.says)
        return draft

    def tile(self, cell: Cell) -> int:
        """The tile of a cell; a full one in the border."""
        return self.level.tile(*cell) if is_inside(cell) else 1

    def with_tiles(self, tiles: Tiles) -> Draft:
        """The draft with other tiles in some cells; cells outside the level are ignored."""
        ids = list(self.level.tiles)
        for (column, row), tile in tiles.items():
            if is_inside((column, row)):
                ids[(column - 1) * ROWS + row - 1] = tile
        return replace(self, level=Level(tuple(ids), self.objects)) if tiles else self

    def with_objects(self, objects: tuple[ObjectSpec, ...]) -> Draft:
        return replace(self, level=Level(self.level.tiles, objects))


def change_text(before: Draft, after: Draft) -> str:
    """What a change did, in a few words.

    >>> change_text(Draft(Level()), Draft(Level(), "Cave", comment="Dark").with_tiles({(1, 1): 1}))
    '1 cell; name, comment'
    """
    cells = len(changed_cells(before, after))
    parts = [counted(cells, "cell")] if cells else []
    old, new = Counter(before.objects), Counter(after.objects)
    gone, come = list((old - new).elements()), list((new - old).elements())
    if gone or come:
        verb = "deleted" if gone else "placed"
        if len(gone) == len(come):
            verb = "moved" if [points(spec) for spec in gone] != [points(spec) for spec in come] else "changed"
        kinds = {object_type_name(spec) for spec in gone or come}
        parts.append(f"{verb} {counted(len(gone or come), kinds.pop() if len(kinds) == 1 else 'object')}")
    elif before.objects != after.objects:
        parts.append("order of objects")
    texts = {"teaches": "what it teaches", "says": "messages"}
    about = [key for key in ("name", "author", "comment", *texts) if getattr(before, key) != getattr(after, key)]
    return "; ".join([*parts, *([", ".join(texts.get(key, key) for key in about)] if about else [])])


def changed_cells(before: Draft, after: Draft) -> list[Cell]:
    old, new = before.level.tiles, after.level.tiles
    changed = (index for index in range(COLUMNS * ROWS) if old[index] != new[index]) if old != new else ()
    return [(index // ROWS + 1, index % ROWS + 1) for index in changed]
