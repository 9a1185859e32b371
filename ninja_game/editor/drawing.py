"""Drawing: what the brush puts into a draft, tile by tile or object by object."""

from __future__ import annotations

from ninja_game.editor.brush import SNAPS, SORTS, cells_between, placed, snapped, with_switch
from ninja_game.editor.draft import Cell, Draft, cell_of
from ninja_game.editor.history import History
from ninja_game.editor.motion import SYMMETRIES
from ninja_game.editor.records import has_switch
from ninja_game.editor.stamp import Selection, Stamp, area_between, cells_of, nearest, put, removed
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import ObjectSpec

REACH = 17.32
"""px within which an object is deleted (√300: game.md §6)."""


class Drawing:
    """A draft with its history, the brush, and the pointer.

    ``tile`` and ``record``: what the brush draws, ``objects`` which of them. ``snap``, ``symmetry``: by name.
    """

    def __init__(self, draft: Draft) -> None:
        self.history = History(draft)
        self.objects = False
        self.tile = 1
        self.record: ObjectSpec = SORTS[2].record
        self.snap = "cell"
        self.symmetry = "off"
        self.pointer = (396.0, 300.0)
        self._pressed_at = self.pointer
        self._switchless: ObjectSpec | None = None

    @property
    def draft(self) -> Draft:
        """The level as it is now."""
        return self.history.draft

    @property
    def cell(self) -> Cell:
        """The cell under the pointer."""
        return cell_of(*self.pointer)

    @property
    def placing_switch(self) -> bool:
        """Whether the next press says where the switch of a door or an exit is."""
        return self._switchless is not None

    def _change(self, stamp: Stamp, draft: Draft | None = None) -> None:
        self.history.change(put(draft or self.draft, stamp, SYMMETRIES[self.symmetry]))

    def _draw_line(self, before: Cell, *, erasing: bool) -> None:
        """Tiles from the last cell to this one, or objects on the way of the pointer."""
        if not self.objects:
            tile = 0 if erasing else self.tile
            self._change(Stamp(dict.fromkeys(cells_between(before, self.cell), tile)))
        elif erasing:
            self.delete_nearest()
        else:
            self._change(Stamp({}, (placed(self.record, *self.pointer, self.snap),)))

    def _draw_rectangle(self) -> None:
        area = area_between(cell_of(*self._pressed_at), self.cell)
        if not self.objects:
            self._change(Stamp(dict.fromkeys(cells_of(area), self.tile)), self.history.began)
            return
        if self.record.kind == NINJA or has_switch(self.record):
            self._drop()
            return
        step = max(SNAPS[self.snap], 12.0)
        (ax, ay), (bx, by) = snapped(*self._pressed_at, self.snap), snapped(*self.pointer, self.snap)
        columns, rows = int(abs(bx - ax) // step), int(abs(by - ay) // step)
        x, y = min(ax, bx), min(ay, by)
        places = [(x + step * i, y + step * j) for j in range(rows + 1) for i in range(columns + 1)]
        objects = tuple(placed(self.record, *place, self.snap) for place in places)
        self._change(Stamp({}, objects), self.history.began)

    def _dropped(self) -> ObjectSpec:
        """The brush's object as it would be placed now."""
        return placed(self.record, *self.pointer, self.snap)

    def _drop(self) -> None:
        """One object under the pointer, until the button goes up; a switch is dragged out of its door."""
        record = self._dropped()
        if has_switch(record):
            record = with_switch(placed(self.record, *self._pressed_at, self.snap), *self.pointer, self.snap)
        self._change(Stamp({}, (record,)), self.history.began)

    def _put_switch(self) -> None:
        if self._switchless is not None:
            record = with_switch(self._switchless, *self.pointer, self.snap)
            self._change(Stamp({}, (record,)), self.history.began)

    def delete_nearest(self) -> None:
        """Delete the object nearest to the pointer, and its images in the symmetry."""
        places = [self.pointer, *(motion.point(*self.pointer) for motion in SYMMETRIES[self.symmetry])]
        for place in places:
            found = nearest(self.draft, *place, REACH)
            if found:
                self.history.change(removed(self.draft, Selection(parts=frozenset({found}))))
