"""`ninja-game player`: a player's data as one file."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import click

from ninja_game.cli.options import NEW_FILE, OLD_FILE, heartbeat
from ninja_game.errors import FileError
from ninja_game.files.shown_text import shown_text
from ninja_game.player.player_data import PlayerData


@click.group()
def player() -> None:
    """Export all data of a player to one file, or import such a file.

    Settings, records, own levels and replays. The game in a browser writes and reads the same file (its page menu), so
    that records move between a page and this machine.

    \b
    Examples:
      ninja-game player export my-data.zip
      ninja-game player import my-data.zip
    """


@player.command("export")
@click.argument("file", type=NEW_FILE)
def export(file: Path) -> None:
    """Write all data of the player into FILE, a zip."""
    from ninja_game.player.backup import write_backup

    with _player() as player:
        for line in write_backup(player, file):
            click.echo(line, err=True)


@player.command("import")
@click.argument("file", type=OLD_FILE)
def take_in(file: Path) -> None:
    """Import FILE. Better runs replace worse ones; nothing of yours is overwritten."""
    from ninja_game.files.reading import read_bytes
    from ninja_game.player.backup import MOST_BYTES, read_backup

    with _player() as player, heartbeat(lambda: "runs the replays of the backup again"):
        for line in read_backup(player, read_bytes(file, MOST_BYTES)):
            click.echo(shown_text(line))


@contextmanager
def _player() -> Iterator[PlayerData]:
    """The player's data, closed afterwards. Raises FileError for records that cannot be used."""
    player = PlayerData()
    try:
        player.open_records()
        if player.store.problem:
            raise FileError(player.store.problem, str(player.folder))
        yield player
    except sqlite3.Error as error:
        raise FileError("the records cannot be used now", str(player.folder), found=str(error)) from None
    finally:
        player.close()
