"""Text files as people have them: any encoding, any line ends, alone or in folders."""

from __future__ import annotations

import codecs
from pathlib import Path

from ninja_game.errors import LevelError

SUFFIXES = (".txt", ".nlevel", ".level", ".replay", ".demo")
"""Which files of a folder are looked at."""

MAX_BYTES = 64 * 2**20
"""No level file comes near this size; a larger one is something else."""


def text_files(path: Path) -> list[Path]:
    """The file itself, or the files below a folder that may hold levels or recordings, in order of their names."""
    if not path.is_dir():
        return [path]
    files = sorted(file for file in path.rglob("*") if file.suffix.lower() in SUFFIXES and file.is_file())
    return [file for file in files if not any(part.startswith(".") for part in file.relative_to(path).parts)]


def read_text(path: Path) -> str:
    """A text file's content with plain line ends: UTF-8, UTF-16 with its mark, or else Latin-1.

    Raises LevelError for a file that is no text; OSError as it comes.
    """
    with path.open("rb") as file:
        data = file.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise LevelError("too large for a file of levels", str(path), expected=f"at most {MAX_BYTES >> 20} MiB")
    try:
        if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
            text = data.decode("utf-16")
        else:
            text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    if "\0" in text:
        raise LevelError("not a text file", str(path), found="a zero byte")
    return text.replace("\r\n", "\n").replace("\r", "\n")
