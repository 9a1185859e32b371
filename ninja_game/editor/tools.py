"""The tools of the level editor: what presses, moves and releases do, and the commands that end these.

They know no window: points are px of the level.
"""

from __future__ import annotations

from collections.abc import Callable

from ninja_game.document import History
from ninja_game.editor import stamp as stamps, strokes
from ninja_game.editor.bench import Bench
from ninja_game.editor.brush import SHAPES, Tool
from ninja_game.editor.draft import Draft, Tiles, changed_cells
from ninja_game.editor.motion import Motion
from ninja_game.editor.selected import Selected
from ninja_game.editor.specs import points
from ninja_game.formats.messages import messages_at
from ninja_game.sim.grid import Cell, cell_of, middle_of
from ninja_game.sim.kinds import GOLD, MINE
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import WORLD_HEIGHT, WORLD_WIDTH

BEND_STEP = 12.0  # px that a line is bent by at each step
PICK_REACH = 12.0  # px within which an object is picked


class EditorTools(Bench):
    """A bench, the stroke under way on it, and the copy. ``selected``: edits of the selection."""

    def __init__(self, draft: Draft) -> None:
        super().__init__(draft)
        self.selected = Selected(self)
        self.stroke: strokes.Stroke | None = None
        self.clipboard: stamps.Stamp | None = None
        self._previewed: tuple[tuple[object, ...], Tiles] = ((), {})
        self._filling: tuple[tuple[object, ...], tuple[ObjectSpec, ...]] = ((), ())

    @property
    def placing_switch(self) -> bool:
        """Whether the next press places the switch of a door or an exit."""
        return isinstance(self.stroke, strokes.PlacingSwitch)

    @property
    def ghost(self) -> stamps.Stamp | None:
        """What the next press pastes."""
        return self.stroke.stamp if isinstance(self.stroke, strokes.Pasting) else None

    @property
    def pasted(self) -> stamps.Stamp | None:
        """The stamp to paste at its place."""
        return self.stroke.at_pointer if isinstance(self.stroke, strokes.Pasting) else None

    @property
    def marquee(self) -> tuple[Cell, Cell] | None:
        """The corners of the frame of a selection."""
        return self.stroke.marquee if isinstance(self.stroke, strokes.Choosing) else None

    @property
    def frame_size(self) -> tuple[int, int] | None:
        """Columns and rows of the shape or the frame that is being drawn."""
        if isinstance(self.stroke, strokes.Stretching | strokes.Choosing):
            return stamps.area_between(cell_of(*self.stroke.start), self.cell)[2:]
        return None

    @property
    def is_dragging(self) -> bool:
        """Whether the selection follows the pointer."""
        return isinstance(self.stroke, strokes.Dragging)

    @property
    def is_busy(self) -> bool:
        """Whether anything is being drawn or dragged."""
        return self.stroke is not None and not isinstance(self.stroke, strokes.Hanging)

    def load(self, history: History[Draft]) -> None:
        """Edit another level, with the first tile and without a symmetry."""
        self.finish()
        self.history = history
        self.selection = stamps.Selection()
        self.take_first()

    # --- strokes ---

    def move(self, x: float, y: float) -> None:
        """Move the pointer, and what is being dragged."""
        self.pointer = min(max(0.0, x), WORLD_WIDTH - 1e-6), min(max(0.0, y), WORLD_HEIGHT - 1e-6)
        if self.stroke:
            self.stroke.move()

    def press(self, *, erase: bool = False, pick: bool = False, add: bool = False, copies: bool = False) -> None:
        """The button is pressed at the pointer. ``add``: to the selection; ``copies``: a drag drags a copy."""
        hanging = self.stroke if isinstance(self.stroke, strokes.Hanging) else None
        if pick and hanging:
            return
        if erase and (hanging or self.tool == Tool.SELECT):
            self.cancel()
        elif hanging:
            self.stroke = None
            hanging.press()
        elif pick or (self.tool == Tool.PICK and not erase):
            self.pick()
        else:
            self.finish()
            if self.tool == Tool.SELECT:
                self._choose(add=add, copies=copies)
            else:
                self._draw(erase=erase)

    def _begin(self, stroke: strokes.Stroke) -> None:
        self.stroke = stroke
        stroke.begin()

    def _draw(self, *, erase: bool) -> None:
        self.selection = stamps.Selection()
        tool = self.effective_tool
        if erase:
            self._begin(strokes.Painting(self, erases=True))
        elif tool == Tool.FILL:
            self._fill()
        elif tool in SHAPES:
            self._begin(strokes.Stretching(self, tool))
        elif not self.brush.draws_objects or self.brush.spec.kind in (GOLD, MINE):
            self._begin(strokes.Painting(self, erases=False))
        else:
            self._begin(strokes.Dropping(self))

    def _fill(self) -> None:
        if self.brush.draws_objects:
            filled = self.brush.with_objects(self.draft, self.next_objects)
        else:
            cells = stamps.filled(self.draft, self.cell)
            filled = self.brush.with_tiles(self.draft, cells, slopes=self.sets_slopes)
        self.history.change(filled)

    def _choose(self, *, add: bool, copies: bool) -> None:
        part = self.near(PICK_REACH)
        before = self.selection if add else stamps.Selection()
        area = self.selection.area
        if not add and (part in self.selection.parts or (area and self.cell in stamps.area_cells(area))):
            self._begin(strokes.Dragging(self, copies=copies))
        elif part is None and not add and messages_at(self.draft.says, self.cell):
            self._begin(strokes.DraggingMessage(self))
        elif part is None:
            self._begin(strokes.Choosing(self, before))
        elif part in before.parts:
            self.selection = stamps.Selection(before.area, before.parts - {part})
        else:
            self.selection = before.joined(stamps.Selection(parts=frozenset({part})))
            self._begin(strokes.Dragging(self, copies=copies))

    def release(self) -> None:
        self.stroke = self.stroke.release() if self.stroke else None

    def finish(self) -> None:
        """End the operation under way; a door or exit without its switch is removed."""
        stroke, self.stroke = self.stroke, None
        if stroke:
            stroke.end()

    def cancel(self) -> bool:
        """Cancel the operation under way, else the selection; whether there was one. A copy stays."""
        stroke, self.stroke = self.stroke, None
        if stroke:
            stroke.cancel()
            return True
        selected = bool(self.selection)
        self.selection = stamps.Selection()
        return selected

    def bend(self, steps: int) -> bool:
        """Bend the line that is being drawn to its right; whether it is busy."""
        if isinstance(self.stroke, strokes.Stretching) and self.stroke.shape == Tool.LINE:
            self.stroke.bend(BEND_STEP * steps)
        return self.is_busy

    def pick(self) -> None:
        part = stamps.nearest_part(self.draft, *self.pointer, PICK_REACH)
        self.pick_up(self.draft.objects[part[0]] if part else self.draft.tile(self.cell))

    def pick_up(self, what: int | ObjectSpec) -> None:
        self.finish()
        self.brush.pick_up(what)
        if not self.tool.draws:
            self.tool = Tool.BRUSH

    # --- what a press would do ---

    @property
    def preview(self) -> Tiles:
        """The tiles that a press of the brush, or a fill, would change; kept while the pointer stays in its cell."""
        brush = self.brush
        key = self.draft, self.cell, self.effective_tool, brush.tile, self.sets_slopes, brush.symmetry
        if key != self._previewed[0]:
            cells = stamps.filled(self.draft, self.cell) if self.effective_tool == Tool.FILL else [self.cell]
            after = brush.with_tiles(self.draft, cells, slopes=self.sets_slopes)
            self._previewed = key, {cell: after.tile(cell) for cell in changed_cells(self.draft, after)}
        return self._previewed[1]

    @property
    def next_objects(self) -> tuple[ObjectSpec, ...]:
        """The objects that a press places, or a fill, without their images of a symmetry.

        Those of a fill are kept while the pointer stays in its cell.
        """
        if self.effective_tool != Tool.FILL:
            return (self.placed(*self.pointer),)
        key = self.draft, self.cell, self.brush.spec, self.brush.nearest
        if key != self._filling[0]:
            cells = stamps.filled(self.draft, self.cell)
            self._filling = key, tuple(self.placed(*middle_of(cell), "cell") for cell in cells)
        return self._filling[1]

    # --- commands that end a stroke ---

    def take(self, what: str) -> None:
        """Set what Select takes, one of TAKES, and deselect the rest."""
        self.finish()
        self.tool = Tool.SELECT
        self.takes = what
        self.selection = self.taken(self.selection)

    def choose_all(self) -> None:
        self.finish()
        self.tool = Tool.SELECT
        self.selection = self.taken(stamps.everything(self.draft))

    def choose(self, parts: frozenset[stamps.ObjectPart]) -> None:
        self.finish()
        self.selection = stamps.Selection(parts=parts)

    def undo(self) -> bool:
        """Cancel a paste or a drawing, else undo the newest change; whether there was any."""
        hung = isinstance(self.stroke, strokes.Hanging)
        self.finish()
        return hung or self._step(self.history.undo)

    def redo(self) -> bool:
        self.finish()
        return self._step(self.history.redo)

    def _step(self, step: Callable[[], bool]) -> bool:
        """Undo or redo. The selection stays if there are as many objects as before."""
        before, parts = len(self.draft.objects), self.selection.parts
        done = step()
        objects = self.draft.objects
        kept = (part for part in parts if len(objects) == before and part[1] in points(objects[part[0]]))
        self.selection = stamps.Selection(parts=frozenset(kept))
        return done

    def turn(self, motion: Motion) -> bool:
        """Flip or turn the stamp that is being pasted, else the selection in its place, else the brush.

        False, without a change, if something would leave the level.
        """
        if isinstance(self.stroke, strokes.Pasting):
            self.stroke.stamp = self.stroke.stamp.carried(motion.about(WORLD_WIDTH / 2, WORLD_HEIGHT / 2))
            return True
        self.finish()
        if self.selection:
            return self.selected.turn(motion)
        self.brush.turn(motion)
        return True

    def delete(self) -> None:
        """Delete the selection, or else the object under the pointer."""
        self.finish()
        if self.selection:
            self.selected.delete()
        elif self.near(PICK_REACH):
            self.delete_nearest(PICK_REACH)

    def copy(self) -> bool:
        """Copy the selection; whether there is one."""
        if self.selection:
            self.clipboard = stamps.copied(self.draft, self.selection)
        return bool(self.selection)

    def cut(self) -> None:
        if self.copy():
            self.delete()

    def paste(self) -> bool:
        """Begin to paste the copy with the next press; whether there is one. Nothing is selected then."""
        self.finish()
        if self.clipboard:
            self._begin(strokes.Pasting(self, self.clipboard))
        self.selection = stamps.Selection()
        return self.ghost is not None
