"""The checkpoint log of a long verification: what is done already, so that it can be stopped and resumed.

A text file, one JSON object a line: first what it is a log of, then each chunk with its results, as soon as it is
done. A line that was not finished, because the program or the machine died, is cut off and its chunk done again.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import IO, Any, Self

from ninja_game import __version__
from ninja_game.errors import FormatError
from ninja_game.formats.replay.text import RULES_VERSION
from ninja_game.runs.recording_reader import Unreadable
from ninja_game.runs.verify import Verdict
from ninja_game.verification.chunks import Result

HEADER = {"checkpoint-log": "ninja-game verify", "version": __version__, "rules": RULES_VERSION}


class CheckpointLog:
    """A checkpoint log that is open for reading and writing; a context manager.

    ``path`` is made if it is missing. Raises FormatError for a file that is something else, OSError.
    """

    def __init__(self, path: Path) -> None:
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
        whole = 0
        for number, line in enumerate(self._file, 1):
            if not line.endswith(b"\n"):
                break
            found = self._parse(line, number)
            if number == 1:
                if found != HEADER:
                    raise self._odd(number, line, f"{json.dumps(HEADER)}; start another file")
            else:
                self._places[str(found["chunk"])] = whole
            whole += len(line)
        self._file.truncate(whole)
        self._file.seek(whole)
        if not whole:
            self._write(HEADER)

    def _parse(self, line: bytes, number: int) -> dict[str, Any]:
        """A line's object. Raises FormatError where it is none."""
        try:
            found = json.loads(line)
        except ValueError:
            found = None
        if not isinstance(found, dict) or (number > 1 and not {"chunk", "results"} <= found.keys()):
            raise self._odd(number, line, "a line that `ninja-game verify --resume` wrote")
        return found

    def _odd(self, number: int, line: bytes, expected: str) -> FormatError:
        found = repr(line[:60].decode("utf-8", "replace"))
        return FormatError(
            "not a checkpoint log that can be resumed", str(self.path), number, found=found, expected=expected
        )

    def _write(self, line: dict[str, Any]) -> None:
        self._file.write(json.dumps(line).encode() + b"\n")
        self._file.flush()

    def __len__(self) -> int:
        return len(self._places)

    def __contains__(self, key: str) -> bool:
        return key in self._places

    def __getitem__(self, key: str) -> list[Result]:
        """The results of a finished chunk."""
        end = self._file.tell()
        self._file.seek(self._places[key])
        line = json.loads(self._file.readline())
        self._file.seek(end)
        return [_result(fields) for fields in line["results"]]

    def add(self, key: str, results: Sequence[Result]) -> None:
        """Note that a chunk is finished."""
        self._places[key] = self._file.tell()
        self._write({"chunk": key, "results": [_fields(result) for result in results]})

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()


def _fields(result: Result) -> dict[str, Any]:
    return {"message": result.message} if isinstance(result, Unreadable) else result.as_json()


def _result(fields: dict[str, Any]) -> Result:
    if "message" in fields:
        return Unreadable(fields["message"])
    return Verdict(**(fields | {"problems": tuple(fields.get("problems", ()))}))
