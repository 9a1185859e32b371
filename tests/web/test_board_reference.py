"""The reference recordings as a board: all of them, each as it was, in a minute."""

import time
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest

from ninja_game.board.judge import judge
from ninja_game.board.ranking import Ranking
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import write_replay
from ninja_game.levels.published import published_levels
from ninja_game.runs.conversion import recorded_again
from ninja_game.web.board.pages import BoardPages
from tests.support.reference import recordings, require_reference, write_pack

SECONDS = 60  # of processor time on all cores: the machine of a test does other things too


@pytest.mark.slow
def test_all_recordings_are_a_board_within_a_minute(tmp_path: Path) -> None:
    require_reference()
    (tmp_path / "runs").mkdir()
    rows = {f"{row.row:04d}.txt": row for row in recordings()}
    for name, row in rows.items():
        (recording,) = parse_replays(f"$run###{row.data}#{row.demo}#")
        recorded = replace(recorded_again(recording), author=row.source)  # a record of N names no player
        (tmp_path / "runs" / name).write_text(write_replay(recorded), "utf-8")
    pack = write_pack(tmp_path / "levels")
    start = time.process_time()
    shown = published_levels(pack)
    ranking = Ranking(judge(tmp_path / "runs", shown), shown)
    BoardPages(tmp_path / "site", ranking).write()
    used = time.process_time() - start
    judged = ranking.judged
    assert len(judged.runs) + len(judged.rejected) == len(rows) == 1108
    for run in judged.runs:
        row = rows[run.file]
        assert (run.tick, run.gold, run.score, run.player) == (row.end_tick, row.gold, row.score_ticks, row.source)
    reasons = ("no keyboard can", "not one of the levels that count", "a copy of", "the same run")
    whys = Counter(next((each for each in reasons if each in rejected.why), "") for rejected in judged.rejected)
    assert set(whys) <= set(reasons)
    assert whys["no keyboard can"] == 19
    assert all(rows[each.file].source != "rta" for each in judged.rejected if reasons[0] in each.why)
    assert len(list((tmp_path / "site" / "board" / "levels").iterdir())) == len(shown.entries) + len(ranking.by_level)
    assert used <= SECONDS
