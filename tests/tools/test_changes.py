"""The lists of breaks with which the tests are tested fit the program as it is."""

from __future__ import annotations

import pytest

from tools import change_events, change_pictures, change_rules
from tools.changes import Suite

SUITES = [change_rules.SUITE, change_events.SUITE, change_pictures.SUITE]


@pytest.mark.parametrize("suite", SUITES, ids=["rules", "events", "pictures"])
def test_every_break_of_the_list_can_be_made(suite: Suite) -> None:
    assert not suite.misfits()
