"""The workbench by presses, moves and releases: what a hand at the mouse does, without a window."""

from __future__ import annotations

import pytest

from ninja_game.editor.bench import Bench
from ninja_game.editor.brush import FAMILIES, SORTS, placed, snapped, sort_of, tile_key, tile_name
from ninja_game.editor.draft import Draft
from ninja_game.editor.motion import CLOCKWISE, MIRROR
from ninja_game.editor.records import points, word
from ninja_game.editor.stamp import Selection
from ninja_game.formats.ascii.object_writer import best_form
from ninja_game.sim import kinds
from ninja_game.sim.level import Level, ObjectSpec


@pytest.fixture(name="bench")
def empty_bench() -> Bench:
    made = Bench(Draft(Level()))
    made.snap = "half"
    return made


def sort(name: str) -> ObjectSpec:
    return next(each.record for each in SORTS if each.name == name)


def drag(bench: Bench, *places: tuple[float, float], **how: bool) -> None:
    bench.move(*places[0])
    bench.press(**how)
    for place in places[1:]:
        bench.move(*place)
    bench.release()


def pending(bench: Bench) -> bool:
    """Whether a switch is still to be placed, for a type checker that thinks it cannot change."""
    return bench.placing_switch


def forms(bench: Bench) -> list[str]:
    return [" ".join(best_form(record)).strip() for record in bench.draft.objects]


def test_a_dragged_brush_draws_every_cell_on_its_way_and_one_undo_takes_it_back(bench: Bench) -> None:
    drag(bench, (36, 36), (300, 36), (300, 100))
    assert [bench.draft.tile((column, 1)) for column in range(1, 14)] == [1] * 12 + [0]
    drag(bench, (36, 36), (100, 36), erase=True)
    assert bench.draft.tile((2, 1)) == 0
    bench.undo()
    bench.undo()
    assert bench.draft == Draft(Level())
    bench.undo(again=True)
    assert bench.draft.tile((2, 1)) == 1


def test_a_rectangle_shrinks_while_it_is_drawn(bench: Bench) -> None:
    bench.tool = "rectangle"
    drag(bench, (36, 36), (300, 300), (84, 60))
    assert sum(bench.draft.level.tiles) == 3 * 2
    bench.take(sort("gold"))
    drag(bench, (120, 120), (180, 150))
    assert len(bench.draft.objects) == 6 * 3
    bench.undo()
    assert not bench.draft.objects


def test_fill_takes_one_press(bench: Bench) -> None:
    bench.tool = "fill"
    drag(bench, (300, 300))
    assert set(bench.draft.level.tiles) == {1}


@pytest.mark.parametrize("tool", ["brush", "rectangle"])
@pytest.mark.parametrize("name", ["locked door", "trap door", "exit"])
def test_what_has_a_switch_takes_two_presses_or_one_drag(bench: Bench, name: str, tool: str) -> None:
    bench.tool = tool
    bench.take(sort(name))
    drag(bench, (238, 300))
    assert pending(bench)
    bench.move(400, 200)
    drag(bench, (420, 204))
    assert not pending(bench)
    drag(bench, (238, 400), (300, 420), (420, 480))
    first, second = bench.draft.objects
    assert points(first)[1] == (420.0, 204.0)
    assert points(second)[1] == (420.0, 480.0)
    bench.undo()
    assert len(bench.draft.objects) == 1
    drag(bench, (238, 500))
    bench.move(500, 500)
    assert bench.cancel()
    assert len(bench.draft.objects) == 1
    assert not bench.cancel()


def test_doors_go_to_the_nearest_side_and_the_rest_where_it_sits_in_a_cell(bench: Bench) -> None:
    bench.snap = "cell"
    for name, at in (("automatic door", (262, 252)), ("launch pad", (300, 300)), ("floor guard", (350, 350)),
                     ("zap drone", (391, 402)), ("gold", (431, 431))):  # fmt: skip
        bench.take(sort(name))
        drag(bench, at)
    assert forms(bench) == [
        "automatic door 10,10 right", "launch pad 12,12 up", "floor guard 14,14",
        "zap drone 16,16 surface-cw right", "gold 17,17",
    ]  # fmt: skip
    bench.snap = "px"
    drag(bench, (433.2, 420.7))
    assert bench.draft.objects[-1].values == (433.0, 421.0)


def test_there_is_one_ninja_and_a_second_press_moves_it(bench: Bench) -> None:
    bench.take(sort("gold"))
    drag(bench, (100, 100))
    bench.take(sort("ninja"))
    drag(bench, (100, 200))
    drag(bench, (204, 204))
    assert [record.kind for record in bench.draft.objects] == [kinds.NINJA, kinds.GOLD]
    assert bench.draft.objects[0].values == (204.0, 204.0)


def test_what_is_selected_moves_turns_copies_and_goes(bench: Bench) -> None:
    bench.take(2)
    drag(bench, (60, 60))
    bench.take(sort("thwump"))
    drag(bench, (84, 60))
    bench.tool = "select"
    drag(bench, (50, 50), (100, 70))
    assert bench.selection == Selection((2, 2, 3, 1), frozenset({(0, 0)}))
    drag(bench, (60, 60), (60, 90), (60, 108))
    assert (bench.draft.tile((2, 4)), bench.draft.tile((2, 2))) == (2, 0)
    assert bench.draft.objects[0].values[:2] == (84.0, 108.0)
    bench.turn(MIRROR)
    assert bench.draft.tile((4, 4)) == MIRROR.tile(2)
    bench.turn(MIRROR)
    assert bench.copy()
    bench.move(300, 300)
    assert bench.paste()
    assert bench.draft.tile((12, 12)) == 2
    assert bench.draft.objects[1].values[:2] == (324.0, 300.0)
    bench.nudge(0, 1)
    assert bench.draft.tile((12, 13)) == 2
    bench.turn(CLOCKWISE)
    bench.delete()
    assert bench.draft.tile((2, 4)) == 2
    assert len(bench.draft.objects) == 1
    while bench.undo():
        pass
    assert bench.draft == Draft(Level())


def test_shift_adds_to_a_selection_and_takes_away_again(bench: Bench) -> None:
    bench.take(sort("mine"))
    for x in (100, 200, 300):
        drag(bench, (x, 100))
    bench.tool = "select"
    drag(bench, (96, 96))
    drag(bench, (204, 96), add=True)
    drag(bench, (300, 96), add=True)
    assert len(bench.selection.parts) == 3
    drag(bench, (204, 96), add=True)
    assert len(bench.selection.parts) == 2
    drag(bench, (600, 500))
    assert not bench.selection


def test_properties_belong_to_what_is_selected_or_to_the_brush(bench: Bench) -> None:
    bench.take(sort("one-way"))
    bench.put_subject(placed(bench.subject, 36, 36, "cell")._replace(values=(36.0, 36.0, 2.0)))
    assert word(bench.record, "direction") == "left"
    drag(bench, (300, 300))
    bench.tool = "select"
    drag(bench, (300, 300))
    assert bench.chosen is not None
    bench.put_subject(bench.chosen._replace(values=(300.0, 300.0, 1.0)))
    assert word(bench.draft.objects[0], "direction") == "down"
    assert word(bench.record, "direction") == "left"


def test_pick_takes_objects_before_tiles(bench: Bench) -> None:
    bench.take(7)
    drag(bench, (300, 300))
    bench.take(sort("mine"))
    drag(bench, (300, 300))
    bench.tool = "pick"
    bench.take(1)
    drag(bench, (303, 300), pick=True)
    assert sort_of(bench.record) == "mine"
    bench.delete()
    assert forms(bench) == []
    drag(bench, (303, 300), pick=True)
    assert (bench.objects, bench.tile) == (False, 7)


def test_a_symmetric_stroke_is_erased_symmetrically(bench: Bench) -> None:
    bench.symmetry = "both"
    bench.take(sort("gold"))
    drag(bench, (100, 100))
    assert len(bench.draft.objects) == 4
    drag(bench, (100, 100), erase=True)
    assert forms(bench) == []
    bench.take(3)
    drag(bench, (100, 100))
    assert len(forms(bench)) + sum(map(bool, bench.draft.level.tiles)) == 4


def test_every_sort_can_be_placed_and_every_tile_has_a_name_and_a_key(bench: Bench) -> None:
    for number, each in enumerate(SORTS):
        assert sort_of(each.record) == each.name
        bench.take(each.record)
        drag(bench, (60 + 36 * number, 300))
        bench.finish()
    assert len(bench.draft.objects) == len(SORTS)
    assert len({tile_key(tile) for tile in range(34)}) == 34
    assert not [tile for tile in range(34) if tile_name(tile).startswith("odd")]
    assert sorted(tile for family in FAMILIES for tile in family.tiles) == list(range(2, 34))


def test_snaps() -> None:
    assert snapped(37, 59, "cell") == (36, 60)
    assert snapped(37, 59, "half") == (36, 60)
    assert snapped(40, 57, "quarter") == (42, 60)
    assert snapped(40.4, 57.6, "px") == (40, 58)
