"""Commands that fill folders for a static host: the site and the board."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import click

from ninja_game.cli.board_ask import ask
from ninja_game.cli.board_ranking import levels_option, memo_of, ranking_of, rules_option
from ninja_game.cli.commands import FAILED
from ninja_game.cli.options import NEW_FILE, NEW_FOLDER, OLD_FILE, OLD_FOLDER, jobs_option
from ninja_game.files.bundled import data_folder
from ninja_game.files.user_folder import cache_folder


def _address(_ctx: click.Context, _param: click.Parameter, value: str) -> str:
    from ninja_game.player.settings import SPECS

    if not SPECS["site"].fits(value):
        raise click.BadParameter("not an address such as https://example.org/game/")
    return value and value.rstrip("/") + "/"


address_option = click.option(
    "--address", metavar="URL", default="", callback=_address,
    help="Where the folder will be published: previews of its links in chats need whole addresses.",
)  # fmt: skip


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

    from ninja_game.levels.published import published_levels
    from ninja_game.web.pages.gallery import write_gallery
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


class _BoardGroup(click.Group):
    """A command with an argument, and with commands below it: their names come before the argument."""

    allow_extra_args = False
    allow_interspersed_args = True

    def make_context(self, info_name: Any, args: list[str], parent: Any = None, **extra: Any) -> click.Context:
        """The context of the command meant: one of those below, or this one."""
        if args and args[0] in self.commands:
            return self.commands[args[0]].make_context(f"{info_name} {args[0]}", args[1:], parent, **extra)
        return super().make_context(info_name, args, parent, **extra)


@click.group(cls=_BoardGroup, invoke_without_command=True, no_args_is_help=False, subcommand_metavar="")
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
    help="The runs of this file in FOLDER are no copies, and by the player whom they name. Needs --json.",
)
@click.option(
    "--reject",
    metavar="RUN",
    multiple=True,
    help="The runs of this file in FOLDER, of a folder there (bob/) or of a player (Bob) do not count. These options "
    "may be repeated, for many files. Needs --json and --reason.",
)
@click.option(
    "--disown",
    metavar="RUN",
    multiple=True,
    help="Runs, named as for --reject, are not by the player whom they name, and do not count. Needs --json.",
)
@click.option(
    "--ladder",
    metavar="RUN LADDER",
    multiple=True,
    type=(str, click.Choice(["played", "assisted"])),
    help="Rank runs, named as for --reject, as played or as assisted, whatever they say. Needs --json.",
)
@click.option("--reason", metavar="TEXT", default="", help="Why, for these three: it stands on the pages.")
@click.option(
    "--dates",
    metavar="FILE.csv",
    type=OLD_FILE,
    help="Rows FILE,DATE: since when runs are known, as in an older board. Needs --json, which keeps them.",
)
@rules_option
@click.option("--again", is_flag=True, help="Simulate every run, and write every page, also those known from before.")
@jobs_option
@address_option
def board(
    folder: Path, levels: Path | None, site: Path | None, data: Path | None, check: Path | None, confirm: Sequence[str],
    reject: Sequence[str], disown: Sequence[str], ladder: Sequence[tuple[str, str]], reason: str, dates: Path | None,
    rules: Path | None, again: bool, jobs: int | None, address: str,
) -> int:  # fmt: skip
    """Rank the runs of a folder, all simulated again: tables, pages, checks.

    FOLDER holds replays, as people send them to a repository; nothing in them is believed but the inputs. Runs on
    other levels, with another body, under other rules, practice runs, copies and runs with false claims are rejected,
    with the reason. Results are kept in your own cache folder, so that no run is simulated twice. `ninja-game site OUT`
    puts the page with the game next to the board, to watch its runs. How to keep a board in a repository:
    docs/board.md. A folder with the name "ask" is given as ./ask.

    \b
    Examples:
      ninja-game board replays/
      ninja-game board replays/ --site public/ --json board.json
      ninja-game board replays/ --check board.json
      ninja-game board replays/ --json board.json --confirm ann/00-0.txt
      ninja-game board replays/ --json board.json --reject bob/00-0.txt --reason "spliced"
      ninja-game board replays/ --json board.json --disown eve/00-0.txt
      ninja-game board replays/ --json board.json --ladder bob/00-1.txt assisted --ladder old/ assisted
      ninja-game board replays/ --levels my-pack/ --site public/
      ninja-game board ask replays/ rank 00-0
    """
    from ninja_game.board.report import (
        board_news,
        board_text,
        check_confirmed,
        escaped,
        lines_of_gone,
        moderate,
        summary,
        unnamed_hint,
    )
    from ninja_game.files.writing import check_output, write_atomically
    from ninja_game.web.board.pages import BoardPages, check_ledger, check_site
    from ninja_game.web.pages.frame import GAME_PAGE

    changes_ledger = bool(confirm or reject or disown or ladder or dates)
    if changes_ledger and not data:
        raise click.UsageError("--confirm, --reject, --disown, --ladder, --dates: name the ledger with --json")
    if site:
        check_site(site, folder)
    if data:
        check_output(data, keep=[folder])
        check_ledger(data, folder)
    decisions = [*((name, "rejected") for name in reject), *((name, "disowned") for name in disown), *ladder]
    decide = partial(moderate, decisions=decisions, reason=reason.strip(), tell=click.echo)
    same = changes_ledger or check is not None
    ranking, before = ranking_of(
        folder, levels, rules, check or data, jobs=jobs, again=again, decide=decide, confirm=confirm, dates=dates,
        same=same,
    )  # fmt: skip
    judged = ranking.judged
    check_confirmed(judged, confirm)
    if site:
        BoardPages(site, ranking, memo=memo_of("pages", site, folder, again=again), address=address).write()
        if not (site / GAME_PAGE).exists():
            click.echo(f"{site} has no page with the game yet: ninja-game site {site}", err=True)
    if data:
        write_atomically(data, board_text(judged, before), keep=[folder])
    if check:
        return _show_news(list(board_news(ranking, before)), summary(judged))
    for run in judged.rejected:
        click.echo(f"{run.kind}: {escaped(run.file)}: {escaped(run.why)}")
    for line in lines_of_gone(ranking, before):
        click.echo(line)
    click.echo(summary(judged))
    if hint := unnamed_hint(judged):
        click.echo(hint, err=True)
    return 0


def _show_news(news: Sequence[tuple[bool, str]], sums: str) -> int:
    """Print changes since an earlier board; FAILED if some are not allowed. ``news``: whether it is, and a line."""
    for _, line in news:
        click.echo(line)
    click.echo(sums if news else f"nothing has changed: {sums}")
    return 0 if all(allowed for allowed, _ in news) else FAILED


board.add_command(ask)
