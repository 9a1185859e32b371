"""Levels with very many objects: how they look, and what is dragged."""

import pygame
import pytest

from ninja_game.editor.brush import Tool
from ninja_game.editor.files import Source
from ninja_game.editor.palette import OBJECT_TYPES, placed
from ninja_game.editor.specs import BODY_PART, points
from ninja_game.editor.stamp import Selection, Stamp, with_stamp
from ninja_game.files.bundled import bundled_levels
from ninja_game.formats.load import load_levels
from ninja_game.play.editor import palette_view
from ninja_game.play.editor.palette_view import ObjectPictures, ObjectSprites
from ninja_game.sim.level import ObjectSpec
from ninja_game.ui.canvas import Canvas
from ninja_game.ui.theme import PALETTES
from ninja_game.view.sprites.drawing import DrawTarget, SpriteBook
from tests.support.level_maker import ROOM, Maker

CROWD = tuple(
    placed(OBJECT_TYPES[2 + k * 7 % 15].spec, 30 + 37 * k % 730, 30 + 53 * k % 540, "quarter") for k in range(500)
)


def pictures() -> ObjectPictures:
    canvas, palette = Canvas((792, 600)), next(iter(PALETTES.values()))
    return ObjectPictures(DrawTarget(canvas, palette, SpriteBook(canvas.scale, palette)))


def rounded(look: ObjectSprites) -> object:
    return [(key, round(x, 6), round(y, 6)) for key, x, y in look.sprites], look.rect


def test_what_is_asked_for_in_one_place_looks_as_it_does_in_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    records = {spec for path in bundled_levels()[::9] for spec in load_levels(path)[0].level.objects}
    odd_doors = [
        (300.0, 300.0, 1.0, 1.0, column, row, 0.0, -1.0, 0.0)
        for column in (0.0, 33.0, -4.0)
        for row in (0.0, 9.0, 25.0)
    ]
    records |= {*CROWD, *(ObjectSpec(9, values) for values in odd_doors), ObjectSpec(9, (1.0, 2.0)), ObjectSpec(77, ())}
    quick = pictures().sprites_of(records)
    monkeypatch.setattr(palette_view, "_model", lambda spec: spec)
    exact = pictures().sprites_of(sorted(records))
    for spec, look in exact.items():
        assert rounded(quick[spec]) == rounded(look), spec
    assert sum(bool(look.sprites) for look in exact.values()) > 500


def test_what_is_dragged_goes_to_the_last_place_of_the_mouse(room: Maker) -> None:
    room.editor.session.begin(Source(with_stamp(ROOM, Stamp({}, CROWD))))
    room.frames(3)
    tools = room.editor.session.tools
    tools.tool, tools.brush.snap = Tool.SELECT, "px"
    tools.selection = Selection(None, frozenset((n, BODY_PART) for n in range(len(tools.draft.objects))))
    before = [points(spec)[BODY_PART] for spec in tools.draft.objects]
    x, y = before[100]
    places = [room.app.canvas.point(*room.at(x + k, y)) for k in range(30)]
    moves: list[float] = []
    move = tools.move

    def counted(x: float, y: float) -> None:
        moves.append(x)
        move(x, y)

    tools.move = counted  # type: ignore[method-assign]
    pygame.event.post(pygame.Event(pygame.MOUSEBUTTONDOWN, pos=places[0], button=1, touch=False))
    for place in places:
        pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=place, rel=(0, 0), buttons=(1, 0, 0), touch=False))
    room.frames()
    assert len(moves) == 2
    checked = room.editor.session.edited.examination.job.result
    room.frames(20)
    assert room.editor.session.edited.examination.job.result is checked, "problems are looked for when it is let go"
    pygame.event.post(pygame.Event(pygame.MOUSEMOTION, pos=places[9], rel=(0, 0), buttons=(1, 0, 0), touch=False))
    pygame.event.post(pygame.Event(pygame.MOUSEBUTTONUP, pos=places[9], button=1, touch=False))
    room.frames()
    gone = points(tools.draft.objects[100])[BODY_PART][0] - x
    assert abs(gone - 9) <= 1
    assert points(tools.draft.objects[0])[BODY_PART] == (before[0][0] + gone, before[0][1])
    assert not tools.is_dragging
