"""What follows the mouse over the level: what would be drawn, what is selected, the frame that is being drawn."""

from __future__ import annotations

import pygame

from ninja_game.editor.brush import placed
from ninja_game.editor.motion import SYMMETRIES, Motion
from ninja_game.editor.records import BODY, SWITCH, carried, points
from ninja_game.editor.stamp import Area, area_between, nearest
from ninja_game.editor.tools import DRAGGED, EditorTools
from ninja_game.play.editor.palette_view import tile_icon
from ninja_game.play.editor.sheet import LevelSheet, joined
from ninja_game.play.ui.canvas import Canvas, Colour
from ninja_game.play.ui.theme import Palette
from ninja_game.play.view.sprites.drawing import DrawTarget, drawing, is_near
from ninja_game.play.view.sprites.sketch import Sketch
from ninja_game.sim.kinds import EXIT, NINJA

GHOST = 5
"""Eighths as solid as what is there is what would be drawn."""
_COVERED = 1.0
"""A switch so near, px, would not be seen under the next exit: nothing is drawn over one that was just placed."""


@drawing(13)
def _ring(s: Sketch, p: Palette, colour: str) -> None:
    """Round what is selected, or would be. ``colour``: its name in the palette."""
    s.ring(getattr(p, colour), 0, 0, 11, 1.6)


class Overlay:
    """Draws over a sheet that is shown with its upper left corner at ``origin``, px of the window."""

    def __init__(self, sheet: LevelSheet, origin: tuple[int, int]) -> None:
        self.sheet = sheet
        self.canvas = Canvas(sheet.canvas.size)
        self.canvas.origin = origin
        self.target = DrawTarget(self.canvas, sheet.palette, sheet.book)

    @property
    def area(self) -> pygame.Rect:
        """The px of the level in the window."""
        return pygame.Rect(self.canvas.origin, self.canvas.size)

    def restore(self, surface: pygame.Surface, rects: list[pygame.Rect]) -> list[pygame.Rect]:
        """Show the sheet where these px of it have changed, and where the overlay was; the px of the window."""
        origin = self.canvas.origin
        changed = joined([rect.move(origin) for rect in rects] + self.target.covered)
        for rect in changed:
            shown = rect.clip(self.area)
            surface.blit(self.sheet.surface, shown, shown.move(-origin[0], -origin[1]))
        return changed

    def draw(self, surface: pygame.Surface, tools: EditorTools, *, hovering: bool) -> list[pygame.Rect]:
        """Draw it; the px of the window that it covers."""
        self.target.begin(surface)
        surface.set_clip(self.area)
        if tools.selection.area:
            self._frame(tools.selection.area, self.sheet.palette.accent)
        for number, part in tools.selection.parts:
            record = tools.draft.objects[number] if number < len(tools.draft.objects) else None
            place = points(record).get(part) if record else None
            if place and is_near(*place):
                self.target.sprite(_ring("accent"), *place)
        if tools.marquee:
            self._frame(area_between(*tools.marquee), self.sheet.palette.good)
        if hovering:
            self._hover(tools)
        surface.set_clip(None)
        return self.target.covered

    def _note(self, rect: pygame.Rect) -> None:
        self.target.covered.append(rect.inflate(4, 4))

    def _frame(self, area: Area, colour: Colour) -> None:
        column, row, columns, rows = area
        rect = self.canvas.rect(24 * column, 24 * row, 24 * columns, 24 * rows)
        pygame.draw.rect(self.target.surface, colour, rect, self.canvas.px(1.6))
        self._note(rect)

    def _hover(self, tools: EditorTools) -> None:
        """What a press would do here, and in the images of the symmetry."""
        if tools.placing_switch:
            return
        drawing = tools.tool in ("brush", "rectangle") or (tools.tool == "fill" and not tools.objects)
        motions = (Motion(), *(SYMMETRIES[tools.symmetry] if drawing else ()))
        if not drawing:
            found = nearest(tools.draft, *tools.pointer, DRAGGED)
            if found:
                self.target.sprite(_ring("faint"), *points(tools.draft.objects[found[0]])[found[1]])
                return
        if not tools.objects or not drawing:
            for motion in motions:
                cell = motion.cell(tools.cell)
                if drawing:
                    self._ghost_tile(cell, motion.tile(tools.tile))
                self._frame((*cell, 1, 1), self.sheet.palette.accent)
            return
        record = placed(tools.record, *tools.pointer, tools.snap)
        x, y = points(record).get(BODY, tools.pointer)
        there = nearest(tools.draft, x, y, _COVERED)
        if there is None or there[1] != SWITCH:
            images = [record] if record.kind in (NINJA, EXIT) else [carried(record, motion) for motion in motions]
            for each in self.sheet.pictures.sprites_of(images).values():
                each.draw(self.target, alpha=GHOST)
        for a, b in (((x - 4, y), (x + 4, y)), ((x, y - 4), (x, y + 4))):
            self.target.line(self.sheet.palette.accent, *a, *b)

    def _ghost_tile(self, cell: tuple[int, int], tile: int) -> None:
        rect = self.canvas.rect(24 * cell[0], 24 * cell[1], 24, 24)
        picture = tile_icon(tile, rect.size, self.sheet.palette.name, alpha=150)
        self.target.surface.blit(picture, rect, special_flags=pygame.BLEND_PREMULTIPLIED)
        self._note(rect)
