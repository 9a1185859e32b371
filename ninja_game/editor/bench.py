"""The workbench: a draft, the tool in hand, and what presses, moves and releases of it do.

It knows no window: points are px of the level.
"""

from __future__ import annotations

from ninja_game.editor.brush import SORT_NAMES, placed, snapped, sort_of
from ninja_game.editor.draft import Cell, Draft, cell_of
from ninja_game.editor.hand import Hand
from ninja_game.editor.history import History
from ninja_game.editor.motion import Motion
from ninja_game.editor.records import has_switch
from ninja_game.editor.stamp import (
    Part,
    Selection,
    Stamp,
    area_between,
    cells_of,
    chosen_in,
    filled,
    moved,
    nearest,
)
from ninja_game.sim.kinds import GOLD, MINE
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import WORLD_HEIGHT, WORLD_WIDTH

TOOLS = ("brush", "rectangle", "fill", "select", "pick")
DRAGGED = 12.0
"""A press that moves farther than this is a drag; what is nearer is chosen."""


class Bench(Hand):
    """``tool``: one of TOOLS; ``marquee``: the corners of the frame that is being drawn around what to choose."""

    def __init__(self, draft: Draft) -> None:
        super().__init__(draft)
        self.marquee: tuple[Cell, Cell] | None = None
        self._doing = ""
        self._chosen_before = Selection()

    @property
    def dragging(self) -> bool:
        """Whether what is chosen follows the pointer."""
        return self._doing == "drag"

    def load(self, draft: Draft) -> None:
        """Work on another level, with the same tool in hand."""
        self.finish()
        self.history, self.selection = History(draft), Selection()

    def move(self, x: float, y: float) -> None:
        """The pointer is somewhere else; what is being dragged follows."""
        before = self.cell
        self.pointer = min(max(0.0, x), WORLD_WIDTH - 1e-6), min(max(0.0, y), WORLD_HEIGHT - 1e-6)
        if self._doing in ("draw", "erase"):
            self._draw_line(before, erasing=self._doing == "erase")
        elif self._switchless is not None:
            self._put_switch()
        elif self._doing == "drop":
            self._drop()
        elif self._doing == "rectangle":
            self._draw_rectangle()
        elif self._doing == "drag":
            self._drag()
        elif self._doing == "choose":
            self.marquee = cell_of(*self._pressed_at), self.cell
            self.selection = self._joined(chosen_in(self.draft, area_between(*self.marquee)))

    def press(self, *, erase: bool = False, pick: bool = False, add: bool = False) -> None:
        """The button goes down at the pointer. ``add``: to what is chosen already."""
        if self._switchless is not None:
            if erase:
                self.cancel()
            else:
                self.finish()
            return
        self._pressed_at = self.pointer
        if pick or (self.tool == "pick" and not erase):
            self.pick()
        elif self.tool == "select" and not erase:
            self._choose(add=add)
        else:
            self.history.begin()
            self.selection = Selection()
            self._begin_to_draw(erase=erase)

    def _begin_to_draw(self, *, erase: bool) -> None:
        if self.tool == "fill" and not self.objects and not erase:
            self._change(Stamp(dict.fromkeys(filled(self.draft, self.cell), self.tile)))
            return
        many = not self.objects or self.record.kind in (GOLD, MINE)
        boxed = self.tool == "rectangle" and not self.draws_one
        drawn = "rectangle" if boxed else "draw" if many else "drop"
        self._doing = "erase" if erase else drawn
        self.move(*self.pointer)

    def release(self) -> None:
        """The button goes up."""
        if self._doing == "drop" and has_switch(self._dropped()):
            self._switchless = placed(self.record, *self._pressed_at, self.snap)
            self._doing = ""
            far = max(abs(a - b) for a, b in zip(self.pointer, self._pressed_at, strict=True)) > DRAGGED
            if far:
                self._put_switch()
                self.finish()
            return
        if self._doing == "choose" and self.marquee is None and not self._chosen_before:
            self.selection = Selection()
        self._doing, self.marquee = "", None
        self.history.end()

    def finish(self) -> None:
        """Whatever is half done is done now."""
        self._switchless = None
        self._doing, self.marquee = "", None
        super().finish()

    def cancel(self) -> bool:
        """Give up what is half done, or the selection; whether there was any."""
        busy = bool(self._doing or self.placing_switch or self.selection)
        if self._doing or self.placing_switch:
            self.history.abandon()
        self._switchless = None
        self._doing, self.marquee, self.selection = "", None, Selection()
        return busy

    def pick(self) -> None:
        """Draw with what is under the pointer."""
        found = nearest(self.draft, *self.pointer, DRAGGED)
        if found:
            self.take(self.draft.objects[found[0]])
        else:
            self.take(self.draft.tile(self.cell))

    def take(self, what: int | ObjectSpec) -> None:
        """Draw with a tile or with objects such as this one."""
        self.finish()
        if isinstance(what, int):
            self.tile, self.objects = what, False
        elif sort_of(what) in SORT_NAMES:
            self.record, self.objects = what, True
        if self.tool in ("select", "pick"):
            self.tool = "brush"

    # --- choosing ---

    def _joined(self, selection: Selection) -> Selection:
        before = self._chosen_before
        return Selection(selection.area or before.area, selection.parts | before.parts)

    def _choose(self, *, add: bool) -> None:
        """Drag what is chosen, or choose what is under the pointer, or begin to draw a frame around what to choose."""
        found = nearest(self.draft, *self.pointer, DRAGGED)
        if not add and (found in self.selection.parts or self._in_area()):
            self._begin_drag()
            return
        self._chosen_before = self.selection if add else Selection()
        if found is None:
            self._doing = "choose"
        elif add and found in self.selection.parts:
            self.selection = Selection(self.selection.area, self.selection.parts - {found})
        else:
            self.selection = self._joined(Selection(parts=frozenset({found})))
            self._begin_drag()

    def _in_area(self) -> bool:
        return self.selection.area is not None and self.cell in cells_of(self.selection.area)

    def _begin_drag(self) -> None:
        self.history.begin()
        self._doing = "drag"
        self._chosen_before = self.selection

    def _drag(self) -> None:
        snap = "cell" if self._chosen_before.area else self.snap
        (ax, ay), (bx, by) = snapped(*self._pressed_at, snap), snapped(*self.pointer, snap)
        draft, self.selection = moved(self.history.began, self._chosen_before, Motion(dx=bx - ax, dy=by - ay))
        self.history.change(draft)

    def choose(self, parts: frozenset[Part]) -> None:
        """Choose these parts of objects."""
        self.finish()
        self.selection = Selection(parts=parts)

    def undo(self, *, again: bool = False) -> bool:
        """Take the last edit back, or do again what was taken back; whether there was any."""
        self.finish()
        self.selection = Selection()
        return self.history.redo() if again else self.history.undo()
