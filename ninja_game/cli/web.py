"""Commands that fill folders for a static host, the site and the board; and `board ask`: what a board knows."""

from __future__ import annotations

import gc
import json
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from difflib import get_close_matches
from functools import partial
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ninja_game.cli.commands import FAILED
from ninja_game.cli.options import NEW_FILE, NEW_FOLDER, OLD_FILE, OLD_FOLDER, InputPath, jobs_option
from ninja_game.cli.tables import as_json, draw, show, table_of
from ninja_game.cli.terminal import size_note, use_dummy_video
from ninja_game.errors import ArgumentError, FileError
from ninja_game.files.shown_text import shown_text
from ninja_game.files.user_folder import cache_folder, data_folder

if TYPE_CHECKING:
    from ninja_game.formats.recording import Recording
    from ninja_game.levels.episodes import Entry
    from ninja_game.web.board.ranking import Ranked, Ranking
    from ninja_game.web.board.rules import Category
    from ninja_game.web.board.runs import Ledger, Run
    from ninja_game.web.pages.memo import Memo

LAST_LEVELS, LAST_LEDGER, LAST_RULES = "/levels", "/ledger", "/rules"  # keys of a memo: no path of a run begins so

rules_option = click.option(
    "--rules",
    metavar="BOARD.TOML",
    type=OLD_FILE,
    help="The categories in which runs are ranked. [default: the fastest, and the highest score]",
)


def memo_of(kind: str, about: Path, folder: Path, *, again: bool) -> Memo:
    """The memo of a folder, ``about``: the runs in ``folder``, or the pages of them.

    Raises FileError for a place in one of the two, where people may put files that are not yours.
    """
    from hashlib import sha256

    from ninja_game.web.board.pages import is_in
    from ninja_game.web.pages.memo import Memo

    name = sha256(str(about.resolve()).encode("utf-8", "surrogateescape")).hexdigest()[:16]
    path = cache_folder() / "board" / f"{kind}-{name}.json"
    if not path.is_absolute() or is_in(path, folder) or is_in(path, about):
        what = "your cache folder has a relative path, or lies in the folder of runs, or of the pages"
        raise FileError(what, str(path), hint="runs are judged by nothing that may come with them: choose another one")
    return Memo(path, again=again)


def _address(_ctx: click.Context, _param: click.Parameter, value: str) -> str:
    from ninja_game.player.settings import RULES

    if not RULES["site"].fits(value):
        raise click.BadParameter("not an address such as https://example.org/game/")
    return value and value.rstrip("/") + "/"


address_option = click.option(
    "--address", metavar="URL", default="", callback=_address,
    help="Where the folder will be: chats that show a preview of a link want whole addresses of pictures.",
)  # fmt: skip

levels_option = click.option(
    "--levels",
    metavar="PACK",
    type=InputPath(),
    help="The levels that count: a pack, a file, a folder or a link of levels. [default: the game's own]",
)


@click.command()
@click.argument("out", required=False, type=NEW_FOLDER)
@click.option(
    "--pyodide", metavar="FOLDER", type=OLD_FOLDER, help="The unpacked npm package of Pyodide; by default npm gets it."
)
@click.option("--serve", is_flag=True, help="Then serve it for this machine, until Ctrl-C.")
@click.option(
    "--port", type=click.IntRange(0, 65535), default=8000, show_default=True, help="Port for --serve; 0: any free port."
)
@address_option
def site(out: Path | None, pyodide: Path | None, serve: bool, port: int, address: str) -> None:
    """Build the game as a page in a browser: a folder for any static host.

    OUT is a new folder, or one that this command has made, which it brings up to date; with --serve it may be left
    out. Nothing in the folder needs a program on the host, and the page loads nothing from elsewhere. Beside the page
    lies a gallery of the levels. docs/browser.md says how to put it online.

    \b
    Examples:
      ninja-game site public
      ninja-game site --serve
      ninja-game site public --pyodide node_modules/pyodide
      ninja-game site public --address https://example.org/game/
    """
    if out is None and not serve:
        raise click.UsageError("name the folder OUT, or give --serve")
    import gzip

    from ninja_game.web.pages.gallery import published_levels, write_gallery
    from ninja_game.web.site.build import build_site, site_server

    folder = out or cache_folder() / "site"
    files = build_site(folder, pyodide, cache_folder(), address)
    weights = {name: (len(content), len(gzip.compress(content, 9))) for name, content in sorted(files.items())}
    size, packed = map(sum, zip(*weights.values(), strict=True))
    heavy = {name: weight for name, weight in weights.items() if weight[1] > 50_000}
    for name, weight in (heavy | {f"{folder}: {len(files)} files": (size, packed)}).items():
        click.echo(f"{name:<28} {weight[0]:>11,} bytes, {weight[1]:>10,} compressed by gzip")
    gallery = write_gallery(folder, published_levels(data_folder("levels")), address=address)
    click.echo(f"{gallery}: pictures and pages of the game's levels")
    if serve:
        with site_server(folder, port) as server:
            click.echo(f"http://127.0.0.1:{server.server_port}/ (Ctrl-C ends it)")
            server.serve_forever()


class _Board(click.Group):
    """A command with an argument, and with commands below it: their names come before the argument."""

    allow_extra_args = False
    allow_interspersed_args = True

    def make_context(self, info_name: Any, args: list[str], parent: Any = None, **extra: Any) -> click.Context:
        """The context of the command meant: one of those below, or this one."""
        if args and args[0] in self.commands:
            return self.commands[args[0]].make_context(f"{info_name} {args[0]}", args[1:], parent, **extra)
        return super().make_context(info_name, args, parent, **extra)


@click.group(cls=_Board, invoke_without_command=True, no_args_is_help=False, subcommand_metavar="")
@click.argument("folder", type=OLD_FOLDER)
@levels_option
@click.option(
    "--site", metavar="OUT", type=NEW_FOLDER, help="Write the pages into OUT/board and the runs into OUT/replays."
)
@click.option(
    "--json",
    "data",
    metavar="FILE",
    type=NEW_FILE,
    help="Write the board as data, for --check. It is the board's ledger: runs that FILE has already keep their dates.",
)
@click.option(
    "--check",
    metavar="FILE",
    type=OLD_FILE,
    help="Report what differs from this file written by --json; exit code 1 if anything is refused, changed or gone.",
)
@click.option(
    "--confirm",
    metavar="RUN",
    multiple=True,
    help="The runs of this file in FOLDER are no copies, although they are nearly somebody else's. Needs --json.",
)
@click.option(
    "--reject",
    metavar="RUN",
    multiple=True,
    help="The runs of this file in FOLDER do not count. Needs --json and --reason.",
)
@click.option(
    "--ladder",
    metavar="RUN LADDER",
    multiple=True,
    type=(str, click.Choice(["played", "assisted"])),
    help="Rank the runs of this file in FOLDER as played or as assisted, whatever they say. Needs --json.",
)
@click.option("--reason", metavar="TEXT", default="", help="Why, for --reject and --ladder: it stands on the pages.")
@click.option(
    "--dates",
    metavar="FILE.csv",
    type=OLD_FILE,
    help="Rows FILE,DATE: since when runs are known, as of an older board. Needs --json, which keeps them.",
)
@rules_option
@click.option("--again", is_flag=True, help="Simulate every run, and write every page, also those known from before.")
@jobs_option
@address_option
def board(
    folder: Path, levels: Path | None, site: Path | None, data: Path | None, check: Path | None, confirm: Sequence[str],
    reject: Sequence[str], ladder: Sequence[tuple[str, str]], reason: str, dates: Path | None, rules: Path | None,
    again: bool, jobs: int | None, address: str,
) -> int:  # fmt: skip
    """Rank the runs of a folder, all simulated again: tables, pages, checks.

    FOLDER holds replays, as people send them to a repository; nothing in them is believed but the inputs. Runs on
    other levels, with another body, under other rules, practice runs, copies and whatever says something that is not
    so are kept out, with the reason. What was simulated is remembered in your own cache folder, by all that it depends
    on, and not simulated again. `ninja-game site OUT` puts the page with the game next to the board, which shows each
    run. How to keep a board in a repository: docs/board.md. A folder that is named ask is given as ./ask.

    \b
    Examples:
      ninja-game board replays/
      ninja-game board replays/ --site public/ --json board.json
      ninja-game board replays/ --check board.json
      ninja-game board replays/ --json board.json --confirm ann/00-0.txt
      ninja-game board replays/ --json board.json --reject bob/00-0.txt --reason "spliced"
      ninja-game board replays/ --json board.json --ladder bob/00-1.txt assisted
      ninja-game board replays/ --levels my-pack/ --site public/
      ninja-game board ask replays/ rank 00-0
    """
    from ninja_game.files.writing import check_output, write_atomically
    from ninja_game.web.board.pages import BoardPages, check_ledger, check_site
    from ninja_game.web.board.report import board_text, changes, gone, moderate, plain, summary, unnamed
    from ninja_game.web.pages.frame import GAME

    keeps = bool(confirm or reject or ladder or dates)
    if keeps and not data:
        raise click.UsageError("--confirm, --reject, --ladder, --dates: name the ledger, which notes it, with --json")
    if site:
        check_site(site, folder)
    if data:
        check_output(data, keep=[folder])
        check_ledger(data, folder)
    decisions = [*((name, "rejected") for name in reject), *ladder]
    decide = partial(moderate, confirm=confirm, decisions=decisions, reason=reason.strip())
    same = keeps or check is not None
    ranking, before = _ranking(
        folder, levels, rules, check or data, jobs=jobs, again=again, decide=decide, dates=dates, same=same
    )
    judged = ranking.judged
    if site:
        BoardPages(site, ranking, memo=memo_of("pages", site, folder, again=again), address=address).write()
        if not (site / GAME).exists():
            click.echo(f"{site} has no page with the game yet: ninja-game site {site}", err=True)
    if data:
        write_atomically(data, board_text(judged, before), keep=[folder])
    if not check:
        for run in judged.rejected:
            click.echo(f"{run.kind}: {plain(run.file)}: {plain(run.why)}")
        for line in gone(ranking, before):
            click.echo(line)
        click.echo(summary(judged))
        if how := unnamed(judged):
            click.echo(how, err=True)
        return 0
    rows = list(changes(ranking, before))
    for _, line in rows:
        click.echo(line)
    click.echo(summary(judged) if rows else f"nothing has changed: {summary(judged)}")
    return 0 if all(allowed for allowed, _ in rows) else FAILED


def _ranking(
    folder: Path,
    levels: Path | None,
    rules: Path | None,
    ledger: Path | None,
    *,
    jobs: int | None,
    again: bool = False,
    decide: Callable[[Ledger, datetime, Sequence[Run], Collection[str]], None] | None = None,
    dates: Path | None = None,
    same: bool = True,
) -> tuple[Ranking, Ledger]:
    """The ranking of a folder's runs by the board's rules, and the earlier ledger with the present decisions.

    ``same``: ``levels`` and ``rules`` that are not given are those of the folder's last board; so is ``ledger`` where
    nothing is decided.
    """
    from ninja_game.web.board.judge import judge
    from ninja_game.web.board.ranking import Ranking
    from ninja_game.web.board.report import dates_of, read_board, read_dates
    from ninja_game.web.board.rules import USUAL, read_categories
    from ninja_game.web.board.runs import NO_LEDGER
    from ninja_game.web.pages.gallery import published_levels

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
    categories = read_categories(rules) if rules else USUAL
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
    judged = judge(folder, shown, dates=added, taken=taken, jobs=jobs, memo=memo, ledger=before, decide=deciding)
    here = {run.file for run in judged.runs} | {run.file for run in judged.rejected + judged.again}
    memo.save()
    if unknown := dates_by_file.keys() - here:
        raise FileError("a file that is not among the runs", str(dates), found=shown_text(min(unknown)))
    return Ranking(judged, shown, categories), before


def _remembered(memo: Memo, key: str) -> Path | None:
    """The file or folder in a memo under a key, if it still exists."""
    last = memo.recall(key)
    return Path(last) if isinstance(last, str) and last and Path(last).exists() else None


NO_DATES = "no ledger: copies are told by the names of files (name it with --ledger)"
QUESTIONS = ("rank", "best", "inputs", "splits", "trace", "film")
MOST_RUNS = 5  # side by side, where no players are named
LONGEST = 400  # characters of a line

RANKED = "{place}. {player}: {result} ({ticks} ticks, {gold} gold, {made}) {date}"
TYPED = (
    "{player}: {ticks} ticks, {presses} presses, {jumps} jumps; ticks left {left}, right {right}, neither {neither}, "
    "jump {jump}; {strokes} strokes, the longest {longest} ticks\n{keys}"
)


@board.command()
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
@click.option("-o", "--output", type=NEW_FILE, help="The picture, or the film.")
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
    from ninja_game.web.board.runs import ASSISTED, PLAYED

    if what in ("trace", "film") and not output:
        raise click.UsageError(f"{what}: name the file with -o")
    ranking, _ = _ranking(folder, levels, rules, ledger, jobs=jobs)
    entry = _level(level, list(ranking.shown.entries.values()))
    chosen = _category(ranking, category)
    tables = ranking.tables.get(entry.digest, {})
    table, other = (tables.get((ladder, chosen), []) for ladder in sorted((PLAYED, ASSISTED), reverse=not assisted))
    rows = [_of_player([*table, *other], player) for player in players] or table[
        : None if what == "rank" else MOST_RUNS
    ]
    if what == "rank":
        rows = [*rows, *ranking.waiting(entry.digest, (ASSISTED if assisted else PLAYED, chosen), rows)]
    if not rows:
        ladder, way = ("played", "without") if assisted else ("assisted", "with")
        hint = f"; {ladder}: {len(other)}, {way} --assisted" if other else ""
        raise ArgumentError(f"nobody has a run in {chosen.name!r} on {shown_text(entry.title)} yet{hint}")
    _answer(what, rows[:1] if what == "best" else rows, chosen, output, as_data=as_data, keep=[folder])
    if other and not (assisted or players or as_data) and other[0].place and other[0].values < table[0].values:
        result, player = chosen.text(other[0].values[0]), other[0].run.player
        click.echo(shown_text(f"assisted: {result} by {player} (--assisted)", LONGEST))


def _answer(
    what: str, ranks: Sequence[Ranked], category: Category, output: Path | None, *, as_data: bool, keep: Sequence[Path]
) -> None:
    from ninja_game.formats.recording import Recording
    from ninja_game.runs.compare import run_splits

    rows: Any = [_row(ranked, category) for ranked in ranks]
    form = RANKED
    ladders = sorted({ranked.run.ladder for ranked in ranks}, reverse=True)
    names = [ranked.run.player + f", {ranked.run.ladder}" * (len(ladders) > 1) for ranked in ranks]
    runs = [
        Recording(ranked.run.entry.named.level, replace(ranked.run.replay, name=name))
        for ranked, name in zip(ranks, names, strict=True)
        if what not in ("rank", "best")
    ]
    if what == "inputs":
        form, rows = TYPED, [row | _inputs(run.inputs) for row, run in zip(rows, runs, strict=True)]
    elif what == "splits":
        table = table_of([run_splits(run, memory="auto") for run in runs], [])
        if not as_data:
            show([table])
            return
        rows = as_json(*table)
    elif output:
        if what == "trace":
            positions = [run_splits(run, memory="auto").positions for run in runs]
            draw(output, runs[0].level, [(run.name, its) for run, its in zip(runs, positions, strict=True)], keep)
        else:
            _film(runs, output)
    if as_data:
        click.echo(json.dumps(rows))
    else:
        entry, ladder = ranks[0].run.entry, " and ".join(ladders)
        click.echo(shown_text(f"{entry.number} {entry.title}, {category.name.lower()}, {ladder}:".strip(), LONGEST))
        click.echo("\n".join(_line(form, row | {"player": name}) for row, name in zip(rows, names, strict=True)))


def _line(form: str, row: Mapping[str, Any]) -> str:
    waits = "" if row["counts"] else "waits for confirmation, "
    note = f"; note: {waits}{row['remark']}" if row["remark"] else ""
    text, *keys = form.format(**{**row, "place": row["place"] or "-"}).rstrip().split("\n")
    return "\n".join([shown_text(text + note, LONGEST), *keys])


def _film(runs: Sequence[Recording], output: Path) -> None:
    use_dummy_video()
    from ninja_game.play.replay.film import Film, write_film

    write_film([Film(runs[0], ghosts=tuple(runs[1:]), keys=True)], output)
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
    hint = f"do you mean {near}?" if near else f"it has {len(entries)}: {named}{', ...' * (len(entries) > 5)}"
    raise ArgumentError(f"{text!a} is no level of the board; {hint}")


def _category(ranking: Ranking, name: str | None) -> Category:
    """The category of a name, or the only one with it as a part of its name; without one the first."""
    if name is None:
        return ranking.categories[0]
    words, names = name.casefold(), {category.name.casefold(): category for category in ranking.categories}
    matches = [names[words]] if words in names else [each for known, each in names.items() if words in known]
    if len(matches) == 1:
        return matches[0]
    what = f"{name!a} is several categories:" if matches else f"no category {name!a}; there are"
    raise ArgumentError(f"{what} {', '.join(known.name for known in matches or ranking.categories)}")


def _of_player(table: Sequence[Ranked], player: str) -> Ranked:
    from ninja_game.web.board.players import folded

    for ranked in table:
        if folded(player) in (folded(ranked.run.player), folded(f"{ranked.run.player}, {ranked.run.ladder}")):
            return ranked
    there = dict.fromkeys(shown_text(ranked.run.player) for ranked in table)
    near = get_close_matches(player, there, 5) or [*there][:10]
    raise ArgumentError(f"{player!a} has no run there; players: {', '.join(near) or 'none'}")


def _row(ranked: Ranked, category: Category) -> dict[str, Any]:
    run = ranked.run
    return {
        "level": run.entry.digest, "level_name": run.entry.title, "place": ranked.place, "player": run.player,
        "result": category.text(ranked.values[0]), "ticks": run.tick, "gold": run.gold, "score": run.score,
        "presses": run.presses, "jumps": run.jumps, "made": run.made or "unknown", "co_authors": run.co_authors,
        "date": run.day, "file": run.file, "record": run.record, "remark": run.remark, "ladder": run.ladder,
        "counts": not run.near,
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
