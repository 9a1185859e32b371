"""Packs under edit: each function changes the folder of a pack on the disk; comments in its index stay.

All raise NinjaGameError for what cannot be done, and OSError. Levels keep their files; which episode has them, and in
what order, is written into the index.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from ninja_game.editor.ascii_text import ascii_text
from ninja_game.editor.draft import Draft
from ninja_game.editor.files import SUFFIX, draft_of, open_source, save
from ninja_game.errors import PackError
from ninja_game.files.reading import read_bytes, read_utf8
from ninja_game.files.shown_text import file_stem
from ninja_game.files.toml import parse_toml
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import free_path
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.files import INDEX, certificate_name
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE, MOST_EPISODES, parse_index
from ninja_game.formats.pack.pack import Pack
from ninja_game.runs.packs import KINDS
from ninja_game.sim.level import Level

_HEADS = re.compile(r"(?m)^(?=[ \t]*\[\[)")


def toml_value(value: str | int | Sequence[str]) -> str:
    r"""A value as TOML writes it.

    >>> toml_value(["a", 'the "b"']), toml_value(3)
    ('["a", "the \\"b\\""]', '3')
    """
    if isinstance(value, str | int):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return f"[{', '.join(map(toml_value, value))}]"


def with_value(block: str, key: str, value: str | int | Sequence[str]) -> str:
    r"""A table of an index with an entry in its old place, else behind the others; comments beside it stay.

    >>> with_value('name = "a"\nlevels = [\n  "b",\n]\n# why\n', "levels", [])
    'name = "a"\nlevels = []\n# why\n'
    """
    lines = block.splitlines()
    entry = re.compile(rf"\s*[\"']?{key}[\"']?\s*=")
    first = next((number for number, line in enumerate(lines) if entry.match(line)), None)
    if first is None:
        entries = [number for number, line in enumerate(lines) if line.strip() and not line.lstrip().startswith("#")]
        first = last = max(entries, default=-1) + 1
    else:
        last = next(end for end in range(first + 1, len(lines) + 1) if _is_toml("\n".join(lines[first:end])))
    return "\n".join([*lines[:first], f"{key} = {toml_value(value)}", *lines[last:]]) + "\n"


def _is_toml(text: str) -> bool:
    with suppress(ValueError):
        parse_toml(text)
        return True
    return False


def _change_index(path: Path, change: Callable[[list[str]], Sequence[str]]) -> None:
    """Write an index whose blocks, the first entries and then a table each, ``change`` has made."""
    text = "".join(change(_HEADS.split(read_utf8(path / INDEX))))
    parse_index(text, file=str(path / INDEX))
    Tree(path).write(INDEX, text)


def new_pack(folder: Path, name: str, author: str) -> Path:
    """A pack with one empty episode; its folder, in ``folder``."""
    path = free_path(folder, file_stem(name, "pack"), "")
    text = "".join(f"{key} = {toml_value(value)}\n" for key, value in (("name", name), ("author", author)))
    parse_index(text)
    Tree(path).write(INDEX, f'{text}\n[[episode]]\nnumber = 0\nname = "Episode 1"\nlevels = []\n')
    return path


def copy_pack(pack: Pack, folder: Path, name: str) -> Path:
    """A copy of a pack by another name; its folder, in ``folder``."""
    path = free_path(folder, file_stem(name, "pack"), "")
    for file in pack.files.own_names:
        Tree(path).write(file, pack.files.text(file))
    describe(path, {"name": name})
    return path


def describe(path: Path, values: Mapping[str, str | Sequence[str]]) -> None:
    """Other first entries of the index: name, author, version, comment, columns."""

    def change(blocks: list[str]) -> list[str]:
        for key, value in values.items():
            blocks[0] = with_value(blocks[0], key, value)
        return blocks

    _change_index(path, change)


def accept(path: Path, file: str, code: str, reason: str) -> None:
    """Accept a finding about a file, for a reason that the index keeps."""
    entries = {"file": file, "code": code, "reason": reason}
    text = "".join(f"{key} = {toml_value(value)}\n" for key, value in entries.items())
    _change_index(path, lambda blocks: [*blocks, f"\n[[accept]]\n{text}"])


# --- episodes ---


def _change_episodes(path: Path, changes: Mapping[int, Mapping[str, str | int | Sequence[str]]]) -> None:
    """Change entries of episodes by their numbers."""
    index = parse_index(read_utf8(path / INDEX), file=str(path / INDEX))
    numbers = {episode.line: episode.number for episode in index.episodes}

    def change(blocks: list[str]) -> list[str]:
        line = 1
        changed = []
        for block in blocks:
            following = line + block.count("\n")
            for key, value in changes.get(numbers.get(line, -1), {}).items():
                block = with_value(block, key, value)  # noqa: PLW2901 - one entry after the other
            changed.append(block)
            line = following
        return changed

    _change_index(path, change)


def rename_episode(path: Path, number: int, name: str) -> None:
    _change_episodes(path, {number: {"name": name}})


def new_episode(path: Path, name: str, column: int) -> int:
    """An episode below the others of a column; its number."""
    number = _free_number({episode.number for episode in Pack(path).index.episodes}, column)
    text = f"\n[[episode]]\nnumber = {number}\nname = {toml_value(name)}\nlevels = []\n"
    _change_index(path, lambda blocks: [*blocks[:-1], blocks[-1].rstrip("\n") + "\n", text])
    return number


def _free_number(numbers: set[int], column: int) -> int:
    """The number behind the last one of a column, or the first that is free."""
    places = range(column * EPISODES_PER_COLUMN, min(MOST_EPISODES, (column + 1) * EPISODES_PER_COLUMN))
    last = max((number for number in numbers if number in places), default=places.start - 1)
    free = [number for number in places if number not in numbers]
    if not free:
        raise PackError(f"column {column + 1} is full", expected="at most ten episodes in each of ten columns")
    return next((number for number in free if number > last), free[0])


def remove_episode(path: Path, number: int) -> None:
    """Take an episode out of the index; its levels stay, in no episode."""
    pack = Pack(path)
    line = next(episode.line for episode in pack.index.episodes if episode.number == number)

    def change(blocks: list[str]) -> list[str]:
        starts = [1 + sum(block.count("\n") for block in blocks[:place]) for place in range(len(blocks))]
        return [block for block, start in zip(blocks, starts, strict=True) if start != line]

    _change_index(path, change)


def move_episode(path: Path, number: int, to: int) -> None:
    """Put an episode into the place of another, which goes down by one with those below it; also into a column."""
    pack = Pack(path)
    files = {episode.number: episode.files(pack.files.levels) for episode in pack.index.episodes}
    column = to // EPISODES_PER_COLUMN
    there = sorted(each for each in files if each // EPISODES_PER_COLUMN == column)
    order = [each for each in there if each != number]
    below = there.index(to) if to in there else len(order)
    places = there if number in there else sorted([*there, _free_number(set(files), column)])
    order.insert(below, number)
    moved = {old: new for old, new in zip(order, places, strict=True) if old != new}
    _change_episodes(path, {old: {"number": new, "levels": files[old]} for old, new in moved.items()})


# --- levels ---


def place(path: Path, file: str, number: int | None, before: str = "") -> None:
    """Put a level into an episode, before another or at the end; ``number``: None for no episode."""
    pack = Pack(path)
    old = {episode.number: list(episode.files(pack.files.levels)) for episode in pack.index.episodes}
    new = {each: [name for name in files if name != file] for each, files in old.items()}
    if number is not None:
        if len(new[number]) >= LEVELS_PER_EPISODE:
            raise PackError(f"episode {number + 1} is full", expected=f"at most {LEVELS_PER_EPISODE} levels")
        new[number].insert(new[number].index(before) if before in new[number] else len(new[number]), file)
    _change_episodes(path, {each: {"levels": files} for each, files in new.items() if files != old[each]})


def new_level(path: Path, name: str, author: str) -> str:
    """An empty level in the folder; its file's name."""
    return _write(path, Draft(Level(), name, author))


def _write(path: Path, draft: Draft) -> str:
    file = free_path(path, file_stem(draft.name, "level"), SUFFIX).name
    Tree(path).write(file, ascii_text(draft))
    return file


def rename_level(file: Path, name: str) -> None:
    """Give the level of a readable file another name; the file keeps its own."""
    source = open_source(file)
    save(source, replace(source.draft, name=name), file)


def duplicate(path: Path, level: NamedLevel) -> str:
    """A copy of a level in the folder, by another name; its file's name."""
    return _write(path, replace(draft_of(level), name=f"{level.name} copy"))


def transfer(level: NamedLevel, path: Path, *, keep: bool) -> str:
    """Take a level and its certificates into another folder; its file's name there. ``keep``: they stay here too."""
    old = Path(level.file)
    if not (level.ascii and old.is_file()):
        return _write(path, draft_of(level))
    new = free_path(path, old.stem, old.suffix).name
    moved = {old.name: new} | {certificate_name(old.name, kind): certificate_name(new, kind) for kind in KINDS}
    there = [name for name in moved if (old.parent / name).is_file()]
    if not keep and (old.parent / INDEX).is_file():
        place(old.parent, old.name, None)
    for name in there:
        Tree(path).write(moved[name], read_bytes(old.parent / name))
    for name in [] if keep else there:
        Tree(old.parent).remove(name)
    return new
