"""`ninja-game learn`: demonstrations for learning agents, their training, and how good they are."""

from __future__ import annotations

import click

from ninja_game.cli.learn import demos, eval, train  # noqa: A004 - the command's name


@click.group(commands={"demos": demos.command, "train": train.command, "eval": eval.command})
def command() -> None:
    """Make demonstrations for learning agents, train agents, and measure them.

    It needs Gymnasium, the extra 'learn'. docs/learning.md explains how.

    \b
    Examples:
      ninja-game learn demos levels/certificates -o demos.npz
      ninja-game learn train --seconds 300
      ninja-game learn eval random --levels 00-0-first-steps
    """
