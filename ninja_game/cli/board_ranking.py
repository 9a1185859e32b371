"""Ranks a folder's runs for the commands of boards: options default to those of the folder's last `board`."""

from __future__ import annotations

import gc
from collections.abc import Callable, Collection, Sequence
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli.options import OLD_FILE, InputPath
from ninja_game.errors import FileError
from ninja_game.files.bundled import data_folder
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import cache_folder

if TYPE_CHECKING:
    from ninja_game.board.memo import Memo
    from ninja_game.board.ranking import Ranking
    from ninja_game.board.runs import Ledger, Run

LAST_LEVELS, LAST_LEDGER, LAST_RULES = "/levels", "/ledger", "/rules"  # keys of a memo: no path of a run begins so

NO_DATES = "no ledger: of two equal runs the first by file name is the original (name a ledger with --ledger)"

levels_option = click.option(
    "--levels",
    metavar="PACK",
    type=InputPath(),
    help="The levels that count: a pack, a file, a folder or a link of levels. [default: the game's own]",
)

rules_option = click.option(
    "--rules",
    metavar="BOARD.TOML",
    type=OLD_FILE,
    help="The board's name, its categories, the ladder of unknown runs. [default: the fastest, and the highest score]",
)


def memo_of(kind: str, about: Path, folder: Path, *, again: bool) -> Memo:
    """The memo of a folder, ``about``: the runs in ``folder``, or the pages of them.

    Raises FileError for a place in one of the two, where people may put files that are not yours.
    """
    from hashlib import sha256

    from ninja_game.board.collect import is_in
    from ninja_game.board.memo import Memo

    name = sha256(str(about.resolve()).encode("utf-8", "surrogateescape")).hexdigest()[:16]
    path = cache_folder() / "board" / f"{kind}-{name}.json"
    if not path.is_absolute() or is_in(path, folder) or is_in(path, about):
        what = "your cache folder has a relative path, or lies in the folder of runs, or of the pages"
        raise FileError(what, str(path), hint="runs are judged by nothing that may come with them: choose another one")
    return Memo(path, again=again)


def ranking_of(
    folder: Path,
    levels: Path | None,
    rules: Path | None,
    ledger: Path | None,
    *,
    jobs: int | None,
    again: bool = False,
    decide: Callable[[Ledger, datetime, Sequence[Run], Collection[str]], None] | None = None,
    confirm: Collection[str] = (),
    dates: Path | None = None,
    same: bool = True,
) -> tuple[Ranking, Ledger]:
    """The ranking of a folder's runs by the board's categories, and the earlier ledger with the present decisions.

    ``same``: missing ``levels`` and ``rules``, and without decisions ``ledger``, are those of the folder's last board.
    """
    from ninja_game.board.categories import BoardRules, read_rules
    from ninja_game.board.judge import Keeping, judge
    from ninja_game.board.ranking import Ranking
    from ninja_game.board.report import dates_of, read_board, read_dates
    from ninja_game.board.runs import NO_LEDGER
    from ninja_game.levels.published import published_levels

    # With many runs, all of which stay in memory, garbage collection took a third of the time.
    gc.set_threshold(20_000)
    now = datetime.now(UTC)
    memo = memo_of("runs", folder, folder, again=False)
    last, kept, ruled = (_remembered(memo, key) for key in (LAST_LEVELS, LAST_LEDGER, LAST_RULES))
    memo.again = again  # of the last board no results are known, only its levels, ledger and rules
    if same:
        levels, rules = levels or last, rules or ruled
    if not decide:
        ledger = ledger or kept
    stated = read_rules(rules) if rules else BoardRules()
    before = read_board(ledger, now) if ledger and ledger.exists() else NO_LEDGER
    if decide:
        memo.note(LAST_LEVELS, str(levels.resolve()) if levels and levels.exists() else "")
        memo.note(LAST_LEDGER, str((ledger or kept or Path()).resolve()) if ledger or kept else "")
        memo.note(LAST_RULES, str(rules.resolve()) if rules else "")
    elif not ledger:
        click.echo(NO_DATES, err=True)
    shown = published_levels(levels or data_folder("levels"))
    dates_by_file = read_dates(dates, now) if dates else {}
    added, taken = dates_of(before, now, dates_by_file) if ledger else (None, None)
    deciding = partial(decide, before, now) if decide else None
    keeping = Keeping(before, added, taken, deciding, confirm, stated.unknown)
    judged = judge(folder, shown, keeping, jobs=jobs, memo=memo)
    present = {run.file for run in judged.runs} | {run.file for run in judged.rejected + judged.again}
    memo.save()
    if unknown := dates_by_file.keys() - present:
        raise FileError("a file that is not among the runs", str(dates), found=shown_text(min(unknown)))
    return Ranking(judged, shown, *stated), before


def _remembered(memo: Memo, key: str) -> Path | None:
    """The file or folder in a memo under a key, if it still exists."""
    last = memo.recall(key)
    return Path(last) if isinstance(last, str) and last and Path(last).exists() else None
