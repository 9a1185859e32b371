"""Pages of the gallery and of a board, tag by tag, and charts of a board, against `golden/pages.txt`.

`python3 tools/dev.py accept-pictures` writes the file again.
"""

import re
import shutil
from pathlib import Path

import numpy as np

from ninja_game.board.judge import judge
from ninja_game.board.ranking import Ranking
from ninja_game.levels.published import published_levels
from ninja_game.web.board.charts import lead_chart, speed_and_keys, step_chart
from ninja_game.web.board.pages import BoardPages
from ninja_game.web.pages.gallery import write_gallery
from tests.support.own_pack import PACK
from tests.support.recorded import hold_against
from tests.support.samples import replay_of_walk

GOLDEN = Path(__file__).parent / "golden" / "pages.txt"
LONG = re.compile(r'((?: d|content|viewBox)="|#level=)[^"]*')  # what is long, and other where a library is


def board(folder: Path) -> Path:
    """Runs of two players, a copy of one, a run on a level that does not count, and what is not a run."""
    runs = folder / "runs"
    shutil.copytree(PACK / "certificates", runs)
    first, *_ = sorted(runs.glob("*.exit.*"))
    for path in (Path(shutil.copy(first, runs / "copy.replay.txt")), *runs.glob("01-*")):
        text = re.sub("^author: .*", "author: Ann", path.read_text("utf-8"), flags=re.MULTILINE)
        path.write_text(text, "utf-8")
    (runs / "other-level.replay.txt").write_text(replay_of_walk(), "utf-8")
    (runs / "notes.txt").write_text("just some notes\n", "utf-8")
    return runs


def lines_of(folder: Path) -> list[str]:
    """The tags of the lists, a level and a player, each with the text behind it."""
    lines = []
    below = [min(folder.glob(f"{name}/*.html"), default=None) for name in ("levels", "players")]
    for path in filter(None, [*sorted(folder.glob("*.html")), *below]):
        lines.append(f"=== {path.relative_to(folder.parent)}")
        lines += LONG.sub(r"\1...", path.read_text("utf-8")).replace("<", "\n<").split("\n")
    return lines


def charts() -> list[str]:
    """One of each sort, a line each."""
    days = "2026-01-02", "2026-03-04"
    steps = step_chart([(0, 9.0), (3, 7.5), (4, 2.0)], ["Ann", "Bob", "Ann"], "{:.1f} s".format, days, "Records")
    speeds = speed_and_keys(np.linspace(0.0, 4.0, 500), bytes(range(8)) * 70, [30, 33, 450])
    return [*map(str, (steps, *speeds, lead_chart([0, 100, 200, 400], [(1, [0, 5, None, -3])], "Behind Ann")))]


def test_every_page_is_as_recorded(tmp_path: Path) -> None:
    shown = published_levels(PACK)
    write_gallery(tmp_path / "site", shown)
    BoardPages(tmp_path / "site", Ranking(judge(board(tmp_path), shown, jobs=1), shown)).write()
    pages = [line for name in ("gallery", "board") for line in lines_of(tmp_path / "site" / name)]
    hold_against(GOLDEN, [*pages, "=== charts", *charts()])
