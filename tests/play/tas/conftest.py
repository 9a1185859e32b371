"""Somebody at the TAS editor with a run of a small level."""

from collections.abc import Iterator
from pathlib import Path
from shutil import copy

import pytest

from ninja_game.formats.load import load_replays
from ninja_game.search.formula import background
from ninja_game.tas_editor import span_results
from ninja_game.tas_editor.opening import prepare_rules
from ninja_game.tas_editor.tabs.search_tab import SearchTab
from tests.support.own_pack import PACK
from tests.support.tas_driver import TasDriver

RUN = PACK / "certificates" / "00-2-wall-to-wall.exit.replay.txt"


@pytest.fixture(scope="session", autouse=True)
def rules_are_there() -> None:
    """The TAS editor opens at once from the viewer, too."""
    prepare_rules(load_replays(RUN)[0])


@pytest.fixture
def run() -> Path:
    """The run on the TAS editor; test files may have another one."""
    return RUN


@pytest.fixture(name="at")
def tas_editor_with_a_run(run: Path, tmp_path: Path) -> Iterator[TasDriver]:
    driver = TasDriver(tmp_path / "player", Path(copy(run, tmp_path / "run.replay.txt")))
    try:
        yield driver
    finally:
        driver.close()


@pytest.fixture(name="tab")
def search_tab(at: TasDriver) -> Iterator[SearchTab]:
    at.editor.select(100, 130)
    at.press("f")
    tab = at.screen.tab
    assert isinstance(tab, SearchTab)
    yield tab
    tab.close()


@pytest.fixture
def nothing_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Searches end at once without a result, and pieces of their spans are proposed then."""
    monkeypatch.setattr(span_results, "PATIENCE", 0.0)
    monkeypatch.setattr(background, "search_span", lambda task, report, **_: (report(1, ()), ())[1])
