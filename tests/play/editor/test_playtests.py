"""A level is tried from the editor; where its tests came and died."""

from dataclasses import replace

import pygame

from ninja_game.document import History
from ninja_game.editor.files import Source
from ninja_game.editor.solver import Certification
from ninja_game.editor.specs import BODY_PART
from ninja_game.editor.stamp import Selection, Stamp, with_stamp
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.editor.properties import FIRST_STEPS
from ninja_game.play.editor.screen import EditorScreen
from ninja_game.sim.kinds import NINJA
from ninja_game.sim.level import ObjectSpec
from tests.support.level_maker import ROOM, Maker
from tests.support.waiting import LONGEST


def test_a_test_leads_back_in_one_press_with_everything_as_it_was(room: Maker) -> None:
    tools = room.editor.session.tools
    room.drag((300, 300))
    before, history = room.draft, list(tools.history.done)
    room.press("f5")
    room.keys.script = [2] * 20
    room.press("space")
    room.frames(19)
    assert isinstance(room.top(), PlaytestScreen)
    room.press("escape")
    assert isinstance(room.top(), EditorScreen)
    assert room.draft is before
    assert tools.history.done == history
    assert len(room.editor.session.edited.playtests.last_route) == 20
    assert room.editor.session.edited.playtests.last_route[0] == (60.0, 542.0)
    room.point(400, 100)
    room.press("f6")
    room.press("escape")
    assert room.draft is before
    assert not room.player.statistics.played().attempts


def test_a_map_shows_where_all_tests_came_and_died(room: Maker) -> None:
    session = room.editor.session
    room.press("shift+i")
    room.drag((100, 540))  # a mine on the way to the exit
    plain = room.app.surface.copy()
    room.press("f9")
    assert "No tests yet" in room.editor.view.hint
    room.press("f5")
    for _ in range(2):
        room.keys.script = [2] * 60
        room.press("space")
        room.frames(70)
        room.press("r")
    room.press("escape")
    session.edited.playtests.maps.finish(LONGEST)
    assert session.edited.playtests.map
    assert len(session.edited.playtests.map.deaths) == 2
    room.frames()
    died, _ = session.edited.playtests.map.deaths
    assert 70 < died[0] < 100
    assert session.edited.playtests.map.visits == {(2, 22): 2, (3, 22): 2}
    assert len(session.edited.playtests.shown) == 2, "what is pressed after a death is no test"
    room.frames(2)
    x, y = room.app.canvas.point(*room.at(60, 500))
    assert room.app.surface.get_at((x, y)) == plain.get_at((x, y)), "nobody came there"
    x, y = room.app.canvas.point(*room.at(90, 532))
    assert room.app.surface.get_at((x, y)) != plain.get_at((x, y))
    room.press("f9")
    marks = room.editor.view.sheet.marks
    assert [key[0] for key in marks if key[0] in ("visit", "death")] == ["death"], "of the last test"  # type: ignore[index]
    room.chord("z", pygame.KMOD_LCTRL)
    room.frames()
    marks = room.editor.view.sheet.marks
    assert not [key for key in marks if key[0] in ("visit", "death")], "the mine is gone"  # type: ignore[index]
    room.chord("y", pygame.KMOD_LCTRL)
    room.frames()
    playtests = session.edited.playtests
    assert (len(playtests.shown), playtests.last_deaths) == (2, (died,)), "those of the level with the mine"
    tools = session.tools
    tools.selection = Selection(parts=frozenset({(len(session.draft.objects) - 1, BODY_PART)}))
    tools.selected.nudge(-1, 0)
    session.add_playtest(session.draft.level, bytes([2] * 20), over=True)
    assert len([*session.edited.playtests.shown]) == 1, (
        "a test in the picture of the change is of the changed level alone"
    )
    session.begin(Source(ROOM))
    assert session.edited.playtests.map is None


def test_a_test_that_passes_comes_back_by_confirming(room: Maker) -> None:
    room.press("f5")
    room.keys.script = [2] * 200
    room.press("space")
    room.frames(100)
    room.press("space")
    assert isinstance(room.top(), EditorScreen)
    assert not room.player.records.level_bests()


def test_a_level_without_a_ninja_cannot_be_tried_but_says_how(maker: Maker) -> None:
    maker.open("Editor")
    maker.press("f5")
    assert isinstance(maker.top(), EditorScreen)
    assert "places a ninja" in maker.app.notice
    maker.press("f7")
    assert "Place a ninja" in maker.app.notice


def test_a_ninja_far_away_leaves_no_route(room: Maker) -> None:
    far = ObjectSpec(NINJA, (9000.0, 300.0))
    room.editor.session.tools.load(History(with_stamp(ROOM, Stamp({}, (far,)))))
    room.press("f5")
    room.frames(4)
    room.press("escape")
    room.frames(2)
    assert isinstance(room.app.top, EditorScreen)


def test_a_new_level_knows_nothing_of_the_one_before(room: Maker) -> None:
    session = room.editor.session
    level, route = session.draft.level, ((60.0, 542.0), (61.0, 542.0))
    session.certifier.certification = Certification(level, route=route, end="Done")
    session.add_playtest(level, bytes([2] * 20), over=True)
    room.frames(2)
    assert sum(key[0] == "route" and bool(mark.rects) for key, mark in room.editor.view.sheet.marks.items()) == 2  # type: ignore[index]
    session.edited.source = replace(session.edited.source, draft=session.draft)
    room.chord("n", pygame.KMOD_LCTRL)
    assert getattr(room.editor.properties.widgets[1], "text", "") not in FIRST_STEPS
    room.choose("Empty")
    room.frames(2)
    assert room.editor.properties.widgets[1].text == FIRST_STEPS[0]  # type: ignore[attr-defined]
    assert not any(key[0] == "route" and mark.rects for key, mark in room.editor.view.sheet.marks.items())  # type: ignore[index]
    certifier = session.certifier
    assert (certifier.text, certifier.is_busy, certifier.is_stale(session.draft.level)) == ("", False, False)
