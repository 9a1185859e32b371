"""Problems of the level: their list, their signs, and the way from one to the next."""

from unittest.mock import patch

from ninja_game.editor.draft import Draft
from ninja_game.editor.examination import Examined
from ninja_game.editor.files import Source
from ninja_game.editor.solver import Certification
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.levels.findings import Finding
from ninja_game.play.editor.panels import Findings
from ninja_game.play.editor.sheet import sign_mark
from ninja_game.search.task import Progress, obstacle
from ninja_game.sim.kinds import EXIT
from ninja_game.sim.level import Level
from tests.support.level_maker import Maker


def test_problems_are_shown_where_they_are_and_a_click_goes_there(room: Maker) -> None:
    room.press("shift+h")
    room.drag((300, 564))
    session = room.editor.session
    room.await_problems()
    assert [finding.text for finding in session.edited.examination.findings] == [
        "it is inside a tile: its rockets explode at once"
    ]
    room.frames(2)
    assert [key for key in room.editor.view.sheet.marks if key[0] == "sign"]  # type: ignore[index]
    room.press("f4")
    assert session.tools.selection.parts == {(2, 0)}
    assert "Move it, or clear the tile." in session.edited.examination.findings[0].advice
    assert room.editor.view.hint == "Problem 1 of 1: the list says how to fix it"
    room.press("delete")
    room.await_problems()
    assert not session.edited.examination.findings
    room.press("f4")
    assert "No problems" in room.app.notice


def test_what_kept_the_solver_from_a_run_is_the_first_problem_and_a_click_goes_there(room: Maker) -> None:
    session, level = room.editor.session, room.draft.level
    exit_ = next(number for number, record in enumerate(level.objects) if record.kind == EXIT)
    why = obstacle(level, 0, Progress(untouched=(exit_,)))
    session.certifier.certification = Certification(level, seconds=20.0, obstacles=(why,), end="No run in 20 s")
    room.wait(lambda: session.edited.examination.findings[:1] == [why], "the problem")
    room.press("f4")
    assert why.advice.endswith("Make the way there easier, or give the solver more time.")
    assert room.editor.view.hint.startswith("Problem 1 of ")
    assert session.tools.pointer == (120.0, 540.0), "the switch"
    room.press("b")
    room.drag((300, 300))
    room.await_problems()
    assert why not in session.edited.examination.findings, "of another level"


def test_other_findings_are_shown_though_their_list_has_the_address_of_an_earlier_one(room: Maker) -> None:
    part = next(part for part in room.editor.parts if isinstance(part, Findings))
    lists = [[Finding("too-many-objects", "one")]]
    address = id(lists[0])

    def key() -> object:
        with patch.object(type(part.session.edited.examination), "findings", lists[-1]):
            part.update(0)
        return part.render_key()

    before = key()
    lists[0] = []
    assert key() != before
    while len(lists) < 1000 and id(lists[-1]) != address:
        lists.append([Finding("many-objects", "another")])
    assert key() != before


def test_the_sign_of_a_finding_leaves_its_cause_visible(room: Maker) -> None:
    sheet, rects = room.editor.view.sheet, []
    for at in ((396.0, 300.0), (780.0, 300.0), (36.0, 12.0), (780.0, 588.0)):
        (rect,) = sign_mark(sheet.flat, sheet.palette, at).rects
        rects.append(rect)
        assert not rect.collidepoint(sheet.flat.point(*at))
        assert sheet.flat.rect(0, 0, 792, 600).inflate(8, 8).contains(rect)


def test_a_problem_is_shown_whole_where_there_is_room(room: Maker) -> None:
    session = room.editor.session
    room.await_problems()
    session.edited.examination.job.result = Examined(
        room.draft.level, [Finding("no-exit", "word " * 60), Finding("no-ninja", "none")]
    )
    room.frames(2)
    part = next(each for each in room.editor.parts if isinstance(each, Findings))
    assert [number for number, _ in part.lines] == [0, 0, 0, 1]
    x, y, w, h = part.list.row_area(2)
    room.mouse(x + w / 2, y + h / 2)
    assert room.editor.view.hint == "Problem 1 of 2: the list says how to fix it"


def test_the_problem_that_f4_goes_to_is_in_sight_in_the_list(room: Maker) -> None:
    session = room.editor.session
    room.await_problems()
    session.edited.examination.job.result = Examined(
        room.draft.level, [Finding("no-exit", f"word {number}") for number in range(12)]
    )
    part = next(part for part in room.editor.parts if isinstance(part, Findings))
    for number in range(12):
        room.press("f4")
        room.frames(2)
        assert part.list.first <= number < part.list.first + part.list.visible_lines
        assert f"Problem {number + 1} of 12" in room.editor.view.hint


def test_what_is_known_of_one_level_is_not_said_of_the_next(room: Maker) -> None:
    session = room.editor.session
    room.await_problems()
    session.begin(Source(with_stamp(Draft(Level()), Stamp({(3, 3): 1}))))
    examination, reaches = session.edited.examination, session.edited.at_pointer.reaches
    assert (examination.level, reaches.result, examination.findings) == (None, None, [])
    room.press("f4")
    assert "No problems" not in room.app.notice
    assert session.edited.examination.level is room.draft.level
