"""`ninja-game board ask`: what a board knows, as text, JSON, pictures and films: for terminals and chat bots."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from difflib import get_close_matches
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli.board_options import levels_option, memo_of, rules_option
from ninja_game.cli.run_options import jobs_option
from ninja_game.cli.splits import as_json, draw, show, table_of
from ninja_game.errors import ArgumentError
from ninja_game.files.shown_text import shown_text

if TYPE_CHECKING:
    from ninja_game.formats.recording import Recording
    from ninja_game.player.catalogue import Entry
    from ninja_game.web.board.ranking import Ranked, Ranking
    from ninja_game.web.board.rules import Category

QUESTIONS = ("rank", "best", "inputs", "splits", "trace", "film")
MOST_RUNS, LONGEST = 5, 400
"""Runs side by side, where no players are named; characters of a line."""

RANKED = "{place}. {player}: {result} ({ticks} ticks, {gold} gold, {made}) {date}"
TYPED = (
    "{player}: {ticks} ticks, {presses} presses, {jumps} jumps; ticks left {left}, right {right}, neither {neither}, "
    "jump {jump}; {strokes} strokes, the longest {longest} ticks"
)
"""Lines of an answer."""


@click.command()
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.argument("what", type=click.Choice(QUESTIONS))
@click.argument("level")
@click.argument("players", nargs=-1)
@levels_option
@rules_option
@click.option(
    "--ledger", metavar="FILE", type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="The file that `ninja-game board --json` wrote, for the dates, and for whose a run is.",
)  # fmt: skip
@click.option("--category", metavar="NAME", help="One of the board's categories. [default: the first]")
@click.option("--assisted", is_flag=True, help="The ladder of runs that were edited or searched.")
@click.option("-o", "--output", type=click.Path(dir_okay=False, path_type=Path), help="The picture, or the film.")
@click.option("--json", "as_data", is_flag=True, help="Answer as JSON.")
@jobs_option
def ask(
    folder: Path, what: str, level: str, players: Sequence[str], levels: Path | None, rules: Path | None,
    ledger: Path | None, category: str | None, assisted: bool, output: Path | None, as_data: bool, jobs: int | None,
) -> None:  # fmt: skip
    """Ask the board of a folder about a level, and about players on it (default: the first five).

    LEVEL is a title, the number of an episode and level (03-1), or the beginning of a digest. WHAT is one of: rank, the
    table; best, its first row; inputs, what the keys do; splits; trace, the paths as a picture; film, the first run
    with the others as ghosts. Nothing is simulated that an earlier command on the same folder has simulated.

    \b
    Examples:
      ninja-game board ask replays/ rank 00-0 --json
      ninja-game board ask replays/ splits "First Steps" Ann Bob
      ninja-game board ask replays/ film 00-0 Ann Bob -o both.gif
    """
    from ninja_game.files.user_folder import data_folder
    from ninja_game.web.board.ranking import Ranking
    from ninja_game.web.board.report import dates_of, read_board
    from ninja_game.web.board.rules import USUAL, read_categories
    from ninja_game.web.board.runs import ASSISTED, NO_LEDGER, PLAYED, judge
    from ninja_game.web.pages.gallery import published_levels

    if what in ("trace", "film") and not output:
        raise click.UsageError(f"{what}: name the file with -o")
    shown, now = published_levels(levels or data_folder("levels")), datetime.now(UTC)
    entry = _level(level, list(shown.entries.values()))
    memo = memo_of("runs", folder, folder, again=False)
    before = read_board(ledger, now) if ledger else NO_LEDGER
    dates = dates_of(before, now) if ledger else None
    ranking = Ranking(
        judge(folder, shown, dates=dates, jobs=jobs, memo=memo, ledger=before),
        shown,
        read_categories(rules) if rules else USUAL,
    )
    memo.save()
    chosen = _category(ranking, category)
    table = ranking.tables.get(entry.digest, {}).get((ASSISTED if assisted else PLAYED, chosen), [])
    found = [_of_player(table, player) for player in players] or table[: None if what == "rank" else MOST_RUNS]
    if not found:
        raise ArgumentError(f"nobody has a run in {chosen.name!r} on {shown_text(entry.title)} yet")
    _answer(what, found[:1] if what == "best" else found, chosen, output, as_data=as_data, keep=[folder])


def _answer(
    what: str, found: Sequence[Ranked], category: Category, output: Path | None, *, as_data: bool, keep: Sequence[Path]
) -> None:
    from ninja_game.formats.recording import Recording
    from ninja_game.runs.compare import run_splits

    rows: Any = [_row(each, category) for each in found]
    told = RANKED
    replays = [replace(each.run.replay, name=each.run.player) for each in found if what not in ("rank", "best")]
    runs = [Recording(each.run.entry.named.level, replay) for each, replay in zip(found, replays, strict=False)]
    if what == "inputs":
        told, rows = TYPED, [row | _inputs(run.inputs) for row, run in zip(rows, runs, strict=True)]
    elif what == "splits":
        table = table_of([run_splits(each, memory="auto") for each in runs], [])
        if not as_data:
            show([table])
            return
        rows = as_json(*table)
    elif output:
        if what == "trace":
            positions = [run_splits(each, memory="auto").positions for each in runs]
            draw(output, runs[0].level, [(each.name, its) for each, its in zip(runs, positions, strict=True)], keep)
        else:
            _film(runs, output)
    if as_data:
        click.echo(json.dumps(rows))
    else:
        entry, ladder = found[0].run.entry, found[0].run.ladder
        click.echo(shown_text(f"{entry.episode} {entry.title}, {category.name.lower()}, {ladder}:".strip(), LONGEST))
        click.echo("\n".join(_line(told, row) for row in rows))


def _line(told: str, row: Mapping[str, Any]) -> str:
    note = f"; note: {row['remark']}" if row["remark"] else ""
    return shown_text(told.format(**row).rstrip() + note, LONGEST)


def _film(runs: Sequence[Recording], output: Path) -> None:
    import os

    os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
    from ninja_game.play.replay.film import Film, write_film

    write_film(Film(runs[0], ghosts=tuple(runs[1:]), keys=True), output, lambda _: True)


def _level(text: str, entries: Sequence[Entry]) -> Entry:
    """The level that is meant. Raises ArgumentError for none, and for several."""
    words = text.casefold()
    exact = [each for each in entries if words in (each.title.casefold(), each.episode, each.digest)]
    found = exact or [each for each in entries if words in each.title.casefold() or each.digest.startswith(words)]
    if len(found) == 1:
        return found[0]
    named = ", ".join(f"{each.episode} {shown_text(each.title)}".strip() for each in found[:5])
    if found:
        raise ArgumentError(f"{text!a} is several levels: {named}")
    titles = {each.title.casefold(): each.title for each in entries}
    near = [f"; do you mean {shown_text(titles[each])}?" for each in get_close_matches(words, titles, 1)]
    raise ArgumentError("".join([f"{text!a} is no level of the board", *near]))


def _category(ranking: Ranking, name: str | None) -> Category:
    for each in ranking.categories:
        if name is None or each.name.casefold() == name.casefold():
            return each
    raise ArgumentError(f"no category {name!a}; there are {', '.join(each.name for each in ranking.categories)}")


def _of_player(table: Sequence[Ranked], player: str) -> Ranked:
    from ninja_game.web.board.players import folded

    for each in table:
        if folded(each.run.player) == folded(player):
            return each
    raise ArgumentError(
        f"{player!a} has no run there; players: {', '.join(each.run.player for each in table[:10]) or 'none'}"
    )


def _row(ranked: Ranked, category: Category) -> dict[str, Any]:
    run = ranked.run
    return {
        "level": run.entry.digest, "level_name": run.entry.title, "place": ranked.place, "player": run.player,
        "result": category.text(ranked.values[0]), "ticks": run.tick, "gold": run.gold, "score": run.score,
        "presses": run.presses, "jumps": run.jumps, "made": run.made or "unknown", "co_authors": run.co_authors,
        "date": run.day, "file": run.file, "record": run.record, "remark": run.remark,
    }  # fmt: skip


def _inputs(inputs: bytes) -> dict[str, int]:
    """Ticks with each key down, and spans of the same keys."""
    from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT, KEYS_DOWN

    keys = {"left": KEY_LEFT, "right": KEY_RIGHT, "jump": JUMP_HELD}
    counts = {name: sum(bool(each & key) for each in inputs) for name, key in keys.items()}
    spans = [len(list(span)) for _, span in groupby(each & KEYS_DOWN for each in inputs)]
    neither = sum(not each & (KEY_LEFT + KEY_RIGHT) for each in inputs)
    return {**counts, "neither": neither, "strokes": len(spans), "longest": max(spans)}
