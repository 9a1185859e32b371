"""Work in the background: whatever goes wrong in it, the screen that waits for it says so and can be used again."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from threading import Event

import pytest

from ninja_game import runtime
from ninja_game.document import History
from ninja_game.editor.solver import Certifier, Solver
from ninja_game.errors import NinjaGameError
from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.text import Replay
from ninja_game.play.app import App
from ninja_game.play.replay import film
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.runtime import NewestJob
from ninja_game.search.formula import background
from ninja_game.search.formula.background import SpanSearch
from ninja_game.search.formula.task import SpanTask
from ninja_game.search.task import Progress, Task
from ninja_game.sim.level import Level
from ninja_game.tas_editor import opening
from ninja_game.tas_editor.tabs import lead_tab
from tests.support.level_maker import ROOM, Maker
from tests.support.menu_driver import MenuDriver
from tests.support.own_pack import PACK
from tests.support.tas_driver import TasDriver
from tests.support.waiting import LONGEST

RUN = PACK / "certificates" / "00-2-wall-to-wall.exit.replay.txt"


def test_a_window_waits_shortly_for_what_works_in_the_background(app: App) -> None:
    before = sys.getswitchinterval()
    sys.setswitchinterval(0.005)  # another window of this process may have shortened it
    try:
        app.run(1)
        assert sys.getswitchinterval() <= 0.001
    finally:
        sys.setswitchinterval(before)


class LibraryPanic(BaseException):
    """What is not an Exception."""


WRONG = {
    "there is not enough memory": MemoryError(),
    "a fault of the program, ZeroDivisionError: by zero": ZeroDivisionError("by zero"),
    "a fault of the program, LibraryPanic: deep below": LibraryPanic("deep below"),
    "No space left": OSError(28, "No space left"),
    "no luck": NinjaGameError("no luck"),
}


@pytest.fixture(name="why", params=list(WRONG))
def sentence(request: pytest.FixtureRequest) -> str:
    """What a user sees."""
    why: str = request.param
    return why


def raising(why: str) -> Callable[..., None]:
    def work(*_: object, **__: object) -> None:
        raise WRONG[why]

    return work


@pytest.fixture(name="driver")
def main_menu(tmp_path: Path) -> Iterator[MenuDriver]:
    driver = MenuDriver(tmp_path)
    yield driver
    driver.close()


@pytest.mark.parametrize("in_page", [False, True])
def test_who_waits_is_informed_and_a_fault_leaves_its_traceback(
    why: str, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str], *, in_page: bool
) -> None:
    monkeypatch.setattr(runtime, "IN_PAGE", in_page)
    reports: list[str] = []
    thread = runtime.run_in_background(raising(why), reports.append)
    if not in_page:
        thread.join(LONGEST)
    assert reports == [why]
    assert ("Traceback" in capfd.readouterr().err) == ("fault" in why)


def test_a_film_that_cannot_be_made_can_be_tried_again(
    driver: MenuDriver, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    screen = ReplayScreen(driver.app, [load_replays(RUN)[0]])
    driver.app.push(screen)
    monkeypatch.setattr(film, "write_film", raising(why))
    for _ in range(2):
        driver.app.notify("")
        driver.press("e")
        driver.wait(lambda: screen.export is None)
        assert driver.app.notice == f"No film: {why}"


def test_a_daily_level_that_cannot_be_made_says_why(
    driver: MenuDriver, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ninja_game.generator.daily.take_packed", lambda *_: False)
    monkeypatch.setattr("ninja_game.generator.daily.make_daily", raising(why))
    monkeypatch.setattr("ninja_game.play.menus.daily.choose_memory", lambda _: None)
    screen = driver.open("Daily")
    driver.wait(lambda: screen.maker is None)  # type: ignore[attr-defined]
    assert screen.message == f"No level could be made for today: {why}"  # type: ignore[attr-defined]


def test_a_level_that_cannot_be_examined_or_certified_says_why(
    tmp_path: Path, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ninja_game.editor.examination.level_problems", raising(why))
    monkeypatch.setattr("ninja_game.search.solve.solve", raising(why))
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    maker = Maker(tmp_path)
    try:
        maker.open("Editor")
        session = maker.editor.session
        session.tools.load(History(ROOM))
        maker.wait(lambda: maker.app.notice)
        assert maker.app.notice == f"The level could not be examined: {why}"
        maker.press("f7")
        maker.wait(lambda: not session.certifier.is_busy)
        assert session.certifier.text == why
        session.close()
    finally:
        maker.close()


def test_runs_that_cannot_be_compared_say_why(tmp_path: Path, why: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lead_tab, "lead_table", raising(why))
    at = TasDriver(tmp_path, RUN)
    try:
        at.editor.tab = "Lead"
        at.wait(lambda: at.screen.tabs[2].summary not in ("", "comparing ..."))  # type: ignore[attr-defined]
        assert at.screen.tabs[2].summary == why  # type: ignore[attr-defined]
    finally:
        at.close()


def test_a_search_that_breaks_off_says_why(why: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(background, "search_span", raising(why))
    search = SpanSearch(SpanTask(ROOM.level, bytes(40), first=0, last=30, goal="x > 130"))
    search.start()
    search.finish(LONGEST)
    assert (search.done, search.problem) == (True, why)


def test_a_run_whose_rules_cannot_be_loaded_says_why(
    driver: MenuDriver, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(opening, "is_prepared", lambda: False)
    monkeypatch.setattr(opening, "prepare_rules", raising(why))
    below = driver.top()
    opening.open_tas_editor(driver.app, load_replays(RUN)[0], [], 0)
    driver.wait(lambda: driver.top() is below)
    assert driver.app.notice == f"It cannot be edited: {why}"


def test_a_search_that_was_stopped_changes_nothing_and_nobody_waits_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    ready = Event()
    old, new = Level(), Level((1,) * len(Level().tiles))
    times: list[float] = []

    def solve(
        task: Task, *, report: Callable[[Progress], object], on_better: Callable[[Replay], object], stop: Event
    ) -> None:
        ready.wait(LONGEST)
        times.append(task.seconds)
        if task.level is old:
            on_better(Replay.of_inputs(b"", old))
        else:
            report(Progress())

    monkeypatch.setattr("ninja_game.search.solve.solve", solve)
    monkeypatch.setattr("ninja_game.editor.solver.compiled_available", lambda: True)
    certifier = Certifier(Solver())
    with monkeypatch.context() as impatient:
        impatient.setattr(NewestJob, "finish", lambda *_: pytest.fail("it waits"))
        certifier.start(old)
        certifier.stop()
        assert (certifier.is_busy, certifier.text) == (False, "Stopped")
        certifier.start(new)
    ready.set()
    certifier.solver.job.finish(LONGEST)
    assert (certifier.certification.level is new, certifier.certification.run) == (True, None)
    assert certifier.text == "No run in 20 s: the first problem says why. F7 looks twice as long"
    assert [finding.code for finding in certifier.certification.obstacles] == ["unreached-exit"]
    certifier.start(new)
    certifier.solver.job.finish(LONGEST)
    assert times[-2:] == [20.0, 40.0]


def test_the_tas_editor_is_left_without_waiting_for_a_comparison(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    at = TasDriver(tmp_path, RUN)
    monkeypatch.setattr(NewestJob, "finish", lambda *_: pytest.fail("it waits"))
    at.close()


def test_a_newer_job_is_done_after_one_that_fails() -> None:
    done: list[int] = []

    def work(job: int) -> int:
        if job < 3:
            jobs.ask(job + 1)
            raise ValueError(job)
        done.append(job)
        return job

    jobs: NewestJob[int, int] = NewestJob(work)
    jobs.ask(1)
    jobs.finish(LONGEST)
    assert (jobs.result, jobs.problem, jobs.is_idle, done) == (3, "", True, [3])
