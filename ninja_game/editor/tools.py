"""The tools of the level editor: a draft, the present tool, and what its presses, moves and releases do.

They know no window: points are px of the level.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum, auto

from ninja_game.document import History
from ninja_game.editor import palette, stamp as stamps
from ninja_game.editor.brush import SHAPES, Brush
from ninja_game.editor.draft import Draft, Tiles, changed_cells
from ninja_game.editor.motion import SYMMETRIES, Motion
from ninja_game.editor.specs import has_switch, points, properties, with_word
from ninja_game.formats.messages import messages_at, parse_messages, with_message_moved
from ninja_game.sim.grid import Cell, cell_of, is_inside, middle_of
from ninja_game.sim.kinds import GOLD, MINE
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL, WORLD_HEIGHT, WORLD_WIDTH

TOOLS = ("brush", *SHAPES, "fill", "select", "pick")
TAKES = ("both", "tiles", "objects")  # the choices of Select
BEND_STEP = 12.0  # px that a line is bent by at each step
DRAGGED = PICK_REACH = 12.0  # a press that moves farther than this is a drag; a nearer object is picked, px
REACH = 17.32  # px within which an object is deleted (√300: game.md §6), or selected by a click


class Gesture(StrEnum):
    """What a pressed button does until its release; the shapes are named like their tools."""

    IDLE = ""
    DRAW = auto()
    ERASE = auto()
    DROP = auto()
    RECTANGLE = auto()
    LINE = auto()
    ELLIPSE = auto()
    CHOOSE = auto()
    DRAG = auto()
    MESSAGE = auto()


class EditorTools:
    """A draft with its history, the pointer, the present tool, the selection and the copy."""

    def __init__(self, draft: Draft) -> None:
        self.history = History(draft)
        self.brush = Brush()
        self._take_first()
        self._bend = 0.0
        self.pointer = (396.0, 300.0)
        self._pressed_at = self.pointer
        self._switchless: ObjectSpec | None = None
        self.selection = stamps.Selection()
        self.clipboard: stamps.Stamp | None = None
        self.ghost: stamps.Stamp | None = None  #: what the next press pastes
        self.marquee: tuple[Cell, Cell] | None = None  #: the corners of the frame of a selection
        self._gesture = Gesture.IDLE
        self._copies = False
        self._chosen_before = stamps.Selection()
        self._previewed: tuple[tuple[object, ...], Tiles] = ((), {})
        self._filling: tuple[tuple[object, ...], tuple[ObjectSpec, ...]] = ((), ())
        #: Gets an object that something else than ``cancel`` takes away, since it has no switch yet
        self.gave_up: Callable[[ObjectSpec], object] = lambda _: None

    def _take_first(self) -> None:
        self.brush.reset()
        self.tool = TOOLS[0]  #: one of TOOLS
        self.takes, self.pastes_empty = TAKES[0], False  #: whether empty cells of a copy remove tiles

    @property
    def draft(self) -> Draft:
        return self.history.draft

    @property
    def cell(self) -> Cell:
        return cell_of(*self.pointer)

    @property
    def placing_switch(self) -> bool:
        """Whether the next press places the switch of a door or an exit."""
        return self._switchless is not None

    @property
    def about_objects(self) -> bool:
        """Whether keys are about objects: drawn, or selected."""
        return self.brush.draws_objects or bool(self.selection.parts)

    @property
    def effective_tool(self) -> str:
        """The tool that a press uses: a ninja, and an object with a switch to place, are placed one at a time."""
        return "brush" if self.brush.draws_one and self.tool not in ("select", "pick") else self.tool

    @property
    def is_dragging(self) -> bool:
        """Whether the selection follows the pointer."""
        return self._gesture == Gesture.DRAG

    @property
    def is_busy(self) -> bool:
        """Whether anything is being drawn or dragged."""
        return bool(self._gesture)

    def load(self, history: History[Draft]) -> None:
        """Edit another level, with the first tile and without a symmetry."""
        self.finish()
        self.history, self.selection = history, stamps.Selection()
        self._take_first()

    def move(self, x: float, y: float) -> None:
        """Move the pointer, and what is being dragged."""
        before = self.cell
        self.pointer = min(max(0.0, x), WORLD_WIDTH - 1e-6), min(max(0.0, y), WORLD_HEIGHT - 1e-6)
        if self._gesture in (Gesture.DRAW, Gesture.ERASE):
            self._draw_line(before, erasing=self._gesture == Gesture.ERASE)
        elif self._switchless is not None:
            self._put_switch()
        elif self._gesture == Gesture.DROP:
            self._drop()
        elif self._gesture in SHAPES:
            self._draw_shape()
        elif self._gesture == Gesture.DRAG:
            self._drag()
        elif self._gesture == Gesture.MESSAGE and is_inside(self.cell):
            began = self.history.began
            place = parse_messages(began.says).index(messages_at(began.says, cell_of(*self._pressed_at))[0])
            self.history.change(replace(began, says=with_message_moved(began.says, place, self.cell)))
        elif self._gesture == Gesture.CHOOSE:
            self.marquee = cell_of(*self._pressed_at), self.cell
            self.selection = self._joined(self._taken(stamps.chosen_in(self.draft, stamps.area_between(*self.marquee))))

    def press(self, *, erase: bool = False, pick: bool = False, add: bool = False, copies: bool = False) -> None:
        """The button is pressed at the pointer. ``add``: to the selection; ``copies``: a drag drags a copy."""
        if pick and (self.placing_switch or self.ghost):
            return
        self._pressed_at, self._bend, self._copies = self.pointer, 0.0, copies
        if erase and (self.placing_switch or self.ghost or self.tool == "select"):
            self.cancel()
        elif self.placing_switch:
            self._end()
        elif stamp := self.pasted:
            self.tool, self.ghost = "select", None
            draft, self.selection = stamps.pasted(self.draft, stamp, empty=self.pastes_empty)
            self.history.change(draft)
        elif pick or (self.tool == "pick" and not erase):
            self.pick()
        elif self.tool == "select":
            self._choose(add=add)
        else:
            self.history.begin()
            self.selection = stamps.Selection()
            self._begin_to_draw(erase=erase)

    def _begin_to_draw(self, *, erase: bool) -> None:
        brush = self.brush
        if self.effective_tool == "fill" and not erase:
            if brush.draws_objects:
                filled = brush.with_objects(self.draft, self.next_objects)
            else:
                cells = stamps.filled(self.draft, self.cell)
                filled = brush.with_tiles(self.draft, cells, slopes=self.sets_slopes)
            self.history.change(filled)
            return
        if erase:
            self._gesture = Gesture.ERASE
        elif self.effective_tool in SHAPES:
            self._gesture = Gesture(self.tool)
        else:
            many = not brush.draws_objects or brush.spec.kind in (GOLD, MINE)
            self._gesture = Gesture.DRAW if many else Gesture.DROP
        self.move(*self.pointer)

    def release(self) -> None:
        if self._gesture == Gesture.DROP and has_switch(self.placed(*self.pointer)):
            self._switchless = self.placed(*self._pressed_at)
            self._gesture = Gesture.IDLE
            far = max(abs(a - b) for a, b in zip(self.pointer, self._pressed_at, strict=True)) > DRAGGED
            if far:
                self._put_switch()
                self._end()
            return
        if self._gesture == Gesture.CHOOSE and self.marquee is None and not self._chosen_before:
            part, area = self.near(REACH), (*self.cell, 1, 1) if self.takes == "tiles" else None
            self.selection = stamps.Selection(area, frozenset({part} if part else ()))
        self._gesture, self.marquee = Gesture.IDLE, None
        self.history.end()

    def finish(self) -> None:
        """End the operation under way; a door or exit without its switch is removed."""
        if spec := self._switchless:
            self.history.abandon()
            self._end()
            self.gave_up(spec)
        else:
            self._end()

    def _end(self) -> None:
        self._switchless = self.ghost = None
        self._gesture, self.marquee = Gesture.IDLE, None
        self.history.end()

    def cancel(self) -> bool:
        """Cancel the operation under way, else the selection; whether there was one. A copy stays."""
        kept = self._chosen_before if self.ghost else stamps.Selection()
        busy = bool(self._gesture or self.placing_switch or self.ghost or self.selection)
        if self._gesture or self.placing_switch:
            self.history.abandon()
        self._switchless = self.ghost = None
        self._gesture, self.marquee, self.selection = Gesture.IDLE, None, kept
        return busy

    def pick(self) -> None:
        part = stamps.nearest_part(self.draft, *self.pointer, PICK_REACH)
        self.pick_up(self.draft.objects[part[0]] if part else self.draft.tile(self.cell))

    def pick_up(self, what: int | ObjectSpec) -> None:
        self.finish()
        self.brush.pick_up(what)
        if self.tool in ("select", "pick"):
            self.tool = "brush"

    # --- drawing ---

    def placed(self, x: float, y: float, snap: str = "") -> ObjectSpec:
        """The brush's object at a point."""
        return self.brush.placed(self.draft, x, y, snap)

    @property
    def sets_slopes(self) -> bool:
        """Whether slopes set themselves where the tool draws: a box has the corners that it is given."""
        return self.brush.slopes and not self.brush.draws_objects and self.tool not in ("rectangle", "select", "pick")

    @property
    def preview(self) -> Tiles:
        """The tiles that a press of the brush, or a fill, would change; kept while the pointer stays in its cell."""
        brush = self.brush
        key = self.draft, self.cell, self.effective_tool, brush.tile, self.sets_slopes, brush.symmetry
        if key != self._previewed[0]:
            cells = stamps.filled(self.draft, self.cell) if self.effective_tool == "fill" else [self.cell]
            after = brush.with_tiles(self.draft, cells, slopes=self.sets_slopes)
            self._previewed = key, {cell: after.tile(cell) for cell in changed_cells(self.draft, after)}
        return self._previewed[1]

    @property
    def next_objects(self) -> tuple[ObjectSpec, ...]:
        """The objects that a press places, or a fill, without their images of a symmetry.

        Those of a fill are kept while the pointer stays in its cell.
        """
        if self.effective_tool != "fill":
            return (self.placed(*self.pointer),)
        key = self.draft, self.cell, self.brush.spec, self.brush.nearest
        if key != self._filling[0]:
            cells = stamps.filled(self.draft, self.cell)
            self._filling = key, tuple(self.placed(*middle_of(cell), "cell") for cell in cells)
        return self._filling[1]

    def _draw_line(self, before: Cell, *, erasing: bool) -> None:
        if not self.brush.draws_objects:
            tile = palette.EMPTY if erasing else self.brush.tile
            stroke = self.brush.with_stroke(self.draft, before, self.cell, tile, slopes=self.sets_slopes)
            self.history.change(stroke)
        elif erasing:
            self.delete_nearest()
        else:
            self._place(self.draft, self.placed(*self.pointer))

    def _draw_shape(self) -> None:
        ends = self._pressed_at, self.pointer
        began, slopes = self.history.began, self.sets_slopes
        self.history.change(self.brush.with_shape(began, self._gesture, *ends, bend=self._bend, slopes=slopes))

    def _place(self, draft: Draft, spec: ObjectSpec) -> None:
        self.history.change(self.brush.with_objects(draft, (spec,)))

    def bend(self, steps: int) -> bool:
        """Bend the line that is being drawn to its right; whether it is busy."""
        if self._gesture == Gesture.LINE:
            self._bend += BEND_STEP * steps
            self._draw_shape()
        return self.is_busy

    def _drop(self) -> None:
        spec = self.placed(*self.pointer)
        if has_switch(spec):
            spec = palette.with_switch(self.placed(*self._pressed_at), *self.pointer, self.brush.snap)
        self._place(self.history.began, spec)

    def _put_switch(self) -> None:
        if self._switchless is not None:
            spec = palette.with_switch(self._switchless, *self.pointer, self.brush.snap)
            self._place(self.history.began, spec)

    def delete_nearest(self, reach: float = REACH) -> None:
        """Delete the object nearest to the pointer, and its images in the symmetry."""
        places = [self.pointer, *(motion.point(*self.pointer) for motion in SYMMETRIES[self.brush.symmetry])]
        parts = [stamps.nearest_part(self.draft, *place, reach) for place in places]
        self.history.change(stamps.removed(self.draft, stamps.Selection(parts=frozenset(filter(None, parts)))))

    # --- choosing ---

    @property
    def frame_size(self) -> tuple[int, int] | None:
        """Columns and rows of the shape or the frame that is being drawn."""
        drawn = self._gesture in (*SHAPES, Gesture.CHOOSE)
        return stamps.area_between(cell_of(*self._pressed_at), self.cell)[2:] if drawn else None

    def near(self, reach: float) -> stamps.ObjectPart | None:
        """The part of an object at the pointer, within that many px; None if Select takes only tiles."""
        tiles = self.tool == "select" and self.takes == "tiles"
        return None if tiles else stamps.nearest_part(self.draft, *self.pointer, reach)

    def take(self, what: str) -> None:
        """Set what Select takes, one of TAKES, and deselect the rest."""
        self.finish()
        self.tool, self.takes = "select", what
        self.selection = self._taken(self.selection)

    def _taken(self, selection: stamps.Selection) -> stamps.Selection:
        area = None if self.takes == "objects" else selection.area
        return stamps.Selection(area, frozenset() if self.takes == "tiles" else selection.parts)

    def choose_all(self) -> None:
        self.finish()
        self.tool, self.selection = "select", self._taken(stamps.everything(self.draft))

    def _joined(self, selection: stamps.Selection) -> stamps.Selection:
        before = self._chosen_before
        return stamps.Selection(selection.area or before.area, selection.parts | before.parts)

    def _choose(self, *, add: bool) -> None:
        part, area = self.near(PICK_REACH), self.selection.area
        if not add and (part in self.selection.parts or (area and self.cell in stamps.area_cells(area))):
            self._begin_drag()
            return
        self._chosen_before = self.selection if add else stamps.Selection()
        if part is None and not add and messages_at(self.draft.says, self.cell):
            self.history.begin()
            self._gesture = Gesture.MESSAGE
        elif part is None:
            self._gesture = Gesture.CHOOSE
        elif add and part in self.selection.parts:
            self.selection = stamps.Selection(self.selection.area, self.selection.parts - {part})
        else:
            self.selection = self._joined(stamps.Selection(parts=frozenset({part})))
            self._begin_drag()

    def _begin_drag(self) -> None:
        self.history.begin()
        self._gesture = Gesture.DRAG
        self._chosen_before = self.selection

    def _drag(self) -> None:
        snap = "cell" if self._chosen_before.area else self.brush.snap
        (ax, ay), (bx, by) = palette.snapped(*self._pressed_at, snap), palette.snapped(*self.pointer, snap)
        began = self.history.began
        motion = Motion(dx=bx - ax, dy=by - ay)
        if self._copies:
            copy = stamps.copied(began, self._chosen_before).carried(motion)
            draft, self.selection = stamps.pasted(began, copy, empty=self.pastes_empty)
        else:
            draft, self.selection = stamps.moved(began, self._chosen_before, motion)
        self.history.change(draft)

    def choose(self, parts: frozenset[stamps.ObjectPart]) -> None:
        self.finish()
        self.selection = stamps.Selection(parts=parts)

    def undo(self) -> bool:
        """Cancel a paste or a drawing, else undo the newest change; whether there was any."""
        hung = self.ghost is not None or self.placing_switch
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

    # --- the selection ---

    def nudge(self, dx: float, dy: float) -> None:
        """Move the selection by steps of the snap, or of cells."""
        step = CELL if self.selection.area else palette.SNAPS[self.brush.snap]
        draft, self.selection = stamps.moved(self.draft, self.selection, Motion(dx=dx * step, dy=dy * step))
        self.history.change(draft)

    def reorder(self, by: int) -> None:
        if self.selection.parts:
            draft, self.selection = stamps.reordered(self.draft, self.selection, by)
            self.history.change(draft)

    def turn(self, motion: Motion) -> bool:
        """Flip or turn the stamp that is being pasted, else the selection in its place, else the brush.

        False, without a change, if something would leave the level.
        """
        if self.ghost is not None:
            self.ghost = self.ghost.carried(motion.about(WORLD_WIDTH / 2, WORLD_HEIGHT / 2))
            return True
        self.finish()
        if self.selection:
            about = motion.about(*stamps.turning_centre(self.draft, self.selection, quarter=bool(motion.xy)))
            return self._carry(self.selection, about)
        self.brush.turn(motion)
        return True

    def _carry(self, selection: stamps.Selection, motion: Motion) -> bool:
        cells = list(stamps.area_cells(selection.area)) if selection.area else []
        cells += [cell_of(*points(self.draft.objects[number])[part]) for number, part in selection.parts]
        if not all(is_inside(motion.cell(cell)) for cell in cells if is_inside(cell)):
            return False
        draft, after = stamps.moved(self.draft, selection, motion)
        self.history.change(draft)
        self.selection = stamps.Selection(after.area or self.selection.area, after.parts)
        return True

    def shift(self, dx: float, dy: float) -> bool:
        """Move the selection, px; without its tiles if these are no whole cells. False as for ``turn``."""
        whole = dx % CELL == dy % CELL == 0.0
        return self._carry(
            self.selection if whole else stamps.Selection(parts=self.selection.parts), Motion(dx=dx, dy=dy)
        )

    def arrange(self, axis: int, share: float | None) -> None:
        """Align the selected objects, or spread them (``stamp.arranged``)."""
        self.history.change(stamps.arranged(self.draft, self.selection, axis, share))

    def copy(self) -> bool:
        """Copy the selection; whether there is one."""
        if self.selection:
            self.clipboard = stamps.copied(self.draft, self.selection)
        return bool(self.selection)

    def cut(self) -> None:
        if self.copy():
            self.delete()

    def delete(self) -> None:
        """Delete the selection, or else the object under the pointer."""
        self.finish()
        if self.selection:
            self.history.change(stamps.removed(self.draft, self.selection))
            self.selection = stamps.Selection()
        elif self.near(PICK_REACH):
            self.delete_nearest(PICK_REACH)

    def paste(self) -> bool:
        """Begin to paste the copy with the next press; whether there is one."""
        self.finish()
        self._chosen_before = self.selection
        self.selection = stamps.Selection()
        self.ghost = self.clipboard
        return self.ghost is not None

    @property
    def pasted(self) -> stamps.Stamp | None:
        """The stamp to paste at its place: its middle under the pointer, within the level if it fits."""
        return stamps.centred(self.ghost, self.pointer, palette.SNAPS[self.brush.snap]) if self.ghost else None

    @property
    def chosen(self) -> ObjectSpec | None:
        numbers = self.selection.numbers
        number = next(iter(numbers)) if len(numbers) == 1 and self.selection.area is None else -1
        return self.draft.objects[number] if 0 <= number < len(self.draft.objects) else None

    @property
    def subjects(self) -> list[ObjectSpec]:
        """All objects with a selected part; without a selection the brush's object."""
        objects = self.draft.objects
        chosen = [objects[number] for number in sorted(self.selection.numbers) if number < len(objects)]
        return chosen if self.selection else [self.brush.spec]

    def put_word(self, name: str, text: str) -> None:
        """Give the subjects this property, as one edit."""
        if not self.selection:
            self.brush.put_word(name, text)
        self.change_each(lambda spec: with_word(spec, name, text) if name in properties(spec) else spec)

    def change_each(self, change: Callable[[ObjectSpec], ObjectSpec]) -> None:
        """Change all objects with a selected part, as one edit."""
        objects = list(self.draft.objects)
        for number in self.selection.numbers:
            objects[number] = change(objects[number])
        parts = frozenset((number, part) for number in self.selection.numbers for part in points(objects[number]))
        self.history.change(self.draft.with_objects(tuple(objects)))
        self.selection = stamps.Selection(self.selection.area, parts)
