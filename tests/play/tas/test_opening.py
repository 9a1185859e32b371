"""Until the rules are loaded the window says what is being done; then it is the TAS editor."""

import gc
from collections.abc import Iterator
from pathlib import Path
from threading import Event

import pytest

from ninja_game.backend.kernel_cache import before_compiling
from ninja_game.backend.memories import compiled_available
from ninja_game.errors import NinjaGameError, ReplayError
from ninja_game.formats.load import load_replays
from ninja_game.tas_editor import opening
from ninja_game.tas_editor.opening import OpeningScreen, is_prepared, open_tas_editor
from ninja_game.tas_editor.screen import TasScreen
from tests.play.tas.conftest import RUN
from tests.support.menu_driver import MenuDriver


@pytest.fixture
def at(tmp_path: Path) -> Iterator[MenuDriver]:
    driver = MenuDriver(tmp_path)
    yield driver
    driver.close()


@pytest.fixture
def loaded(monkeypatch: pytest.MonkeyPatch) -> Iterator[Event]:
    """The rules are there once this is set."""
    event = Event()
    monkeypatch.setattr(opening, "prepare_rules", lambda _: event.wait(60))
    monkeypatch.setattr(opening, "is_prepared", lambda: False)
    yield event
    event.set()


def opened(at: MenuDriver) -> None:
    """Let pictures pass until the TAS editor is there, or refused."""
    screen = at.shown(OpeningScreen)
    screen.thread.join(60)
    at.frames(2)


def test_the_window_says_what_is_done_until_the_tas_editor_is_there(at: MenuDriver, loaded: Event) -> None:
    gc.set_threshold(*(garbage := (700, 10, 10)))  # whatever a board, ranked before in this process, has set
    open_tas_editor(at.app, load_replays(RUN)[0], [], 17)
    at.frames(2)
    screen = at.shown(OpeningScreen)
    assert screen.explanation == ""
    at.frames(100)
    assert screen.explanation == "Loading the rules (2 s)"
    for announce in before_compiling:
        announce()
    assert screen.explanation.startswith("Compiling the rules for this machine")
    at.press("escape", "return")
    assert at.top() is screen, "nothing can be done yet"
    loaded.set()
    opened(at)
    editor = at.shown(TasScreen)
    assert editor.editor.cursor == 17
    assert gc.get_threshold()[0] > garbage[0], "points of a path are not garbage"
    editor.files.leave()
    assert screen not in at.app.stack
    assert gc.get_threshold() == garbage


def test_what_cannot_be_opened_is_reported_where_one_came_from(
    at: MenuDriver, loaded: Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise ReplayError("a run without an end")

    monkeypatch.setattr("ninja_game.tas.files.open_recording", refuse)
    before = at.top()
    open_tas_editor(at.app, load_replays(RUN)[0], [], 0)
    loaded.set()
    at.frames()
    opened(at)
    assert at.top() is before
    assert at.app.notice == "It cannot be edited: a run without an end"
    at.app.stack.clear()
    at.app.push(OpeningScreen(at.app, load_replays(RUN)[0], refuse))  # type: ignore[arg-type]
    at.frames()
    with pytest.raises(NinjaGameError, match="a run without an end"):
        opened(at)


def test_what_was_prepared_is_there_at_once(at: MenuDriver) -> None:
    opening.prepare_rules(load_replays(RUN)[0])
    assert is_prepared()
    if compiled_available():
        open_tas_editor(at.app, load_replays(RUN)[0], [], 3)
        assert isinstance(at.top(), TasScreen)


def test_while_another_process_compiles_the_tas_editor_opens_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(opening, "compiled_available", lambda: True)
    monkeypatch.setattr(opening, "has_compiled_twin", lambda _: False)
    monkeypatch.setattr(opening, "begins_on_plain", lambda *_: True)
    assert is_prepared()
