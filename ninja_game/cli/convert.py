"""`ninja-game convert`: levels of N to readable ones and back."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ninja_game.errors import LevelError

if TYPE_CHECKING:
    from ninja_game.formats.load import NamedLevel

FORMS = ("ascii", "string", "file")
STANDARD_STREAM = "-"


@click.command()
@click.argument("source", metavar="IN", type=click.Path(exists=True, path_type=Path))
@click.argument("target", metavar="OUT", type=click.Path(allow_dash=True))
@click.option("--to", "form", type=click.Choice(FORMS), help="The form to write, whatever OUT is called.")
@click.option("--legend", is_flag=True, help="End readable levels with the meaning of all characters, as comments.")
def command(source: Path, target: str, form: str | None, legend: bool) -> None:
    """Turn levels from one format into the other.

    IN is a file or folder of levels in any format; OUT a file, a folder, or - for the terminal. What is written:

    \b
      ascii   the readable format of docs/level-format.md; several levels: one file each, in the folder OUT
      string  the in-game string of N; several levels: one a line
      file    a level file of N with all levels, $name#author#comment#data#

    Without --to: levels of N become ascii; readable ones become a string where OUT ends in .nlevel, else a level file.

    \b
    Examples:
      ninja-game convert userlevels.txt my-levels/
      ninja-game convert my-levels/ userlevels.txt
      ninja-game convert my-levels/first.txt first.nlevel
      ninja-game convert first.nlevel -
    """
    from ninja_game.formats.load import load_levels

    levels = load_levels(source)
    form = form or _form_for(target, levels)
    if form == "ascii" and (_is_folder(target) or (len(levels) > 1 and target != STANDARD_STREAM)):
        _write_folder(Path(target), levels, legend, source)
    elif form == "ascii":
        _write(target, "\n".join(_ascii_text(level, legend) for level in levels), source)
    else:
        _write(target, _level_file_text(levels) if form == "file" else _strings_text(levels), source)


def _form_for(target: str, levels: Sequence[NamedLevel]) -> str:
    """The form to write when none is asked for: the other one."""
    if not all(level.ascii for level in levels):
        return "ascii"
    return "string" if Path(target).suffix == ".nlevel" else "file"


def _is_folder(target: str) -> bool:
    return target.endswith(("/", "\\")) or Path(target).is_dir()


def _ascii_text(level: NamedLevel, legend: bool) -> str:
    from ninja_game.formats.ascii.reader import write_ascii_level

    return write_ascii_level(
        level.level, name=level.name, author=level.author, comment=level.comment, legend=legend
    )  # fmt: skip


def _level_file_text(levels: Sequence[NamedLevel]) -> str:
    """All levels as one level file of N."""
    from ninja_game.formats.n14.level_file import LevelRecord, write_level_file
    from ninja_game.formats.n14.level_string import write_level_string

    return write_level_file(
        LevelRecord(level.name, level.author, level.comment, write_level_string(level.level)) for level in levels
    )


def _strings_text(levels: Sequence[NamedLevel]) -> str:
    """All levels as in-game strings, one a line."""
    from ninja_game.formats.n14.level_string import write_level_string

    return "".join(write_level_string(level.level) + "\n" for level in levels)


def _write(target: str, text: str, source: Path) -> None:
    """Write one file, never the one that was read, or to the terminal."""
    from ninja_game.files.writing import write_atomically

    if target == STANDARD_STREAM:
        click.echo(text, nl=False)
    else:
        write_atomically(Path(target), text, keep=[source])


def _write_folder(folder: Path, levels: Sequence[NamedLevel], legend: bool, source: Path) -> None:
    """Write one readable file a level, named after its place and its name."""
    from ninja_game.files.writing import write_atomically

    if folder.exists() and not folder.is_dir():
        raise LevelError(
            f"{len(levels)} levels do not fit into one file", str(folder), hint="name a folder, or use --to file"
        )
    folder.mkdir(parents=True, exist_ok=True)
    for name, level in zip(_file_names(levels), levels, strict=True):
        write_atomically(folder / name, _ascii_text(level, legend), keep=[source])
    click.echo(f"{len(levels)} level{'s' * (len(levels) != 1)} written to {folder}", err=True)


def _file_names(levels: Sequence[NamedLevel]) -> Iterator[str]:
    """`0007-name-of-the-level.txt`; files that came from a folder keep their names."""
    from ninja_game.files.shown_text import file_stem

    digits = max(3, len(str(len(levels) - 1)))
    stems = [Path(level.file).stem for level in levels]
    for number, level in enumerate(levels):
        if len(set(stems)) == len(levels) > 1:
            yield f"{stems[number]}.txt"
        else:
            name = file_stem(level.name)
            yield f"{number:0{digits}d}{'-' * bool(name)}{name}.txt"
