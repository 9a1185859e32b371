"""Edits of what is selected in the level editor."""

from __future__ import annotations

from collections.abc import Callable

from ninja_game.editor import palette, stamp as stamps
from ninja_game.editor.bench import Bench
from ninja_game.editor.draft import Draft
from ninja_game.editor.motion import Motion
from ninja_game.editor.specs import points, properties, with_word
from ninja_game.sim.grid import cell_of, is_inside
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL


class Selected:
    """What is selected on a bench. Each change is one edit, and what it changed stays selected."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench

    @property
    def chosen(self) -> ObjectSpec | None:
        """The object, if it is the only thing that is selected."""
        selection, objects = self._bench.selection, self._bench.draft.objects
        numbers = selection.numbers
        number = next(iter(numbers)) if len(numbers) == 1 and selection.area is None else -1
        return objects[number] if 0 <= number < len(objects) else None

    @property
    def subjects(self) -> list[ObjectSpec]:
        """All objects with a selected part; without a selection the brush's object."""
        selection, objects = self._bench.selection, self._bench.draft.objects
        chosen = [objects[number] for number in sorted(selection.numbers) if number < len(objects)]
        return chosen if selection else [self._bench.brush.spec]

    def _put(self, edit: tuple[Draft, stamps.Selection]) -> None:
        draft, self._bench.selection = edit
        self._bench.history.change(draft)

    def nudge(self, dx: float, dy: float) -> None:
        """Move it by steps of the snap, or of cells."""
        bench = self._bench
        step = CELL if bench.selection.area else palette.SNAPS[bench.brush.snap]
        self._put(stamps.moved(bench.draft, bench.selection, Motion(dx=dx * step, dy=dy * step)))

    def reorder(self, by: int) -> None:
        """Move the objects in the list of all objects."""
        if self._bench.selection.parts:
            self._put(stamps.reordered(self._bench.draft, self._bench.selection, by))

    def turn(self, motion: Motion) -> bool:
        """Flip or turn it in its place. False, without a change, if something would leave the level."""
        draft, selection = self._bench.draft, self._bench.selection
        centre = stamps.turning_centre(draft, selection, quarter=bool(motion.xy))
        return self._carry(selection, motion.about(*centre))

    def shift(self, dx: float, dy: float) -> bool:
        """Move it, px; without its tiles if these are no whole cells. False as for ``turn``."""
        selection = self._bench.selection
        whole = dx % CELL == dy % CELL == 0.0
        moving = selection if whole else stamps.Selection(parts=selection.parts)
        return self._carry(moving, Motion(dx=dx, dy=dy))

    def _carry(self, selection: stamps.Selection, motion: Motion) -> bool:
        draft = self._bench.draft
        cells = list(stamps.area_cells(selection.area)) if selection.area else []
        cells += [cell_of(*points(draft.objects[number])[part]) for number, part in selection.parts]
        if not all(is_inside(motion.cell(cell)) for cell in cells if is_inside(cell)):
            return False
        after, carried = stamps.moved(draft, selection, motion)
        self._put((after, stamps.Selection(carried.area or self._bench.selection.area, carried.parts)))
        return True

    def arrange(self, axis: int, share: float | None) -> None:
        """Align the objects, or spread them (``stamp.arranged``)."""
        self._bench.history.change(stamps.arranged(self._bench.draft, self._bench.selection, axis, share))

    def delete(self) -> None:
        self._put((stamps.removed(self._bench.draft, self._bench.selection), stamps.Selection()))

    def put_word(self, name: str, text: str) -> None:
        """Give the subjects this property."""
        if not self._bench.selection:
            self._bench.brush.put_word(name, text)
        self.change_each(lambda spec: with_word(spec, name, text) if name in properties(spec) else spec)

    def change_each(self, change: Callable[[ObjectSpec], ObjectSpec]) -> None:
        """Change all objects with a selected part."""
        bench, numbers = self._bench, self._bench.selection.numbers
        objects = list(bench.draft.objects)
        for number in numbers:
            objects[number] = change(objects[number])
        parts = frozenset((number, part) for number in numbers for part in points(objects[number]))
        self._put((bench.draft.with_objects(tuple(objects)), stamps.Selection(bench.selection.area, parts)))
