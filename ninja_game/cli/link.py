"""`ninja-game link`: a level, a pack or replays as a link."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import click

from ninja_game.cli.run_options import LevelPath, choose


@click.command()
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=LevelPath())
@click.option("--record", type=click.IntRange(min=0), help="This level or recording of the file, counted from 0.")
@click.option("--base", metavar="URL", default="", help="Address of a page with the game, which opens the link.")
def link(files: Sequence[Path], record: int | None, base: str) -> None:
    """Make a link that carries a level, a pack or replays.

    FILE is a level, a pack (a folder or zip with pack.toml) or a replay, in any format; several replays of one level
    run side by side. The link holds the whole text, compressed: whoever opens it needs nothing else, and a link
    without --base is opened with `ninja-game play LINK`. How links are written: docs/links.md.

    \b
    Examples:
      ninja-game link 00-0-first-steps --base https://example.org/game/
      ninja-game link my-pack.zip
      ninja-game link mine.replay.txt yours.replay.txt
      ninja-game play '#level=1.…'
    """
    click.echo(base.partition("#")[0] + link_of(files, record))


def link_of(files: Sequence[Path], record: int | None = None) -> str:
    """The link of what files hold: one pack, one level, or all the recordings. Raises NinjaGameError."""
    from ninja_game.formats.ascii.writer import headers_of
    from ninja_game.formats.links import level_link, recording_link
    from ninja_game.formats.load import load_levels, load_replays, texts_of
    from ninja_game.formats.pack.pack import PackFiles, is_pack
    from ninja_game.formats.recording import holds_recordings

    first = files[0]
    if is_pack(first):
        if len(files) > 1 or record is not None:
            raise click.UsageError("a link carries one pack, whole")
        return PackFiles(first).link()
    if all(holds_recordings(text) for file in files for _, text in texts_of(file)):
        found = [each for file in files for each in load_replays(file)]
        return recording_link(found if record is None else [choose(found, "recordings", first, record)])
    if len(files) > 1:
        raise click.UsageError("a link carries one level; make a pack of several, or give replays only")
    named = choose(load_levels(first), "levels", first, record)
    return level_link(named.level, **headers_of(named))
