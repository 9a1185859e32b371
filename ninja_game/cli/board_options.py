"""What `ninja-game board` and `board ask` share: options, and what is remembered."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.cli.run_options import InputPath

if TYPE_CHECKING:
    from ninja_game.web.pages.memo import Memo

rules_option = click.option(
    "--rules", metavar="BOARD.TOML", type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="The categories in which runs are ranked. [default: the fastest, and the highest score]",
)  # fmt: skip


def cache_folder() -> Path:
    """Where boards remember what they found out."""
    from platformdirs import user_cache_path

    return user_cache_path("ninja-game", appauthor=False) / "board"


def memo_of(kind: str, about: Path, folder: Path, *, again: bool) -> Memo:
    """What is remembered of a folder, ``about``: the runs in ``folder``, or the pages of them.

    Raises FileError for a place in one of the two, where people may put files that are not yours.
    """
    from hashlib import sha256

    from ninja_game.errors import FileError
    from ninja_game.web.board.pages import is_in
    from ninja_game.web.pages.memo import Memo

    name = sha256(str(about.resolve()).encode("utf-8", "surrogateescape")).hexdigest()[:16]
    path = cache_folder() / f"{kind}-{name}.json"
    if not path.is_absolute() or is_in(path, folder) or is_in(path, about):
        what = "your cache folder has a relative path, or lies in the folder of runs, or of the pages"
        raise FileError(what, str(path), hint="runs are judged by nothing that may come with them: choose another one")
    return Memo(path, again=again)


def _address(_ctx: click.Context, _param: click.Parameter, value: str) -> str:
    from ninja_game.player.settings import RULES

    if not RULES["site"].fits(value):
        raise click.BadParameter("not an address such as https://example.org/game/")
    return value and value.rstrip("/") + "/"


address_option = click.option(
    "--address", metavar="URL", default="", callback=_address,
    help="Where the folder will be: chats that show a preview of a link want whole addresses of pictures.",
)  # fmt: skip

levels_option = click.option(
    "--levels", metavar="PACK", type=InputPath(),
    help="The levels that count: a pack, a file, a folder or a link of levels. [default: the game's own]",
)  # fmt: skip
