"""The brush: the tile or object that is drawn, and the drafts that strokes of it give."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from enum import StrEnum, auto

from ninja_game.editor import shapes, stamp as stamps
from ninja_game.editor.draft import Draft, Tiles
from ninja_game.editor.motion import SYMMETRIES, Motion
from ninja_game.editor.palette import (
    EMPTY,
    FULL,
    OBJECT_TYPE_NAMES,
    SNAPS,
    object_of_type,
    object_type_of,
    placed,
    snapped,
)
from ninja_game.editor.specs import has_switch, with_word
from ninja_game.formats.ascii.object_lines import SIDES
from ninja_game.sim.grid import Cell, Point, cell_of
from ninja_game.sim.kinds import DOOR, NINJA
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL


class Tool(StrEnum):
    """The tools of the editor, in the order of their buttons."""

    BRUSH = auto()
    RECTANGLE = auto()
    LINE = auto()
    ELLIPSE = auto()
    FILL = auto()
    SELECT = auto()
    PICK = auto()

    @property
    def draws(self) -> bool:
        return self not in (Tool.SELECT, Tool.PICK)


CURVES = (Tool.LINE, Tool.ELLIPSE)
SHAPES = (Tool.RECTANGLE, *CURVES)
SPACINGS = (12.0, 16.0, 20.0, 24.0, 36.0, 48.0, 72.0)
NEAREST = "nearest"  # doors go to the side nearest to the pointer

_MIN_STEP = 12.0  # the least px between objects that fill a box

Ends = Sequence[tuple[Cell, ...]]  # the cells at each end of a line


class Brush:
    """What is drawn, and how. Its methods change no draft, but give another one; points are px of the level.

    ``slopes`` of a method: whether slopes set themselves around the tiles that it draws.
    """

    def __init__(self) -> None:
        self.snap = "cell"  #: of SNAPS
        self.spacing = CELL  #: of objects along a line or ellipse, px, of SPACINGS
        self.slopes = False  #: whether slopes are automatic
        self.reset()

    def reset(self) -> None:
        """Take the first tile, without a symmetry."""
        self.symmetry = "off"  #: of SYMMETRIES
        self.draws_objects = False  #: whether the object is drawn, not the tile
        self.tile = FULL
        self.spec: ObjectSpec = object_of_type("gold")
        self.nearest = True  #: whether doors go to the side of a cell nearest to the pointer, not to their own

    @property
    def state(self) -> tuple[object, ...]:
        """All that is set."""
        return (
            self.draws_objects, self.tile, self.spec, self.nearest, self.symmetry, self.snap, self.spacing, self.slopes
        )  # fmt: skip

    @property
    def draws_one(self) -> bool:
        """Whether its object is placed one at a time: a ninja, and what has a switch to place."""
        return self.draws_objects and (self.spec.kind == NINJA or has_switch(self.spec))

    def pick_up(self, what: int | ObjectSpec) -> None:
        """Take a tile, or an object of the palette; others change nothing."""
        if isinstance(what, int):
            self.tile, self.draws_objects = what, False
        elif object_type_of(what) in OBJECT_TYPE_NAMES:
            self.spec, self.draws_objects = what, True

    def turn(self, motion: Motion) -> None:
        if self.draws_objects:
            self.spec = stamps.Stamp({}, (self.spec,)).carried(motion.about(36.0, 36.0)).objects[0]
            self.nearest = self.nearest and self.spec.kind != DOOR
        else:
            self.tile = motion.tile(self.tile)

    def put_word(self, name: str, text: str) -> None:
        """Give its object a property."""
        self.nearest = text == NEAREST if name == "side" else self.nearest
        self.spec = self.spec if text == NEAREST else with_word(self.spec, name, text)

    def placed(self, draft: Draft, x: float, y: float, snap: str = "") -> ObjectSpec:
        """Its object at a point. A door goes to a side that closes a gap between full tiles, if there is one."""

        def is_gap(i: int, j: int) -> bool:
            return all(draft.tile((column + k * i, row + k * j)) == FULL for k in (-1, 1))

        column, row = cell_of(x, y)
        closing = (("left", "right") if is_gap(0, 1) else ()) + (("top", "bottom") if is_gap(1, 0) else ())
        return placed(self.spec, x, y, snap or self.snap, (closing or SIDES) if self.nearest else ())

    def with_stamp(self, draft: Draft, stamp: stamps.Stamp, *, slopes: bool, ends: Ends = ()) -> Draft:
        """The draft with a stamp on it, in all images of the symmetry.

        ``ends``: of a line two cells thick; where slopes would make one pointed, it stays square.
        """
        images = SYMMETRIES[self.symmetry]
        after = stamps.with_stamp(draft, stamp, images)
        if not (slopes and set(stamp.tiles.values()) <= {EMPTY, FULL}):
            return after
        sloped = shapes.sloped(draft, after)
        all_ends = [*ends, *(tuple(map(motion.cell, end)) for motion in images for end in ends)]
        pointed = [end for end in all_ends if FULL not in map(sloped.tile, end)]
        return sloped.with_tiles({cell: after.tile(cell) for end in pointed for cell in end})

    def with_objects(self, draft: Draft, specs: Iterable[ObjectSpec]) -> Draft:
        return self.with_stamp(draft, stamps.Stamp({}, tuple(specs)), slopes=False)

    def with_tiles(self, draft: Draft, cells: Iterable[Cell], *, slopes: bool) -> Draft:
        """The draft with its tile in these cells."""
        return self.with_stamp(draft, stamps.Stamp(dict.fromkeys(cells, self.tile)), slopes=slopes)

    def with_stroke(self, draft: Draft, start: Cell, end: Cell, tile: int, *, slopes: bool) -> Draft:
        """The draft with a straight part of a line that is drawn by hand."""
        cells = shapes.covered(Tool.LINE, start, end, 0.0)
        cells += shapes.stair_cells(cells) if self.slopes and tile in (EMPTY, FULL) else []
        return self.with_stamp(draft, stamps.Stamp(self._lined(cells, tile, draft)), slopes=slopes)

    def _lined(self, cells: list[Cell], tile: int, draft: Draft) -> Tiles:
        """The tiles of a line; with automatic slopes full ones fill its notches, those on the solid side of slopes."""
        notches = shapes.behind(cells, tile) if self.slopes else []
        return {cell: FULL for cell in notches if draft.tile(cell) == EMPTY} | dict.fromkeys(cells, tile)

    def with_shape(
        self, draft: Draft, shape: str, start: Point, end: Point, *, bend: float = 0.0, slopes: bool
    ) -> Draft:
        """The draft with one of SHAPES from a point to another. ``bend``: of a line, px to its right.

        Tiles fill it; objects fill a box, and lie along a line or an ellipse.
        """
        if not self.draws_objects:
            tiles, ends = self._tiles_of(draft, shape, cell_of(*start), cell_of(*end), bend)
            return self.with_stamp(draft, stamps.Stamp(tiles), slopes=slopes, ends=ends)
        corners = snapped(*start, self.snap), snapped(*end, self.snap)
        if shape in CURVES:
            places, snap = shapes.spaced_places(shapes.curve(shape, *corners, bend), self.spacing), "px"
        else:
            step, snap = max(SNAPS[self.snap], _MIN_STEP), self.snap
            (x, right), (y, bottom) = (sorted(along) for along in zip(*corners, strict=True))
            rows, columns = (range(int(length // step) + 1) for length in (bottom - y, right - x))
            places = [(x + step * i, y + step * j) for j in rows for i in columns]
        return self.with_objects(draft, (self.placed(draft, *place, snap) for place in places))

    def _tiles_of(self, draft: Draft, shape: str, start: Cell, end: Cell, bend: float) -> tuple[Tiles, Ends]:
        """The tiles of a shape, and the ends of a line two cells thick."""
        cells = shapes.covered(shape, start, end, bend)
        sloped = dict[Cell, int]()  # the shape from full tiles and slopes, where there is such a form
        if self.slopes and self.tile == FULL and not bend and shape == Tool.LINE:
            sloped = shapes.ramp(start, end)
        elif self.slopes and self.tile == FULL and shape == Tool.ELLIPSE:
            column, row, *size = stamps.area_between(start, end)
            sloped = {(column + i, row + j): tile for (i, j), tile in shapes.rounded(*size).items()}
        if sloped:
            # Slopes of the shape remove no tiles.
            return {cell: tile for cell, tile in sloped.items() if tile == FULL or not draft.tile(cell)}, ()
        if shape != Tool.LINE:
            return dict.fromkeys(cells, self.tile), ()
        ramp = self.slopes and self.tile in (EMPTY, FULL)
        band = shapes.ramp_cells(cells) if ramp else cells
        thick = self.tile == FULL and len(band) > len(cells)
        ends = ((band[0], band[len(cells)]), (cells[-1], band[-1])) if thick else ()
        return self._lined(band, self.tile, draft), ends
