"""What tests of the world share."""

import pytest

from tests.support.memories import BOTH
from tests.support.room_runs import Play, starter


@pytest.fixture(params=BOTH)
def play(request: pytest.FixtureRequest) -> Play:
    """Starts runs in the scenes' room, on each memory."""
    return starter(request.param)
