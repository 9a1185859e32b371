"""From a row of the board into the page's own viewer, with a ghost; from the gallery into a level."""

import shutil
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from ninja_game.board.judge import judge
from ninja_game.board.ranking import Ranking
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.levels.published import published_levels
from ninja_game.web.board.pages import BoardPages
from ninja_game.web.pages.gallery import write_gallery
from tests.support.forgeries import WALKING, replay
from tests.support.samples import WALK
from tests.support.visitor import Visitor
from tests.support.web_page import served


@pytest.mark.slow
def test_rows_are_watched_together_and_levels_are_played(site: Path, chromium: Any, tmp_path: Path) -> None:
    out = shutil.copytree(site, tmp_path / "site")
    levels, runs = tmp_path / "levels.txt", tmp_path / "runs"
    levels.write_text(write_ascii_level(parse_level_string(WALK), name="Walk"), "utf-8")
    runs.mkdir()
    (runs / "ann.txt").write_text(replay(author="Ann"), "utf-8")
    (runs / "bob.txt").write_text(replay(bytes(5) + WALKING + b"\2", author="Bob"), "utf-8")
    shown = published_levels(levels)
    BoardPages(out, Ranking(judge(runs, shown, jobs=1), shown)).write()
    write_gallery(out, shown)
    with served(out) as address, ExitStack() as stack:
        visitor = Visitor(chromium, address, stack)
        page = visitor.page
        page.goto(f"{address}board/players.html")
        page.get_by_role("link", name="Ann").click()
        page.locator("main td > a").first.click()
        page.get_by_role("link", name="together").first.click()
        visitor.until("replay")
        assert visitor.python("', '.join(run.title for run in app.top.runs)") == "Walk - Ann, Walk - Bob"
        assert visitor.python("len(app.top.view.ghosts)") == 1
        page.goto(f"{address}gallery/index.html")
        page.locator(".card a").first.click()
        page.get_by_role("link", name="Play this level").click()
        visitor.until("ready")
        assert visitor.python("app.top.playthrough.title") == "Walk"
        assert visitor.problems == []
