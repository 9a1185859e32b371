"""The world in a page is that of the game here, bit for bit; a sample of all runs, or all with EVERY=1."""

import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from tests.support.page_digests import digests
from tests.support.page_runs import Run, digests_in_node, digests_in_page, page_runs
from tests.support.web_page import PYODIDE

EVERY = int(os.environ.get("EVERY", "17"))  # the sample: every this many runs one


@pytest.fixture(scope="module")
def runs() -> list[Run]:
    """Certificates, replays, scenes and crowded levels."""
    return page_runs()[::EVERY]


def test_the_sample_holds_runs_of_every_kind(runs: list[Run]) -> None:
    names = " ".join(name for name, *_ in runs)
    assert len(runs) > 20
    assert ".exit.replay.txt" in names
    assert "crowded-" in names
    assert {body for _, _, body, _ in runs} == {"circle", "box"}


def test_runs_in_chromium_have_the_digests_of_those_here(python: Any, runs: list[Run]) -> None:
    assert digests_in_page(python, runs) == digests(runs)


def test_runs_in_node_have_the_digests_of_those_here(site: Path, runs: list[Run], tmp_path: Path) -> None:
    if shutil.which("node") is None:
        pytest.skip("Node is not installed")
    some = runs[::3] if EVERY > 1 else runs
    assert digests_in_node(PYODIDE, some, tmp_path) == digests(some)


def test_a_difference_is_seen(python: Any, runs: list[Run]) -> None:
    name, level, body, keys = runs[0]
    other = [(name, level, body, ("02" if keys[:2] == "01" else "01") * 20 + keys[40:])]
    assert digests_in_page(python, other) != digests(runs[:1])
