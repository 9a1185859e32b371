"""What certifies a level in the editor: the solver's runs, also of levels that were left, and the maker's own."""

import re
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import replace
from functools import partial
from math import ceil, dist, inf
from pathlib import Path
from threading import Event
from time import monotonic
from unittest.mock import patch

import pygame
import pytest

from ninja_game.backend.memories import compiled_available
from ninja_game.editor import packs
from ninja_game.editor.draft import Draft
from ninja_game.editor.examination import LevelQuestion, examine_level
from ninja_game.editor.files import open_source
from ninja_game.editor.palette import object_of_type, placed, with_switch
from ninja_game.editor.reach import LANDED_TICK, Ask, find_reach
from ninja_game.editor.solver import Certification, Certifier, Solver, search_of
from ninja_game.editor.specs import BODY_PART, SWITCH_PART, points
from ninja_game.formats.load import load_levels
from ninja_game.formats.pack.pack import Pack
from ninja_game.formats.replay.text import Replay, parse_replay
from ninja_game.levels.findings import level_finding
from ninja_game.play.editor.sheet import _rects
from ninja_game.play.menu_screen import Menu
from ninja_game.runs.packs import lint, make_pars
from ninja_game.runs.problems import passed_by
from ninja_game.search.certificate import verified_run
from ninja_game.search.task import Progress, Task
from ninja_game.sim.grid import cell_of, is_inside
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.kinds import EXIT, GOLD
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.ui.canvas import Canvas
from tests.support.draw_log import drawn
from tests.support.level_maker import ROOM, Maker
from tests.support.waiting import LONGEST

RIGHT = bytes([2]) * 100


def test_searches_of_levels_that_were_left_go_on_one_after_the_other(
    room: Maker, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    ready, at_once = Event(), list[bool]()
    request.addfinalizer(ready.set)
    run = verified_run(ROOM.level, with_press_bits(RIGHT))

    def solve(
        task: Task, *, report: Callable[[Progress], object], on_better: Callable[[Replay], object], stop: Event
    ) -> Replay | None:
        at_once.append(ready.is_set())
        ready.wait(LONGEST)
        report(Progress())
        if task.level != ROOM.level:
            return None
        on_better(run)
        return run

    monkeypatch.setattr("ninja_game.search.solve.solve", solve)
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    reports: list[str] = []
    monkeypatch.setattr(room.app, "notify", lambda text, **_: reports.append(text))
    session, levels = room.editor.session, tmp_path / "levels"
    room.chord("s", pygame.KMOD_LCTRL)
    room.press("f7")
    room.wait(lambda: at_once, "the first search")
    assert session.certifier.text.startswith(("Loading the solver: ", "Compiling the solver, "))
    room.chord("n", pygame.KMOD_LCTRL)
    room.choose("A room")
    assert session.certifier.text == "", "nothing is asked, and the new level has no search"
    session.save(levels / "other.txt", name="Other")
    room.press("f7")
    assert session.certifier.text.startswith("Another level's search comes first: #2 in the queue")
    assert session.certify_text == "Stop #2"
    room.chord("n", pygame.KMOD_LCTRL)
    room.choose("Empty")
    session.begin(open_source(levels / "room.txt"))
    assert session.certifier.is_busy, "it is this level's again"
    session.close()
    kept = levels / "certificates" / "room.exit.replay.txt"
    assert not kept.exists()
    ready.set()
    session.certifier.solver.job.finish(LONGEST)
    assert (at_once, kept.exists()) == ([False, True], True)
    assert reports[-2:] == ["Room: certified, 0.975 s, kept with the level", "Other: no run in 20 s"]


@pytest.mark.parametrize(
    "gold, wait, text",
    [
        (1, 0, "Certified: 0.975 s, 1 of 2 gold, hard. Kept when"),
        (1, 5, "Certified: 0.975 s, all gold 1.100 s, hard. Kept when"),
        (2, 0, "Certified: 0.975 s, all gold, hard. Kept when"),
    ],
)
def test_the_card_says_how_much_gold_the_run_takes_and_how_hard_it_is(
    room: Maker, monkeypatch: pytest.MonkeyPatch, gold: int, wait: int, text: str
) -> None:
    """With a run that takes all gold ``wait`` ticks later."""

    def solve(task: Task, *, on_better: Callable[[Replay], object], **_: object) -> Replay:
        if wait:
            on_better(replace(verified_run(task.level, with_press_bits(bytes(wait) + RIGHT)), gold=2))
        run = replace(verified_run(task.level, with_press_bits(RIGHT)), gold=gold)
        on_better(run)
        return run

    monkeypatch.setattr("ninja_game.search.solve.solve", solve)
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    monkeypatch.setattr("ninja_game.batch.difficulty.difficulty", lambda *_: 5.0)
    pieces = [ObjectSpec(GOLD, (x, 60.0)) for x in (300.0, 324.0)]
    room.editor.session.tools.history.change(room.draft.with_objects((*room.draft.objects, *pieces)))
    room.press("f7")
    room.wait(lambda: room.editor.session.certifier.certification.end)
    assert text in " ".join(re.findall("text '(.*?)' at 616,", drawn(room.app)))


def test_a_search_that_fails_ends_and_says_so_of_its_own_level_alone(
    room: Maker, monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest
) -> None:
    ready = Event()
    request.addfinalizer(ready.set)

    def solve(task: Task, **_: object) -> None:
        if task.level == ROOM.level:
            raise MemoryError
        ready.wait(LONGEST)

    monkeypatch.setattr("ninja_game.search.solve.solve", solve)
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    certifier = room.editor.session.certifier
    room.chord("s", pygame.KMOD_LCTRL)
    room.press("f7")
    failed = certifier.certification
    room.chord("n", pygame.KMOD_LCTRL)
    room.choose("A room")
    room.press("f7")
    room.wait(lambda: failed.end)
    assert (failed.end, certifier.is_busy) == ("there is not enough memory", True)
    assert certifier.text.startswith(("Loading the solver: ", "Compiling the solver, "))


def test_the_button_stops_a_search_and_it_is_said_what_it_had_found(
    room: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = room.editor.session
    monkeypatch.setattr("ninja_game.play.editor.session.REST", inf)
    assert session.certify_text == "Certify"
    run = verified_run(ROOM.level, with_press_bits(RIGHT))
    for progress, best, status in (
        (Progress(seconds=12.2), None, "Stopped: no exit found in 12 s"),
        (Progress(seconds=3.0), run, "Stopped. Certified: 0.975 s"),
        (Progress(seconds=122.2), None, "Stopped: no exit found in 122 s"),
    ):
        session.certifier.certification = Certification(room.draft.level, seconds=20.0, run=best, progress=progress)
        assert f"text 'Stop {progress.seconds:.0f}{' s' * (progress.seconds < 100)}'" in drawn(room.app), "it fits"
        room.mouse(*next(each for each in room.editor.widgets if getattr(each, "name", "") == "certify").centre)
        assert (room.app.notice, session.certify_text) == (status, "Certify")
    session.certifier.certification = Certification(room.draft.level, seconds=20.0, progress=Progress(seconds=1.0))
    room.drag((300, 300))
    assert session.certify_text == "Certify", "it would search the level as it is now"
    assert "The level has changed" in drawn(room.app), "and so says the card"
    room.chord("z", pygame.KMOD_LCTRL)
    assert (session.certify_text, "The level has changed" in drawn(room.app)) == ("Stop 1 s", False)


def test_while_the_solver_is_compiled_its_seconds_are_shown_and_nothing_stops(
    room: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = room.editor.session
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    monkeypatch.setattr(session.certifier.solver.job, "ask", lambda _: None)
    session.certifier.certification = Certification(room.draft.level, began=monotonic() - 300)
    for compiles, says in ((False, "Loading the solver"), (True, "Compiling the solver, .* a minute or more")):
        monkeypatch.setattr(session.certifier.solver, "compiles", compiles)
        shown = drawn(room.app)
        assert "text '30" in shown
        assert re.search(f"{says}: 30[0-9] s", " ".join(re.findall("text '(.*)'", shown)))
    room.press("f7")
    assert (session.certifier.is_busy, room.app.notice) == (True, "Still preparing: F7 stops the search that follows")
    room.drag((300, 300))
    assert session.certifier.certification.level == room.draft.level
    assert session.certify_text[0] == "3", "it goes on with the level as it is now, and counts on"


def test_a_search_goes_on_with_the_changed_level_once_that_has_rested(
    room: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    session, asked, clock = room.editor.session, list[Certification](), [1000.0]
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    monkeypatch.setattr("ninja_game.play.editor.session.monotonic", lambda: clock[0])
    monkeypatch.setattr(session.certifier.solver.job, "ask", asked.append)
    search = session.certifier.certification = Certification(
        room.draft.level, seconds=20.0, progress=Progress(seconds=5.0)
    )
    for place in ((300, 300), (400, 300)):
        room.drag(place)
        clock[0] += 0.9
        room.frames()
        assert (asked, search.end) == ([], ""), "each change begins the rest again"
    assert "The level has changed" in drawn(room.app)
    clock[0] += 0.2
    room.frames()
    assert ([each.level for each in asked], search.end) == ([room.draft.level], "Stopped")
    session.certifier.certification.progress = Progress(seconds=5.0)
    session.tools.history.change(room.draft.with_objects(room.draft.objects[:1]))
    for _ in range(2):
        room.frames()
        clock[0] += 2
    assert len(asked) == 1, "there is no exit to look for yet"


def test_after_a_change_the_runs_known_before_are_tried_first(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tasks = list[Task]()
    certifier = Certifier(solver := Solver())
    monkeypatch.setattr(solver.job, "ask", solver.work)
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    monkeypatch.setattr("ninja_game.search.solve.solve", lambda task, **_: tasks.append(task))
    level = load_levels(root / "levels" / "00-0-first-steps.txt")[0].level
    run, gold = (
        parse_replay((root / "levels/certificates" / f"00-0-first-steps.{kind}.replay.txt").read_text("utf-8"))
        for kind in ("exit", "gold")
    )
    for known in (gold, run):
        certifier.adopt(search_of(level, known))
    for places in (1, 2):
        certifier.start(Level(level.tiles, level.objects[places:]))
        assert tasks[-1].others == (gold.inputs, run.inputs), "also where the search between has no run"


def test_a_search_that_waits_is_of_the_level_as_it_is_by_then(room: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    session, asked = room.editor.session, list[Certification]()
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    monkeypatch.setattr(session.certifier.solver.job, "ask", asked.append)
    monkeypatch.setattr(session.certifier.solver, "at_work", Certification(ROOM.level))
    room.press("f7")
    room.drag((300, 300))
    room.chord("z", pygame.KMOD_LCTRL)
    room.drag((300, 300), (350, 300))
    assert (asked[-1].level, asked[-1].end) == (room.draft.level, "")
    assert {each.end for each in asked[:-1]} == {"Stopped"}
    assert (session.certify_text, session.certifier.text[:36]) == ("Stop #1", "Another level's search comes first: ")
    room.press("f7")
    assert (session.certify_text, session.certifier.text) == ("Certify", "Stopped")
    room.drag((400, 300))
    assert session.certify_text == "Certify", "what was stopped stays so"


class OtherFirst(AbstractContextManager[None]):
    """A lock that another thread has held just before: its change comes first."""

    def __init__(self, change: Callable[[], object]) -> None:
        self.change = change

    def __enter__(self) -> None:
        self.change()

    def __exit__(self, *_: object) -> None:
        """Nothing is to be released."""


def test_a_change_by_the_other_thread_just_before_counts() -> None:
    slow, fast = (verified_run(ROOM.level, with_press_bits(keys)) for keys in (bytes(9) + RIGHT, RIGHT))
    assert fast.end_tick < slow.end_tick
    search = Certification(ROOM.level)
    search.lock = OtherFirst(partial(setattr, search, "run", fast))
    search.take(slow)
    assert search.run is fast, "a slower run does not replace it"
    for end in ("Stopped", "Done"):
        search = Certification(ROOM.level)
        search.lock = OtherFirst(partial(setattr, search, "end", end))
        search.finish("MemoryError", failed=True)
        assert (search.end, search.failed) == (end, False), "what is over stays so"


def test_what_is_stopped_while_it_fails_stays_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    certifier = Certifier(solver := Solver())
    monkeypatch.setattr(solver.job, "ask", lambda _: None)
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)

    def solve(*_: object, **__: object) -> None:
        certifier.stop()
        raise MemoryError

    monkeypatch.setattr("ninja_game.search.solve.solve", solve)
    certifier.start(ROOM.level)
    with pytest.raises(MemoryError):
        solver.work(certifier.certification)
    assert (certifier.text, certifier.certification.failed) == ("Stopped", False)


def test_a_door_that_the_certified_run_skips_is_reported() -> None:
    switches = (130.0, 540.0), (300.0, 300.0)
    door = placed(object_of_type("locked door"), 324.0, 540.0, "cell")
    level = ROOM.with_objects((*ROOM.objects, *(with_switch(door, *at, "px") for at in switches))).level
    run = verified_run(level, with_press_bits(RIGHT))
    (found,) = search_of(level, run).obstacles
    assert (found.code, found.records) == ("unneeded-door", (3,)), "the other switch lies on its way"
    assert found.sentence.startswith("locked door at 13,22"), "and it is named"
    assert passed_by(ROOM.level, [run]) == ()
    with patch("ninja_game.runs.problems.Simulation") as played:
        search_of(level, run).take(run)
    assert not played.called, "the window takes up a run that is known by now, and waits for no play"
    with patch("ninja_game.runs.problems.Simulation") as played:
        passed_by(level, [replace(run, body="box")])
    played.assert_called_once_with(level, body="box")


def test_a_search_of_what_no_file_holds_ends_with_the_level(room: Maker) -> None:
    certifier = room.editor.session.certifier
    search = certifier.certification = type(certifier.certification)(room.draft.level)
    with pytest.MonkeyPatch.context() as busy:
        busy.setattr(type(certifier.solver.job), "is_idle", False)
        room.chord("n", pygame.KMOD_LCTRL)
        room.choose("Empty")
    assert (search.end, certifier.text) == ("Stopped", "")


def passed(room: Maker, *, begin: str = "f5", late: int = 0, helped: str = "") -> str:
    """Pass a test, and what the editor says then."""
    room.press(begin)
    room.keys.script = [0] * late + [2] * 200
    room.press("space")
    room.frames(10)
    if helped:
        room.press(helped)
        room.press("space")
    room.frames(100 + late)
    room.press("escape")
    room.frames()
    return room.editor.session.certifier.text


def test_a_pass_of_ones_own_certifies_the_level_as_it_is(room: Maker, tmp_path: Path) -> None:
    room.app.change_settings(name="Mia")
    session, kept = room.editor.session, tmp_path / "levels" / "certificates" / "room.exit.replay.txt"
    room.mouse(*room.at(66, 545), click=False)
    assert passed(room, begin="f6") == "", "not from its start"
    text = passed(room, late=12)
    assert text.startswith("Certified: 1.")
    assert passed(room) < text, "a faster one"
    faster = session.certifier.text
    session.certifier.certification.take(verified_run(ROOM.level, with_press_bits(bytes(30) + bytes([2]) * 100)))
    assert session.certifier.text == faster, "a slower one of the solver"
    room.chord("s", pygame.KMOD_LCTRL)
    room.frames()
    replay = parse_replay(kept.read_text())
    assert (replay.author, str(replay.made), replay.name) == ("Mia", "played", "Room")
    pack = packs.new_pack(tmp_path / "levels", "Pack", "me")
    file = packs.transfer(load_levels(tmp_path / "levels" / "room.txt")[0], pack, keep=False)
    packs.place(pack, [file], 0)
    assert not [finding for finding in lint(Pack(pack)) if "certificate" in finding.code]
    ((_, pars),) = make_pars(Pack(pack), tries=1)
    assert (pars.exit, pars.difficulty is not None) == (replay.end_tick, True)
    room.drag((300, 300))
    assert session.certifier.is_stale(room.draft.level)


def test_a_pass_with_help_certifies_nothing(room: Maker) -> None:
    assert passed(room, helped="period") == "", "a single step"
    assert passed(room) != ""


def test_an_exit_in_one_wall_with_its_switch_is_one_problem(room: Maker) -> None:
    exit_ = next(n for n, spec in enumerate(room.draft.objects) if spec.kind == EXIT)
    (column, row), (at, on) = (cell_of(*points(room.draft.objects[exit_])[part]) for part in (BODY_PART, SWITCH_PART))
    around = {(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)} - {(0, 0)}
    walls = [{(a + i, b + j) for i, j in around if is_inside((a + i, b + j))} for a, b in ((column, row), (at, on))]
    found = []
    for shut in (walls[0] | walls[1], walls[1]):
        level = room.draft.with_tiles(dict.fromkeys(shut, 1)).level
        findings = examine_level(LevelQuestion(level, (), "", b"")).findings
        found.append([finding.code for finding in findings if exit_ in finding.records])
    assert found == [["unreachable"], ["unreachable-switch"]]


def test_a_search_for_an_exit_that_cannot_be_reached_is_asked_about(
    room: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[object] = []
    monkeypatch.setattr(room.editor.session.certifier, "start", started.append)
    shut = dict.fromkeys([(i, j) for i in (6, 7, 8) for j in (21, 22) if (i, j) != (7, 22)], 1)
    room.editor.session.tools.history.change(room.draft.with_tiles(shut))
    room.frames()
    room.press("f7")
    assert room.shown(Menu).title == "The ninja cannot reach the exit or its switch"
    room.choose("Cancel")
    assert not started
    room.press("f7")
    room.choose("Look for a run anyway")
    assert started == [room.draft.level]
    exit_ = next(n for n, spec in enumerate(room.draft.objects) if spec.kind == EXIT)
    never = level_finding("unreached-exit", (exit_,))
    odd = examine_level(LevelQuestion(room.draft.level, (never,), "", b"")).findings
    assert [each.code for each in odd if exit_ in each.records] == ["unreachable"]
    assert examine_level(LevelQuestion(ROOM.level, (never,), "", b"")).findings == [never]


@pytest.mark.skipif(not compiled_available(), reason="needs Numba")
def test_who_stands_goes_nowhere_before_the_jump_and_steers_in_the_air() -> None:
    arcs = find_reach(Ask(Draft(Level()), (396.0, 565.0), 0.0)).arcs
    lefts, ups, rights = (arcs[k : k + 2] for k in (0, 2, 4))
    for way, both in ((-1, lefts), (0, ups), (1, rights)):
        for arc in both:
            assert {x for x, _ in arc[: LANDED_TICK + 1]} == {396.0}
            assert (arc[-1][0] - 396) * way > 24 if way else arc[-1][0] == 396
        low, high = (min(y for _, y in arc) for arc in both)
        assert high < low - 24, "who holds the key jumps higher"


@pytest.mark.parametrize("end", [(300.0, 100.0), (100.0, 300.0), (-50.0, 100.0), (220.0, -60.0), (100.0, 100.0)])
def test_small_rectangles_cover_a_line_over_the_level(end: tuple[float, float]) -> None:
    found, length = list(_rects(Canvas((792, 600)), (100.0, 100.0), end)), dist((100, 100), end)
    assert len(found) == max(1, ceil(length / 60))
    for k in range(101):
        x, y = (100 + (each - 100) * k / 100 for each in end)
        assert any(rect.inflate(2, 2).collidepoint(x, y) for rect in found)
