"""The program, fresh for each test."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.menu_driver import MenuDriver


@pytest.fixture
def driver(tmp_path: Path) -> Iterator[MenuDriver]:
    """The program at its main menu, with an empty folder of the player's."""
    driver = MenuDriver(tmp_path)
    yield driver
    driver.close()
