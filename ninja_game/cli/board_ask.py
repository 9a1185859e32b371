"""`board ask`: what a board knows about a level, and about players on it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli.board_ranking import levels_option, ranking_of, rules_option
from ninja_game.cli.options import OLD_FILE, OLD_FOLDER, jobs_option, output_option
from ninja_game.cli.tables import as_json, draw, show, table_of
from ninja_game.cli.terminal import size_note, use_dummy_video
from ninja_game.errors import ArgumentError
from ninja_game.files.shown_text import shown_text

if TYPE_CHECKING:
    from ninja_game.board.categories import Category
    from ninja_game.board.ranking import Ranked, Ranking
    from ninja_game.formats.recording import Recording
    from ninja_game.levels.episodes import Entry

QUESTIONS = ("rank", "best", "inputs", "splits", "trace", "film")
MAX_RUNS = 5  # side by side, where no players are named
_MAX_LINE = 400  # characters of a line

RANKED = "{place}. {player}: {result} ({ticks} ticks, {gold} gold, {made}) {date}"
TYPED = (
    "{player}: {ticks} ticks, {presses} presses, {jumps} jumps; ticks left {left}, right {right}, neither {neither}, "
    "jump {jump}; {strokes} strokes, the longest {longest} ticks\n{keys}"
)


@click.command()
@click.argument("folder", type=OLD_FOLDER)
@click.argument("what", type=click.Choice(QUESTIONS))
@click.argument("level")
@click.argument("players", nargs=-1)
@levels_option
@rules_option
@click.option(
    "--ledger",
    metavar="FILE",
    type=OLD_FILE,
    help="The file that `ninja-game board --json` wrote, for the dates, and for whose a run is.",
)
@click.option("--category", metavar="NAME", help="One of the board's, or a part of its name. [default: the first]")
@click.option("--assisted", is_flag=True, help="The ladder of runs that were edited or searched.")
@output_option("The picture, or the film.")
@click.option("--json", "as_data", is_flag=True, help="Answer as JSON.")
@jobs_option
def ask(
    folder: Path, what: str, level: str, players: Sequence[str], levels: Path | None, rules: Path | None,
    ledger: Path | None, category: str | None, assisted: bool, output: Path | None, as_data: bool, jobs: int | None,
) -> None:  # fmt: skip
    """Ask the board of a folder about a level, and about players on it (default: the first five).

    LEVEL is a title, a number as 03-1, the name of a file, or the beginning of a digest. WHAT is one of: rank, the
    table; best, its first row; inputs, the keys as text and how often each is down; splits; trace, the paths as a
    picture; film, the first run with the others as ghosts. A player of both ladders is asked for as "Ann, assisted".
    Nothing is simulated that an earlier command on the same folder has simulated.

    \b
    Examples:
      ninja-game board ask replays/ rank 00-0 --json
      ninja-game board ask replays/ splits "First Steps" Ann Bob
      ninja-game board ask replays/ film 00-0 Ann Bob -o both.gif
    """
    from ninja_game.board.runs import ASSISTED, PLAYED

    if what in ("trace", "film") and not output:
        raise click.UsageError(f"{what}: name the file with -o")
    ranking, _ = ranking_of(folder, levels, rules, ledger, jobs=jobs)
    entry = _level(level, list(ranking.shown.entries.values()))
    chosen = _category(ranking, category)
    tables = ranking.tables.get(entry.digest, {})
    table, other = (tables.get((ladder, chosen), []) for ladder in sorted((PLAYED, ASSISTED), reverse=not assisted))
    rows = [_of_player([*table, *other], player) for player in players] or table[: None if what == "rank" else MAX_RUNS]
    if what == "rank":
        rows = [*rows, *ranking.waiting(entry.digest, (ASSISTED if assisted else PLAYED, chosen), rows)]
    if not rows:
        ladder, way = ("played", "without") if assisted else ("assisted", "with")
        hint = f"; {ladder}: {len(other)}, {way} --assisted" if other else ""
        raise ArgumentError(f"nobody has a run in {chosen.name!r} on {shown_text(entry.title)} yet{hint}")
    _answer(what, rows[:1] if what == "best" else rows, chosen, output, as_data=as_data, keep=[folder])
    if other and not (assisted or players or as_data) and other[0].place and other[0].values < table[0].values:
        result, player = chosen.text(other[0].values[0]), other[0].run.player
        click.echo(shown_text(f"assisted: {result} by {player} (--assisted)", _MAX_LINE))


def _answer(
    what: str, ranks: Sequence[Ranked], category: Category, output: Path | None, *, as_data: bool, keep: Sequence[Path]
) -> None:
    from ninja_game.formats.recording import Recording
    from ninja_game.runs.splits import run_splits

    rows: Any = [_row(ranked, category) for ranked in ranks]
    form = RANKED
    ladders = sorted({ranked.run.ladder for ranked in ranks}, reverse=True)
    names = [f"{row.run.player}, {row.run.ladder}" if len(ladders) > 1 else row.run.player for row in ranks]
    runs = [
        Recording(ranked.run.entry.named.level, replace(ranked.run.replay, name=name))
        for ranked, name in zip(ranks, names, strict=True)
        if what not in ("rank", "best")
    ]
    if what == "inputs":
        form = TYPED
        rows = [row | _inputs(run.inputs) for row, run in zip(rows, runs, strict=True)]
    elif what == "splits":
        table = table_of([run_splits(run, memory="auto") for run in runs], [])
        if not as_data:
            show([table])
            return
        rows = as_json(*table)
    elif output:
        if what == "trace":
            positions = [run_splits(run, memory="auto").positions for run in runs]
            draw(output, runs[0].level, list(zip((run.name for run in runs), positions, strict=True)), keep)
        else:
            _film(runs, output)
    if as_data:
        click.echo(json.dumps(rows))
    else:
        entry, ladder = ranks[0].run.entry, " and ".join(ladders)
        click.echo(shown_text(f"{entry.number} {entry.title}, {category.name.lower()}, {ladder}:".strip(), _MAX_LINE))
        click.echo("\n".join(_line(form, row | {"player": name}) for row, name in zip(rows, names, strict=True)))


def _line(form: str, row: Mapping[str, Any]) -> str:
    waits = "" if row["counts"] else "waits for confirmation, "
    note = f"; note: {waits}{row['remark']}" if row["remark"] else ""
    text, *keys = form.format(**{**row, "place": row["place"] or "-"}).rstrip().split("\n")
    return "\n".join([shown_text(text + note, _MAX_LINE), *keys])


def _film(runs: Sequence[Recording], output: Path) -> None:
    use_dummy_video()
    from ninja_game.play.replay.film import Film, write_film

    write_film([Film(runs[0], ghosts=tuple(runs[1:]), colours=tuple(range(1, len(runs))), keys=True)], output)
    if note := size_note(output):
        click.echo(f"{shown_text(str(output))}{note}", err=True)


def _level(text: str, entries: Sequence[Entry]) -> Entry:
    """The level of a title, number, file or digest. Raises ArgumentError for an unknown one, and for several."""
    words = text.casefold()
    stems = {entry.digest: Path(entry.named.file).stem.casefold() for entry in entries}
    exact = [entry for entry in entries if words in (entry.title.casefold(), entry.number, stems[entry.digest])]
    matches = exact or [entry for entry in entries if words in entry.title.casefold() or entry.digest.startswith(words)]
    if len(matches) == 1:
        return matches[0]
    named = ", ".join(f"{entry.number} {shown_text(entry.title)}".strip() for entry in (matches or entries)[:5])
    if matches:
        raise ArgumentError(f"{text!a} is several levels: {named}")
    titles = {entry.title.casefold(): entry.title for entry in entries}
    near = ", ".join(shown_text(titles[title]) for title in get_close_matches(words, titles, 5))
    more = ", ..." if len(entries) > 5 else ""
    hint = f"do you mean {near}?" if near else f"it has {len(entries)}: {named}{more}"
    raise ArgumentError(f"{text!a} is no level of the board; {hint}")


def _category(ranking: Ranking, name: str | None) -> Category:
    """The category with this name, else the only one whose name contains it; the first one for None."""
    if name is None:
        return ranking.categories[0]
    words = name.casefold()
    names = {category.name.casefold(): category for category in ranking.categories}
    matches = [names[words]] if words in names else [category for known, category in names.items() if words in known]
    if len(matches) == 1:
        return matches[0]
    what = f"{name!a} is several categories:" if matches else f"no category {name!a}; there are"
    raise ArgumentError(f"{what} {', '.join(known.name for known in matches or ranking.categories)}")


def _of_player(table: Sequence[Ranked], player: str) -> Ranked:
    from ninja_game.board.players import folded

    for ranked in table:
        if folded(player) in (folded(ranked.run.player), folded(f"{ranked.run.player}, {ranked.run.ladder}")):
            return ranked
    players = dict.fromkeys(shown_text(ranked.run.player) for ranked in table)
    near = get_close_matches(player, players, 5) or [*players][:10]
    raise ArgumentError(f"{player!a} has no run there; players: {', '.join(near) or 'none'}")


def _row(ranked: Ranked, category: Category) -> dict[str, Any]:
    run = ranked.run
    return {
        "level": run.entry.digest, "level_name": run.entry.title, "place": ranked.place, "player": run.player,
        "result": category.text(ranked.values[0]), "ticks": run.tick, "gold": run.gold, "score": run.score,
        "presses": run.presses, "jumps": run.jumps, "made": run.made or "unknown", "co_authors": run.co_authors,
        "date": run.day, "file": run.file, "record": run.record, "remark": run.remark, "ladder": run.ladder,
        "counts": not run.waits,
    }  # fmt: skip


def _inputs(inputs: bytes) -> dict[str, int | str]:
    """Ticks with each key down, and spans of the same keys; and the inputs as text."""
    from ninja_game.formats.replay.notations import write_inputs
    from ninja_game.sim.inputs import KEY_LEFT, KEY_RIGHT, KEYS_DOWN, MOVES

    counts = {name: sum(bool(keys & key) for keys in inputs) for name, key in MOVES}
    spans = [len(list(span)) for _, span in groupby(keys & KEYS_DOWN for keys in inputs)]
    neither = sum(not keys & (KEY_LEFT + KEY_RIGHT) for keys in inputs)
    text = "\n".join(write_inputs(inputs))
    return {**counts, "neither": neither, "strokes": len(spans), "longest": max(spans), "keys": text}
