"""`ninja-game levels`: what is done with whole packs of levels."""

from __future__ import annotations

import click

from ninja_game.cli.levels import lint, pars


@click.group(commands={"pars": pars.command, "lint": lint.command})
def command() -> None:
    """Check packs of levels, and make their tables of par times.

    A pack is a folder or zip with an index, pack.toml.

    \b
    Examples:
      ninja-game levels lint my-pack/
      ninja-game levels pars my-pack/
    """
