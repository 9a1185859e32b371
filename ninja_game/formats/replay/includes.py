"""Files that the inputs of a replay take in."""

from __future__ import annotations

import os
from pathlib import Path

from ninja_game.errors import NinjaGameError, ReplayError
from ninja_game.files.reading import MAX_BYTES, path_below, read_text
from ninja_game.formats.replay.input_text import Include


def included_beside(file: str) -> Include | None:
    """Reads files in the folder of ``file`` or below it, as inputs name them; None where there is no such folder."""
    if not file or not os.path.isfile(file):  # noqa: PTH113 - Path.is_file() fails on long names
        return None

    texts: dict[Path, str] = {}

    def include(name: str) -> tuple[str, str]:
        path = path_below(Path(file).parent, name)
        if path is None or not name:
            expected = "a file in the replay's folder or below it"
            raise ReplayError("a file elsewhere", found=repr(name[:40]), expected=expected)
        try:
            if path not in texts:
                texts[path] = read_text(path)
        except (OSError, NinjaGameError) as error:
            why = error.strerror if isinstance(error, OSError) else str(error)
            raise ReplayError("a file that cannot be taken in", found=repr(name[:40]), hint=why or "") from None
        if sum(map(len, texts.values())) > MAX_BYTES:
            raise ReplayError("too much taken in", found=repr(name[:40]), expected=f"{MAX_BYTES >> 20} MiB in all")
        return str(path), texts[path]

    return include
