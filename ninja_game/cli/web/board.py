"""`ninja-game board`: a folder of runs as a board."""

from __future__ import annotations

import os
from datetime import UTC, datetime
from pathlib import Path

import click

from ninja_game.cli.run_options import InputPath, jobs_option


@click.command()
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option(
    "--levels", metavar="PACK", type=InputPath(),
    help="The levels that count: a pack, a file, a folder or a link of levels. [default: the game's own]",
)  # fmt: skip
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
@jobs_option
@click.pass_context
def command(
    ctx: click.Context, folder: Path, levels: Path | None, site: Path | None, data: Path | None, check: Path | None,
    jobs: int | None,
) -> None:  # fmt: skip
    """Rank the runs of a folder, all simulated again: tables, pages, checks.

    FOLDER holds replays, as people send them to a repository; nothing in them is believed but the inputs. Runs on
    other levels, with another body, under other rules, practice runs, copies and whatever says something that is not
    so are kept apart, with the reason. `ninja-game site OUT` puts the page with the game next to the board, which shows
    each run. How to keep a board in a repository: docs/board.md.

    \b
    Examples:
      ninja-game board replays/
      ninja-game board replays/ --site public/ --json board.json
      ninja-game board replays/ --check board.json
      ninja-game board replays/ --levels my-pack/ --site public/
    """
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    from ninja_game.files.user_folder import data_folder
    from ninja_game.files.writing import check_output, write_atomically
    from ninja_game.web.board.pages import BoardPages, check_site
    from ninja_game.web.board.ranking import Ranking
    from ninja_game.web.board.report import board_text, changes, dates_of, plain, read_board, summary
    from ninja_game.web.board.runs import judge
    from ninja_game.web.pages.exhibition import exhibition

    if site:
        check_site(site, folder)
    if data:
        check_output(data, keep=[folder])
    now = datetime.now(UTC)
    ledger = check or data
    before = read_board(ledger, now) if ledger and ledger.exists() else ({}, {})
    shown = exhibition(levels or data_folder("levels"))
    judged = judge(folder, shown, dates=dates_of(before, now) if ledger else None, jobs=jobs)
    ranking = Ranking(judged, shown)
    if site:
        BoardPages(site, ranking).write()
        if not (site / "index.html").exists():
            click.echo(f"{site} has no page with the game yet: ninja-game site {site}", err=True)
    if data:
        write_atomically(data, board_text(judged), keep=[folder])
    if not check:
        for each in judged.apart:
            click.echo(f"{each.kind}: {plain(each.file)}: {plain(each.why)}")
        click.echo(summary(judged))
        return
    found = list(changes(ranking, before))
    for _, line in found:
        click.echo(line)
    click.echo(summary(judged) if found else f"nothing has changed: {summary(judged)}")
    ctx.exit(0 if all(allowed for allowed, _ in found) else 1)
