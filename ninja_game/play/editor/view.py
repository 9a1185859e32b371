"""The level under edit in its part of the window: picture, overlay, pointer; and the places of all parts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import pygame

from ninja_game.editor.brush import Tool
from ninja_game.editor.draft import Draft
from ninja_game.editor.motion import SYMMETRIES, Motion
from ninja_game.editor.playtests import PathPoints, PlaytestMap
from ninja_game.editor.reach import SQUARE, Reach
from ninja_game.editor.specs import BODY_PART, SWITCH_PART, carried, object_type_name, points
from ninja_game.editor.stamp import Stamp, area_around, area_between, nearest_part
from ninja_game.editor.tools import PICK_REACH, EditorTools
from ninja_game.formats.messages import messages_at
from ninja_game.play.app import App
from ninja_game.play.editor.palette_view import tile_icon
from ninja_game.play.editor.session import EditorSession
from ninja_game.play.editor.sheet import (
    GRIDS,
    MIDDLE,
    Grid,
    LevelSheet,
    finding_points,
    level_marks,
    message_near,
    message_places,
    united,
)
from ninja_game.play.workspace import Pane
from ninja_game.sim.grid import Cell, Point, is_inside
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, ObjectSpec
from ninja_game.sim.rules import CELL
from ninja_game.ui.canvas import WIDTH, Camera, Colour, Lens
from ninja_game.ui.text_entry import DOUBLE_MS
from ninja_game.ui.theme import Area, Palette, Theme
from ninja_game.ui.widgets import Widget
from ninja_game.view.sprites.drawing import DrawTarget, drawn_within, is_near
from ninja_game.view.sprites.sketch import Sketch

GHOST = 5  # opacity of the preview of a press, in eighths
NEAR_SWITCH_PX = 1.0
"""px; a preview nearer than this to a switch is not drawn: it would hide a switch that was just placed."""
DOUBLE = 4  # notches of the wheel that double the zoom
EDGE_SPEED = 0.3  # scrolling while something is dragged beyond an edge of the view, logical px per ms


@drawn_within(13)
def _ring(s: Sketch, p: Palette, colour: str) -> None:
    """A ring around an object that is, or by a click would be, selected. ``colour``: a role of the palette."""
    s.ring(getattr(p, colour), 0, 0, 11, 1.6)


class Overlay:
    """Draws over a sheet whose upper left corner is shown at ``corner``, px of the window.

    ``area``: of the sheet; ``canvas``: from px of the level, both px of the window.
    """

    def __init__(self, sheet: LevelSheet, corner: tuple[int, int]) -> None:
        self.sheet = sheet
        self.area = sheet.surface.get_rect(topleft=corner)
        (x, y), seen = corner, sheet.canvas
        self.canvas = Lens(seen.window, seen.scale, (x + seen.origin[0], y + seen.origin[1]))
        self.target = DrawTarget(self.canvas, sheet.palette, sheet.target.book)
        self._reach: Reach | None = None
        self._reached, self._seen = pygame.Surface((1, 1)), pygame.Rect(0, 0, 0, 0)

    def restore(self, surface: pygame.Surface, rects: list[pygame.Rect]) -> list[pygame.Rect]:
        """Copy changed parts of the sheet, and those under the last overlay, to the window; gives these areas, px."""
        x, y = self.area.topleft
        changed = united(rect.clip(self.area) for rect in [area.move(x, y) for area in rects] + self.target.covered)
        for rect in changed:
            surface.blit(self.sheet.surface, rect, rect.move(-x, -y))
        return changed

    def draw(
        self, surface: pygame.Surface, tools: EditorTools, reach: Reach | None, spot: Point | None, *, hovering: bool
    ) -> list[pygame.Rect]:
        """Draw the overlay; gives the covered areas, px. ``spot``: bubble of the selected message, px of the level."""
        self.target.begin(surface)
        surface.set_clip(self.area)
        if reach:
            self._draw_reach(reach)
        if tools.selection.area:
            self._frame(tools.selection.area, self.sheet.palette.accent)
        for number, part in tools.selection.parts:
            spec = tools.draft.objects[number] if number < len(tools.draft.objects) else None
            places = points(spec) if spec else {}
            if part in places and all(is_near(*place) for place in places.values()):
                self.target.sprite(_ring("accent"), *places[part])
                if SWITCH_PART in places:
                    self.target.line(self.sheet.palette.accent, *places[BODY_PART], *places[SWITCH_PART], 1.2)
        if spot:
            self.target.sprite(_ring("accent"), *spot)
        if tools.marquee:
            self._frame(area_between(*tools.marquee), self.sheet.palette.good)
        if hovering:
            self._hover(tools)
        surface.set_clip(None)
        return self.target.covered

    def _draw_reach(self, reach: Reach) -> None:
        """The reachable squares, some jumps, the last places to jump from; paths of dangers as dots every 10 ticks.

        The squares are drawn once, onto a picture that is then copied.
        """
        palette, target, canvas = self.sheet.palette, self.target, self.canvas
        if self._reach is not reach:
            self._reach = reach
            areas = [(reach.spans, palette.lock, 80), (reach.deaths, palette.bad, 255)]
            squares = [
                ((*colour[:3], alpha), canvas.rect(x, y, width, SQUARE))
                for spans, colour, alpha in areas
                for x, y, width in spans
            ]
            rects = [rect for _, rect in squares] or [pygame.Rect(canvas.origin, (1, 1))]
            self._seen = rects[0].unionall(rects).clip(self.area)
            self._reached = pygame.Surface(self._seen.size, pygame.SRCALPHA)
            for paint, rect in squares:
                self._reached.fill(paint, rect.move(-self._seen.x, -self._seen.y))
        target.covered.append(target.surface.blit(self._reached, self._seen))
        for route in (*reach.arcs, *reach.dangers):
            colour = palette.bad if route in reach.dangers else palette.lock
            shown = [canvas.exact(*point) for point in route if is_near(*point)]
            if len(shown) > 1 and shown[0] != shown[-1]:
                self._note(pygame.draw.lines(target.surface, colour, closed=False, points=shown, width=canvas.px(0.8)))
                for point in route[10::10]:
                    target.disc(colour, *point, 2.2)
        for x, y in reach.latest:
            target.line(palette.accent, x, y - 26, x, y + 10, 1.6)

    def _note(self, rect: pygame.Rect) -> None:
        self.target.covered.append(rect.inflate(4, 4))

    def _frame(self, area: Area, colour: Colour) -> None:
        column, row, columns, rows = area
        rect = self.canvas.rect(CELL * column, CELL * row, CELL * columns, CELL * rows)
        pygame.draw.rect(self.target.surface, colour, rect, self.canvas.px(1.6))
        self._note(rect)

    def _ghost(self, stamp: Stamp, *, empty: bool) -> None:
        """Draw the preview of a paste."""
        for cell, tile in (stamp if empty else stamp.solid).tiles.items():
            self._ghost_tile(cell, tile)
        for sprites in self.sheet.pictures.sprites_of(stamp.objects).values():
            sprites.draw(self.target, alpha=GHOST)
        if stamp.tiles:
            self._frame(area_around(stamp.tiles), self.sheet.palette.accent)

    def _hover(self, tools: EditorTools) -> None:
        """Draw the preview of a press, also at the mirrored places of a symmetry."""
        if tools.placing_switch:
            return
        ghost = tools.pasted
        if ghost:
            self._ghost(ghost, empty=tools.pastes_empty)
            return
        draws = tools.effective_tool.draws
        motions = (Motion(), *(SYMMETRIES[tools.brush.symmetry] if draws else ()))
        if not draws:
            target = tools.near(PICK_REACH)
            for message in messages_at(tools.draft.says, tools.cell):
                # The message appears when the ninja enters this frame.
                self._frame(message.frame, self.sheet.palette.accent)
            if target:
                self.target.sprite(_ring("faint"), *points(tools.draft.objects[target[0]])[target[1]])
                return
        if not tools.brush.draws_objects or not draws:
            for cell, tile in tools.preview.items() if draws else ():
                self._ghost_tile(cell, tile)
            for motion in motions:
                self._frame((*motion.cell(tools.cell), 1, 1), self.sheet.palette.accent)
            return
        spec = tools.placed(*tools.pointer)
        x, y = points(spec).get(BODY_PART, tools.pointer)
        there = nearest_part(tools.draft, x, y, NEAR_SWITCH_PX)
        if there is None or there[1] != SWITCH_PART:
            motions = motions[: 1 if spec.kind in (NINJA, EXIT) else None]
            images = [carried(placed, motion) for placed in tools.next_objects for motion in motions]
            for sprites in self.sheet.pictures.sprites_of(images).values():
                sprites.draw(self.target, alpha=GHOST)
        for a, b in (((x - 4, y), (x + 4, y)), ((x, y - 4), (x, y + 4))):
            self.target.line(self.sheet.palette.accent, *a, *b)

    def _ghost_tile(self, cell: tuple[int, int], tile: int) -> None:
        rect = self.canvas.rect(CELL * cell[0], CELL * cell[1], CELL, CELL)
        if self.sheet.draft and self.sheet.draft.tile(cell):
            self.target.surface.fill(self.sheet.palette.background, rect)
        picture = tile_icon(tile, rect.size, self.sheet.palette.base.name, alpha=150)
        self.target.surface.blit(picture, rect, special_flags=pygame.BLEND_PREMULTIPLIED)
        self._note(rect)


class EditorLayout(NamedTuple):
    """Areas of the parts of the editor, logical px."""

    toolbar: Area = (0, 0, WIDTH, 26)
    level: Area = (6, 30, 602, 456)
    palette: Area = (610, 26, 182, 231)
    properties: Area = (610, 257, 182, 231)
    findings: Area = (6, 490, 602, 84)
    file: Area = (612, 490, 176, 84)
    status: Area = (0, 579, WIDTH, 21)


LAYOUT = EditorLayout()


class Hint(NamedTuple):
    """A text of the status line about a draft. ``offers_menu``: whether Esc opens the File menu while it is shown."""

    draft: Draft
    text: str
    offers_menu: bool = False


class Press(NamedTuple):
    """A press on the level, and the draft before it; two of them are a double click."""

    cell: Cell
    ms: int
    draft: Draft

    def doubles(self, before: Press) -> bool:
        return before.cell == self.cell and self.ms - before.ms < DOUBLE_MS


class EditorView(Pane):
    """The level under edit with its overlay."""

    area = LAYOUT.level

    def __init__(self, app: App, session: EditorSession) -> None:
        self.app = app
        self.session = session
        self.hovering = False  #: whether the pointer is shown
        self.by_keys = False  #: whether keys or a pad moved it last
        self._hint = Hint(session.draft, "")
        self.grid: Grid = GRIDS[1]
        self.lines = self.paths = True
        self.listing = False  #: whether the list of objects replaces the palette
        self.playtest_map = False  #: whether the map of playtests is shown
        #: gets the cell of the next press, which then draws nothing; None: cancelled
        self.taker: Callable[[Cell | None], None] | None = None
        session.tools.gave_up = self._tell_given_up
        self.open_message: Callable[[int], object] = lambda _: None  #: gets the number of a double-clicked message
        self._pressed: Press | None = None
        self._message: int | None = None  #: the number of the message on whose bubble Select was clicked last
        self.camera = Camera(2.0 ** (1 / DOUBLE), 4.0)  #: the shown part of the level
        self.finding = -1  #: the number of the problem that was gone to last
        self._mouse = (0, 0)
        self._held = False
        self._marked: tuple[object, ...] = ()
        self._laid_out: tuple[object, ...] = ()
        self.sheet: LevelSheet
        self._lay_out()

    @property
    def hint(self) -> str:
        """A text for the status line; it is dropped when the level changes."""
        return self._hint.text if self._hint.draft is self.session.draft else ""

    @hint.setter
    def hint(self, text: str) -> None:
        self._hint = Hint(self.session.draft, text)

    @property
    def offers_menu(self) -> bool:
        """Whether the hint that is shown offers the File menu."""
        return bool(self.hint) and self._hint.offers_menu

    def offer_menu(self) -> None:
        self._hint = Hint(self.session.draft, "Esc again opens the File menu, where Leave is too", offers_menu=True)

    def _tell_given_up(self, spec: ObjectSpec) -> None:
        self.app.notify(f"The {object_type_name(spec)} is removed: it had no switch yet")

    @property
    def message(self) -> int | None:
        """The number of the selected message."""
        tools, number = self.session.tools, self._message
        selects = tools.tool == Tool.SELECT and not tools.selection
        return number if selects and number in message_places(tools.draft).values() else None

    def _layout_key(self) -> tuple[object, ...]:
        return self.app.canvas, self.app.theme.palette.name, *self.camera.render_key

    @property
    def _rect(self) -> pygame.Rect:
        return self.app.canvas.rect(*self.area)

    def _lay_out(self) -> None:
        """Fit to the window's size, the palette, and what the camera shows."""
        before, self._laid_out = self._laid_out, self._layout_key()
        seen = self.camera.canvas(self._rect.size)
        if before[:2] == self._laid_out[:2]:
            self.sheet.look(seen)
        else:
            self.sheet = LevelSheet(seen, self.app.theme.palette)
            self.sheet.show(self.session.draft)
        self.overlay = Overlay(self.sheet, self._rect.topleft)
        if before[:3] != self._laid_out[:3]:
            self.sheet.show_grid(self.grid.lines())
            self._marked = ()

    def repaint(self) -> None:
        """Paint all of the level at the next drawing, also what has not changed."""
        self._laid_out = ()

    def _point(self) -> None:
        """Move the pointer to the mouse's place in the level."""
        (left, top), size = self._rect.topleft, self._rect.size
        seen = self.camera.canvas(size)
        self.session.tools.move(*seen.logical((self._mouse[0] - left, self._mouse[1] - top)))

    def zoom(self, notches: int) -> None:
        """Zoom about the pointer; 0: show all of the level, or double its scale if all is shown."""
        camera, size = self.camera, self._rect.size
        if not notches and camera.zoom > 1:
            camera.show_all()
        else:
            camera.zoom_at(size, camera.canvas(size).point(*self.session.tools.pointer), notches or DOUBLE)
        if self.hovering and not self.by_keys:
            self._point()

    def follow(self, x: float, y: float) -> None:
        """Scroll until a place of the level is in view."""
        if is_near(x, y):
            self.camera.follow(self._rect.size, x, y)

    def update(self, real_ms: int) -> None:
        """A drag beyond an edge scrolls the picture."""
        rect, (x, y) = self._rect, self._mouse
        if self.session.tools.is_busy and not (self.by_keys or self.camera.zoom == 1 or rect.collidepoint(x, y)):
            way = real_ms * EDGE_SPEED * self.app.canvas.scale
            dx, dy = (x < rect.left) - (x >= rect.right), (y < rect.top) - (y >= rect.bottom)
            self.camera.move(rect.size, way * dx, way * dy)
            self._point()

    def show_grid(self, grid: Grid) -> None:
        self.grid = grid
        self.sheet.show_grid(grid.lines())

    def press(self, *, erase: bool = False, pick: bool = False, add: bool = False, copies: bool = False) -> None:
        tools, cell = self.session.tools, self.session.tools.cell
        if self.taker:
            if erase or (is_inside(cell) and not pick):
                self.take(None if erase else cell)
            return
        free = tools.tool == Tool.SELECT and not (erase or pick or tools.ghost or tools.near(PICK_REACH))
        self._message = message_near(tools.draft, *tools.pointer) if free else None
        before = None if erase or pick else self._pressed
        self._pressed = Press(cell, pygame.time.get_ticks(), tools.draft)
        if before and self._pressed.doubles(before):
            number = message_near(before.draft, *tools.pointer)
            if number is not None:
                # Undo what the first click of the two has drawn.
                tools.finish()
                if tools.draft is not before.draft:
                    tools.undo()
                self._pressed = None
                self.open_message(number)
                return
        self._held = True
        tools.press(erase=erase, pick=pick, add=add, copies=copies)

    def turn(self, motion: Motion) -> None:
        if not self.session.tools.turn(motion):
            self.app.notify("Not turned: a part of it would leave the level. Move it away from the border first")

    def take(self, cell: Cell | None) -> bool:
        """Give a cell to a waiting ``taker``; tells whether there was one. None cancels, or deselects a message."""
        if cell is None and self.message is not None:
            self._message = None
            return True
        taker, self.taker = self.taker, None
        if taker:
            taker(cell)
        return bool(taker)

    def release(self) -> bool:
        """A button is released; whether it was down."""
        held, self._held = self._held, False
        if held:
            self.session.tools.release()
        return held

    def mouse(self, event: pygame.Event, x: float, y: float) -> bool:
        camera = self.camera
        button = getattr(event, "button", 0)
        if event.type == pygame.MOUSEBUTTONUP:
            if button != pygame.BUTTON_MIDDLE:
                self.release()
            elif camera.held and not camera.moved:
                self.press(pick=True)
                self.release()
            camera.held = None
            return True
        self._mouse = self.app.canvas.point(x, y)
        self.hovering = self._rect.collidepoint(self._mouse)
        self.by_keys = False
        if event.type == pygame.MOUSEMOTION and event.buttons[1]:
            camera.drag(self._rect.size, self._mouse)
        self._point()
        if event.type == pygame.MOUSEWHEEL and not self.session.tools.bend(-event.y):
            self.zoom(event.y)
        elif button == pygame.BUTTON_MIDDLE:
            camera.grab(self._mouse)
        elif button:
            held = pygame.key.get_mods()
            add, copies = bool(held & pygame.KMOD_SHIFT), bool(held & pygame.KMOD_CTRL)
            self.press(erase=button == pygame.BUTTON_RIGHT, add=add, copies=copies)
        return True

    def mouse_left(self) -> None:
        self.hovering = False

    def render_key(self) -> tuple[object, ...]:
        """All that the overlay depends on; the sheet watches the level itself."""
        tools = self.session.tools
        reach = self.session.edited.at_pointer.reach
        return (
            tools.pointer, self.hovering, tools.tool, tools.brush.state, tools.ghost, tools.pastes_empty,
            tools.selection, tools.marquee, tools.placing_switch, tools.draft, self.message, reach and reach[1:],
        )  # fmt: skip

    def draw(self, surface: pygame.Surface, theme: Theme, focus: Widget | None, *, whole: bool) -> list[pygame.Rect]:
        if self._laid_out != self._layout_key():
            self._lay_out()
            whole = True
        tools = self.session.tools
        if tools.draft is not self.sheet.draft:
            self.sheet.show(tools.draft)
        self._follow_marks()
        dirty = self.sheet.paint()
        key = self.render_key()
        if not (whole or dirty) and key == self._drawn:
            return []
        self._drawn = key
        if whole:
            changed = [self.overlay.area]
            surface.blit(self.sheet.surface, self.overlay.area)
        else:
            changed = self.overlay.restore(surface, dirty)
        reach = self.session.edited.at_pointer.reach if self.hovering else None
        spot = next((at for at, number in message_places(tools.draft).items() if number == self.message), None)
        return [*changed, *self.overlay.draw(surface, tools, reach, spot, hovering=self.hovering)]

    def _follow_marks(self) -> None:
        session, edited, draft = self.session, self.session.edited, self.session.draft
        palette = self.app.theme.palette
        certification = session.certifier.certification
        stale = session.certifier.is_stale(draft.level)
        playtests, findings, drone_round = edited.playtests, edited.examination.findings, edited.at_pointer.drone_round
        state = (
            draft.objects, self.lines, self.paths, playtests.last_route, certification.route, stale,
            findings, session.tools.brush.symmetry, draft.says, self.playtest_map and playtests.map,
            playtests.last_deaths, drone_round,
        )  # fmt: skip
        if len(state) == len(self._marked) and all(a is b for a, b in zip(state, self._marked, strict=True)):
            return
        self._marked = state
        open_findings = [finding for finding in findings if finding.code not in edited.accepted]
        level = edited.examination.level or draft.level
        signs = [place for finding in open_findings for place in finding_points(level, finding)]
        routes: list[tuple[PathPoints, Colour]] = [
            (playtests.last_route, palette.ghost),
            (certification.route, palette.faint if stale else palette.good),
            (drone_round, palette.bad),
        ]
        last = PlaytestMap({}, playtests.last_deaths if self.paths else ())
        marks = level_marks(
            self.sheet.flat,
            palette,
            draft,
            self.sheet.marks,
            lines=self.lines,
            signs=list(dict.fromkeys(signs)),
            messages=list(message_places(draft)),
            routes=routes if self.paths else (),
            playtests=(self.playtest_map and playtests.map) or last,
            axes=SYMMETRY_AXES.get(session.tools.brush.symmetry, ()),
        )
        self.sheet.show_marks(marks)


_X, _Y = MIDDLE
_UPRIGHT, _LEVEL = ((_X, CELL), (_X, CELL * (ROWS + 1))), ((CELL, _Y), (CELL * (COLUMNS + 1), _Y))
SYMMETRY_AXES: dict[str, Sequence[tuple[Point, Point]]] = {
    "left-right": [_UPRIGHT], "up-down": [_LEVEL], "both": [_UPRIGHT, _LEVEL],
    "point": [((_X - 12, _Y), (_X + 12, _Y)), ((_X, _Y - 12), (_X, _Y + 12))],
}  # fmt: skip
"""Lines that show a symmetry."""
