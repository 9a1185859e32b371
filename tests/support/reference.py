"""The reference data ``../shared/n14``: where it lies, and its tables as typed rows (README there).

It belongs to others and is never copied: a test that needs it calls ``require_reference()`` and skips where it is
missing.
"""

import lzma
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple, TypeVar, get_type_hints

import pytest

from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string

ROOT = Path(__file__).resolve().parent.parent.parent
FOLDER = ROOT.parent / "shared" / "n14"

R = TypeVar("R")


def reference_folder() -> Path | None:
    """The folder of the reference data, None where it is missing."""
    return FOLDER if FOLDER.is_dir() else None


def require_reference() -> Path:
    """The folder of the reference data; skips the test where it is missing."""
    folder = reference_folder()
    if folder is None:
        pytest.skip("the reference data ../shared/n14 is not here")
    return folder


class LevelRow(NamedTuple):
    """A published level: ``label`` is episode-level, ``data`` the in-game string."""

    label: str
    name: str
    author: str
    data: str


class RunRow(NamedTuple):
    """A run with the ninja's positions: a recording of a passed level, or random keys.

    ``data``: the in-game string it runs on; ``end_tick``: -1 if nothing ended it; ``offset``: where its ``ticks``
    positions and states start in ``positions()``; ``source``, ``kind`` and ``score_ticks``: only of recordings.
    """

    table: str
    row: int
    label: str
    source: str
    kind: str
    outcome: str
    end_tick: int
    score_ticks: int
    gold: int
    ticks: int
    offset: int
    sha256_xy: str
    data: str
    demo: str


class AftermathRow(NamedTuple):
    """The run ``row`` of ``table``, 150 ticks beyond its end: digests; ``objects``: id -> 8 hex digits."""

    table: str
    row: int
    ticks: int
    ninja_sha256: str
    run_sha256: str
    objects: dict[int, str]


class SceneRow(NamedTuple):
    """A small level that shows one rule (section of the specification); its trace is in ``scene_traces()``."""

    name: str
    rule: str
    ticks: int
    ninja_sha256: str
    run_sha256: str
    offset: int
    data: str
    demo: str


class FuzzRow(NamedTuple):
    """A crowded random level with random keys; ``objects``: id -> 8 hex digits."""

    name: str
    ticks: int
    ninja_sha256: str
    run_sha256: str
    objects: dict[int, str]
    data: str
    demo: str


def _rows(table: str) -> Iterator[dict[str, str]]:
    """The rows of a table as dictionaries."""
    with (require_reference() / f"{table}.tsv").open(encoding="utf-8", newline="\n") as lines:
        header = next(lines).rstrip("\n").split("\t")
        for line in lines:
            yield dict(zip(header, line.rstrip("\n").split("\t"), strict=True))


def _objects(text: str) -> dict[int, str]:
    """``id:digest,id:digest`` as a dictionary."""
    return {int(part.partition(":")[0]): part.partition(":")[2] for part in text.split(",") if part}


_READ: dict[Any, Callable[[str], Any]] = {int: int, str: str, dict[int, str]: _objects}


def _read(kind: Callable[..., R], row: dict[str, str], /, **more: object) -> R:
    """A row of a table: each field from the column of its name, read as its type says. ``more``: other fields."""
    fields = {name: _READ[hint](row[name]) for name, hint in get_type_hints(kind).items() if name in row}
    return kind(**fields | more)


@cache
def levels() -> tuple[LevelRow, ...]:
    """The 500 published levels."""
    return tuple(_read(LevelRow, row, label=row["level"]) for row in _rows("levels"))


def _runs(table: str, published: dict[str, str]) -> Iterator[RunRow]:
    """The runs of a table. ``published``: levels of those that do not say theirs."""
    for number, row in enumerate(_rows(table)):
        label = row["level"]
        data = row.get("data") or row["own_level"] or published[label]
        filled = {"source": "", "kind": "", "score_ticks": "0"} | row
        yield _read(RunRow, filled, table=table, row=number, label=label, data=data)


@cache
def recordings() -> tuple[RunRow, ...]:
    """The 1108 recordings of passed levels, each with the level that it was made on."""
    return tuple(_runs("recordings", {level.label: level.data for level in levels()}))


@cache
def random_runs() -> tuple[RunRow, ...]:
    """The 1834 runs with random keys."""
    return tuple(_runs("random_runs", {}))


@cache
def aftermath() -> tuple[AftermathRow, ...]:
    """The 2942 runs of both tables with 150 ticks more."""
    return tuple(_read(AftermathRow, row) for row in _rows("aftermath"))


@cache
def scenes() -> tuple[SceneRow, ...]:
    """The 1142 scenes, each made to show one rule."""
    return tuple(_read(SceneRow, row) for row in _rows("scenes"))


@cache
def fuzz() -> tuple[FuzzRow, ...]:
    """The 1500 crowded random levels."""
    return tuple(_read(FuzzRow, row) for row in _rows("fuzz"))


@cache
def positions() -> bytes:
    """The unpacked positions: at a run's ``offset``, ``ticks`` pairs of float64, then ``ticks`` state bytes."""
    return lzma.decompress((require_reference() / "positions.bin.xz").read_bytes())


@cache
def scene_traces() -> bytes:
    """The unpacked traces of the scenes: at a scene's ``offset``, ``ticks`` records of everything."""
    return lzma.decompress((require_reference() / "scenes.bin.xz").read_bytes())


def write_pack(folder: Path) -> Path:
    """The published levels as a pack with a hundred episodes."""
    folder.mkdir()
    episodes = range(len(levels()) // 5)
    for number, row in enumerate(levels()):
        text = write_ascii_level(parse_level_string(row.data), name=row.name, author=row.author)
        (folder / f"{number // 5:02d}-{number % 5}.txt").write_text(text, "utf-8")
    index = "\n".join(f'[[episode]]\nnumber = {number}\nname = "Episode {number}"' for number in episodes)
    (folder / "pack.toml").write_text(f'name = "reference"\n{index}\n', "utf-8")
    return folder
