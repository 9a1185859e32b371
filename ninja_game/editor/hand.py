"""A draft in hand: what the brush puts into it, what is chosen in it, and what is done with that."""

from __future__ import annotations

from ninja_game.editor.brush import SNAPS, SORTS, cells_between, placed, snapped, with_switch
from ninja_game.editor.draft import Cell, Draft, cell_of
from ninja_game.editor.history import History
from ninja_game.editor.motion import SYMMETRIES, Motion
from ninja_game.editor.records import has_switch, points
from ninja_game.editor.stamp import (
    Selection,
    Stamp,
    area_between,
    cells_of,
    copied,
    middle_of,
    moved,
    nearest,
    pasted,
    put,
    removed,
)
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import ObjectSpec

REACH = 17.32
"""px within which an object is deleted (√300: game.md §6)."""


class Hand:
    """A draft with its history, the brush, and the pointer.

    ``tile`` and ``record``: what the brush draws, ``objects`` which of them. ``snap``, ``symmetry``: by name.
    ``selection``: what is chosen; ``clipboard``: what was copied; ``tool``: what is in hand, one of bench.TOOLS.
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
        self.tool = "brush"
        self.selection = Selection()
        self.clipboard: Stamp | None = None

    def finish(self) -> None:
        """Whatever is half done is done now."""
        self.history.end()

    # --- drawing ---

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

    @property
    def draws_one(self) -> bool:
        """Whether every tool puts one object at a time: a ninja, or what has a switch to be placed after it."""
        return self.objects and (self.record.kind == NINJA or has_switch(self.record))

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

    # --- what is chosen ---

    def nudge(self, dx: float, dy: float) -> None:
        """Move what is chosen by steps of the snap, or of cells."""
        step = 24.0 if self.selection.area else SNAPS[self.snap]
        draft, self.selection = moved(self.draft, self.selection, Motion(dx=dx * step, dy=dy * step))
        self.history.change(draft)

    def turn(self, motion: Motion) -> None:
        """Flip or turn what is chosen, in its place; without a selection what the brush draws."""
        self.finish()
        if self.selection:
            about = motion.about(*middle_of(self.draft, self.selection, quarter=bool(motion.xy)))
            draft, self.selection = moved(self.draft, self.selection, about)
            self.history.change(draft)
        elif self.objects:
            self.record = Stamp({}, (self.record,)).carried(motion.about(36.0, 36.0)).objects[0]
        else:
            self.tile = motion.tile(self.tile)

    def copy(self) -> bool:
        """Remember what is chosen; whether anything is."""
        if self.selection:
            self.clipboard = copied(self.draft, self.selection)
        return bool(self.selection)

    def cut(self) -> None:
        """Remember what is chosen, and delete it."""
        if self.copy():
            self.delete()

    def delete(self) -> None:
        """Delete what is chosen, or else the object nearest to the pointer."""
        self.finish()
        if self.selection:
            self.history.change(removed(self.draft, self.selection))
            self.selection = Selection()
        else:
            self.delete_nearest()

    def paste(self) -> bool:
        """Put what was copied under the pointer, and choose it; whether anything was copied."""
        self.finish()
        if self.clipboard is None:
            return False
        tiles = self.clipboard.tiles
        places = [point for record in self.clipboard.objects for point in points(record).values()]
        corner = (24.0 * min(c for c, _ in tiles), 24.0 * min(r for _, r in tiles)) if tiles else min(places)
        there = (24.0 * self.cell[0], 24.0 * self.cell[1]) if tiles else snapped(*self.pointer, self.snap)
        motion = Motion(dx=there[0] - corner[0], dy=there[1] - corner[1])
        draft, self.selection = pasted(self.draft, self.clipboard.carried(motion))
        self.tool = "select"
        self.history.change(draft)
        return True

    @property
    def chosen(self) -> ObjectSpec | None:
        """The only object that is selected."""
        records = self.selection.records
        number = next(iter(records)) if len(records) == 1 and self.selection.area is None else -1
        return self.draft.objects[number] if 0 <= number < len(self.draft.objects) else None

    @property
    def subject(self) -> ObjectSpec:
        """The object whose properties can be changed: the selected one, or the one that is drawn with."""
        return self.chosen or self.record

    def put_subject(self, record: ObjectSpec) -> None:
        """Another record in the place of the subject."""
        if self.chosen is None:
            self.record = record
            return
        number = next(iter(self.selection.records))
        objects = (*self.draft.objects[:number], record, *self.draft.objects[number + 1 :])
        self.history.change(self.draft.with_objects(objects))
        self.selection = Selection(None, frozenset((number, part) for part in points(record)))
