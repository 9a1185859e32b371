"""Where the mouse takes hold of what lies at the edge of its cell."""

from dataclasses import replace

import pytest

from ninja_game.formats.ascii.object_lines import ListedObject, read_object_line
from ninja_game.sim.grid import Point
from ninja_game.sim.level import ObjectSpec
from tests.support.level_maker import ROOM, Maker

_LEFT, _TOP = 12 * 24, 9 * 24  # of the cell, px
_MIDDLE = _LEFT + 12, _TOP + 10


def _spec(line: str) -> ObjectSpec:
    listed = read_object_line(line)[0]
    assert isinstance(listed, ListedObject)
    return listed.spec


@pytest.mark.parametrize(
    "line, moved, held",
    [
        ("launch pad 12,9 up", "launch pad 13,10 up", (_LEFT + 12, _TOP + 4)),
        ("automatic door 12,9 left", "automatic door 13,10 left", (_LEFT + 20, _TOP + 12)),
        ("one-way 12,9 up", "one-way 13,10 up", (_LEFT + 22, _TOP + 1)),
    ],
)
def test_a_drag_takes_it_by_the_middle_of_its_cell_and_where_it_is_drawn_unless_something_is_nearer(
    room: Maker, line: str, moved: str, held: Point
) -> None:
    tools, count = room.editor.session.tools, len(ROOM.objects)
    room.press("v")
    for says, others, start, wanted in (
        ("", [], held, [moved]),
        ("", ["gold 12,9"], _MIDDLE, [line, "gold 13,10"]),
        ("at 12,9: Hello", [], held, [line]),
    ):
        tools.selection = type(tools.selection)()
        added = [_spec(text) for text in (line, *others)]
        tools.history.change(replace(room.draft.with_objects((*ROOM.objects, *added)), says=says))
        room.drag(start, (start[0] + 24, start[1] + 24))
        assert room.draft.objects[count:] == tuple(_spec(text) for text in wanted), (says, others)
