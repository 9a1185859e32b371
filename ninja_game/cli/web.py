"""Commands that fill folders for a static host: the site and the board."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import click

from ninja_game.cli.board_options import address_option, levels_option, memo_of, rules_option
from ninja_game.cli.run_options import jobs_option


@click.command()
@click.argument("out", required=False, type=click.Path(file_okay=False, path_type=Path))
@click.option(
    "--pyodide", metavar="FOLDER", type=click.Path(exists=True, file_okay=False, path_type=Path),
    help="The unpacked npm package of Pyodide; by default npm gets it.",
)  # fmt: skip
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
    from platformdirs import user_cache_path

    from ninja_game.files.user_folder import data_folder
    from ninja_game.web.pages.gallery import write_gallery
    from ninja_game.web.pages.published import published_levels
    from ninja_game.web.site.build import build_site

    cache = user_cache_path("ninja-game", appauthor=False)
    folder = out or cache / "site"
    files = build_site(folder, pyodide, cache, address)
    for file in files:
        if file.compressed > 50_000:
            click.echo(f"{file.name:<28} {file.size:>11,} bytes, {file.compressed:>10,} compressed by gzip")
    size, compressed = sum(file.size for file in files), sum(file.compressed for file in files)
    click.echo(f"{f'{folder}: {len(files)} files':<28} {size:>11,} bytes, {compressed:>10,} compressed by gzip")
    gallery = write_gallery(folder, published_levels(data_folder("levels")), address=address)
    click.echo(f"{gallery}: pictures and pages of the game's levels")
    if serve:
        _serve(folder, port)


def _serve(folder: Path, port: int) -> None:
    from ninja_game.web.site.build import site_server

    with site_server(folder, port) as server:
        click.echo(f"http://127.0.0.1:{server.server_port}/ (Ctrl-C ends it)")
        server.serve_forever()


class _Board(click.Command):
    """The command ``board``; ``board ask`` is one of its own."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: click.Context | None = None, **extra: Any
    ) -> click.Context:
        """The context of the command that is meant: ``board`` or ``board ask``."""
        if args[:1] == ["ask"]:
            from ninja_game.cli.board_ask import ask

            return ask.make_context(f"{info_name} ask", args[1:], parent, **extra)
        return super().make_context(info_name, args, parent, **extra)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Tell of the command below it, as groups do."""
        with formatter.section("Commands"):
            formatter.write_dl([("ask", "Ask the board of a folder about a level, and about players on it.")])


@click.command(cls=_Board)
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@levels_option
@click.option(
    "--site", metavar="OUT", type=click.Path(file_okay=False, path_type=Path),
    help="Write the pages into OUT/board and the runs into OUT/replays.",
)  # fmt: skip
@click.option(
    "--json", "data", metavar="FILE", type=click.Path(dir_okay=False, path_type=Path),
    help="Write the board as data, for --check. It is the board's ledger: runs that FILE has already keep their dates.",
)  # fmt: skip
@click.option(
    "--check", metavar="FILE", type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="Report what differs from this file written by --json; exit code 1 if anything is refused, changed or gone.",
)  # fmt: skip
@rules_option
@click.option("--again", is_flag=True, help="Simulate every run, and write every page, also those known from before.")
@jobs_option
@address_option
@click.pass_context
def board(
    ctx: click.Context, folder: Path, levels: Path | None, site: Path | None, data: Path | None, check: Path | None,
    rules: Path | None, again: bool, jobs: int | None, address: str,
) -> None:  # fmt: skip
    """Rank the runs of a folder, all simulated again: tables, pages, checks.

    FOLDER holds replays, as people send them to a repository; nothing in them is believed but the inputs. Runs on
    other levels, with another body, under other rules, practice runs, copies and whatever says something that is not
    so are kept out, with the reason. What was simulated is remembered in your own cache folder, by all that it depends
    on, and not simulated again. `ninja-game site OUT` puts the page with the game next to the board, which shows each
    run. How to keep a board in a repository: docs/board.md.

    \b
    Examples:
      ninja-game board replays/
      ninja-game board replays/ --site public/ --json board.json
      ninja-game board replays/ --check board.json
      ninja-game board replays/ --levels my-pack/ --site public/
      ninja-game board ask replays/ rank 00-0
    """
    import gc

    from ninja_game.files.user_folder import data_folder
    from ninja_game.files.writing import check_output, write_atomically
    from ninja_game.web.board.pages import BoardPages, check_ledger, check_site
    from ninja_game.web.board.ranking import Ranking
    from ninja_game.web.board.report import board_text, changes, dates_of, gone, plain, read_board, summary
    from ninja_game.web.board.rules import USUAL, read_categories
    from ninja_game.web.board.runs import NO_LEDGER, judge
    from ninja_game.web.pages.frame import GAME
    from ninja_game.web.pages.published import published_levels

    if site:
        check_site(site, folder)
    if data:
        check_output(data, keep=[folder])
        check_ledger(data, folder)
    gc.set_threshold(20_000)  # of many runs, all of which stay, a third of the time went into looking for garbage
    now = datetime.now(UTC)
    ledger = check or data
    before = read_board(ledger, now) if ledger and ledger.exists() else NO_LEDGER
    categories = read_categories(rules) if rules else USUAL
    shown = published_levels(levels or data_folder("levels"))
    memo = memo_of("runs", folder, folder, again=again)
    dates = dates_of(before, now) if ledger else None
    judged = judge(folder, shown, dates=dates, jobs=jobs, memo=memo, ledger=before)
    memo.save()
    ranking = Ranking(judged, shown, categories)
    if site:
        BoardPages(site, ranking, memo=memo_of("pages", site, folder, again=again), address=address).write()
        if not (site / GAME).exists():
            click.echo(f"{site} has no page with the game yet: ninja-game site {site}", err=True)
    if data:
        write_atomically(data, board_text(judged, before), keep=[folder])
    if not check:
        for each in judged.rejected:
            click.echo(f"{each.kind}: {plain(each.file)}: {plain(each.why)}")
        for line in gone(judged, before):
            click.echo(line)
        click.echo(summary(judged))
        return
    found = list(changes(ranking, before))
    for _, line in found:
        click.echo(line)
    click.echo(summary(judged) if found else f"nothing has changed: {summary(judged)}")
    ctx.exit(0 if all(allowed for allowed, _ in found) else 1)
