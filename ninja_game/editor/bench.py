"""What the tools of the level editor work on: the draft, the brush, the pointer and the selection."""

from __future__ import annotations

from collections.abc import Callable

from ninja_game.document import History
from ninja_game.editor import stamp as stamps
from ninja_game.editor.brush import Brush, Tool
from ninja_game.editor.draft import Draft
from ninja_game.editor.motion import SYMMETRIES
from ninja_game.sim.grid import Cell, cell_of
from ninja_game.sim.level import ObjectSpec

TAKES = ("both", "tiles", "objects")  # the choices of Select
REACH = 17.32  # px within which an object is deleted (√300: game.md §6), or selected by a click


class Bench:
    """A draft with its history, the brush, the pointer, the present tool and the selection."""

    def __init__(self, draft: Draft) -> None:
        self.history = History(draft)
        self.brush = Brush()
        self.pointer = (396.0, 300.0)
        self.selection = stamps.Selection()
        #: Gets an object that something else than ``cancel`` takes away, since it has no switch yet
        self.gave_up: Callable[[ObjectSpec], object] = lambda _: None
        self.take_first()

    def take_first(self) -> None:
        """Take the first tool and the first tile, without a symmetry."""
        self.brush.reset()
        self.tool = Tool.BRUSH
        self.takes = TAKES[0]
        self.pastes_empty = False  #: whether empty cells of a copy remove tiles

    @property
    def draft(self) -> Draft:
        return self.history.draft

    @property
    def cell(self) -> Cell:
        return cell_of(*self.pointer)

    @property
    def about_objects(self) -> bool:
        """Whether keys are about objects: drawn, or selected."""
        return self.brush.draws_objects or bool(self.selection.parts)

    @property
    def effective_tool(self) -> Tool:
        """The tool that a press uses: a ninja, and an object with a switch to place, are placed one at a time."""
        return Tool.BRUSH if self.tool.draws and self.brush.draws_one else self.tool

    @property
    def sets_slopes(self) -> bool:
        """Whether slopes set themselves where the tool draws: a box has the corners that it is given."""
        draws_edges = self.tool.draws and self.tool != Tool.RECTANGLE
        return draws_edges and self.brush.slopes and not self.brush.draws_objects

    def placed(self, x: float, y: float, snap: str = "") -> ObjectSpec:
        """The brush's object at a point."""
        return self.brush.placed(self.draft, x, y, snap)

    def near(self, reach: float) -> stamps.ObjectPart | None:
        """The part of an object at the pointer, within that many px; None if Select takes only tiles."""
        tiles = self.tool == Tool.SELECT and self.takes == "tiles"
        return None if tiles else stamps.nearest_part(self.draft, *self.pointer, reach)

    def taken(self, selection: stamps.Selection) -> stamps.Selection:
        """The part of a selection that Select takes."""
        area = None if self.takes == "objects" else selection.area
        return stamps.Selection(area, frozenset() if self.takes == "tiles" else selection.parts)

    def delete_nearest(self, reach: float = REACH) -> None:
        """Delete the object nearest to the pointer, and its images in the symmetry."""
        places = [self.pointer, *(motion.point(*self.pointer) for motion in SYMMETRIES[self.brush.symmetry])]
        parts = [stamps.nearest_part(self.draft, *place, reach) for place in places]
        self.history.change(stamps.removed(self.draft, stamps.Selection(parts=frozenset(filter(None, parts)))))
