"""Somebody at the TAS editor with a run of a small level."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from shutil import copy

import pytest

from ninja_game.formats.load import load_replays
from ninja_game.tas_editor.opening import prepare_rules
from tests.support.own_pack import PACK
from tests.support.tas_driver import TasDriver

RUN = PACK / "certificates" / "00-2-the-chimney.exit.replay.txt"


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
