"""The site, a server of it and Chromium, once for all tests of pages; they skip, with a word, where there are none."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from ninja_game.errors import NinjaGameError
from ninja_game.files.locking import locked
from ninja_game.web.site.build import MARK
from tests.support.visitor import Visitor
from tests.support.web_page import browser, built_site, missing, python_page, served


@pytest.fixture(autouse=True)
def board_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The cache folder of boards in a test."""
    monkeypatch.setattr("ninja_game.cli.web.cache_folder", lambda: tmp_path / "cache")
    return tmp_path / "cache" / "board"


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The folder of the site. Workers of one session share it; the second one finds its files as they should be."""
    base = tmp_path_factory.getbasetemp()
    folder = (base if "PYTEST_XDIST_WORKER" not in os.environ else base.parent) / "site"
    try:
        with locked(folder, 1800):  # as long as a download and all that Node compiles may take
            return folder if (folder / MARK).exists() else built_site(folder)
    except NinjaGameError as error:
        if "could not compile" in str(error):
            raise  # what npm or a mirror cannot give is no fault of ours, this is
        pytest.skip(f"no site can be built here: {error}")


@pytest.fixture(scope="session")
def address(site: Any) -> Iterator[str]:
    """Where the site is served."""
    with served(site) as where:
        yield where


@pytest.fixture(scope="session")
def chromium() -> Iterator[Any]:
    """A Chromium without a window."""
    if words := missing():
        pytest.skip(words)
    with browser() as running:
        yield running


@pytest.fixture(scope="session")
def python(chromium: Any, address: str) -> Iterator[Any]:
    """An empty page with the site's Python and a host."""
    with python_page(chromium, address) as page:
        yield page


@pytest.fixture
def new_visitor(address: str, chromium: Any) -> Iterator[Callable[..., Visitor]]:
    """Makes visitors of the site; keyword arguments are those of a context of playwright."""
    with ExitStack() as stack:
        yield lambda **about: Visitor(chromium, address, stack, **about)
