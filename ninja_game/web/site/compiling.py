"""Runs in Pyodide: puts bytecode beside every Python file of the folders ``library`` and ``game``.

Without docstrings and assertions; the library also without the tables of line numbers, so that its bytecode is no
larger than its text. The bytecode is used whatever its source's date.
"""

import marshal
from importlib.util import MAGIC_NUMBER
from pathlib import Path
from types import CodeType

_PLACES = {"library": "/lib/python314.zip", "game": "/game"}  # the place of each folder in the page, for tracebacks

DOCUMENTED = ("pyodide", "_pyodide")  # packages that need their docstrings when they run

UNCHECKED = MAGIC_NUMBER + (1).to_bytes(4, "little") + bytes(8)
"""Header of bytecode that is never compared with a source."""


def without_lines(code: CodeType) -> CodeType:
    """Code without line numbers: entries without a line, each for up to eight units of code."""
    inner = tuple(without_lines(item) if isinstance(item, CodeType) else item for item in code.co_consts)
    eights, rest = divmod(len(code.co_code) // 2, 8)
    last = bytes([0xF7 + rest]) if rest else b""
    return code.replace(co_consts=inner, co_linetable=b"\xff" * eights + last)


def bytecode(path: Path, folder: str) -> bytes:
    """The content of a ``.pyc`` file."""
    name = path.relative_to(folder)
    optimize = 0 if name.parts[0] in DOCUMENTED else 2  # 2: without docstrings and assertions
    code = compile(path.read_bytes(), f"{_PLACES[folder]}/{name}", "exec", dont_inherit=True, optimize=optimize)
    return UNCHECKED + marshal.dumps(code if folder == "game" else without_lines(code))


if __name__ == "__main__":
    for place in _PLACES:
        for text in Path(place).rglob("*.py"):
            text.with_suffix(".pyc").write_bytes(bytecode(text, place))
