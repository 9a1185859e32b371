"""The site, a server of it and Chromium, once for all tests of pages; they skip, with a word, where there are none."""

import json
import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest

from ninja_game.errors import NinjaGameError
from ninja_game.files.locking import locked
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.web.pages import documents
from tests.support.board import HOSTILE
from tests.support.forgeries import GOLD_LATER
from tests.support.samples import SPIKED, WALK
from tests.support.visitor import Visitor
from tests.support.web_page import browser, built_site, missing, python_page, served


@pytest.fixture
def levels(tmp_path: Path) -> Path:
    """Three levels that count, as a pack with an episode, one of them with a hostile name."""
    folder = tmp_path / "levels"
    folder.mkdir()
    for number, (string, name) in enumerate(((WALK, "Walk"), (SPIKED, "Spiked"), (GOLD_LATER, HOSTILE))):
        text = write_ascii_level(parse_level_string(string), name=name, author=HOSTILE, comment=HOSTILE)
        (folder / f"00-{number}-level.txt").write_text(text, "utf-8")
    (folder / "pack.toml").write_text(
        f'name = {json.dumps(HOSTILE)}\n[[episode]]\nnumber = 0\nname = {json.dumps(HOSTILE)}\n'
        'levels = ["00-0-level.txt"]\n', "utf-8",
    )  # fmt: skip
    return folder


@pytest.fixture
def runs(tmp_path: Path) -> Path:
    folder = tmp_path / "runs"
    folder.mkdir()
    return folder


@pytest.fixture(autouse=True)
def board_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The cache folder of boards in a test."""
    monkeypatch.setattr("ninja_game.cli.board_ranking.cache_folder", lambda: tmp_path / "cache")
    return tmp_path / "cache" / "board"


@pytest.fixture(scope="session", autouse=True)
def _made_once() -> Iterator[None]:
    """What takes most of the time that documents take, and is the same in every build of them."""
    with ExitStack() as stack:
        for name in ("_film", "_highlighted", "figure_picture"):
            stack.enter_context(patch.object(documents, name, cache(getattr(documents, name))))
        yield


def made_by_one(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], object]) -> Path:
    """A folder that the first of the session's workers makes, and the others find as it should be."""
    base = factory.getbasetemp()
    folder = (base if "PYTEST_XDIST_WORKER" not in os.environ else base.parent) / name
    made = folder.with_suffix(".made")
    with locked(folder, 1800):  # as long as a download and all that Node compiles may take
        if not made.exists():
            make(folder)
            made.touch()
    return folder


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The folder of the site."""
    try:
        return made_by_one(tmp_path_factory, "site", built_site)
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
