"""Recordings cut into chunks that can be verified anywhere, and the log of those that are done.

A chunk is some files, or some records of a large one. It carries its text, so that it can be sent to a machine that
does not see the files. Included files are read where the chunk is verified, unless ``self_contained`` put them inside.

With the checkpoint log a long verification can be stopped and resumed. It is a text file, one JSON object per line:
first the log's format and version, then each chunk with its results, as soon as it is done. Chunks are known by a
digest of everything that their results depend on. An unfinished last line is cut off, and its chunk done again.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import asdict, dataclass, field, replace
from hashlib import sha256
from itertools import islice
from pathlib import Path
from typing import IO, Any, Self, get_args, get_type_hints

from ninja_game import __version__
from ninja_game.budget import RUN_BUDGET
from ninja_game.errors import DAMAGED, BudgetError, DemoError, FileError, FormatError, LevelError, ReplayError
from ninja_game.files.locking import lock
from ninja_game.files.reading import IncludedFile, file_type, known_files
from ninja_game.formats.n14.level_file import LevelRecord
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import is_episode
from ninja_game.levels.findings import RUN_WORDINGS, RunProblem
from ninja_game.runs.recording_reader import Unreadable, recording_of_text, recordings_of, records_of, texts_in
from ninja_game.runs.verify import NOT_RUN, OutOfRangeError, Verdict, verify_recording
from ninja_game.runs.workers import ClusterError
from ninja_game.sim.level import Level
from ninja_game.sim.rules import RULES_VERSION
from ninja_game.sim.states import OUTCOME_NAMES

_RECORDS = 64  # records a chunk at most: enough that sending it is cheap beside running it

Result = Verdict | Unreadable


@dataclass(frozen=True)
class Chunk:
    """A file, records ``first`` … of one, or run ``first`` of an episode.

    ``text``: the whole file, if ``records`` is empty; ``beside``: all files that it includes, None while they are read
    where they are needed; ``problem``: why the file cannot be read, '' if it can; ``named``: whether the caller named
    the file (else it was found in a folder); ``key``: its key in the checkpoint log; ``done``: whether it is in there.
    """

    file: str
    first: int = 0
    text: str = field(default="", repr=False)
    beside: dict[str, IncludedFile] | None = field(default=None, repr=False)
    records: tuple[LevelRecord, ...] = field(default=(), repr=False)
    problem: str = ""
    named: bool = True
    key: str = ""
    done: bool = False

    @property
    def weight(self) -> int:
        return len(self.records) or 1

    @property
    def digest(self) -> str:
        """Sha256 (hex) of its content and its file's name: of everything that its results depend on."""
        return sha256(json.dumps(asdict(self)).encode()).hexdigest()


def chunks_in(paths: Iterable[Path], record: int | None = None) -> Iterator[Chunk]:
    """All chunks of files and folders, in order, each read when it is asked for. ``record``: only this one of each."""
    for filed in texts_in(paths):
        if isinstance(filed, Unreadable):
            yield Chunk("", problem=filed.message)
            continue
        file, text, named = filed
        if is_episode(text):
            runs = list(recording_of_text(text, file, named=named))
            chunks = [Chunk(file, number, text=text, named=named) for number in range(len(runs))]
            yield from chunks if record is None else chunks[record : record + 1]
            continue
        records = records_of(text, file)
        if not records and not record:
            yield Chunk(file, text=text, named=named)
        elif record is not None and records[record:]:
            yield Chunk(file, record, records=(records[record],), named=named)
        for first in range(0, len(records) if record is None else 0, _RECORDS):
            yield Chunk(file, first, records=tuple(records[first : first + _RECORDS]), named=named)


def self_contained(chunk: Chunk, level: Level | None = None) -> Chunk:
    """The chunk with all files inside that its text includes; unchanged if that fails."""
    included: dict[str, IncludedFile] = {}
    if not chunk.records and not chunk.problem:
        with known_files(included, no_more=False):
            list(recording_of_text(chunk.text, chunk.file, level, named=chunk.named))
    return replace(chunk, beside=included)


@dataclass(frozen=True)
class VerifyOptions:
    """All that the results of a chunk depend on besides it, mostly as for ``verify_recording``.

    ``level``: what recordings that do not hold theirs are played on.
    """

    memory: str = "auto"
    level: Level | None = None
    counting: frozenset[str] | None = None
    budget: int = RUN_BUDGET

    def context(self) -> str:
        """A key of these options; plain and compiled share one."""
        level = level_digest(self.level) if self.level else ""
        return json.dumps([self.memory == "both", level, self.counting and sorted(self.counting), self.budget])


def verify_chunk(chunk: Chunk, options: VerifyOptions) -> list[Result]:
    """A verdict on every recording of a chunk, in order; what cannot be read is reported and stops nothing.

    Raises NinjaGameError where nothing can be judged.
    """
    if chunk.problem:
        return [Unreadable(chunk.problem)]
    with nullcontext() if chunk.beside is None else known_files(chunk.beside, no_more=True):
        if chunk.records:
            recordings = recordings_of(chunk.records, chunk.file, options.level)
        else:
            recordings = recording_of_text(chunk.text, chunk.file, options.level, named=chunk.named)
        if is_episode(chunk.text):
            recordings = islice(recordings, chunk.first, chunk.first + 1)
        return [_result(recording, options) for recording in recordings]


def _result(recording: Recording | Unreadable, options: VerifyOptions) -> Result:
    if isinstance(recording, Unreadable):
        return recording
    try:
        return verify_recording(recording, options.memory, options.counting, options.budget)
    except BudgetError as error:
        return Unreadable(str(replace(error, option="")), error.option)
    except (DemoError, LevelError, OutOfRangeError, ReplayError) as error:
        # An error of the run; any other one is an error here, and nothing can be judged.
        return Unreadable(str(error))


# --- results as plain data ---


def results_as_text(results: Sequence[Sequence[Result]]) -> str:
    """The results of several chunks as JSON."""
    return json.dumps([[asdict(result) for result in of_chunk] for of_chunk in results])


def results_from_text(text: object, chunks: Sequence[Chunk]) -> list[list[Result]]:
    """The results that ``results_as_text`` wrote of these chunks. Raises ClusterError for anything else."""
    try:
        all_results = [[result_from_data(data) for data in of_chunk] for of_chunk in json.loads(str(text))]
        if len(all_results) != len(chunks):
            raise ValueError(f"{len(all_results)} answers to {len(chunks)} questions")
        for chunk, results in zip(chunks, all_results, strict=True):
            # A text that was found in a folder may hold only levels.
            if chunk.done:
                expected_count = 0
            elif chunk.problem:
                expected_count = 1
            else:
                expected_count = len(chunk.records) or int(chunk.named)
            if len(results) != expected_count and (chunk.records or len(results) < expected_count):
                raise ValueError(f"{len(results)} results of {expected_count}")
        return all_results
    except DAMAGED as error:
        raise ClusterError(f"a worker of the cluster answers with something else than results ({error})") from None


MAX_NUMBER = 2**53  # numbers of a result are smaller
_OUTCOMES = (*OUTCOME_NAMES, NOT_RUN)

_TYPES = {name: hint for name, hint in get_type_hints(Verdict).items() if name != "problems"}


def result_from_data(data: object) -> Result:
    """The inverse of ``asdict``, also after JSON. Raises ValueError for anything else."""
    texts = isinstance(data, dict) and all(isinstance(value, str) for value in data.values())
    if isinstance(data, dict) and texts and {"message"} <= data.keys() <= {"message", "option"}:
        return Unreadable(**data)
    if not isinstance(data, dict) or data.keys() != {*_TYPES, "problems"}:
        raise ValueError("not the fields of a result")
    for name, kind in _TYPES.items():
        value = data[name]
        if isinstance(value, int) and abs(value) >= MAX_NUMBER:
            raise ValueError(f"{name} is out of range")
        if not isinstance(value, kind) or (isinstance(value, bool) and bool not in (kind, *get_args(kind))):
            raise ValueError(f"{name} is {value!r}"[:80])
    if data["outcome"] not in _OUTCOMES:
        raise ValueError(f"outcome is {data['outcome']!r}"[:80])
    problems = data["problems"]
    if not isinstance(problems, (list, tuple)) or not all(map(_is_problem, problems)):
        raise ValueError("problems are not a list of codes and texts")
    return Verdict(**(data | {"problems": tuple(RunProblem(*problem) for problem in problems)}))


def _is_problem(data: object) -> bool:
    if not isinstance(data, (list, tuple)) or len(data) != 2 or not isinstance(data[1], str):
        return False
    return isinstance(data[0], str) and data[0] in RUN_WORDINGS


HEADER = {"checkpoint-log": "ninja-game verify", "version": __version__, "rules": RULES_VERSION}

MAX_LINE_BYTES = 2**26  # bytes; the results of a chunk are a thousandth of it


class CheckpointLog:
    """A checkpoint log that is open for reading and writing; a context manager.

    ``path`` is made if it is missing. Raises FormatError for any other file, which stays as it is; OSError.
    """

    def __init__(self, path: Path) -> None:
        if path.exists() and not path.is_file():
            raise FileError(
                "only a regular file can be a checkpoint log", str(path), found=file_type(path.stat().st_mode)
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
        """Index the results of every finished chunk, and cut off an unfinished line."""
        if not lock(self._file.fileno()):
            raise FileError("another program writes this checkpoint log", str(self.path), hint="wait, or name another")
        header = json.dumps(HEADER).encode() + b"\n"
        first = self._file.readline(len(header))
        if first == header:
            whole = self._read_chunks(len(header))
        elif not first or (header.startswith(first) and first.startswith(header[:20])):
            # Empty, or its writer died in the first line; any shorter file is not ours.
            whole = 0
        else:
            raise self._bad_line(1, first, f"{json.dumps(HEADER)}; start another file")
        self._file.truncate(whole)
        self._file.seek(whole)
        if not whole:
            self._write(header)

    def _read_chunks(self, whole: int) -> int:
        """Index the chunks of all lines but the first; the end of the last whole line."""
        number = 1
        while line := self._file.readline(MAX_LINE_BYTES):
            number += 1
            if not line.endswith(b"\n") and len(line) < MAX_LINE_BYTES:
                break
            try:
                self._places[_parse(line)[0]] = whole
            except (ValueError, RecursionError):
                raise self._bad_line(number, line, "a line that `ninja-game verify --resume` wrote") from None
            whole += len(line)
        return whole

    def _bad_line(self, number: int, line: bytes, expected: str) -> FormatError:
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
        written_key, results = _parse(self._file.readline())
        self._file.seek(end)
        if written_key != key:
            raise FormatError(
                "the checkpoint log was changed meanwhile", str(self.path), expected="one writer at a time"
            )
        return results

    def add(self, key: str, results: Sequence[Result]) -> None:
        self._places[key] = self._file.tell()
        fields: dict[str, Any] = {"chunk": key, "results": [asdict(result) for result in results]}
        self._write(json.dumps(fields).encode() + b"\n")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()


def _parse(line: bytes) -> tuple[str, list[Result]]:
    """The key and the results of a chunk's line. Raises ValueError for an invalid one, RecursionError."""
    fields = json.loads(line)
    if not isinstance(fields, dict) or fields.keys() != {"chunk", "results"} or not isinstance(fields["results"], list):
        raise ValueError("not the line of a chunk")
    return str(fields["chunk"]), [result_from_data(data) for data in fields["results"]]
