"""The program, fresh for each test."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.menu_driver import Stage


@pytest.fixture
def stage(tmp_path: Path) -> Iterator[Stage]:
    """The program at its main menu, with an empty folder of the player's."""
    stage = Stage(tmp_path)
    yield stage
    stage.close()
