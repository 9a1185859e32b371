"""Whole episodes on a board: ranked for who played all of their levels, refused where they are none."""

import json
import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from ninja_game.board.categories import FASTEST
from ninja_game.board.judge import Keeping, judge
from ninja_game.board.memo import Memo
from ninja_game.board.ranking import Ranking
from ninja_game.board.runs import PLAYED, ValidatedRuns
from ninja_game.cli.main import cli
from ninja_game.formats.load import load_replays
from ninja_game.formats.replay.text import write_replay
from ninja_game.levels.published import published_levels
from ninja_game.runs.run import record_replay
from ninja_game.web.board.pages import EPISODE_HEADS
from tests.support.board import board
from tests.support.own_pack import PACK

RUNS = sorted((PACK / "certificates").glob("0*.exit.replay.txt"))[:5]
SHOWN = published_levels(PACK)


def episode(folder: Path, author: str, runs: list[Path], name: str = "") -> Path:
    """An episode of these runs under an author's name."""
    path = folder / f"{name or author}.episode.txt"
    assert CliRunner().invoke(cli, ["convert", *map(str, runs), str(path)]).exit_code == 0
    lines = path.read_text().splitlines()
    path.write_text("\n".join(f"author: {author}" if line.startswith("author:") else line for line in lines) + "\n")
    return path


def judged(folder: Path, memo: Memo | None = None) -> ValidatedRuns:
    return judge(
        folder, SHOWN, Keeping(dates=lambda key, _: f"2026-01-0{1 + (key[0] > 'b')}T00:00:00Z"), jobs=1, memo=memo
    )


def whole(folder: Path) -> list[tuple[float, list[str]]]:
    """Sum of the ticks and players of the whole runs of the first episode."""
    ranking = Ranking(judged(folder), SHOWN)
    ladder = next(iter(sorted(ranking.ladders, key=lambda each: each == PLAYED)))
    found = ranking.whole(SHOWN.levels.episodes[0], (ladder, FASTEST))
    return [(total, [run.player for run in runs]) for _, total, runs in found]


def test_a_whole_episode_is_ranked_and_its_levels_count_too(runs: Path, tmp_path: Path) -> None:
    path = episode(runs, "Ann", RUNS)
    later = load_replays(RUNS[2])[0]
    slower = tmp_path / "later.replay.txt"
    slower.write_text(write_replay(record_replay(later.level, b"\0" + later.inputs)))
    episode(runs, "Ann", [*RUNS[:2], slower, *RUNS[3:]], "ann-slower")
    played = load_replays(path)
    ticks = sum(each.replay.final_tick for each in played)
    assert whole(runs) == [(ticks, ["Ann"] * 5)]
    assert {run.entry.digest for run in judged(runs).runs} == {each.replay.level_digest for each in played}
    board(runs, PACK, "--site", str(tmp_path / "site"))
    page = (tmp_path / "site" / "board" / "episodes.html").read_text("utf-8")
    assert "in one recording" in page
    assert "Episodes</a>" in page
    (tmp_path / "rules.toml").write_text('[[category]]\nname = "Most"\nrank = ["-score"]\nepisodes = true\n')
    board(runs, PACK, "--site", str(tmp_path / "most"), "--rules", str(tmp_path / "rules.toml"))
    heads = [
        re.findall(
            "<th[^>]*>([^<]+)", (tmp_path / out / "board" / "episodes.html").read_text().partition("</thead>")[0]
        )
        for out in ("site", "most")
    ]
    assert heads == [[*EPISODE_HEADS], [each for each in EPISODE_HEADS if each != "Sum"]], (
        "a sum of scores is no number"
    )
    assert "Score: 90 s, and 2 s for each piece of gold" in page
    assert f"{(played[4].lifetime + 80 * played[4].replay.gold - played[4].replay.final_tick) / 40:.3f}" in page


def test_an_episode_of_runs_that_were_sent_before_counts_for_who_sent_them(runs: Path) -> None:
    for each in RUNS:
        (runs / each.name).write_text(each.read_text())
    author = load_replays(RUNS[0])[0].author
    episode(runs, author, RUNS, "whole")
    assert [players for _, players in whole(runs)] == [[author] * 5]


def test_an_episode_of_own_runs_has_no_copies(runs: Path, tmp_path: Path) -> None:
    """Also where it comes with them, under a name before theirs; its levels keep their dates in the ledger."""
    data, pages = tmp_path / "board.json", tmp_path / "site"
    author = load_replays(RUNS[0])[0].author
    for each in RUNS:
        (runs / each.name).write_text(each.read_text())
    board(runs, PACK, "--json", str(data))
    episode(runs, author, RUNS, "0")
    output = board(runs, PACK, "--check", str(data), "--site", str(pages))
    assert f"new: 0.episode.txt: an episode in which {author} plays 5 levels as in an earlier run\n" in output
    assert "copy" not in output
    found = judged(runs)
    assert (len(found.runs), found.rejected, len(found.again)) == (5, (), 5)
    assert "in one recording" in (pages / "board" / "episodes.html").read_text("utf-8")
    assert "0.episode.txt" not in (pages / "board" / "rejected.html").read_text("utf-8")
    board(runs, PACK, "--json", str(data))
    rows = json.loads(data.read_text("utf-8"))["rejected"]
    assert [(row["kind"], bool(row["way"] and row["added"])) for row in rows] == [("own", True)] * 5
    assert board(runs, PACK, "--check", str(data)).startswith("nothing has changed")


def test_one_run_of_another_player_makes_no_episode(runs: Path) -> None:
    (runs / "ann.txt").write_text(RUNS[2].read_text())
    episode(runs, "bob", RUNS)
    found = judged(runs)
    assert [(each.kind, each.record) for each in found.rejected] == [("copy", 2)]
    assert whole(runs) == []


@pytest.mark.parametrize("chosen", [RUNS[:4], [*RUNS[:4], RUNS[3]], RUNS[::-1]], ids=["four", "twice", "backwards"])
def test_levels_that_are_no_episode_are_refused(chosen: list[Path], runs: Path) -> None:
    episode(runs, "Ann", chosen)
    found = judged(runs)
    assert not found.runs
    assert {each.why for each in found.rejected} == {"its levels, in this order, are no episode that counts"}


def test_what_is_remembered_is_what_was_judged(runs: Path, tmp_path: Path) -> None:
    episode(runs, "Ann", RUNS)
    memo = Memo(tmp_path / "memo.json")
    first = judged(runs, memo)
    memo.save()
    again = judged(runs, Memo(tmp_path / "memo.json"))
    assert [run.key for each in again.episodes.values() for found in each for run in found]
    assert again.episodes == first.episodes
