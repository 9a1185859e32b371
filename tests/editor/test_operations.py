"""Operations of the editor: exact inverses, symmetric tiles and objects, selections that move and turn."""

from dataclasses import replace
from itertools import product

import pytest
from hypothesis import given, settings, strategies as st

from ninja_game.document import History
from ninja_game.editor.draft import Draft, Tiles
from ninja_game.editor.motion import CLOCKWISE, FLIP, HALF_TURN, MIRROR, SYMMETRIES, Motion
from ninja_game.editor.palette import object_of_type, placed, remade
from ninja_game.editor.specs import (
    PROPERTIES_BY_KIND,
    carried,
    object_type_name,
    points,
    properties,
    settled,
    with_word,
    word,
)
from ninja_game.editor.stamp import (
    Selection,
    Stamp,
    chosen_in,
    copied,
    everything,
    filled,
    moved,
    nearest_part,
    pasted,
    removed,
    turning_centre,
    with_stamp,
)
from ninja_game.formats.ascii.object_lines import ListedObject, read_object_line
from ninja_game.sim.collision import tiles as shapes
from ninja_game.sim.kinds import DOOR, GOLD, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec
from ninja_game.simulation import Simulation

EIGHT = [Motion(*matrix) for matrix in ((1, 0, 0, 1), (0, -1, 1, 0), (-1, 0, 0, -1), (0, 1, -1, 0),
                                        (-1, 0, 0, 1), (1, 0, 0, -1), (0, 1, 1, 0), (0, -1, -1, 0))]  # fmt: skip
LINES = (
    "ninja 5,7", "gold 5.5,7", "mine 300,561px", "bounce block 9,9", "one-way 12,3.5 up", "thwump 4,4 left",
    "launch pad 9.5,20 up-right", "launch pad 3,3 right", "floor guard 8,20", "zap drone 5,7 wander-cw right seeker",
    "laser drone 6,6 surface-ccw up", "chaingun drone 7,7 alternating down", "gauss turret 8,8",
    "homing launcher 9,3", "exit 29,21 switch 3.5,4", "locked door 9,21 left switch 3,19",
    "trap door 20,21 bottom switch 15,21", "automatic door 12,22 right", "automatic door 12,12 top",
)  # fmt: skip


def spec(line: str) -> ObjectSpec:
    listed = read_object_line(line)[0]
    assert isinstance(listed, ListedObject)
    return listed.spec


SPECS = [spec(line) for line in LINES]

# --- undo and redo ---

cells = st.tuples(st.integers(0, COLUMNS + 1), st.integers(0, ROWS + 1))
areas = st.builds(lambda a, w, h: (*a, w, h), cells, st.integers(1, 5), st.integers(1, 5))
steps = st.one_of(
    st.tuples(st.just("tiles"), st.dictionaries(cells, st.integers(0, 33), max_size=6)),
    st.tuples(st.just("object"), st.sampled_from(SPECS), st.integers(0, 400)),
    st.tuples(st.just("fill"), cells, st.integers(0, 33)),
    st.tuples(st.just("move"), areas, st.sampled_from(EIGHT), st.integers(-48, 48)),
    st.tuples(st.just("cut"), areas),
    st.tuples(st.just("paste"), areas, st.integers(-5, 5)),
    st.tuples(st.just("name"), st.text(max_size=3)),
    st.tuples(st.just("stroke"), st.booleans()),
)


def step(history: History[Draft], what: tuple[object, ...]) -> None:
    draft = history.draft
    match what:
        case ("tiles", tiles):
            history.change(with_stamp(draft, Stamp(tiles), SYMMETRIES["both"]))  # type: ignore[arg-type]
        case ("object", ObjectSpec() as one, int(dx)):
            history.change(with_stamp(draft, Stamp({}, (carried(one, Motion(dx=dx)),)), SYMMETRIES["point"]))
        case ("fill", cell, tile):
            history.change(draft.with_tiles(dict.fromkeys(filled(draft, cell), tile)))  # type: ignore[arg-type]
        case ("move", area, Motion() as motion, int(dx)):
            chosen = chosen_in(draft, area)  # type: ignore[arg-type]
            middle = turning_centre(draft, chosen, quarter=bool(motion.xy))
            turned = motion.about(*middle)
            history.change(moved(draft, chosen, turned._replace(dx=turned.dx + 24 * (dx // 24)))[0])
        case ("cut", area):
            history.change(removed(draft, chosen_in(draft, area)))  # type: ignore[arg-type]
        case ("paste", area, int(dx)):
            stamp = copied(draft, chosen_in(draft, area)).carried(Motion(dx=24.0 * dx))  # type: ignore[arg-type]
            history.change(pasted(draft, stamp)[0])
        case ("name", str(text)):
            history.change(Draft(draft.level, text, draft.author, draft.comment, text[:3]))
        case ("stroke", begin):
            (history.begin if begin else history.end)()


@settings(max_examples=25)
@given(st.lists(steps, min_size=200, max_size=200))
def test_any_200_operations_undone_give_the_first_draft_and_redone_the_last(some: list[tuple[object, ...]]) -> None:
    first = Draft(Level(objects=tuple(SPECS)), "first")
    history = History(first)
    for one in some:
        step(history, one)
    history.end()
    last = history.draft
    undone = 0
    while history.undo():
        undone += 1
    assert repr(history.draft) == repr(first)
    assert history.draft.level.tiles == first.level.tiles
    while history.redo():
        undone -= 1
    assert repr(history.draft) == repr(last)
    assert history.draft.level.tiles == last.level.tiles
    assert undone == 0


def test_a_stroke_is_undone_as_one_and_an_abandoned_one_leaves_nothing() -> None:
    history = History(Draft(Level()))
    history.begin()
    for column in range(1, 6):
        history.change(history.draft.with_tiles({(column, 3): 1}))
    history.end()
    history.begin()
    history.change(history.draft.with_tiles({(9, 9): 1}))
    history.abandon()
    assert sum(history.draft.level.tiles) == 5
    assert history.undo()
    assert history.draft == Draft(Level())
    assert not history.undo()
    assert history.can_redo
    history.change(history.draft.with_tiles({(1, 1): 2}))
    assert not history.can_redo


def test_drafts_share_what_an_edit_leaves_alone() -> None:
    before = Draft(Level(objects=tuple(SPECS)))
    without = removed(before, Selection(parts=frozenset({(3, 0)})))
    assert without.objects == (*SPECS[:3], *SPECS[4:])
    assert without.level.tiles is before.level.tiles
    assert before.with_tiles({(3, 3): 1}).objects is before.objects
    history = History(before)
    history.change(Draft(Level(objects=tuple(SPECS))))
    assert not history.can_undo, "nothing has changed"


# --- motions ---


@pytest.mark.parametrize("motion", EIGHT)
def test_tiles_turn_as_the_faces_normals_and_surfaces_of_the_world_do(motion: Motion) -> None:
    assert sorted(map(motion.tile, range(34))) == list(range(34))
    for tile in range(34):
        turned = motion.tile(tile)
        for side in range(4):
            there = int(motion.direction(float(side)))
            assert shapes.FACE[4 * turned + there] == shapes.FACE[4 * tile + side]
        normal = motion.vector(shapes.NORMAL_X[tile], shapes.NORMAL_Y[tile])
        assert normal == (shapes.NORMAL_X[turned], shapes.NORMAL_Y[turned])
        ends = {motion.vector(*end) for end in _ends(tile)}
        assert ends == set(_ends(turned))


def _ends(tile: int) -> list[tuple[float, float]]:
    """The two ends of a slope's surface."""
    return [(shapes.T_X[tile], shapes.T_Y[tile]), (shapes.S_X[tile], shapes.S_Y[tile])]


@pytest.mark.parametrize("motion", [MIRROR, FLIP, HALF_TURN])
def test_a_turned_level_has_the_turned_edges(motion: Motion) -> None:
    draft = Draft(Level()).with_tiles(
        {(column, row): (7 * column + 3 * row) % 34 for column in range(1, 32) for row in range(1, 24)}
    )
    after, _ = moved(draft, everything(draft), motion.about(396, 300))
    edges, turned = edges_of(draft), edges_of(after)
    for (cell, side), state in edges.items():
        there = motion.about(396, 300).cell(cell)
        assert turned[there, int(motion.direction(float(side)))] == state


def edges_of(draft: Draft) -> dict[tuple[tuple[int, int], int], int]:
    """Edge states by cell and side, as the world has them."""
    world = Simulation(Level(draft.level.tiles, (ObjectSpec(NINJA, (36.0, 36.0)),))).world
    return {
        ((column, row), side): world.edges[4 * ((row + 1) * 35 + column + 1) + side]
        for column, row, side in product(range(33), range(25), range(4))
    }


@pytest.mark.parametrize("one", SPECS, ids=LINES)
@pytest.mark.parametrize("motion", EIGHT)
def test_an_object_is_itself_again_after_a_motion_and_its_inverse(one: ObjectSpec, motion: Motion) -> None:
    about = motion.about(396, 300)
    inverse = Motion(motion.xx, motion.yx, motion.xy, motion.yy).about(396, 300)
    there = carried(one, about)
    for part, point in points(one).items():
        if object_type_name(one) != "floor guard":
            assert points(there)[part] == pytest.approx(about.point(*point))
    back = carried(there, inverse)
    assert back.values == pytest.approx(one.values)
    assert (there == one) == (not motion.turns) or object_type_name(one) in ("ninja", "bounce block", "floor guard")


@pytest.mark.parametrize("motion", EIGHT)
def test_a_turned_door_closes_the_turned_edges(motion: Motion) -> None:
    about = motion.about(300, 300)
    for one in (spec("locked door 9,11 left switch 3,9"), spec("trap door 10,12 bottom switch 3,9")):
        assert {about.cell(cell) for cell in door_cells(one)} == set(door_cells(carried(one, about)))


def door_cells(door: ObjectSpec) -> list[tuple[int, int]]:
    """The two cells whose common side a door closes, as the world makes it."""
    level = Level(objects=(ObjectSpec(NINJA, (36.0, 36.0)), door))
    world = Simulation(level).world
    made = world.objects[2]
    return [(index % 35 - 1, index // 35 - 1) for index in (made.edge_1 // 4, made.edge_2 // 4)]


def test_reversed_drones_go_the_other_way_round_and_turned_ones_do_not() -> None:
    drone = spec("zap drone 5,7 surface-cw right")
    assert word(carried(drone, MIRROR.about(396, 300)), "movement") == "surface-ccw"
    assert word(carried(drone, MIRROR.about(396, 300)), "direction") == "left"
    assert word(carried(drone, CLOCKWISE.about(396, 300)), "movement") == "surface-cw"
    assert word(carried(drone, Motion(0, 1, -1, 0).about(396, 300)), "direction") == "up"


def test_a_malformed_record_stays_what_it_is_but_for_its_place() -> None:
    for bad in (
        ObjectSpec(0, (float("nan"), 5.0)),
        ObjectSpec(6, (1.0, 2.0)),
        ObjectSpec(-1, (), "77^1"),
        ObjectSpec(3, ()),
    ):
        assert len(carried(bad, Motion(dx=24.0)).values) == len(bad.values)
        assert not properties(bad)


# --- drawing ---


def test_a_symmetric_stroke_is_drawn_in_all_its_images() -> None:
    stamp = Stamp({(3, 4): 2, (16, 12): 5}, (spec("thwump 4,4 left"), spec("ninja 2,2")))
    draft = with_stamp(Draft(Level()), stamp, SYMMETRIES["both"])
    assert [draft.tile(cell) for cell in ((3, 4), (29, 4), (3, 20), (29, 20))] == [2, 3, 5, 4]
    assert draft.tile((16, 12)) == 5
    assert [word(one, "direction") for one in draft.objects if one.kind != NINJA] == ["left", "right", "left", "right"]
    assert [one for one in draft.objects if one.kind == NINJA] == [spec("ninja 2,2")]
    way_out = spec("exit 4,4 switch 6,6")
    assert with_stamp(Draft(Level()), Stamp({}, (way_out,)), SYMMETRIES["both"]).objects == (way_out,)


def test_the_ninja_comes_first_and_moves_when_it_is_put_again() -> None:
    draft = with_stamp(Draft(Level(objects=tuple(SPECS[1:4]))), Stamp({}, (SPECS[0],)))
    assert draft.objects[0] == SPECS[0]
    again = with_stamp(draft, Stamp({}, (spec("ninja 9,9"),)))
    assert again.objects == (spec("ninja 9,9"), *SPECS[1:4])


def test_fill_takes_what_is_joined_and_alike() -> None:
    walls: Tiles = {(5, row): 1 for row in range(1, 24)}
    draft = Draft(Level()).with_tiles(walls)
    assert len(filled(draft, (2, 2))) == 4 * 23
    assert sorted(walls) == filled(draft, (5, 9))
    assert filled(draft, (0, 9)) == []


def test_a_selection_takes_tiles_objects_and_single_parts() -> None:
    draft = Draft(Level(objects=tuple(SPECS))).with_tiles({(3, 19): 4})
    chosen = chosen_in(draft, (3, 19, 2, 1))
    door = SPECS.index(spec("locked door 9,21 left switch 3,19"))
    assert chosen.parts == {(door, 1)}
    after, selection = moved(draft, chosen, Motion(dx=48.0))
    assert after.tile((5, 19)) == 4
    assert after.tile((3, 19)) == 0
    assert after.objects[door] == spec("locked door 9,21 left switch 5,19")
    assert selection.area == (5, 19, 2, 1)
    assert nearest_part(after, 133.0, 470.0, 17.0) == (door, 1)
    assert nearest_part(after, 133.0, 40.0, 17.0) is None
    assert len(removed(after, selection).objects) == len(SPECS) - 1


def test_messages_move_with_the_cells_around_them_and_with_what_they_are_about() -> None:
    gold = ObjectSpec(GOLD, (132.0, 108.0))
    says = "start: Go | at 6,4 3x1 for 9 s: Here | gold 5,4!: Well | at 20,4: Far"
    draft = replace(Draft(Level()).with_objects((gold,)), says=says)
    around, alone = Selection((4, 3, 4, 4), frozenset({(0, 0)})), Selection(parts=frozenset({(0, 0)}))
    both = "start: Go | at 8,4 3x1 for 9 s: Here | gold 7,4!: Well | at 20,4: Far"
    for chosen, after in ((around, both), (alone, both.replace("at 8,4", "at 6,4"))):
        assert moved(draft, chosen, Motion(dx=48.0))[0].says == after
    assert moved(draft, around, Motion(dx=-240.0))[0].says == says, "none leaves the level"


def test_the_whole_level_flipped_twice_is_the_same_level() -> None:
    draft = with_stamp(Draft(Level(objects=tuple(SPECS))), Stamp({(3, 19): 4, (30, 2): 22}))
    for motion in (FLIP, MIRROR, HALF_TURN):
        about = motion.about(396, 300)
        once, chosen = moved(draft, everything(draft), about)
        assert once != draft
        assert moved(once, chosen, about)[0] == draft


def test_properties_say_what_the_records_words_say() -> None:
    for kind, some in PROPERTIES_BY_KIND.items():
        for one in (each for each in SPECS if each.kind == kind):
            for name, (_, words) in some.items():
                for text in words:
                    changed = with_word(one, name, text)
                    assert word(changed, name) == text
                    world = Simulation(Level(objects=(SPECS[0], changed))).world
                    assert world.objects[2].kind == kind
    door = with_word(spec("locked door 9,21 left switch 3,19"), "type", "automatic door")
    assert settled(door) == spec("automatic door 9,21 left")
    assert door.kind == DOOR


def test_an_object_of_another_kind_keeps_direction_and_its_natural_place() -> None:
    thwump = object_of_type("thwump")
    pad = remade(with_word(thwump, "direction", "left"), "launch pad")
    assert (object_type_name(pad), word(pad, "direction")) == ("launch pad", "left")
    assert pad == placed(pad, 36.0, 36.0, "cell"), "on the wall of its cell"
    drone = with_word(object_of_type("zap drone"), "movement", "wander-ccw")
    assert word(remade(drone, "laser drone"), "movement") == "wander-ccw"
    assert object_type_name(remade(drone, "laser drone")) == "laser drone"
    for name in ("ninja", "exit", "locked door"):
        assert remade(object_of_type(name), "mine") == object_of_type(name)
