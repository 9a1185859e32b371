"""Recordings cut into chunks that can be verified anywhere: some files, or some records of a large one.

A chunk carries its text, so that it can be sent to a machine that does not see the files, as JSON. Only what a
replay of ours names by path is read where the chunk is verified; ``self_contained`` puts it inside first.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from hashlib import sha256
from pathlib import Path
from typing import Any, get_type_hints

from ninja_game.budget import RUN_BUDGET
from ninja_game.errors import NinjaGameError
from ninja_game.formats.n14.level_file import LevelRecord
from ninja_game.formats.named_level import level_of_replay
from ninja_game.formats.replay.text import is_replay, parse_replay, write_replay
from ninja_game.runs.recording_reader import Unreadable, recording_of_text, recordings_of, records_of, texts_in
from ninja_game.runs.verify import Verdict, verify_recording
from ninja_game.sim.level import Level
from ninja_game.verification.workers import ClusterError

_INCLUDE = re.compile(r"^[ \t]+include[ \t]", re.MULTILINE)

RECORDS = 64
"""Records a chunk at most: enough that sending it is cheap beside running it."""

Result = Verdict | Unreadable


@dataclass(frozen=True)
class Chunk:
    """A file, or records ``first`` … of one.

    ``text``: of the whole file, if ``records`` is empty; ``problem``: why the file cannot be read, '' if it can;
    ``named``: whether the caller named the file, or it was found in a folder; ``key``: by which the checkpoint log
    knows it, ``done``: whether that has its results.
    """

    file: str
    first: int = 0
    text: str = field(default="", repr=False)
    records: tuple[LevelRecord, ...] = field(default=(), repr=False)
    problem: str = ""
    named: bool = True
    key: str = ""
    done: bool = False

    @property
    def weight(self) -> int:
        """About how much work it is."""
        return len(self.records) or 1

    @property
    def digest(self) -> str:
        """Sha256 (hex) of its content and its file's name: of everything that its results tell of."""
        return sha256(json.dumps(asdict(self)).encode()).hexdigest()


def chunks_in(paths: Iterable[Path]) -> Iterator[Chunk]:
    """All chunks of files and folders, in order, each read when it is asked for."""
    for found in texts_in(paths):
        if isinstance(found, Unreadable):
            yield Chunk("", problem=found.message)
            continue
        file, text, named = found
        records = records_of(text, file)
        if not records:
            yield Chunk(file, text=text, named=named)
        for first in range(0, len(records), RECORDS):
            yield Chunk(file, first, records=tuple(records[first : first + RECORDS]), named=named)


def self_contained(chunk: Chunk) -> Chunk:
    """The same chunk with the level inside, where a replay of ours names it by path; what is wrong stays as it is."""
    if not is_replay(chunk.text):
        return chunk
    try:
        parsed = parse_replay(chunk.text, file=chunk.file)
        if not (parsed.level_path or _INCLUDE.search(chunk.text)):
            return chunk
        level = level_of_replay(parsed, chunk.file) if parsed.level_path else parsed.level
        return replace(chunk, text=write_replay(replace(parsed, level=level, level_path="")))
    except NinjaGameError as error:
        return replace(chunk, problem=str(error))


def verify_chunk(
    chunk: Chunk, memory: str = "auto", level: Level | None = None, budget: int = RUN_BUDGET
) -> list[Result]:
    """A verdict on every recording of a chunk, in order; what cannot be read is said and stops nothing.

    ``level``: what recordings that do not hold their level are played on. ``budget``: of each run.
    """
    if chunk.problem:
        return [Unreadable(chunk.problem)]
    if chunk.records:
        recordings = recordings_of(chunk.records, chunk.file, level)
    else:
        recordings = recording_of_text(chunk.text, chunk.file, level, named=chunk.named)
    results: list[Result] = []
    result: Result
    for recording in recordings:
        try:
            result = recording if isinstance(recording, Unreadable) else verify_recording(recording, memory, budget)
        except NinjaGameError as error:
            result = Unreadable(str(error))
        results.append(result)
    return results


# --- as plain data ---


def chunks_as_text(chunks: Sequence[Chunk]) -> str:
    """Chunks as JSON, for another machine."""
    return json.dumps([asdict(chunk) for chunk in chunks])


def chunks_from_text(text: str) -> list[Chunk]:
    """The chunks that ``chunks_as_text`` wrote."""
    return [
        Chunk(**(fields | {"records": tuple(LevelRecord(**record) for record in fields["records"])}))
        for fields in json.loads(text)
    ]


def results_as_text(results: Sequence[Sequence[Result]]) -> str:
    """The results of several chunks as JSON."""
    return json.dumps([[as_data(result) for result in each] for each in results])


def results_from_text(text: object) -> list[list[Result]]:
    """The results that ``results_as_text`` wrote. Raises ClusterError for anything else: it comes from elsewhere."""
    try:
        return [[result_from_data(data) for data in each] for each in json.loads(str(text))]
    except (ValueError, TypeError, RecursionError) as error:
        raise ClusterError(f"a worker of the cluster answers with something else than results ({error})") from None


def as_data(result: Result) -> dict[str, Any]:
    """A result as a dictionary of plain values."""
    return asdict(result)


_TYPES = {name: hint for name, hint in get_type_hints(Verdict).items() if name != "problems"}


def result_from_data(data: object) -> Result:
    """The result that ``as_data`` gave, also after a way through JSON. Raises ValueError for anything else."""
    if isinstance(data, dict) and data.keys() == {"message"} and isinstance(data["message"], str):
        return Unreadable(data["message"])
    if not isinstance(data, dict) or data.keys() != {*_TYPES, "problems"}:
        raise ValueError("not the fields of a result")
    for name, kind in _TYPES.items():
        value = data[name]
        if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
            raise ValueError(f"{name} is {value!r}"[:80])
    problems = data["problems"]
    if not isinstance(problems, (list, tuple)) or not all(isinstance(problem, str) for problem in problems):
        raise ValueError("problems are no list of texts")
    return Verdict(**(data | {"problems": tuple(problems)}))
