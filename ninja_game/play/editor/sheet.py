"""The level under edit as a picture that is repaired where something has changed."""

from __future__ import annotations

from collections.abc import Hashable, Iterable

import pygame

from ninja_game.editor.draft import Draft
from ninja_game.play.editor.marks import LevelMark
from ninja_game.play.editor.object_pictures import ObjectPictures, ObjectSprites
from ninja_game.play.ui.canvas import Canvas
from ninja_game.play.ui.theme import Palette
from ninja_game.play.view.sprites.drawing import DrawTarget, SpriteBook
from ninja_game.play.view.sprites.tile_sheet import TileSheet
from ninja_game.sim import kinds
from ninja_game.sim.level import COLUMNS, ROWS, ObjectSpec
from ninja_game.sim.loader import grid_tiles
from ninja_game.sim.memory.schema import TileMap
from ninja_game.sim.rules import STRIDE

_FRONT = {kinds.GOLD: 1, kinds.MINE: 1, kinds.NINJA: 3} | {kind.number: 2 for kind in kinds.KINDS if kind.moves}
"""What is drawn later lies in front."""

_MANY = 60
"""More rectangles than this are drawn again as one."""

COVERED_ALPHA = 4
"""Eighths as solid: an object that a tile hides is seen through it."""


class LevelSheet:
    """``surface``: the picture, without what follows the mouse. ``canvas``: from px of the level to px of the sheet.

    What is shown is drawn by the next ``paint``.
    """

    def __init__(self, size: tuple[int, int], palette: Palette) -> None:
        self.canvas = Canvas(size)
        self.palette = palette
        self.surface = pygame.Surface(self.canvas.size)
        self.book = SpriteBook(self.canvas.scale, palette)
        self.target = DrawTarget(self.canvas, palette, self.book)
        self.pictures = ObjectPictures(self.target)
        self.draft: Draft | None = None
        self._tiles = TileSheet(self.canvas, palette)
        self._looks: dict[ObjectSpec, ObjectSprites] = {}
        self._order: list[ObjectSprites] = []
        self._rects: list[pygame.Rect] = []
        self.marks: dict[Hashable, LevelMark] = {}
        self._grid: pygame.Surface | None = None
        self._dirty: list[pygame.Rect] = []

    def show(self, draft: Draft) -> None:
        before, self.draft = self.draft, draft
        if before is None:
            static = TileMap()
            static.tiles = grid_tiles(draft.level)
            self._tiles.show(static)
            self._dirty.append(self.surface.get_rect())
        else:
            self._change_tiles(before, draft)
        if before is None or before.objects != draft.objects:
            self._change_objects(draft)

    def _change_tiles(self, before: Draft, draft: Draft) -> None:
        old, new = before.level.tiles, draft.level.tiles
        if old == new:
            return
        grid = grid_tiles(draft.level)
        for index in range(COLUMNS * ROWS):
            if old[index] != new[index]:
                column, row = index // ROWS + 1, index % ROWS + 1
                self._tiles.draw(column, row, grid[(row + 1) * STRIDE + column + 1])
                self._dirty.append(self._tiles.cell(column, row))

    def _change_objects(self, draft: Draft) -> None:
        before = self._looks
        found = before | self.pictures.sprites_of(spec for spec in draft.objects if spec not in before)
        self._looks = {spec: found[spec] for spec in draft.objects}
        self._order = [found[spec] for spec in sorted(self._looks, key=lambda each: _FRONT.get(each.kind, 0))]
        self._rects = [each.rect for each in self._order]
        self._dirty += [found[spec].rect for spec in before.keys() ^ self._looks.keys()]

    def show_marks(self, marks: dict[Hashable, LevelMark]) -> None:
        """Show these marks. A mark with the key of an earlier one is the same."""
        changed = [self.marks[key] for key in self.marks.keys() - marks.keys()]
        changed += [marks[key] for key in marks.keys() - self.marks.keys()]
        self.marks = marks
        self._dirty += [rect for mark in changed for rect in mark.rects]

    def show_grid(self, lines: Iterable[tuple[bool, float, bool]]) -> None:
        """Show grid lines: whether upright, where (px of the level), whether one of the middle lines."""
        lines = list(lines)
        self._grid = pygame.Surface(self.canvas.size, pygame.SRCALPHA) if lines else None
        for upright, at, middle in lines:
            assert self._grid is not None  # noqa: S101 - for the type checker
            colour = (*self.palette.accent[:3], 150) if middle else (*self.palette.text[:3], 60)
            ends = ((at, 24.0), (at, 576.0)) if upright else ((24.0, at), (768.0, at))
            pygame.draw.line(self._grid, colour, self.canvas.point(*ends[0]), self.canvas.point(*ends[1]))
        self._dirty.append(self.surface.get_rect())

    def paint(self) -> list[pygame.Rect]:
        """Draw what is shown now and was not before; the px that changed."""
        dirty, self._dirty = joined(self._dirty), []
        for area in dirty:
            self._repaint_area(area.clip(self.surface.get_rect()))
        return dirty

    def _repaint_area(self, area: pygame.Rect) -> None:
        surface, target = self.surface, self.target
        if not area.width or self.draft is None:
            return
        surface.set_clip(area)
        surface.fill(self.palette.background)
        target.begin(surface)
        near = area.collidelistall(self._rects)
        for number in near:
            self._order[number].draw(target)
        if self._tiles.has_tile(area):
            surface.blit(self._tiles.surface, area, area, pygame.BLEND_PREMULTIPLIED)
            for number in near:
                if any(self.draft.tile(cell) == 1 for cell in self._order[number].cells):
                    self._order[number].draw(target, alpha=COVERED_ALPHA)
        if self._grid is not None:
            surface.blit(self._grid, area, area)
        for mark in self.marks.values():
            if area.collidelist(mark.rects) >= 0:
                mark.draw(target)
        surface.set_clip(None)


def joined(rects: Iterable[pygame.Rect]) -> list[pygame.Rect]:
    """Few rectangles that cover the same px: those that touch become one, and so do very many."""
    waiting = [rect.copy() for rect in rects if rect.width]
    if len(waiting) > _MANY:
        return [waiting[0].unionall(waiting[1:])]
    found: list[pygame.Rect] = []
    while waiting:
        rect = waiting.pop()
        touching = rect.collidelistall(found)
        if touching:
            for number in reversed(touching):
                rect.union_ip(found.pop(number))
            waiting.append(rect)
        else:
            found.append(rect)
    return found
