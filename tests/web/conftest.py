"""The site, a server of it and Chromium, once for all tests of pages; they skip, with a word, where there are none."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from ninja_game.errors import NinjaGameError
from tests.support.web_page import browser, built_site, missing, python_page, served


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The folder of the site."""
    try:
        return built_site(tmp_path_factory.mktemp("site"))
    except NinjaGameError as error:
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
