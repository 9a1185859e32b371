"""Files that the inputs of a replay take in."""

from __future__ import annotations

from ninja_game.errors import ReplayError
from ninja_game.files.beside import has_folder, read_beside
from ninja_game.files.reading import MAX_BYTES
from ninja_game.formats.replay.input_text import Include


def included_beside(file: str) -> Include | None:
    """Reads files in the folder of ``file`` or below it, as inputs name them; None where there is no such folder."""
    if not has_folder(file):
        return None

    texts: dict[str, str] = {}

    def include(name: str) -> tuple[str, str]:
        found = read_beside(file, name)
        if not found.path:
            expected = "a file in the replay's folder or below it"
            raise ReplayError("a file elsewhere", found=repr(name[:40]), expected=expected)
        if found.text is None:
            hint = found.problem or "no file of this name is there"
            raise ReplayError("a file that cannot be included", found=repr(name[:40]), hint=hint)
        texts[found.path] = found.text
        if sum(map(len, texts.values())) > MAX_BYTES:
            raise ReplayError("too much included", found=repr(name[:40]), expected=f"{MAX_BYTES >> 20} MiB in all")
        return found.path, found.text

    return include
