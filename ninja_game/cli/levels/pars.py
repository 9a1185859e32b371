"""`ninja-game levels pars`: the table of par times of a pack."""

from __future__ import annotations

from pathlib import Path

import click

from ninja_game.cli.run_options import with_progress
from ninja_game.files.shown_text import shown_text


@click.command(name="pars")
@click.argument("pack", type=click.Path(exists=True, file_okay=False, path_type=Path))
def command(pack: Path) -> None:
    """Write par times and difficulties of a pack's levels into its pars.toml.

    They are derived from the certificates, replays in PACK/certificates: NAME.exit.replay.txt, the fastest run to the
    exit of NAME.txt, and NAME.gold.replay.txt, a run with all gold. A level without a sound certificate gets none.

    \b
    Examples:
      ninja-game levels pars my-pack/
      ninja-game levels pars levels/
    """
    from ninja_game.files.tree import Tree
    from ninja_game.formats.pack.files import PARS
    from ninja_game.formats.pack.pack import Pack
    from ninja_game.formats.pack.pars import MARGINS, write_pars
    from ninja_game.player.scoring import seconds_text
    from ninja_game.runs.packs import make_pars

    opened = Pack(pack)
    made = dict(with_progress(make_pars(opened), "level"))
    for file, pars in made.items():
        times = "  ".join(f"{medal} {seconds_text(pars.par(medal)):>7}" for medal in MARGINS)
        click.echo(f"{times}  difficulty {pars.difficulty or 0:6.2f}  {shown_text(file)}")
    Tree(pack).write(PARS, write_pars(made))
    without = len(opened.levels) - len(made)
    click.echo(f"{len(made)} levels with pars, {without} without a sound certificate; wrote {pack / PARS}")
