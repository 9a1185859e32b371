"""The program, fresh for each test."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.menu_driver import MenuDriver


@pytest.fixture
def driver(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[MenuDriver]:
    """The program at its main menu, with an empty folder of the player's; no level of the day is made."""
    monkeypatch.setattr("ninja_game.generator.daily.take_packed", lambda *_: False)
    monkeypatch.setattr("ninja_game.generator.daily.make_daily", lambda *_, **__: False)
    driver = MenuDriver(tmp_path)
    yield driver
    driver.close()
