"""Packs under edit: each function changes the folder of a pack on the disk; comments in its index stay.

All raise NinjaGameError for an impossible change, and OSError. Levels keep their files; the index lists the levels of
each episode, in order.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ninja_game.editor.draft import Draft
from ninja_game.editor.files import SUFFIX, ascii_text, draft_of, open_source, save
from ninja_game.editor.pack_steps import move_folder, noted, write_file
from ninja_game.errors import PackError
from ninja_game.files.reading import read_bytes, read_utf8
from ninja_game.files.shown_text import counted, file_stem, name_problem, shown_text, unused_name
from ninja_game.files.user_folder import free_path
from ninja_game.formats.links import whole_certificate
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE, MAX_COLUMNS, parse_index
from ninja_game.formats.pack.pack import CERTIFICATES, INDEX, MAX_FILES, RECEIVED, Pack, certificate_name
from ninja_game.runs.packs import RUN_KINDS, level_file_of
from ninja_game.sim.level import Level

if TYPE_CHECKING:
    from tomlkit import TOMLDocument

_Values = Mapping[str, str | int | Sequence[str]]

# --- the index ---


def _change_index(path: Path, change: Callable[[TOMLDocument], object]) -> None:
    import tomlkit
    from tomlkit.exceptions import TOMLKitError

    text = read_utf8(path / INDEX)
    parse_index(text, file=str(path / INDEX))
    try:
        document = tomlkit.parse(text)
    except TOMLKitError as error:
        raise PackError(f"no TOML: {error}", str(path / INDEX)) from None
    change(document)
    _write_index(path, document)


def _write_index(path: Path, document: TOMLDocument) -> None:
    text = document.as_string()
    parse_index(text, file=str(path / INDEX))
    write_file(path, INDEX, text)


def _add(document: TOMLDocument, key: str, values: _Values) -> None:
    """A table [[key]] behind the others."""
    import tomlkit

    table = tomlkit.table()
    table.update(values)
    table.trivia.indent = "\n"
    tables: Any = document.get(key)
    if tables is None:
        document[key] = tomlkit.aot()
        tables = document[key]
    tables.append(table)


def _remove(document: TOMLDocument, key: str, values: _Values) -> None:
    """Delete the first table [[key]] with these values."""
    tables: Any = document[key]
    del tables[next(k for k, table in enumerate(tables) if all(table[name] == values[name] for name in values))]
    if not tables:
        del document[key]


def new_pack(folder: Path, name: str, author: str) -> Path:
    """A pack with one empty episode; its folder, in ``folder``."""
    import tomlkit

    path = free_path(folder, file_stem(name, "pack"), "")
    document = tomlkit.document()
    document.update({"name": name, "author": author})
    _add(document, "episode", {"number": 0, "name": "Episode 1", "levels": []})
    _write_index(path, document)
    return path


def copy_pack(pack: Pack, folder: Path, name: str, *, received: bool = False, over: Pack | None = None) -> Path:
    """A copy of any pack, by another name; its folder, in ``folder``. ``received``: it stays another author's.

    ``over``: a pack there, which is replaced.
    """
    names = pack.files.own_names
    if len(names) > MAX_FILES:
        raise PackError("a pack of too many files", found=f"{len(names):,}", expected=f"at most {MAX_FILES:,}")
    for file in names:
        if problem := name_problem(file.rpartition("/")[2]):
            raise PackError("a name that no file here can have", found=ascii(file[:40]), hint=problem)
    path = over.files.path if over else free_path(folder, file_stem(name, "pack"), "")
    for file in set(over.files.own_names) - {*names} if over else ():
        write_file(path, file, None)
    for file in names:
        text, level = pack.files.text(file), pack.levels.get(level_file_of(pack, file))
        write_file(path, file, whole_certificate(text, level) if level else text)
    describe(path, {"name": name})
    if received:
        write_file(path, RECEIVED, "")
    return path


def news(old: Pack, pack: Pack) -> str:
    """The differences between a pack and an older version of it; one or two levels of a kind are named."""
    both = old.levels.keys() & pack.levels.keys()
    kinds = {
        "new": [level.name for file, level in pack.levels.items() if file not in both],
        "changed": [pack.levels[file].name for file in both if old.files.text(file) != pack.files.text(file)],
        "gone": [level.name for file, level in old.levels.items() if file not in both],
    }
    texts = [
        f"{counted(len(names), 'level')} {what}"
        + (f": {shown_text(', '.join(sorted(names)))}" if len(names) < 3 else "")
        for what, names in kinds.items()
        if names
    ]
    return "; ".join(texts) or "Its levels are the same"


def make_own(path: Path) -> None:
    """Make a received pack the player's own."""
    write_file(path, RECEIVED, None)


def describe(path: Path, values: Mapping[str, str | Sequence[str]]) -> None:
    """Change the texts of the index: name, author, version, comment, columns."""
    _change_index(path, lambda document: document.update(values))


def accept(path: Path, file: str, code: str, reason: str) -> None:
    """Accept a finding about a file, with a reason for the index."""
    entries = {"file": file, "code": code, "reason": reason}
    _change_index(path, lambda document: _add(document, "accept", entries))


def take_back(path: Path, file: str, code: str) -> None:
    """Undo the acceptance of a finding."""
    _change_index(path, lambda document: _remove(document, "accept", {"file": file, "code": code}))


def bin_pack(path: Path, folder: Path) -> Path:
    """Move a pack's folder into another folder, under a free name; its new place."""
    folder.mkdir(parents=True, exist_ok=True)
    new = free_path(folder, path.name, "")
    move_folder(path, new)
    return new


def same_pack(pack: Pack, other: Pack, *, whole: bool = False) -> bool:
    """Whether two packs have the same files, unless ``whole`` except certificates, which links shorten."""
    one, two = (
        {name: pack.files.text(name) for name in pack.files.own_names if whole or not name.startswith(CERTIFICATES)}
        for pack in (pack, other)
    )
    return one == two


# --- episodes ---


def _change_episodes(path: Path, changes: Mapping[int, _Values]) -> None:
    def change(document: TOMLDocument) -> None:
        for table in document.get("episode", ()):
            table.update(changes.get(table["number"], {}))

    _change_index(path, change)


def rename_episode(path: Path, number: int, name: str) -> None:
    _change_episodes(path, {number: {"name": name}})


def new_episode(path: Path, name: str, column: int) -> int:
    """An episode below the others of a column; its number."""
    number = _free_number({episode.number for episode in Pack(path).index.episodes}, column)
    _change_index(path, lambda document: _add(document, "episode", {"number": number, "name": name, "levels": []}))
    return number


def _free_number(numbers: set[int], column: int) -> int:
    """The number behind the last one of a column, or the first free one."""
    places = range(column * EPISODES_PER_COLUMN, min(column + 1, MAX_COLUMNS) * EPISODES_PER_COLUMN)
    last = max((number for number in numbers if number in places), default=places.start - 1)
    free = [number for number in places if number not in numbers]
    if not free:
        most = f"at most {EPISODES_PER_COLUMN} episodes in each of {MAX_COLUMNS} columns"
        raise PackError(f"column {column + 1} is full", expected=most)
    return next((number for number in free if number > last), free[0])


def remove_episode(path: Path, number: int) -> None:
    """Take an episode out of the index; its levels stay, in no episode."""
    _change_index(path, lambda document: _remove(document, "episode", {"number": number}))


def move_episode(path: Path, number: int, to: int) -> None:
    """Put an episode into the place of another, which moves down by one with those below it; also into a column."""
    pack = Pack(path)
    files = {episode.number: episode.files(pack.files.levels) for episode in pack.index.episodes}
    column = to // EPISODES_PER_COLUMN
    in_column = sorted(other for other in files if other // EPISODES_PER_COLUMN == column)
    order = [other for other in in_column if other != number]
    below = in_column.index(to) if to in in_column else len(order)
    places = in_column if number in in_column else sorted([*in_column, _free_number(set(files), column)])
    order.insert(below, number)
    numbers = {old: new for old, new in zip(order, places, strict=True) if old != new}
    _change_episodes(path, {old: {"number": new, "levels": files[old]} for old, new in numbers.items()})


# --- levels ---


def place(path: Path, names: Sequence[str], number: int | None, before: str = "") -> bool:
    """Put levels into an episode, in this order, before another or at the end; whether that changes anything.

    ``number``: None for no episode.
    """
    pack = Pack(path)
    old = {episode.number: list(episode.files(pack.files.levels)) for episode in pack.index.episodes}
    new = {key: [name for name in files if name not in names] for key, files in old.items()}
    if number is not None:
        at = new[number].index(before) if before in new[number] else len(new[number])
        new[number][at:at] = names
        if len(new[number]) > LEVELS_PER_EPISODE:
            raise PackError(f"episode {number + 1} is full", expected=f"at most {LEVELS_PER_EPISODE} levels")
    _change_episodes(path, changes := {key: {"levels": files} for key, files in new.items() if files != old[key]})
    return bool(changes)


def new_level(path: Path, name: str, author: str) -> str:
    return _write_level(path, Draft(Level(), name, author))


def _write_level(path: Path, draft: Draft) -> str:
    file = free_path(path, file_stem(draft.name, "level"), SUFFIX).name
    write_file(path, file, ascii_text(draft))
    return file


def rename_level(file: Path, name: str) -> None:
    """Give the level of a readable file another name; the file keeps its own."""
    source = open_source(file)
    with noted(file.parent, file.name):
        save(source, replace(source.draft, name=name), file)


def duplicate(path: Path, level: NamedLevel) -> str:
    """A copy of a level in the folder, by a name that no level there has; its file's name."""
    names = {other.name for other in Pack(path).levels.values()}
    return _write_level(path, replace(draft_of(level), name=unused_name(f"{level.name} copy", names)))


def transfer(level: NamedLevel, path: Path, *, keep: bool) -> str:
    """Move a level and its certificates into another folder; its file's name there. ``keep``: copy them."""
    old = Path(level.file)
    if not (level.ascii and old.is_file()):
        return _write_level(path, draft_of(level))
    new = free_path(path, old.stem, old.suffix).name
    names = {old.name: new} | {certificate_name(old.name, kind): certificate_name(new, kind) for kind in RUN_KINDS}
    files = [name for name in names if (old.parent / name).is_file()]
    if not keep and (old.parent / INDEX).is_file():
        place(old.parent, [old.name], None)
    for name in files:
        write_file(path, names[name], read_bytes(old.parent / name))
    for name in [] if keep else files:
        write_file(old.parent, name, None)
    return new


def bring(levels: Sequence[NamedLevel], path: Path, folder: Path, *, copy: bool = False) -> list[str]:
    """Move levels into one of the player's folders; their files' names there. ``copy``: copy all of them.

    Those that are not the player's own are copied: from outside ``folder``, or in a received pack. Raises PackError for
    a received pack as goal.
    """
    if (path / RECEIVED).exists():
        raise PackError("that pack was received, and stays as it is")
    names = []
    for level in levels:
        file = Path(level.file)
        keep = copy or folder not in file.parents or (file.parent / RECEIVED).exists()
        here = duplicate(path, level) if copy and file.parent == path else file.name
        names.append(here if file.parent == path else transfer(level, path, keep=keep))
    return names
