"""Run a reader's program in the Python of the page; gives its output or its error."""

from __future__ import annotations

import sys
from contextlib import redirect_stdout
from io import StringIO
from traceback import extract_tb
from types import FrameType
from typing import Any

NAME = "<your program>"
MAX_LINES = 300_000  # most lines that a program may run
MAX_OUTPUT = 5_000  # most characters of its output


def run_program(text: str) -> str:
    """Its output; after an error also its line and message."""
    printed, left = StringIO(), MAX_LINES

    def count(_frame: FrameType, event: str, _: object) -> Any:
        nonlocal left
        left -= event == "line"
        if left < 0:
            raise TimeoutError(f"stopped after {MAX_LINES:,} lines; does a loop never end?")
        return count

    wrong = ""
    try:
        program = compile(text, NAME, "exec")
        with redirect_stdout(printed):
            sys.settrace(count)
            exec(program, {"__name__": "__main__"})  # noqa: S102 - the reader's own words, in the reader's own page
    except BaseException as error:  # noqa: BLE001 - whatever it raises, SystemExit too, is for the reader
        lines = [entry.lineno for entry in extract_tb(error.__traceback__) if entry.filename == NAME]
        line, words = (error.lineno, error.msg) if isinstance(error, SyntaxError) else ([0, *lines][-1], error)
        wrong = f"Line {line}: {type(error).__name__}: {words}"
    finally:
        sys.settrace(None)
    return printed.getvalue()[:MAX_OUTPUT] + wrong
