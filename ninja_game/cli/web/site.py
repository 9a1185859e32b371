"""`ninja-game site`: the game as a folder for any static host."""

from __future__ import annotations

import os
from pathlib import Path

import click


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
def command(out: Path | None, pyodide: Path | None, serve: bool, port: int) -> None:
    """Build the game as a page in a browser: a folder for any static host.

    OUT is a new folder, or one that this command has made, which it brings up to date; with --serve it may be left
    out. Nothing in the folder needs a program on the host, and the page loads nothing from elsewhere. Beside the page
    lies a gallery of the levels. docs/browser.md says how to put it online.

    \b
    Examples:
      ninja-game site public
      ninja-game site --serve
      ninja-game site public --pyodide node_modules/pyodide
    """
    if out is None and not serve:
        raise click.UsageError("name the folder OUT, or give --serve")
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    from platformdirs import user_cache_path

    from ninja_game.files.user_folder import data_folder
    from ninja_game.web.pages.exhibition import exhibition
    from ninja_game.web.pages.gallery import write_gallery
    from ninja_game.web.site.build import build_site

    cache = user_cache_path("ninja-game", appauthor=False)
    folder = out or cache / "site"
    files = build_site(folder, pyodide, cache)
    for file in files:
        if file.compressed > 50_000:
            click.echo(f"{file.name:<28} {file.size:>11,} bytes, {file.compressed:>10,} compressed by gzip")
    size, compressed = sum(file.size for file in files), sum(file.compressed for file in files)
    click.echo(f"{f'{folder}: {len(files)} files':<28} {size:>11,} bytes, {compressed:>10,} compressed by gzip")
    gallery = write_gallery(folder, exhibition(data_folder("levels")))
    click.echo(f"{gallery}: pictures and pages of the game's levels")
    if serve:
        _serve(folder, port)


def _serve(folder: Path, port: int) -> None:
    from ninja_game.web.site.build import site_server

    with site_server(folder, port) as server:
        click.echo(f"http://127.0.0.1:{server.server_port}/ (Ctrl-C ends it)")
        server.serve_forever()
