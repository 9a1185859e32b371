"""The checkpoint log of a long verification: what is done already, so that it can be stopped and resumed.

A text file, one JSON object a line: first what it is a log of, then each chunk with its results, as soon as it is
done. Chunks are known by a digest of everything that their results depend on. A last line that was not finished,
because the program or the machine died, is cut off and its chunk done again.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any, Self

from ninja_game import __version__
from ninja_game.errors import FileError, FormatError
from ninja_game.files.locking import lock
from ninja_game.files.reading import what_it_is
from ninja_game.formats.replay.text import RULES_VERSION
from ninja_game.runs.chunks import Result, as_data, result_from_data

HEADER = {"checkpoint-log": "ninja-game verify", "version": __version__, "rules": RULES_VERSION}

LONGEST_LINE = 2**26
"""Bytes; the results of a chunk are a thousandth of it."""


class CheckpointLog:
    """A checkpoint log that is open for reading and writing; a context manager.

    ``path`` is made if it is missing. Raises FormatError for a file that is something else, and leaves it as it is;
    OSError.
    """

    def __init__(self, path: Path) -> None:
        if path.exists() and not path.is_file():
            raise FileError(
                "only a regular file can be a checkpoint log", str(path), found=what_it_is(path.stat().st_mode)
            )
        self.path = path
        self._places: dict[str, int] = {}
        self._file: IO[bytes] = path.open("r+b" if path.exists() else "w+b")
        try:
            self._read()
        except BaseException:
            self._file.close()
            raise

    def _read(self) -> None:
        """Note where the results of every finished chunk stand, and cut off what was not finished."""
        if not lock(self._file.fileno()):
            raise FileError("another program writes this checkpoint log", str(self.path), hint="wait, or name another")
        header = json.dumps(HEADER).encode() + b"\n"
        first = self._file.readline(len(header))
        if first == header:
            whole = self._read_chunks(len(header))
        elif not first or (header.startswith(first) and first.startswith(header[:20])):
            # Empty, or its writer died in the first line; a shorter beginning may be that of anything.
            whole = 0
        else:
            raise self._odd(1, first, f"{json.dumps(HEADER)}; start another file")
        self._file.truncate(whole)
        self._file.seek(whole)
        if not whole:
            self._write(header)

    def _read_chunks(self, whole: int) -> int:
        """Note the chunks of all lines but the first; where the last whole line ends."""
        number = 1
        while line := self._file.readline(LONGEST_LINE):
            number += 1
            if not line.endswith(b"\n") and len(line) < LONGEST_LINE:
                break
            try:
                self._places[_parse(line)[0]] = whole
            except (ValueError, RecursionError):
                raise self._odd(number, line, "a line that `ninja-game verify --resume` wrote") from None
            whole += len(line)
        return whole

    def _odd(self, number: int, line: bytes, expected: str) -> FormatError:
        what, found = "not a checkpoint log that can be resumed", repr(line[:60].decode("utf-8", "replace"))
        return FormatError(what, str(self.path), number, found=found, expected=expected)

    def _write(self, line: bytes) -> None:
        self._file.write(line)
        self._file.flush()

    def __len__(self) -> int:
        return len(self._places)

    def __contains__(self, key: str) -> bool:
        return key in self._places

    def __getitem__(self, key: str) -> list[Result]:
        end = self._file.tell()
        self._file.seek(self._places[key])
        found, results = _parse(self._file.readline())
        self._file.seek(end)
        if found != key:
            raise FormatError(
                "the checkpoint log was changed meanwhile", str(self.path), expected="one writer at a time"
            )
        return results

    def add(self, key: str, results: Sequence[Result]) -> None:
        """Note that a chunk is finished."""
        self._places[key] = self._file.tell()
        fields: dict[str, Any] = {"chunk": key, "results": [as_data(result) for result in results]}
        self._write(json.dumps(fields).encode() + b"\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()


def _parse(line: bytes) -> tuple[str, list[Result]]:
    """The key and the results of a chunk's line. Raises ValueError where it is none, RecursionError."""
    fields = json.loads(line)
    if not isinstance(fields, dict) or fields.keys() != {"chunk", "results"} or not isinstance(fields["results"], list):
        raise ValueError("not the line of a chunk")
    return str(fields["chunk"]), [result_from_data(data) for data in fields["results"]]
