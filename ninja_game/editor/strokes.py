"""What presses begin in the level editor, and moves and releases continue: drawings, pastes, frames, drags."""

from __future__ import annotations

from dataclasses import replace

from ninja_game.editor import palette, stamp as stamps
from ninja_game.editor.bench import REACH, Bench
from ninja_game.editor.brush import Tool
from ninja_game.editor.motion import Motion
from ninja_game.editor.specs import has_switch
from ninja_game.formats.messages import messages_at, parse_messages, with_message_moved
from ninja_game.sim.grid import Cell, cell_of, is_inside
from ninja_game.sim.level import ObjectSpec

DRAGGED = 12.0  # a press that moves farther than this is a drag, px


class Stroke:
    """What a press began, until its button is released: one edit. ``start``: where it began, px of the level."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.start = bench.pointer

    def begin(self) -> None:
        self.bench.history.begin()

    def move(self) -> None:
        """The pointer has moved."""

    def release(self) -> Stroke | None:
        """The button is released. Gives a stroke that continues this one without a button, or None."""
        self.end()
        return None

    def end(self) -> None:
        """Something else begins: keep what is done."""
        self.bench.history.end()

    def cancel(self) -> None:
        """Take back what is done."""
        self.bench.history.abandon()
        self.bench.selection = stamps.Selection()


class Hanging(Stroke):
    """What hangs at the pointer without a button, until the next press."""

    def release(self) -> Stroke | None:
        return self

    def press(self) -> None:
        """Put it where it is."""
        self.bench.history.end()


class PlacingSwitch(Hanging):
    """The switch of a door or an exit that was placed. The edit began with that."""

    def __init__(self, bench: Bench, spec: ObjectSpec) -> None:
        super().__init__(bench)
        self._spec = spec

    def move(self) -> None:
        bench = self.bench
        spec = palette.with_switch(self._spec, *bench.pointer, bench.brush.snap)
        bench.history.change(bench.brush.with_objects(bench.history.began, (spec,)))

    def end(self) -> None:
        """Remove what has no switch yet."""
        self.bench.history.abandon()
        self.bench.gave_up(self._spec)


class Pasting(Hanging):
    """A stamp that the next press pastes."""

    def __init__(self, bench: Bench, stamp: stamps.Stamp) -> None:
        super().__init__(bench)
        self.stamp = stamp
        self._chosen_before = bench.selection

    def begin(self) -> None:
        """Before the press, nothing is edited."""

    @property
    def at_pointer(self) -> stamps.Stamp:
        """The stamp with its middle under the pointer, within the level if it fits."""
        return stamps.centred(self.stamp, self.bench.pointer, palette.SNAPS[self.bench.brush.snap])

    def press(self) -> None:
        bench = self.bench
        draft, bench.selection = stamps.pasted(bench.draft, self.at_pointer, empty=bench.pastes_empty)
        bench.history.change(draft)
        bench.tool = Tool.SELECT

    def cancel(self) -> None:
        self.bench.selection = self._chosen_before


class Drawn(Stroke):
    """A stroke that draws at its first place already."""

    def begin(self) -> None:
        super().begin()
        self.move()


class Painting(Drawn):
    """Tiles, or many objects, by hand; or they are erased."""

    def __init__(self, bench: Bench, *, erases: bool) -> None:
        super().__init__(bench)
        self._erases = erases
        self._cell = bench.cell

    def move(self) -> None:
        bench, brush = self.bench, self.bench.brush
        if not brush.draws_objects:
            tile = palette.EMPTY if self._erases else brush.tile
            after = brush.with_stroke(bench.draft, self._cell, bench.cell, tile, slopes=bench.sets_slopes)
            bench.history.change(after)
        elif self._erases:
            bench.delete_nearest()
        else:
            bench.history.change(brush.with_objects(bench.draft, (bench.placed(*bench.pointer),)))
        self._cell = bench.cell


class Stretching(Drawn):
    """One of SHAPES from the press to the pointer."""

    def __init__(self, bench: Bench, shape: Tool) -> None:
        super().__init__(bench)
        self.shape = shape
        self._bend = 0.0

    def move(self) -> None:
        bench, ends = self.bench, (self.start, self.bench.pointer)
        began = bench.history.began
        after = bench.brush.with_shape(began, self.shape, *ends, bend=self._bend, slopes=bench.sets_slopes)
        bench.history.change(after)

    def bend(self, px: float) -> None:
        """Bend a line to its right."""
        self._bend += px
        self.move()


class Dropping(Drawn):
    """An object that follows the pointer; one with a switch stays, and the switch follows."""

    def move(self) -> None:
        bench = self.bench
        spec = bench.placed(*bench.pointer)
        if has_switch(spec):
            self._switch().move()
        else:
            bench.history.change(bench.brush.with_objects(bench.history.began, (spec,)))

    def release(self) -> Stroke | None:
        if not has_switch(self.bench.placed(*self.bench.pointer)):
            return super().release()
        switch = self._switch()
        if max(abs(a - b) for a, b in zip(self.bench.pointer, self.start, strict=True)) <= DRAGGED:
            return switch
        switch.move()
        switch.press()
        return None

    def _switch(self) -> PlacingSwitch:
        return PlacingSwitch(self.bench, self.bench.placed(*self.start))


class Choosing(Stroke):
    """A frame that selects; without a move, a click. ``before``: what stays selected."""

    def __init__(self, bench: Bench, before: stamps.Selection) -> None:
        super().__init__(bench)
        self._before = before
        self.marquee: tuple[Cell, Cell] | None = None  #: the corners of the frame

    def begin(self) -> None:
        """The selection is no edit."""

    def move(self) -> None:
        self.marquee = cell_of(*self.start), self.bench.cell
        chosen = stamps.chosen_in(self.bench.draft, stamps.area_between(*self.marquee))
        self.bench.selection = self.bench.taken(chosen).joined(self._before)

    def release(self) -> Stroke | None:
        if self.marquee is None and not self._before:
            part = self.bench.near(REACH)
            area = (*self.bench.cell, 1, 1) if self.bench.takes == "tiles" else None
            self.bench.selection = stamps.Selection(area, frozenset({part} if part else ()))
        return None


class Dragging(Stroke):
    """The selection, or a copy of it, follows the pointer."""

    def __init__(self, bench: Bench, *, copies: bool) -> None:
        super().__init__(bench)
        self._copies = copies
        self._chosen = bench.selection

    def move(self) -> None:
        bench, began = self.bench, self.bench.history.began
        snap = "cell" if self._chosen.area else bench.brush.snap
        (ax, ay), (bx, by) = palette.snapped(*self.start, snap), palette.snapped(*bench.pointer, snap)
        motion = Motion(dx=bx - ax, dy=by - ay)
        if self._copies:
            copy = stamps.copied(began, self._chosen).carried(motion)
            draft, bench.selection = stamps.pasted(began, copy, empty=bench.pastes_empty)
        else:
            draft, bench.selection = stamps.moved(began, self._chosen, motion)
        bench.history.change(draft)


class DraggingMessage(Stroke):
    """The place of the message at the press follows the pointer."""

    def move(self) -> None:
        began, cell = self.bench.history.began, self.bench.cell
        if is_inside(cell):
            number = parse_messages(began.says).index(messages_at(began.says, cell_of(*self.start))[0])
            self.bench.history.change(replace(began, says=with_message_moved(began.says, number, cell)))
