"""The board as data, and what a change of the folder does to it: for the automatic checks of a repository."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ninja_game.errors import FormatError
from ninja_game.files.reading import read_utf8
from ninja_game.files.shown_text import shown_text
from ninja_game.play.ui.text_layout import counted
from ninja_game.player.scoring import seconds_text
from ninja_game.web.board.ranking import ORDERS, Ranking
from ninja_game.web.board.runs import Apart, Judged, Run

VERSION = 1

IN_WORDS = {"practice": "of practice", "copy": "copied", "refused": "refused", "unreadable": "unreadable"}

Key = tuple[str, int]
Rows = dict[Key, dict[str, Any]]


def board_data(judged: Judged) -> dict[str, Any]:
    """The board as plain values: nothing in it depends on time or machine."""
    runs = sorted(judged.runs, key=lambda run: run.key)
    return {"version": VERSION, "runs": list(map(_run_data, runs)), "apart": list(map(_apart_data, judged.apart))}


def _run_data(run: Run) -> dict[str, Any]:
    return {
        "file": run.file, "record": run.record, "player": run.player, "level": run.entry.digest,
        "level_name": run.entry.title, "tick": run.tick, "gold": run.gold, "score": run.score,
    }  # fmt: skip


def _apart_data(apart: Apart) -> dict[str, Any]:
    return {"file": apart.file, "record": apart.record, "kind": apart.kind, "why": apart.why}


def board_text(judged: Judged) -> str:
    """The same as JSON, a run a line, so that a difference of two reads well."""
    data = board_data(judged)
    lines = {key: ",\n".join("  " + json.dumps(row) for row in data[key]) for key in ("runs", "apart")}
    return f'{{"version": {VERSION}, "runs": [\n{lines["runs"]}\n], "apart": [\n{lines["apart"]}\n]}}\n'


def read_board(path: Path) -> tuple[Rows, Rows]:
    """The runs and what is apart in a file of ``board_text``, by file and record. Raises FormatError, OSError."""
    try:
        data = json.loads(read_utf8(path))
        if data["version"] != VERSION:
            raise FormatError("a board of an unknown version", str(path), found=str(data["version"])[:20])
        runs, apart = (
            {(str(row["file"]), int(row["record"])): dict(row) for row in data[key]} for key in ("runs", "apart")
        )
    except (ValueError, TypeError, KeyError, RecursionError, OverflowError):
        raise FormatError("not a board", str(path), expected="a file that `ninja-game board --json` wrote") from None
    return runs, apart


def changes(ranking: Ranking, before: tuple[Rows, Rows]) -> Iterator[tuple[bool, str]]:
    """What is different from the board before: whether it may be, and a line about it."""
    runs, apart = before
    now = {run.key: _run_data(run) for run in ranking.judged.runs}
    for run in sorted(ranking.judged.runs, key=lambda run: run.key):
        if run.key not in runs:
            yield True, f"new: {_place(run.key)}: {_achieved(ranking, run)}"
        elif now[run.key] != runs[run.key]:
            yield False, f"changed: {_place(run.key)}: {_achieved(ranking, run)}"
    here = set(now) | {(each.file, each.record) for each in ranking.judged.apart}
    for each in ranking.judged.apart:
        key = each.file, each.record
        if key not in apart or apart[key].get("why") != each.why:
            yield each.kind == "practice", f"{each.kind}: {_place(key)}: {plain(each.why)}"
    for key, row in sorted(runs.items()):
        if key not in here:
            yield False, f"gone: {_place(key)}: {plain(str(row.get('player')))} on {plain(str(row.get('level_name')))}"


def _achieved(ranking: Ranking, run: Run) -> str:
    """What a run is worth, in words."""
    text = f"{plain(run.player)} passes {plain(run.entry.title)} in {seconds_text(run.tick)} s with {run.gold} gold"
    for kind in ORDERS:
        table = ranking.tables[run.entry.digest][kind]
        place = next((each.place for each in table if each.run is run), 0)
        if place == 1:
            text += f"; the {kind}"
        elif place:
            text += f"; {kind}: place {place} of {len(table)}"
    if run.medal:
        text += f"; {run.medal} medal"
    return f"{text}; note: {plain(run.remark)}" if run.remark else text


def _place(key: Key) -> str:
    file, record = key
    return plain(file) + (f", record {record}" if record else "")


def plain(text: str) -> str:
    """A text of a stranger in a line of a report, which may stand in Markdown between fences."""
    return shown_text(text, 300).replace("`", "'")


def summary(judged: Judged) -> str:
    """All of it in a line."""
    players, levels = {run.player for run in judged.runs}, {run.entry.digest for run in judged.runs}
    counts = ("run", judged.runs), ("player", players), ("level", levels)
    runs, by, on = (counted(len(each), name, f"{name}s") for name, each in counts)
    kinds = Counter(each.kind for each in judged.apart)
    apart = ", ".join(f"{kinds[kind]} {IN_WORDS[kind]}" for kind in sorted(kinds))
    return f"{runs} by {by} on {on}; apart: {apart or 'none'}"
