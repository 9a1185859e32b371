"""The tools by presses, moves and releases: what a hand at the mouse does, without a window."""

from itertools import pairwise
from pathlib import Path
from unittest.mock import patch

import pytest

from ninja_game.document import History
from ninja_game.editor import stamp
from ninja_game.editor.brush import Tool
from ninja_game.editor.draft import Draft, changed_cells
from ninja_game.editor.files import open_source
from ninja_game.editor.motion import CLOCKWISE, MIRROR
from ninja_game.editor.palette import (
    FAMILIES,
    OBJECT_TYPES,
    TILE_KEYS,
    object_of_type,
    object_type_of,
    placed,
    snapped,
    tile_name,
)
from ninja_game.editor.shapes import covered, rounded
from ninja_game.editor.specs import points, word
from ninja_game.editor.stamp import Selection, chosen_in
from ninja_game.editor.tools import EditorTools
from ninja_game.formats.ascii.legend import TILE_CHARS
from ninja_game.formats.ascii.writer import best_form
from ninja_game.sim import kinds
from ninja_game.sim.grid import cell_of, is_inside
from ninja_game.sim.level import Level


@pytest.fixture(name="tools")
def empty_tools() -> EditorTools:
    made = EditorTools(Draft(Level()))
    made.brush.snap = "half"
    return made


def drag(tools: EditorTools, *places: tuple[float, float], **how: bool) -> None:
    tools.move(*places[0])
    tools.press(**how)
    for place in places[1:]:
        tools.move(*place)
    tools.release()


def pending(tools: EditorTools) -> bool:
    """Whether a switch is still to be placed, for a type checker that thinks it cannot change."""
    return tools.placing_switch


def forms(tools: EditorTools) -> list[str]:
    return [" ".join(best_form(spec)).strip() for spec in tools.draft.objects]


def test_a_dragged_brush_draws_every_cell_on_its_way_and_one_undo_takes_it_back(tools: EditorTools) -> None:
    drag(tools, (36, 36), (300, 36), (300, 100))
    assert [tools.draft.tile((column, 1)) for column in range(1, 14)] == [1] * 12 + [0]
    drag(tools, (36, 36), (100, 36), erase=True)
    assert tools.draft.tile((2, 1)) == 0
    tools.undo()
    tools.undo()
    assert tools.draft == Draft(Level())
    tools.redo()
    assert tools.draft.tile((2, 1)) == 1
    tools.move(-5, -5)
    assert tools.pointer == (0, 0)


def test_a_rectangle_shrinks_while_it_is_drawn(tools: EditorTools) -> None:
    tools.tool = Tool.RECTANGLE
    drag(tools, (36, 36), (300, 300), (84, 60))
    assert sum(tools.draft.level.tiles) == 3 * 2
    tools.pick_up(object_of_type("gold"))
    drag(tools, (120, 120), (180, 150))
    assert len(tools.draft.objects) == 6 * 3
    tools.undo()
    assert not tools.draft.objects


def test_fill_takes_one_press(tools: EditorTools) -> None:
    tools.tool = Tool.FILL
    drag(tools, (300, 300))
    assert set(tools.draft.level.tiles) == {1}


def test_fill_puts_an_object_into_each_cell_that_is_joined_and_alike(tools: EditorTools) -> None:
    tools.tool = Tool.RECTANGLE
    drag(tools, (24, 24), (96, 96))
    tools.pick_up(0)
    drag(tools, (48, 48), (72, 72))
    tools.tool = Tool.FILL
    tools.pick_up(object_of_type("gold"))
    drag(tools, (60, 60))
    assert len(tools.draft.objects) == 4
    assert {spec.values[:2] for spec in tools.draft.objects} == {(x, y) for x in (60.0, 84.0) for y in (60.0, 84.0)}
    tools.undo()
    assert not tools.draft.objects


@pytest.mark.parametrize("tool", [Tool.BRUSH, Tool.RECTANGLE, Tool.FILL])
@pytest.mark.parametrize("name", ["locked door", "trap door", "exit"])
def test_what_has_a_switch_takes_two_presses_or_one_drag(tools: EditorTools, name: str, tool: Tool) -> None:
    tools.tool = tool
    tools.pick_up(object_of_type(name))
    drag(tools, (238, 300))
    assert pending(tools)
    tools.move(400, 200)
    drag(tools, (420, 204))
    assert not pending(tools)
    drag(tools, (238, 400), (300, 420), (420, 480))
    first, second = tools.draft.objects
    assert points(first)[1] == (420.0, 204.0)
    assert points(second)[1] == (420.0, 480.0)
    tools.undo()
    assert len(tools.draft.objects) == 1
    drag(tools, (238, 500))
    tools.move(500, 500)
    assert tools.cancel()
    assert len(tools.draft.objects) == 1
    assert not tools.cancel()
    drag(tools, (238, 500))
    tools.pick_up(object_of_type("gold"))
    assert not pending(tools), "the next press puts what was taken"


def test_a_pick_while_a_switch_is_to_be_placed_changes_nothing(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("exit"))
    drag(tools, (238, 300))
    drag(tools, (300, 300), pick=True)
    assert pending(tools)
    tools.move(360, 300)
    drag(tools, (420, 204))
    assert len(tools.draft.objects) == 1, "it is still one edit"
    assert tools.undo()
    assert not tools.draft.objects


def test_doors_go_to_the_nearest_side_and_the_rest_where_it_sits_in_a_cell(tools: EditorTools) -> None:
    tools.brush.snap = "cell"
    for name, at in (("automatic door", (262, 262)), ("launch pad", (300, 300)), ("floor guard", (350, 350)),
                     ("zap drone", (391, 402)), ("gold", (431, 431))):  # fmt: skip
        tools.pick_up(object_of_type(name))
        drag(tools, at)
    assert forms(tools) == [
        "automatic door 10,10 right", "launch pad 12,12 up", "floor guard 14,14",
        "zap drone 16,16 surface-cw right", "gold 17,17",
    ]  # fmt: skip
    tools.brush.snap = "px"
    drag(tools, (433.2, 420.7))
    assert tools.draft.objects[-1].values == (433.0, 421.0)


def test_a_door_in_a_gap_closes_it(tools: EditorTools) -> None:
    walls = dict.fromkeys([(10, 9), (10, 11), (19, 15), (21, 15), (4, 4), (4, 6), (3, 5), (5, 5)], 1)
    tools.history.change(tools.draft.with_tiles(walls))
    tools.pick_up(object_of_type("automatic door"))
    places = (251, 242), (254, 262), (252, 252), (482, 371), (503, 383), (492, 372), (108, 124), (360, 482)
    sides = [word(tools.placed(*at), "side") for at in places]
    assert sides == ["left", "right", "right", "top", "bottom", "top", "top", "left"]


def test_there_is_one_ninja_and_a_second_press_moves_it(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("gold"))
    drag(tools, (100, 100))
    tools.pick_up(object_of_type("ninja"))
    drag(tools, (100, 200))
    drag(tools, (204, 204))
    assert [spec.kind for spec in tools.draft.objects] == [kinds.NINJA, kinds.GOLD]
    assert tools.draft.objects[0].values == (204.0, 204.0)


def test_what_is_selected_moves_turns_copies_and_goes(tools: EditorTools) -> None:
    tools.pick_up(2)
    drag(tools, (60, 60))
    tools.pick_up(object_of_type("thwump"))
    drag(tools, (84, 60))
    tools.tool = Tool.SELECT
    drag(tools, (50, 50), (100, 70))
    assert tools.selection == Selection((2, 2, 3, 1), frozenset({(0, 0)}))
    drag(tools, (60, 60), (60, 90), (60, 108))
    assert (tools.draft.tile((2, 4)), tools.draft.tile((2, 2))) == (2, 0)
    assert tools.draft.objects[0].values[:2] == (84.0, 108.0)
    tools.turn(MIRROR)
    assert tools.draft.tile((4, 4)) == MIRROR.tile(2)
    tools.turn(MIRROR)
    assert tools.copy()
    tools.move(300, 300)
    before = tools.draft
    assert tools.paste()
    assert tools.draft is before, "it follows the pointer"
    assert tools.cancel()
    assert tools.ghost is None
    assert tools.paste()
    assert tools.undo()
    assert (tools.ghost, tools.draft) == (None, before), "only what hangs at the pointer is removed"
    assert tools.paste()
    drag(tools, (300, 300))
    assert tools.draft.tile((11, 12)) == 2
    assert tools.draft.objects[1].values[:2] == (300.0, 300.0)
    tools.selected.nudge(0, 1)
    assert tools.draft.tile((11, 13)) == 2
    tools.turn(CLOCKWISE)
    tools.delete()
    assert tools.draft.tile((2, 4)) == 2
    assert len(tools.draft.objects) == 1
    while tools.undo():
        pass
    assert tools.draft == Draft(Level())


@pytest.mark.parametrize("area", [(5, 5, 2, 1), (5, 5, 1, 2), (5, 5, 3, 4), (5, 5, 2, 2), None])
@pytest.mark.parametrize("name", ["gold", "trap door"])
def test_four_turns_are_none(area: tuple[int, int, int, int] | None, name: str) -> None:
    tools = EditorTools(Draft(Level()).with_tiles({(5, 5): 7}))
    for snap, x, y in (("cell", 132, 132), ("half", 150, 140), ("quarter", 162, 135)):
        tools.brush.snap = snap
        tools.pick_up(object_of_type(name))
        drag(tools, (x, y), (x + 20, y))
        tools.finish()
        tools.selection = Selection(area, chosen_in(tools.draft, (1, 1, 31, 23)).parts)
        first, chosen, seen = tools.draft, tools.selection, set()
        for _ in range(4):
            tools.turn(CLOCKWISE)
            seen.add(repr(tools.draft.objects))
        assert (tools.draft, tools.selection) == (first, chosen)
        assert len(seen) > 1


def test_shift_adds_to_a_selection_and_takes_away_again(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("mine"))
    for x in (100, 200, 300):
        drag(tools, (x, 100))
    tools.tool = Tool.SELECT
    drag(tools, (96, 96))
    drag(tools, (204, 96), add=True)
    drag(tools, (300, 96), add=True)
    assert len(tools.selection.parts) == 3
    drag(tools, (204, 96), add=True)
    assert len(tools.selection.parts) == 2
    drag(tools, (600, 500))
    assert not tools.selection


def test_properties_belong_to_what_is_selected_or_to_the_brush(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("one-way"))
    tools.brush.spec = placed(tools.brush.spec, 36, 36, "cell")._replace(values=(36.0, 36.0, 2.0))
    assert word(tools.brush.spec, "direction") == "left"
    drag(tools, (300, 300))
    tools.tool = Tool.SELECT
    drag(tools, (300, 300))
    assert tools.selected.chosen is not None
    tools.selected.change_each(lambda spec: spec._replace(values=(300.0, 300.0, 1.0)))
    assert word(tools.draft.objects[0], "direction") == "down"
    assert word(tools.brush.spec, "direction") == "left"


def test_pick_takes_objects_before_tiles(tools: EditorTools) -> None:
    tools.pick_up(7)
    drag(tools, (300, 300))
    tools.pick_up(object_of_type("mine"))
    drag(tools, (300, 300))
    tools.tool = Tool.PICK
    tools.pick_up(1)
    drag(tools, (303, 300), pick=True)
    assert object_type_of(tools.brush.spec) == "mine"
    tools.delete()
    assert forms(tools) == []
    drag(tools, (303, 300), pick=True)
    assert (tools.brush.draws_objects, tools.brush.tile) == (False, 7)


def test_a_symmetric_stroke_is_erased_symmetrically(tools: EditorTools) -> None:
    tools.brush.symmetry = "both"
    tools.pick_up(object_of_type("gold"))
    drag(tools, (100, 100))
    assert len(tools.draft.objects) == 4
    drag(tools, (100, 100), erase=True)
    assert forms(tools) == []
    drag(tools, (100, 100))
    tools.delete()
    assert forms(tools) == []
    tools.undo()
    assert len(tools.draft.objects) == 4, "one step for all images"
    tools.delete()
    tools.pick_up(3)
    drag(tools, (100, 100))
    assert len(forms(tools)) + sum(map(bool, tools.draft.level.tiles)) == 4


def test_every_type_can_be_placed_and_every_tile_has_a_name_and_a_key(tools: EditorTools) -> None:
    for number, each in enumerate(OBJECT_TYPES):
        assert object_type_of(each.spec) == each.name
        tools.pick_up(each.spec)
        drag(tools, (60 + 36 * number, 300))
        if tools.placing_switch:
            drag(tools, (60 + 36 * number, 340))
    assert len(tools.draft.objects) == len(OBJECT_TYPES)
    assert len({family.key for family in FAMILIES} | {*TILE_KEYS.values()}) == len(FAMILIES) + 2
    assert not [tile for tile in range(34) if tile_name(tile).startswith("odd")]
    assert sorted(tile for family in FAMILIES for tile in family.tiles) == list(range(2, 34))


def test_snaps() -> None:
    assert snapped(37, 59, "cell") == (36, 60)
    assert snapped(37, 59, "half") == (36, 60)
    assert snapped(40, 57, "quarter") == (42, 60)
    assert snapped(40.4, 57.6, "px") == (40, 58)


def test_gold_lies_evenly_along_a_line_that_the_wheel_bends(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("gold"))
    tools.tool, tools.brush.spacing = Tool.LINE, 36.0
    drag(tools, (60, 300), (276, 300))
    assert [spec.values for spec in tools.draft.objects] == [(60.0 + 36 * k, 300.0) for k in range(7)]
    tools.undo()
    tools.move(60, 300)
    tools.press()
    tools.move(276, 300)
    assert tools.bend(-4)
    places = [spec.values for spec in tools.draft.objects]
    assert (places[0], places[-1]) == ((60.0, 300.0), (276.0, 300.0))
    assert 252 <= min(y for _, y in places) <= 254, "four steps to the left of its way: 48 px above"
    gaps = [((ax - bx) ** 2 + (ay - by) ** 2) ** 0.5 for (ax, ay), (bx, by) in pairwise(places)]
    assert max(gaps) - min(gaps) < 3
    tools.release()
    assert not tools.bend(1), "nothing is being drawn"
    tools.undo()
    assert not tools.draft.objects, "one drag is undone at once"


def test_an_ellipse_is_full_of_tiles_and_has_objects_along_it(tools: EditorTools) -> None:
    tools.tool = Tool.ELLIPSE
    drag(tools, (36, 36), (132, 132))
    rows = ["".join(str(tools.draft.tile((column, row))) for column in range(1, 6)) for row in range(1, 6)]
    assert rows == ["01110", "11111", "11111", "11111", "01110"]
    tools.pick_up(object_of_type("mine"))
    drag(tools, (300, 300), (420, 420))
    assert len(tools.draft.objects) == round(120 * 3.1416 / 24)
    assert all(58.9 < ((x - 360) ** 2 + (y - 360) ** 2) ** 0.5 < 61 for x, y in (s.values for s in tools.draft.objects))
    tools.undo()
    drag(tools, (300, 300))
    assert len(tools.draft.objects) == 1, "a click is an ellipse of no size"


def picture(tools: EditorTools, columns: range, rows: range) -> list[str]:
    return ["".join(TILE_CHARS[tools.draft.tile((column, row))] for column in columns) for row in rows]


def test_slopes_set_themselves_on_steps_and_corners(tools: EditorTools) -> None:
    tools.brush.slopes = True
    tools.tool = Tool.RECTANGLE
    drag(tools, (60, 60), (156, 132))
    assert picture(tools, range(1, 8), range(2, 6)) == [".#####."] * 4, "a box has corners"
    assert not tools.sets_slopes
    tools.tool = Tool.LINE
    drag(tools, (372, 564), (756, 564))
    for left, row in ((16, 22), (18, 21), (19, 20), (20, 19), (20, 18), (21, 17)):
        drag(tools, (24 * left + 12, 24 * row + 12), (732, 24 * row + 12))
    hill = ["......fF###", ".....s#####", ".....######", "....s######", "...s#######", ".fF########", "s##########"]
    assert picture(tools, range(15, 26), range(17, 24)) == hill
    tools.brush.tile = 0
    for row in range(4):
        drag(tools, (588, 420 + 24 * row), (660, 420 + 24 * row))
    assert picture(tools, range(15, 26), range(17, 24))[:2] == ["......fFa..", ".....s###.."]
    for _ in range(4):
        tools.undo()
    assert picture(tools, range(15, 26), range(17, 24)) == hill


_UP = ["....#", "...sq", "..sq.", ".sq..", "#q..."]


@pytest.mark.parametrize(
    "ends, rows",
    [
        ((60, 60, 156, 156), ["#....", "wa...", ".wa..", "..wa.", "...w#"]),
        ((60, 156, 156, 60), _UP),
        ((156, 60, 60, 156), _UP),
    ],
)
def test_a_quick_freehand_diagonal_is_one_band_with_slopes(
    tools: EditorTools, ends: tuple[int, int, int, int], rows: list[str]
) -> None:
    tools.brush.slopes = True
    ax, ay, bx, by = ends
    # At every move of the mouse a cell on and a cell up or down.
    drag(tools, *((ax + (bx - ax) * k / 4, ay + (by - ay) * k / 4) for k in range(5)))
    assert picture(tools, range(2, 7), range(2, 7)) == rows


@pytest.mark.parametrize("tool", [Tool.BRUSH, Tool.LINE])
@pytest.mark.parametrize(
    "tile, full",
    [
        (3, {(3, 6), (4, 5), (5, 4)}),
        (5, {(2, 5), (3, 4), (4, 3)}),
        (7, {(3, 6), (4, 5), (5, 4)}),
        (2, set()),
        (15, {(3, 6), (4, 5), (5, 4)}),
        (31, set()),
    ],
)
def test_slopes_drawn_along_their_line_have_no_notch_behind_them(
    tools: EditorTools, tool: Tool, tile: int, full: set[tuple[int, int]]
) -> None:
    before = tools.draft
    for slopes, notches in ((True, full), (False, set())):
        tools.brush.slopes, tools.brush.tile, tools.tool = slopes, tile, tool
        drag(tools, *((24 * k + 12, 24 * (8 - k) + 12) for k in range(2, 6)))
        drawn = {cell: tools.draft.tile(cell) for cell in changed_cells(before, tools.draft)}
        assert drawn == dict.fromkeys(notches, 1) | {(k, 8 - k): tile for k in range(2, 6)}
        tools.undo()
    tools.history.change(before.with_tiles(dict.fromkeys(full, 9)))
    tools.brush.slopes = True
    drag(tools, *((24 * k + 12, 24 * (8 - k) + 12) for k in range(2, 6)))
    assert {tools.draft.tile(cell) for cell in full} <= {9}, "what is there stays"


def test_slopes_that_nobody_touched_stay_as_they_are(root: Path) -> None:
    level = open_source(root / "levels" / "00-1-mind-the-gap.txt").draft
    for tool, tile, ends in (
        (Tool.LINE, 1, ((108, 228), (180, 228))),
        (Tool.BRUSH, 0, ((300, 300),)),
        (Tool.BRUSH, 1, ((132, 276),)),
    ):
        tools = EditorTools(level)
        tools.brush.slopes, tools.tool, tools.brush.tile = True, tool, tile
        drag(tools, *ends)
        drawn = covered("line", cell_of(*ends[0]), cell_of(*ends[-1]), 0.0)
        changed = changed_cells(level, tools.draft)
        assert changed
        assert all(min(max(abs(x - a), abs(y - b)) for a, b in drawn) <= 1 for x, y in changed), changed


def test_both_halves_of_a_slope_of_two_tiles_change_together(tools: EditorTools) -> None:
    tools.brush.slopes, tools.tool = True, Tool.LINE
    drag(tools, (60, 564), (756, 564))
    drag(tools, (156, 540), (756, 540))
    assert picture(tools, range(4, 10), range(22, 23)) == ["..fF##"]
    drag(tools, (132, 540), (132, 540))
    assert picture(tools, range(4, 10), range(22, 23)) == [".fF###"], "no dent stays"


def test_a_line_that_slants_is_a_ramp_where_slopes_set_themselves(tools: EditorTools) -> None:
    tools.tool = Tool.LINE
    ends = (60, 180), (132, 108)
    drag(tools, *ends)
    assert picture(tools, range(2, 6), range(4, 9)) == ["...#", "..#.", ".#..", "#...", "...."]
    tools.undo()
    tools.brush.slopes = True
    drag(tools, *ends)
    assert picture(tools, range(2, 6), range(4, 9)) == ["...s", "..sq", ".sq.", "sq..", "q..."]
    tools.undo()
    drag(tools, (60, 60), (252, 132))
    gentle = ["Dd.......", "rR#Dd....", "...rR#Dd.", "......rR#", "........."]
    assert picture(tools, range(2, 11), range(2, 7)) == gentle, "22°"
    tools.undo()
    drag(tools, (60, 60), (180, 132))
    assert picture(tools, range(2, 8), range(2, 7)) == ["a.....", "wDd...", ".rRa..", "...wDd", "....rR"]
    clean = ["Dd......", "rRDd....", "..rRDd..", "....rRDd", "......rR"]
    for start, end, columns, rows, there in (
        ((60, 60), (228, 132), range(2, 10), range(2, 7), clean),
        ((60, 60), (252, 156), range(2, 11), range(2, 7), [*(row + "." for row in clean[:4]), "......rR#"]),
        ((228, 60), (60, 132), range(2, 10), range(2, 7), ["......fF", "....fFEe", "..fFEe..", "fFEe....", "Ee......"]),
        ((60, 60), (84, 132), range(2, 5), range(2, 6), ["Yg.", "yG.", ".Yg", ".yG"]),
        ((84, 60), (60, 132), range(2, 5), range(2, 6), [".hT", ".Ht", "hT.", "Ht."]),
    ):
        tools.undo()
        drag(tools, start, end)
        assert picture(tools, columns, rows) == there, "clean ends"
        before = tools.draft
        drag(tools, end, start)
        assert tools.draft.level == before.level, "from either end; its slopes remove no tiles"


def test_an_ellipse_is_round_where_slopes_set_themselves(tools: EditorTools) -> None:
    tools.brush.slopes, tools.tool = True, Tool.ELLIPSE
    drag(tools, (60, 60), (324, 324))
    upper = ["...fF##Dd...", "..s######a..", ".s########a.", "h##########g", "H##########G", "############"]
    assert picture(tools, range(2, 14), range(2, 8)) == upper
    tools.undo()
    drag(tools, (60, 60), (108, 108))
    assert picture(tools, range(2, 5), range(2, 5)) == ["K#J", "###", "I#U"], "round curves"
    tools.undo()
    drag(tools, (60, 60), (204, 204))
    upper = [".fF#Dd.", "h#####g", "H#####G", "#######"]
    assert picture(tools, range(2, 9), range(2, 6)) == upper, "no cut diamond"
    tools.undo()
    tools.tool = Tool.LINE
    drag(tools, (36, 132), (204, 132))
    tools.tool = Tool.ELLIPSE
    drag(tools, (60, 60), (132, 132))
    assert all(tools.draft.tile((column, 5)) for column in range(2, 6))
    for size in ((5, 4), (20, 8), (17, 17), (31, 23)):
        round_ = rounded(*size)
        mirrored = {(size[0] - 1 - i, j): MIRROR.tile(tile) for (i, j), tile in round_.items()}
        assert mirrored == round_
        gentle = {cell for cell, tile in round_.items() if TILE_CHARS[tile] == "f"}
        assert {(i + 1, j) for i, j in gentle} == {cell for cell, tile in round_.items() if TILE_CHARS[tile] == "F"}


@pytest.mark.parametrize("corner", [(0, 0), (791, 0), (0, 599), (791, 599)])
def test_what_is_pasted_stays_in_the_level(tools: EditorTools, corner: tuple[float, float]) -> None:
    for name, x in (("mine", 300), ("gold", 372)):
        tools.pick_up(object_of_type(name))
        drag(tools, (x, 300))
    for area in ((12, 12, 5, 2), None):
        tools.selection = Selection(area, chosen_in(tools.draft, (1, 1, 31, 23)).parts)
        tools.copy()
        tools.move(*corner)
        tools.paste()
        stamp = tools.pasted
        assert stamp
        assert all(is_inside(cell) for cell in stamp.tiles)
        assert all(is_inside(cell_of(*spec.values[:2])) for spec in stamp.objects)
        tools.cancel()


def test_what_would_leave_the_level_stays_where_it_is(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("gold"))
    drag(tools, (36, 300))
    tools.choose(frozenset({(0, 0)}))
    assert [tools.selected.shift(dx, 0) for dx in (-24, 720, 24)] == [False, True, False]
    assert tools.draft.objects[0].values[0] == 756


def test_undo_keeps_selected_what_is_still_there(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("gold"))
    for x in (100, 200, 300):
        drag(tools, (x, 100))
    chosen = frozenset({(0, 0), (2, 0)})
    tools.choose(chosen)
    tools.selected.arrange(1, 0.0)
    tools.selected.nudge(0, 1)
    assert tools.undo()
    assert tools.selection.parts == chosen
    assert tools.redo()
    assert tools.selection.parts == chosen
    tools.delete()
    tools.choose(frozenset({(0, 0)}))
    assert tools.undo()
    assert not tools.selection, "other objects have the numbers now"


def test_what_is_pasted_can_be_mirrored_and_turned_in_hand(tools: EditorTools) -> None:
    drag(tools, (36, 36), (60, 36))
    tools.pick_up(object_of_type("gold"))
    drag(tools, (84, 36))
    tools.selection = Selection((1, 1, 3, 1), frozenset({(0, 0)}))
    tools.copy()
    for motion, tiles, gold in ((MIRROR, {(11, 10), (12, 10)}, (10, 10)), (CLOCKWISE, {(11, 9), (11, 10)}, (11, 11))):
        tools.move(11 * 24 + 12, 10 * 24 + 12)
        tools.paste()
        assert tools.turn(motion)
        assert tools.ghost, "it still hangs at the pointer"
        drag(tools, tools.pointer)
        drawn = {(x, y) for x in range(2, 32) for y in range(2, 24) if tools.draft.tile((x, y))}
        assert drawn == tiles
        assert cell_of(*tools.draft.objects[-1].values[:2]) == gold
        tools.undo()


def test_the_tool_select_drags_a_message_in_one_edit(tools: EditorTools) -> None:
    tools.load(History(Draft(Level(), says="start: Go | at 12,5: Jump: here")))
    tools.tool = Tool.SELECT
    drag(tools, (12 * 24 + 3, 5 * 24 + 3), (400, 300), (20 * 24 + 3, 6 * 24 + 3), (2, 2))
    assert tools.draft.says == "start: Go | at 20,6: Jump: here", "the border is no place for it"
    tools.undo()
    assert tools.draft.says == "start: Go | at 12,5: Jump: here"
    tools.tool = Tool.BRUSH
    drag(tools, (12 * 24 + 3, 5 * 24 + 3), (400, 300))
    assert tools.draft.says == "start: Go | at 12,5: Jump: here"


def test_a_chosen_side_of_a_door_wins_over_the_pointer(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("automatic door"))
    tools.selected.put_word("side", "bottom")
    drag(tools, (241, 250))
    assert word(tools.draft.objects[-1], "side") == "bottom"
    tools.selected.put_word("side", "nearest")
    drag(tools, (289, 300))
    assert word(tools.draft.objects[-1], "side") == "left"


def test_the_preview_of_a_press_shows_the_slopes_too(tools: EditorTools) -> None:
    tools.brush.slopes = True
    drag(tools, (372, 564), (756, 564))
    tools.move(468, 540)
    shown = tools.preview
    before = tools.draft
    drag(tools, (468, 540))
    assert shown == {cell: tools.draft.tile(cell) for cell in changed_cells(before, tools.draft)}
    tools.move(492, 540)
    assert tools.preview == {(19, 22): TILE_CHARS.index("s"), (20, 22): TILE_CHARS.index("a")}
    tools.brush.slopes = False
    assert tools.preview == {(20, 22): 1}


def test_the_preview_of_a_fill_is_made_once_while_the_pointer_stays_in_its_cell(tools: EditorTools) -> None:
    tools.tool = Tool.FILL
    with patch.object(stamp, "filled", wraps=stamp.filled) as flooded:
        for x in range(360, 384, 3):
            tools.move(x, 300)
            assert len(tools.preview) == 713
        assert flooded.call_count == 1
        tools.pick_up(0)
        assert not tools.preview
        drag(tools, (370, 300))
        tools.pick_up(1)
        tools.move(390, 300)
        assert len(tools.preview) == 713


def test_chosen_objects_move_in_the_order_with_their_selection(tools: EditorTools) -> None:
    for x in (36, 60, 84, 108):
        tools.pick_up(object_of_type("mine"))
        drag(tools, (x, 36))
    tools.choose(frozenset({(1, 0), (3, 0)}))
    tools.selected.reorder(-1)
    assert [spec.values[0] for spec in tools.draft.objects] == [60, 108, 36, 84]
    assert tools.selection.parts == {(0, 0), (1, 0)}
    tools.selected.reorder(1)
    assert [spec.values[0] for spec in tools.draft.objects] == [36, 60, 108, 84]
    tools.selected.reorder(-9999)
    assert [spec.values[0] for spec in tools.draft.objects] == [60, 108, 36, 84]
    tools.selected.reorder(9999)
    assert [spec.values[0] for spec in tools.draft.objects] == [36, 84, 60, 108]


def test_the_right_button_gives_up_the_selection_and_deletes_nothing_in_select(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("gold"))
    drag(tools, (100, 100))
    before, tools.tool = tools.draft, Tool.SELECT
    drag(tools, (100, 100))
    assert tools.selection
    drag(tools, (100, 100), erase=True)
    drag(tools, (100, 100), erase=True)
    assert (tools.draft, tools.selection, tools.tool) == (before, Selection(), Tool.SELECT)
    drag(tools, (100, 100))
    tools.delete()
    assert not forms(tools)


def test_a_paste_is_exact_also_where_slopes_set_themselves(tools: EditorTools) -> None:
    slope, half = TILE_CHARS.index("s"), FAMILIES[4].tiles[3]
    row = {(5 + k, 20): tile for k, tile in enumerate((slope, 1, 1, half, 0))}
    tools.history.change(tools.draft.with_tiles({(column, 12): 1 for column in range(5, 20)} | row))
    tools.brush.slopes, tools.selection = True, Selection((5, 20, 5, 1))
    tools.copy()
    tools.paste()
    drag(tools, (24 * 11 + 12.0, 24 * 11 + 12.0))
    after = tools.draft
    assert [tools.draft.tile((column, 11)) for column in range(9, 14)] == list(row.values())
    tools.undo()
    assert {cell[1] for cell in changed_cells(after, tools.draft)} == {11}, "nothing round it becomes another tile"


def test_a_copied_piece_of_the_border_pastes_nothing(tools: EditorTools) -> None:
    tools.selection = Selection((0, 0, 1, 3))
    before = tools.draft
    assert tools.copy()
    assert tools.paste()
    tools.press()
    assert tools.draft == before
    assert tools.ghost is None


def test_a_door_that_is_turned_in_hand_keeps_that_side(tools: EditorTools) -> None:
    tools.pick_up(object_of_type("automatic door"))
    tools.move(30.0, 60.0)
    sides = []
    for _ in range(2):
        tools.turn(CLOCKWISE)
        sides.append(word(tools.placed(*tools.pointer), "side"))
    assert len(set(sides)) == 2


def test_select_takes_only_tiles_or_only_objects(tools: EditorTools) -> None:
    drag(tools, (60, 60), (132, 60))
    tools.pick_up(object_of_type("gold"))
    drag(tools, (84, 60))
    drawn = tools.draft
    tools.take("tiles")
    drag(tools, (50, 50), (140, 80))
    assert tools.selection == Selection((2, 2, 4, 2))
    tools.delete()
    assert (sum(tools.draft.level.tiles), tools.draft.objects) == (0, drawn.objects)
    tools.undo()
    drag(tools, (84, 60))
    assert tools.selection == Selection((3, 2, 1, 1)), "a click takes the cell"
    tools.cancel()
    tools.delete()
    assert tools.draft == drawn, "the pointer is on the gold"
    tools.choose_all()
    assert tools.selection.area
    assert not tools.selection.parts
    tools.takes = "both"
    tools.choose_all()
    tools.take("objects")
    assert tools.selection == Selection(parts=frozenset({(0, 0)}))
    drag(tools, (50, 50), (140, 80))
    assert tools.selection == Selection(parts=frozenset({(0, 0)}))
    tools.delete()
    assert (tools.draft.level.tiles, tools.draft.objects) == (drawn.level.tiles, ())


def test_a_drag_can_drag_a_copy(tools: EditorTools) -> None:
    drag(tools, (60, 60), (132, 60))
    tools.pick_up(object_of_type("gold"))
    drag(tools, (84, 84))
    before = tools.draft
    tools.tool = Tool.SELECT
    drag(tools, (50, 50), (140, 90))
    neighbour = (2, 9)
    before = tools.draft.with_tiles({neighbour: 1})
    tools.history.change(before)
    drag(tools, (60, 60), (300, 90), (60, 204), copies=True)
    assert tools.draft.tile(neighbour) == 1, "empty cells of the copy remove nothing"
    assert tools.selection == Selection((2, 8, 4, 2), frozenset({(1, 0)}))
    assert forms(tools) == ["gold 3,3", "gold 3,9"]
    assert [tools.draft.tile((3, row)) for row in (2, 3, 8, 9)] == [1, 0, 1, 0]
    drag(tools, (60, 204), copies=True)
    tools.undo()
    assert tools.draft == before, "a press alone changes nothing"
    for empty in (False, True):
        tools.selection, tools.pastes_empty = Selection((2, 2, 4, 2)), empty
        assert tools.copy()
        assert tools.paste()
        tools.move(84, 216)
        tools.press()
        assert (tools.draft.tile((2, 8)), tools.draft.tile(neighbour)) == (1, not empty)
        tools.undo()
        assert tools.draft == before


def test_a_fill_shows_what_it_would_fill_and_a_frame_how_large_it_is(tools: EditorTools) -> None:
    tools.tool = Tool.RECTANGLE
    tools.move(36, 36)
    tools.press()
    tools.move(100, 60)
    drawn = tools.frame_size
    tools.release()
    assert (drawn, tools.frame_size) == ((4, 2), None)
    tools.tool, tools.brush.tile = Tool.FILL, 6
    tools.move(36, 36)
    assert tools.preview == dict.fromkeys([(column, row) for column in (1, 2, 3, 4) for row in (1, 2)], 6)
