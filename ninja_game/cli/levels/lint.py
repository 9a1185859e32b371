"""`ninja-game levels lint`: what is odd about a pack."""

from __future__ import annotations

from pathlib import Path

import click

from ninja_game.files.shown_text import shown_text


@click.command(name="lint")
@click.argument("pack", type=click.Path(exists=True, path_type=Path))
@click.pass_context
def command(ctx: click.Context, pack: Path) -> None:
    """Report what is odd about a pack: its index, its levels, its certificates, its table of pars.

    A line says how to mend what was found, and ends in its code (docs/findings.md).

    Exit code 0: nothing; 1: something is odd; 2: the pack or its index cannot be read.

    \b
    Examples:
      ninja-game levels lint my-pack/
      ninja-game levels lint my-pack.zip
    """
    from ninja_game.formats.pack.pack import Pack
    from ninja_game.runs.packs import lint

    opened = Pack(pack)
    found = list(lint(opened))
    for finding in found:
        click.echo(f"{shown_text(str(finding), 500)}. {finding.hint} [{finding.code}]")
    episodes = len(opened.episodes)
    counted = f"{shown_text(opened.name)}: {episodes} episodes, {len(opened.levels)} levels"
    click.echo(f"{counted}, {len(found)} findings" if found else f"{counted}, nothing odd")
    ctx.exit(1 if found else 0)
