"""What all tests share: no real screen, no sound card, examples without a time limit."""

import gc
import os
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings

from tests.support.warm_start import WarmStart

# Speed is no business of tests on a loaded machine. The examples are always the same, unless new ones are asked for.
settings.register_profile(
    "ninja-game",
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    derandomize="NEW_EXAMPLES" not in os.environ,
)
settings.load_profile("ninja-game")

# A shell lets what it starts in the background ignore Ctrl-C; the programs that tests start must hear it.
signal.signal(signal.SIGINT, signal.default_int_handler)

# A process that compiles beside a test belongs only to those that are about it.
os.environ["NINJA_GAME_BACKGROUND_COMPILER"] = "0"

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
gc.disable()  # until all is imported

ROOT = Path(__file__).resolve().parent.parent

COSTLY = ("chromium", "site", "screens", "warm_start")
"""Fixtures that take seconds to make, once for each worker that needs them."""


@pytest.hookimpl(tryfirst=True)
def pytest_runtestloop() -> None:
    """What was imported stays: the garbage collector does not look through it again and again."""
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Let one worker do the tests that share what is costly: the first ones, since others take the last from it."""
    items.sort(key=lambda item: [name not in getattr(item, "fixturenames", ()) for name in COSTLY])


@pytest.hookimpl(optionalhook=True)
def pytest_handlecrashitem(crashitem: str, report: pytest.TestReport) -> None:
    """The test in which a worker died has failed; how it ends alone says whether the fault is its own."""
    worker = report.node
    words = [sys.executable, "-m", "pytest", "-p", "no:xdist", "-q", crashitem]
    again = subprocess.run(words, cwd=worker.config.rootpath, capture_output=True, text=True, check=False)
    code = worker.gateway._io.popen.poll()
    outcome = "passed" if again.returncode == 0 else f"did NOT pass:\n{again.stdout}{again.stderr}"
    report.longrepr = f"{report.longrepr} (exit code {code}; Python's trace of it stands above). Alone it {outcome}"


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_terminal_summary(terminalreporter: Any) -> Iterator[None]:
    """At the end, how many tests were skipped, for which reasons, and where: hosts differ, so nothing fails for it."""
    yield
    families: dict[str, Counter[str]] = {}
    for report in terminalreporter.stats.get("skipped", ()):
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
        families.setdefault(reason.removeprefix("Skipped: "), Counter())[report.nodeid.split("::")[0]] += 1
    if families:
        number = sum(sum(files.values()) for files in families.values())
        terminalreporter.section(f"NOT RUN HERE: {number} tests or files of tests", sep="!", yellow=True, bold=True)
    for reason, files in families.items():
        terminalreporter.line(f"{sum(files.values())} skipped, {reason!r}: {', '.join(sorted(files))}")


@pytest.fixture
def own_fields() -> Iterator[None]:
    """A memory, plain and compiled, in which an object has the fields of its kind only (support/own_fields.py)."""
    from tests.support.own_fields import own_fields_only

    with own_fields_only():
        yield


@pytest.fixture(autouse=os.environ.get("OWN_FIELDS") == "1")
def _own_fields_everywhere(own_fields: None) -> None:
    """With OWN_FIELDS=1 every test runs in that memory."""


@pytest.fixture(scope="session")
def warm_start(tmp_path_factory: pytest.TempPathFactory) -> Iterator[WarmStart]:
    """Starts programs without the time that loading the game and Numba takes."""
    if not hasattr(os, "fork"):
        pytest.skip("this system cannot fork")
    started = WarmStart(tmp_path_factory.mktemp("warm"))
    yield started
    started.close()


@pytest.fixture(scope="session")
def root() -> Path:
    """The project's folder."""
    return ROOT
