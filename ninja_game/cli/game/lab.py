"""`ninja-game lab`: figures about how the world works."""

from __future__ import annotations

import os
from pathlib import Path

import click

from ninja_game.cli.run_options import window_options

FIGURES = ("cells", "edges", "projection", "grids", "nine-cells", "pairs", "bullets", "rays", "drones", "tick")


@click.command()
@click.argument("figure", metavar="[FIGURE]", required=False, type=click.Choice(FIGURES))
@window_options
@click.option(
    "-o", "--output", type=click.Path(dir_okay=False, path_type=Path),
    help="Open no window: write the figure to this .png file, or its demonstration to this .gif file.",
)  # fmt: skip
@click.pass_context
def command(
    ctx: click.Context,
    figure: str | None,
    size: str | None,
    frames: int | None,
    screenshot: str | None,
    output: Path | None,
) -> None:
    """Drag, paint and watch: ten figures about how the world works.

    FIGURE is the one that is shown first: cells, edges, projection, grids, nine-cells, pairs, bullets, rays, drones or
    tick.

    \b
    Examples:
      ninja-game lab
      ninja-game lab rays
      ninja-game lab edges -o edges.png
    """
    from ninja_game.cli.game.play import pixels

    if output is not None and figure is None:
        raise click.UsageError("--output needs a FIGURE")
    window = pixels(size) if size else None
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    if output is not None and figure is not None:
        from ninja_game.play.lab.screen import export_figure

        export_figure(figure, output)
        return
    from ninja_game.play.lab.screen import LabScreen
    from ninja_game.play.main import run_app

    ctx.exit(run_app(lambda app: LabScreen(app, figure or ""), size=window, frames=frames, screenshot=screenshot))
