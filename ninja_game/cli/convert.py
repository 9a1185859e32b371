"""`ninja-game convert`: levels of N to readable ones and back."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from ninja_game.formats.files import NamedLevel

FORMS = ("ascii", "string", "file")


@click.command()
@click.argument("source", metavar="IN", type=click.Path(exists=True, path_type=Path))
@click.argument("target", metavar="OUT", type=click.Path(path_type=Path, allow_dash=True))
@click.option("--to", "form", type=click.Choice(FORMS), help="The form to write, whatever OUT is called.")
@click.option("--legend", is_flag=True, help="Add the meaning of all characters to readable levels, as comments.")
def command(source: Path, target: Path, form: str | None, legend: bool) -> None:
    """Turn levels from one format into the other.

    IN is a file or folder of levels in any format; OUT a file, a folder, or - for the terminal. What is written:

    \b
      ascii   the readable format of docs/level-format.md; several levels: one file each, in folder OUT
      string  the in-game string of N; several levels: one a line
      file    a level file of N, $name#author#comment#data#, with all levels

    Without --to: N levels become ascii; readable ones become a string where OUT is called .nlevel, else a file.

    \b
    Examples:
      ninja-game convert userlevels.txt my-levels/
      ninja-game convert my-levels/ userlevels.txt
      ninja-game convert levels/first-steps.txt first-steps.nlevel
      ninja-game convert first-steps.nlevel -
    """
    from ninja_game.formats.files import load_levels

    levels = load_levels(source)
    form = form or _form_for(target, levels)
    if form == "ascii":
        texts = [_ascii_text(level, legend) for level in levels]
        if _is_folder(target) or (len(levels) > 1 and str(target) != "-"):
            _write_folder(target, levels, texts)
            return
        text = "\n".join(texts)
    else:
        text = _level_file_text(levels) if form == "file" else _strings_text(levels)
    _write(target, text)


def _form_for(target: Path, levels: Sequence[NamedLevel]) -> str:
    """The form to write when none is asked for: the other one."""
    if not all(level.ascii for level in levels):
        return "ascii"
    return "string" if target.suffix == ".nlevel" else "file"
