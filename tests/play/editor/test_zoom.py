"""The level under edit larger than its part of the window: every tool works where the mouse sees it."""

import pygame
import pytest

from ninja_game.editor.brush import Tool
from ninja_game.editor.files import Source
from ninja_game.editor.motion import SYMMETRIES
from ninja_game.editor.specs import BODY_PART, points
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.play.editor.sheet import GRIDS, line_mark, route_mark
from ninja_game.play.editor.view import SYMMETRY_AXES
from ninja_game.sim.grid import Cell, Point, middle_of
from ninja_game.sim.kinds import GOLD
from ninja_game.sim.level import ObjectSpec
from ninja_game.ui.canvas import Canvas
from tests.support.level_maker import ROOM, Maker


class Looker:
    """The maker with the level zoomed in, who sees places of the level where they are now."""

    def __init__(self, room: Maker) -> None:
        self.room = room
        self.view, self.tools = room.editor.view, room.editor.session.tools
        room.wheel(4, *room.at(60, 560))
        assert self.view.camera.zoom == 2.0

    def px(self, place: Point) -> tuple[int, int]:
        return self.view.overlay.canvas.point(*place)

    def event(self, kind: int, px: tuple[int, int], button: int = 0, *, held: int = 0) -> None:
        """A mouse event at a px, and a picture."""
        more = {"button": button} if button else {"rel": (0, 0), "buttons": tuple(held == k for k in (1, 2, 3))}
        pygame.event.post(pygame.Event(kind, {"pos": px, "touch": False} | more))
        self.room.frames(1)

    def drag(self, *pxs: tuple[int, int], button: int = 1) -> None:
        self.event(pygame.MOUSEMOTION, pxs[0])
        self.event(pygame.MOUSEBUTTONDOWN, pxs[0], button)
        for px in pxs[1:]:
            self.event(pygame.MOUSEMOTION, px, held=button)
        self.event(pygame.MOUSEBUTTONUP, pxs[-1], button)

    def cells(self, *cells: Cell, button: int = 1) -> None:
        self.drag(*(self.px(middle_of(cell)) for cell in cells), button=button)

    def is_as_drawn_at_once(self) -> bool:
        """Whether the picture, repaired and moved, is that of a sheet that is drawn again.

        Smoothed edges may be a shade off: a line far from the corner is rounded otherwise.
        """
        self.room.frames(1)
        area, nothing = self.view.overlay.area, (0, 0, 0)
        before = self.room.app.surface.subsurface(area).copy()
        self.view.repaint()
        self.room.frames(1)
        now = self.room.app.surface.subsurface(area)
        same = pygame.mask.from_threshold(before, nothing, (24, 24, 24, 255), now).count()
        return area.width * area.height - same <= 5


@pytest.fixture(name="near")
def zoomed_in(room: Maker) -> Looker:
    return Looker(room)


def test_the_wheel_zooms_about_the_pointer_and_all_can_be_seen_again(room: Maker) -> None:
    view, tools = room.editor.view, room.editor.session.tools
    tile = tools.brush.tile
    for notches, zoom in ((1, 1.19), (1, 1.41), (2, 2), (4, 4), (1, 4), (-4, 2), (-3, 1.19), (-1, 1), (-1, 1)):
        room.wheel(notches, *room.at(300, 400))
        assert tools.brush.tile == tile
        assert view.camera.zoom == pytest.approx(zoom, abs=0.01)
        assert tools.pointer == pytest.approx((300, 400), abs=1.5)
        centre = view.camera.centre
        view.follow(300, 400)
        assert view.camera.centre == centre, "it is well inside"
    room.chord("equals", pygame.KMOD_LCTRL)
    room.press("kp_plus")
    assert view.camera.zoom == 4
    room.chord("minus", pygame.KMOD_LCTRL)
    assert view.camera.zoom == 2
    room.chord("0", pygame.KMOD_LCTRL)
    assert view.camera.zoom == 1
    button = room.button("Zoom: {zoom}")
    for zoom in (2, 1):
        room.mouse(*button.centre)
        assert view.camera.zoom == zoom


def test_the_wheel_over_the_palette_takes_the_next_entry(room: Maker) -> None:
    tools, (x, y) = room.editor.session.tools, (700, 140)
    before = tools.brush.tile
    room.wheel(-1, x, y)
    assert (tools.brush.tile != before, room.editor.view.camera.zoom) == (True, 1)
    room.wheel(1, x, y)
    assert tools.brush.tile == before


def test_tools_draw_and_erase_where_the_mouse_is(near: Looker) -> None:
    near.cells((4, 18), (6, 18))
    assert [near.room.draft.tile((column, 18)) for column in range(3, 8)] == [0, 1, 1, 1, 0]
    near.cells((5, 18), button=3)
    near.tools.tool = Tool.RECTANGLE
    near.cells((9, 19), (10, 20))
    near.tools.tool = Tool.LINE
    near.cells((4, 15), (8, 15))
    drawn = near.room.draft
    assert [drawn.tile((5, 18)), drawn.tile((10, 20)), drawn.tile((11, 20)), drawn.tile((8, 15))] == [0, 1, 0, 1]
    near.tools.pick_up(ObjectSpec(GOLD, (36.0, 36.0)))
    near.tools.brush.snap, near.tools.tool = "quarter", Tool.BRUSH
    near.cells((7, 19))
    x, y = middle_of((7, 19))
    near.drag(near.px((x + 31, y + 5)))
    assert points(near.room.draft.objects[-2])[BODY_PART] == (x, y)
    assert points(near.room.draft.objects[-1])[BODY_PART] == (x + 30, y + 6)
    assert near.is_as_drawn_at_once()


def test_what_is_selected_is_dragged_and_pasted(near: Looker) -> None:
    near.tools.tool = Tool.SELECT
    ninja = points(near.room.draft.objects[0])[BODY_PART]
    near.drag(near.px(ninja), near.px((ninja[0] + 72, ninja[1])))
    assert points(near.room.draft.objects[0])[BODY_PART] == (ninja[0] + 72, ninja[1])
    near.drag(near.px((40, 555)), near.px((90, 570)))
    assert near.tools.selection.area == (1, 23, 3, 1)
    near.room.chord("c", pygame.KMOD_LCTRL)
    near.room.chord("v", pygame.KMOD_LCTRL)
    near.event(pygame.MOUSEMOTION, near.px(middle_of((6, 16))))
    assert near.tools.ghost is not None
    near.cells((6, 16))
    assert [near.room.draft.tile((column, 16)) for column in range(4, 9)].count(1) == 3
    assert near.is_as_drawn_at_once()


def test_the_middle_button_drags_the_level_and_picks_where_it_stays(near: Looker) -> None:
    near.tools.pick_up(0)
    at, under = near.px(middle_of((5, 23))), middle_of((5, 23))
    near.drag(at, (at[0] + 1, at[1]), button=2)
    assert near.tools.brush.tile == 1, "a hand trembles"
    near.tools.pick_up(0)
    centre = near.view.camera.centre
    near.drag(at, (at[0] - 60, at[1] - 30), (at[0] - 80, at[1] - 40), button=2)
    assert near.tools.brush.tile == 0
    assert near.view.camera.centre[0] > centre[0]
    assert near.px(under)[0] == pytest.approx(at[0] - 80, abs=1)
    assert near.tools.cell[0] == 5
    assert near.is_as_drawn_at_once()
    near.event(pygame.MOUSEBUTTONDOWN, at, 2)
    near.room.press("f5", "escape")
    centre = near.view.camera.centre
    near.event(pygame.MOUSEMOTION, (at[0] + 50, at[1]))
    assert near.view.camera.centre == centre, "it was let go elsewhere"


def test_what_is_dragged_beyond_an_edge_takes_the_level_along(near: Looker) -> None:
    near.tools.tool = Tool.RECTANGLE
    start, area = near.px(middle_of((8, 19))), near.view.overlay.area
    near.event(pygame.MOUSEMOTION, start)
    near.event(pygame.MOUSEBUTTONDOWN, start, 1)
    beyond = area.right + 20, start[1]
    near.event(pygame.MOUSEMOTION, beyond, held=1)
    near.room.frames(200)
    near.event(pygame.MOUSEBUTTONUP, beyond, 1)
    assert near.view.camera.centre[0] == pytest.approx(594, abs=1)
    assert [near.room.draft.tile((column, 19)) for column in (7, 8, 20, 31)] == [0, 1, 1, 1]
    centre = near.view.camera.centre
    near.event(pygame.MOUSEMOTION, (area.left - 4, start[1]))
    near.room.frames(20)
    assert near.view.camera.centre == centre, "nothing is dragged"


def test_keys_findings_and_the_list_bring_into_the_picture_what_they_are_about(near: Looker) -> None:
    view = near.view
    for _ in range(20):
        near.room.press("right")
        assert view.overlay.area.collidepoint(near.px(near.tools.pointer))
    assert view.camera.centre[0] > 400
    listed = near.room.editor.sides[1]
    near.room.press("f3")
    listed.update(0)
    listed._choose(0)  # type: ignore[attr-defined]
    near.room.frames(1)
    assert view.overlay.area.collidepoint(near.px(points(near.room.draft.objects[0])[BODY_PART]))


def test_a_level_that_is_moved_keeps_what_was_drawn_and_draws_the_rest(near: Looker) -> None:
    view = near.view
    painted: list[pygame.Rect] = []
    paint = view.sheet._repaint_area

    def noted(flat: pygame.Rect) -> None:
        painted.append(flat)
        paint(flat)

    view.sheet._repaint_area = noted  # type: ignore[method-assign]
    view.camera.move(view.overlay.area.size, -9, 6)
    near.room.frames(1)
    assert sum(area.width * area.height for area in painted) < 0.05 * near.view.overlay.area.width**2
    assert near.is_as_drawn_at_once()


def test_a_path_is_seen_wherever_the_level_was_enlarged(near: Looker) -> None:
    near.view.camera.move(near.view.overlay.area.size, -900, -900)
    near.room.editor.session.edited.playtests.last_route = tuple((700.0 - k, 560.0) for k in range(200))
    near.view.repaint()
    near.room.frames(1)
    assert near.room.app.surface.get_at(near.px((650, 560)))[:3] == near.room.app.theme.palette.ghost[:3]


@pytest.mark.parametrize(
    "name, across, down",
    [
        ("off", [], []),
        ("4 cells", [120, 216, 312, 396, 408, 504, 600, 696], [120, 216, 300, 312, 408, 504]),
        ("4 cells + 1/2", [36, 132, 228, 324, 396, 420, 516, 612, 708], [36, 132, 228, 300, 324, 420, 516]),
        ("level / 4", [210, 396, 582], [162, 300, 438]),
    ],
)
def test_lines_of_a_grid(name: str, across: list[float], down: list[float]) -> None:
    (grid,) = (grid for grid in GRIDS if grid.name == name)
    assert [sorted(at for upright, at, _ in grid.lines() if upright is way) for way in (True, False)] == [across, down]


def test_a_line_over_the_level_covers_little_more_than_itself() -> None:
    canvas, black, ends = Canvas((792, 600)), (0, 0, 0), ((100.0, 500.0), (160.0, 520.0))
    for mark in (route_mark(canvas, black, ends), line_mark(canvas, black, ends[0], ends[1])):
        assert pygame.Rect(100, 500, 60, 20).inflate(24, 24).contains(mark.rects[0].unionall(mark.rects[1:]))


@pytest.mark.parametrize("zoom", [2, 4])
def test_all_that_lies_over_the_level_is_repaired_wherever_it_was_moved_to(
    room: Maker, zoom: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    gold = tuple(ObjectSpec(GOLD, (30.0 + 37 * k % 730, 30.0 + 53 * k % 540)) for k in range(60))
    door = ObjectSpec(9, (400.0, 400.0, 0.0, 0.0, 20.0, 15.0, 1.0, 0.0, 0.0))
    drawn = with_stamp(ROOM, Stamp({(column, 12): 1 + column for column in range(1, 30)}, (*gold, door)))
    room.editor.session.begin(Source(drawn))
    room.frames(2)
    near = Looker(room)
    near.view.show_grid(GRIDS[3])
    near.tools.brush.symmetry = "both"
    room.editor.session.edited.playtests.last_route = tuple((60.0 + k, 500.0 - k / 3) for k in range(400))
    if zoom == 4:
        near.view.zoom(1)
    # Signs come when the level has been examined.
    monkeypatch.setattr("ninja_game.play.editor.view.finding_points", lambda *_: [])
    area = near.view.overlay.area
    for step in ((-200, 90), (-333, 41), (120, -60), (-5000, -5000)):
        near.view.camera.move(area.size, *step)
        near.room.frames(1)
        near.drag(area.center, area.midright)
        assert near.is_as_drawn_at_once(), step


@pytest.mark.parametrize("name", [name for name in SYMMETRIES if name != "off"])
def test_the_lines_of_a_symmetry_are_alike_under_it(name: str) -> None:
    lines = {frozenset(line) for line in SYMMETRY_AXES[name]}
    assert all(len(line) == 2 for line in lines)
    for motion in SYMMETRIES[name]:
        assert {frozenset(motion.point(*end) for end in line) for line in lines} == lines
