"""What is chosen in a draft, and what can be done with it: moved, turned, copied, deleted, given other properties."""

from __future__ import annotations

from ninja_game.editor.brush import SNAPS, snapped
from ninja_game.editor.draft import Draft
from ninja_game.editor.drawing import Drawing
from ninja_game.editor.motion import Motion
from ninja_game.editor.records import points
from ninja_game.editor.stamp import Selection, Stamp, copied, middle_of, moved, pasted, removed
from ninja_game.sim.level import ObjectSpec


class Choosing(Drawing):
    """``selection``: what is chosen; ``clipboard``: what was copied; ``tool``: what is in hand, one of bench.TOOLS."""

    def __init__(self, draft: Draft) -> None:
        super().__init__(draft)
        self.tool = "brush"
        self.selection = Selection()
        self.clipboard: Stamp | None = None

    def finish(self) -> None:
        """Whatever is half done is done now."""
        self.history.end()

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
