"""Which tests execute which lines of the program, and how long each takes: a plugin of pytest, loaded by breaks.py."""

import json
import os
from collections import Counter
from collections.abc import Generator
from pathlib import Path
from typing import Any

import pytest
from coverage import Coverage

FOLDER = Path(os.environ["EXECUTED"])
seconds: Counter[str] = Counter()
now = [""]
recording = Coverage(FOLDER / "lines", data_suffix=True, source=["ninja_game"], omit=["ninja_game/sim/*"])
recording.set_option("run:relative_files", value=True)
if "PYTEST_XDIST_WORKER" in os.environ:
    recording.start()


def pytest_runtest_logstart(nodeid: str) -> None:
    """What runs from here on belongs to this test, whatever its parameters."""
    switch_to(nodeid.partition("[")[0])


@pytest.hookimpl(wrapper=True)
def pytest_fixture_setup(fixturedef: Any) -> Generator[None, Any, Any]:
    """What makes a shared fixture belongs to all tests of the file."""
    before = now[0]
    if fixturedef.scope != "function":
        switch_to(before.partition("::")[0])
    try:
        return (yield)
    finally:
        switch_to(before)


def switch_to(context: str) -> None:
    now[0] = context
    if "PYTEST_XDIST_WORKER" in os.environ:
        recording.switch_context(context)


def pytest_runtest_logreport(report: Any) -> None:
    """Add up the time of all phases and parameters."""
    seconds[report.nodeid.partition("[")[0]] += report.duration


def pytest_sessionfinish() -> None:
    """Keep what was seen; the process that hands out the tests has heard of all times."""
    if "PYTEST_XDIST_WORKER" in os.environ:
        recording.stop()
        recording.save()
    else:
        (FOLDER / "seconds.json").write_text(json.dumps(seconds), "utf-8")
