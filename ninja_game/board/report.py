"""The board as data, also used as its ledger, and the effects of a change of the folder, for a repository's checks."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from datetime import UTC, datetime, timedelta
from functools import lru_cache
from pathlib import Path
from typing import Any

from ninja_game.board.players import folded
from ninja_game.board.ranking import Ranking
from ninja_game.board.runs import (
    ASSISTED,
    DECISIONS,
    NO_LEDGER,
    OWN,
    PLAYED,
    REJECTED,
    REJECTED_KINDS,
    UNKNOWN_PLAYER,
    Dates,
    Decision,
    Ledger,
    Run,
    RunKey,
    RunRows,
    ValidatedRuns,
)
from ninja_game.errors import ArgumentError, FormatError
from ninja_game.files.reading import read_utf8
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.formats.run_time import seconds_text

VERSION = 2
DATE = "%Y-%m-%dT%H:%M:%SZ"
MAX_REASON = 300  # characters

_FIELDS: dict[str, dict[str, type]] = {
    "runs": {
        "file": str, "record": int, "player": str, "level": str, "level_name": str,
        "tick": int, "gold": int, "score": int, "way": str, "added": str,
    },
    "rejected": {"file": str, "record": int, "kind": str, "why": str, "way": str, "added": str},
    "withdrawn": {"level": str, "way": str, "player": str, "added": str},
    "decisions": {"level": str, "way": str, "file": str, "player": str, "what": str, "reason": str, "added": str},
}  # fmt: skip

MAX_NAMED = 3  # files that wait, in the last line
_KEPT = {"near": str, "untrusted": str, "confirmed": bool, "taken": str}  # a withdrawn one keeps it


def _run_data(run: Run) -> dict[str, Any]:
    return {
        "file": run.file, "record": run.record, "player": run.player, "level": run.level,
        "level_name": run.entry.title, "tick": run.tick, "gold": run.gold, "score": run.score,
        "way": run.way, "added": run.added,
        **{key: value for key in ("made", *_KEPT) if (value := getattr(run, key))},
    }  # fmt: skip


def board_text(judged: ValidatedRuns, before: Ledger = NO_LEDGER) -> str:
    """A board as JSON, a run per line, so that differences read well; only its dates depend on time.

    ``before``: its ledger; a run there whose file does not count or cannot be read now keeps its positions' digest and
    date, and one that has counted stays its player's.
    """
    data = {"runs": [_run_data(run) for run in sorted(judged.runs, key=lambda run: run.key)]}
    counting = {run.key for run in judged.runs}
    rejected = {
        (item.file, item.record): {key: getattr(item, key) for key in _FIELDS["rejected"]}
        for item in (*judged.rejected, *judged.again)
    }
    for key, old in (before.rejected | before.runs).items():
        whole = rejected.get((key[0], 0), {})
        row = rejected.get(key) or (whole if whole.get("kind") == "unreadable" else {})
        if old["way"] and key not in counting and row and row["kind"] not in ("copy", OWN):
            rejected[key] = row | {"record": key[1], "way": old["way"], "added": old["added"]}
    data["rejected"] = [rejected[key] for key in sorted(rejected)]
    ways = {(run.level, run.way) for run in judged.runs}
    names = (*_FIELDS["withdrawn"], *_KEPT)
    withdrawn = sorted((way, row) for way, row in before.owners.items() if way not in ways)
    data["withdrawn"] = [{name: row[name] for name in names if name in row} for _, row in withdrawn]
    data["decisions"] = [decision._asdict() for _, decision in sorted(before.decisions.items())]
    parts = (f'"{key}": [\n' + ",\n".join("  " + json.dumps(row) for row in data[key]) + "\n]" for key in _FIELDS)
    return f'{{"version": {VERSION}, {", ".join(parts)}}}\n'


def read_board(path: Path, now: datetime) -> Ledger:
    """The ledger in a file of ``board_text``. Raises FormatError, OSError."""
    try:
        data = json.loads(read_utf8(path))
        if data["version"] != VERSION:
            found = f"version {str(data['version'])[:20]}"
            hint = "to start again, remove it: all runs get one date then, and go by the names of their files"
            raise FormatError("a board of another version", str(path), found=found, expected=str(VERSION), hint=hint)
        for part in ("withdrawn", "decisions"):  # absent in early ledgers
            data.setdefault(part, [])
        runs, rejected, withdrawn, decided = (_rows(path, key, data[key], now) for key in _FIELDS)
        decisions = [Decision(*(row[key] for key in _FIELDS["decisions"])) for row in decided.values()]
        return Ledger(runs, rejected, withdrawn, {decision.key: decision for decision in decisions})
    except (ValueError, TypeError, KeyError, RecursionError):
        raise FormatError("not a board", str(path), expected="a file that `ninja-game board --json` wrote") from None


def _rows(path: Path, part: str, rows: list[dict[str, Any]], now: datetime) -> RunRows:
    """The rows of a part of a board by their first two fields. Raises FormatError for an invalid one."""
    first, second, *_ = _FIELDS[part]
    if not isinstance(rows, list):
        raise FormatError(f"{part!r} is of the wrong type", str(path), expected="a list of rows")
    rows_by_key: RunRows = {}
    for number, row in enumerate(rows, 1):
        place = f"row {number} of {part!r}"
        for name, kind in (_FIELDS[part] | {key: kind for key, kind in _KEPT.items() if key in row}).items():
            if type(row[name]) is not kind:
                raise FormatError(f"{place}: {name!r} is of the wrong type", str(path), expected=kind.__name__)
        for date in filter(None, (row["added"], row.get("taken"))):
            if not _is_date(date, now):
                expected = "a date in the past as in 2026-01-31T12:00:00Z"
                raise FormatError(f"{place}: not a date", str(path), found=repr(date[:40]), expected=expected)
        if row.get("what", REJECTED) not in DECISIONS:
            expected = ", ".join(DECISIONS)
            raise FormatError(
                f"{place}: 'what' is no decision", str(path), found=escaped(row["what"]), expected=expected
            )
        # A decision is about a level, a way and a player.
        key = row[first], (row["way"], folded(row["player"])) if part == "decisions" else row[second]
        if key in rows_by_key:
            raise FormatError(f"{place}: given twice", str(path), found=escaped(key[0]))
        rows_by_key[key] = row
    return rows_by_key


@lru_cache(4096)
def _is_date(text: str, now: datetime) -> bool:
    """Whether a text is a date in the format DATE, not in the future."""
    try:
        date = datetime.strptime(text, DATE).replace(tzinfo=UTC)
    except ValueError:
        return False
    return date.strftime(DATE) == text and date < now + timedelta(days=1)


def moderate(
    ledger: Ledger,
    now: datetime,
    runs: Sequence[Run],
    files: Collection[str],
    *,
    decisions: Sequence[tuple[str, str]],
    reason: str,
    tell: Callable[[str], object],
) -> None:
    """Write the keeper's decisions on the runs of ``files`` into a ledger.

    ``decisions``: a file, a folder that ends in / or a player, and one of DECISIONS. ``tell``: how many runs they move
    to a ladder, in a line for each. Raises ArgumentError for one
    without such runs, and for a reason that is too long, or missing where a run is rejected.
    """
    if len(reason) > MAX_REASON or (not reason and any(what == REJECTED for _, what in decisions)):
        raise ArgumentError(f"--reject: say why with --reason, in at most {MAX_REASON} characters")
    for name, what in decisions:
        rows = _rows_of(name, _decidable(ledger, runs, files, what), what)
        if what in (PLAYED, ASSISTED):
            tell(f"ranked as {what}: {counted(len(rows), 'run')} of {escaped(name)}")
        for row in rows:
            run = row["level"], row["way"], row["file"], row["player"]
            decision = Decision(*run, what, reason, now.strftime(DATE))
            ledger.decisions[decision.key] = decision


def check_confirmed(judged: ValidatedRuns, confirm: Collection[str]) -> None:
    """Raise ArgumentError for a file to confirm without runs that waited."""
    if unknown := {*confirm} - {run.file for run in judged.runs if run.confirmed}:
        raise _no_run(min(unknown), [run.file for run in judged.runs if run.waits], "--confirm", "that waits")


def _decidable(ledger: Ledger, runs: Sequence[Run], files: Collection[str], what: str) -> list[dict[str, Any]]:
    """A row for each run to decide on: for its file's present content, not an earlier one.

    For a deleted file its rows of the ledger. No run is played that no keyboard can do.
    """
    present = [_run_data(run) for run in runs if not run.kind or what != PLAYED]
    earlier = *ledger.runs.values(), *(decision._asdict() for decision in ledger.decisions.values())
    return present + [row for row in earlier if row["file"] not in files]


def _rows_of(name: str, rows: Sequence[dict[str, Any]], what: str) -> list[dict[str, Any]]:
    """The rows of a file or folder, else of a player. Raises ArgumentError for none."""
    in_it = [row for row in rows if row["file"] == name or (name.endswith("/") and row["file"].startswith(name))]
    if chosen := in_it or [row for row in rows if folded(row["player"]) == folded(name)]:
        return chosen
    which = f"in that {'folder' if name.endswith('/') else 'file'}, or by that player"
    raise _no_run(name, [row["file"] for row in rows], what, which)


def _no_run(name: str, files: Sequence[str], what: str, which: str) -> ArgumentError:
    """The error for a name without runs, with the files that have some."""
    some = ", ".join(dict.fromkeys(map(escaped, files[:10]))) or "none"
    return ArgumentError(f"{what} {name!a}: no run of the ledger {which}; there are: {some}")


def read_dates(path: Path, now: datetime) -> dict[str, str]:
    """Dates by file, from rows FILE,DATE, with or without a head. Raises FormatError, FileError, OSError."""
    dates: dict[str, str] = {}
    for number, row in enumerate(read_utf8(path).splitlines(), 1):
        file, _, day = map(str.strip, row.rpartition(","))
        if number == 1 and (file.upper(), day.upper()) == ("FILE", "DATE"):
            continue
        date = f"{day}T00:00:00Z" if len(day) == len("2026-01-31") else day
        if file in dates or not _is_date(date, now):
            expected = "FILE,DATE, once for a file, with a date in the past as 2026-01-31 or 2026-01-31T12:00:00Z"
            raise FormatError(f"row {number}: no date of a file", str(path), found=escaped(row), expected=expected)
        dates[file] = date
    return dates


def dates_of(before: Ledger, now: datetime, dates_by_file: Mapping[str, str]) -> tuple[Dates, Dates]:
    """``added`` and ``taken`` of runs. One that the ledger does not have, or not with this path, is added now.

    ``dates_by_file``: take the place of the ledger's, where they are noted, with when the board took in these runs.
    """
    for row in before.runs.values():
        if date := dates_by_file.get(row["file"]):
            row |= {"taken": row.get("taken", row["added"]), "added": date}
    rows, today = before.rejected | before.runs, now.strftime(DATE)

    def known(key: RunKey, way: str) -> Mapping[str, Any]:
        row = rows.get(key, {})
        return row if row.get("way") == way else {"added": today}

    def added(key: RunKey, way: str) -> str:
        return dates_by_file.get(key[0]) or str(known(key, way)["added"])

    def taken(key: RunKey, way: str) -> str:
        row = known(key, way)
        return str(row.get("taken", row["added"] if key[0] in dates_by_file else ""))

    return added, taken


def board_news(ranking: Ranking, before: Ledger) -> Iterator[tuple[bool, str]]:
    """Each difference from the board before: whether it is allowed, and a line about it."""
    runs, rejected, *_ = before
    now = {run.key: _run_data(run) for run in ranking.judged.runs}
    for run in sorted(ranking.judged.runs, key=lambda run: run.key):
        if run.key not in runs:
            yield True, f"new: {_place(run.key)}: {_achieved(ranking, run)}"
        elif now[run.key] | (waits := {"near": "", "untrusted": ""}) != runs[run.key] | waits:
            yield False, f"changed: {_place(run.key)}: {_achieved(ranking, run)}"
    new = [item for item in ranking.judged.again if (item.file, item.record) not in rejected]
    for (file, player), levels in Counter((item.file, item.player) for item in new).items():
        what = counted(levels, "level")
        yield True, f"new: {escaped(file)}: an episode in which {escaped(player)} plays {what} as in an earlier run"
    for item in ranking.judged.rejected:
        key = item.file, item.record
        if key not in rejected or rejected[key].get("why") != item.why:
            yield item.kind == "practice", f"{item.kind}: {_place(key)}: {escaped(item.why)}"
    yield from ((False, line) for line in lines_of_gone(ranking, before))


def lines_of_gone(ranking: Ranking, before: Ledger) -> Iterator[str]:
    """Lines about runs of a ledger whose files are gone, with the present leaders of their levels."""
    judged = ranking.judged
    present = {run.key for run in judged.runs} | {(item.file, item.record) for item in judged.rejected + judged.again}
    for key, row in sorted(before.runs.items()):
        if key not in present:
            leaders = [
                f"{ranking.leaderboard_name(board)} {escaped(ranked.run.player)}, {board[1].text(ranked.values[0])}"
                for board, table in ranking.tables.get(row["level"], {}).items()
                for ranked in table
                if ranked.place == 1
            ]
            first = f"first now: {'; '.join(leaders) or 'nobody'}"
            yield f"gone: {_place(key)}: {escaped(row['player'])} on {escaped(row['level_name'])}; {first}"


def _achieved(ranking: Ranking, run: Run) -> str:
    """Time, gold, places, medal and remark of a run in a line."""
    text = f"{escaped(run.player)} passes {escaped(run.entry.title)} in {seconds_text(run.tick)} s with {run.gold} gold"
    for (ladder, category), table, number in ranking.places.get(run.key, ()):
        if place := table[number].place:
            text += f"; {'' if ladder == PLAYED else 'assisted, '}{category.name}: place {place} of {len(table)}"
    if run.medal:
        text += f"; {run.medal} medal"
    return f"{text}; note: {escaped(run.remark)}" if run.remark else text


def _place(key: RunKey) -> str:
    file, record = key
    return escaped(file) + (f", record {record}" if record else "")


def escaped(text: str) -> str:
    """An untrusted text in a line of a report, safe in Markdown between fences."""
    return shown_text(text, 300).replace("`", "'")


def unnamed_hint(judged: ValidatedRuns) -> str:
    """Advice on naming the players of nameless runs, such as demos of N; "" where all runs have a name."""
    nameless = sum(run.player.startswith(UNKNOWN_PLAYER) for run in judged.runs)
    how = "name their players with: ninja-game convert FILE OUT --to replay --author NAME"
    return f"{counted(nameless, 'run')} by unknown players; {how}" if nameless else ""


def counts(judged: ValidatedRuns) -> str:
    players, levels = {run.player for run in judged.runs}, {run.level for run in judged.runs}
    runs = counted(len(judged.runs), "run")
    return f"{runs} by {counted(len(players), 'player')} on {counted(len(levels), 'level')}"


def summary(judged: ValidatedRuns) -> str:
    kinds = Counter(item.kind for item in judged.rejected)
    rejected = ", ".join(f"{kinds[kind]} {REJECTED_KINDS[kind][0]}" for kind in sorted(kinds))
    near = [run.file for run in judged.runs if run.waits]
    files = [f"--confirm {escaped(file)}" for file in dict.fromkeys(near)]
    some = " ".join([*files[:MAX_NAMED], *(["..."] if len(files) > MAX_NAMED else [])])
    waits = f"; {counted(len(near), 'waits', 'wait')} for confirmation: {some}" if near else ""
    return f"{counts(judged)}; rejected: {rejected or 'none'}{waits}"
