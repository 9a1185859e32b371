"""`ninja-game learn`: demonstrations for learning agents, and how good agents are."""

from __future__ import annotations

import click

from ninja_game.cli.learn import demos


@click.group(commands={"demos": demos.command})
def command() -> None:
    """Make demonstrations for learning agents, and measure agents.

    It needs Gymnasium, the extra 'learn'. docs/learning.md tells how to learn with it.

    \b
    Examples:
      ninja-game learn demos levels/certificates -o demos.npz
    """
