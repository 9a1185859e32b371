"""Packs under edit: each function changes the folder of a pack on the disk; comments in its index stay.

All raise NinjaGameError for an impossible change, and OSError. Levels keep their files; the index lists the levels of
each episode, in order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass, replace
from itertools import count
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, NamedTuple

from ninja_game.backend.memories import compiled_available
from ninja_game.editor.certify import COMPILING
from ninja_game.editor.draft import Draft
from ninja_game.editor.files import SUFFIX, ascii_text, draft_of, open_source, save
from ninja_game.errors import LinkError, NinjaGameError, PackError
from ninja_game.files.reading import read_bytes, read_utf8
from ninja_game.files.shown_text import counted, file_stem, name_problem, shown_text
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import free_path
from ninja_game.formats.links import whole_certificate
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN, LEVELS_PER_EPISODE, MAX_COLUMNS, parse_index
from ninja_game.formats.pack.pack import CERTIFICATES, INDEX, MAX_FILES, PARS, RECEIVED, Pack, certificate_name
from ninja_game.formats.pack.pars import write_pars
from ninja_game.levels.episodes import episode_set
from ninja_game.levels.findings import Finding, PackFinding
from ninja_game.runs.packs import RUN_KINDS, findings, has_gold_out_of_reach, is_certified, level_of, make_pars
from ninja_game.runtime import install_hint
from ninja_game.sim.level import Level

if TYPE_CHECKING:
    from tomlkit import TOMLDocument

Values = Mapping[str, str | int | Sequence[str]]


# --- undo ---


class Step(NamedTuple):
    """A change of packs that can be undone."""

    name: str
    #: By folder and name of a changed file: its bytes before and after; None for a missing file
    texts: dict[tuple[Path, str], tuple[bytes | None, bytes | None]]
    moves: list[tuple[Path, Path]]  #: folders, from and to


_step: ContextVar[Step | None] = ContextVar("step", default=None)
"""The present step of this thread, to which each change below is added."""


class Steps(list[Step]):
    """The last dozen steps, in memory."""

    def run(self, name: str, action: Callable[[], object]) -> bool:
        """Change packs by the functions here; whether anything changed. Raises as ``action`` does.

        Changes before an error are a step too.
        """
        step = Step(name, {}, [])
        token = _step.set(step)
        try:
            action()
        finally:
            _step.reset(token)
            changed = bool(step.moves) or any(old != new for old, new in step.texts.values())
            if changed:
                self[:] = [*self, step][-12:]
        return changed

    def undo(self) -> str:
        """Undo the newest step; its name. Nothing is done if its files have changed since.

        Raises NinjaGameError then, OSError: a failed undo can be tried again.
        """
        if not self:
            raise NinjaGameError("there is nothing to undo")
        step_name, texts, moves = self[-1]
        changed = [name for (folder, name), versions in texts.items() if _text(folder / name) not in versions]
        changed += [old_place.name for old_place, _ in moves if old_place.exists()]
        if changed:
            self.pop()
            raise NinjaGameError(f"{step_name}: not undone, as {changed[0]} was changed since")
        for old_place, new_place in moves:
            new_place.rename(old_place)
        for (folder, name), (old, _) in texts.items():
            _write_file(folder, name, old)
        new_packs = [folder for (folder, name), (old, _) in texts.items() if name == INDEX and old is None]
        for empty in [place for folder in new_packs for place in (folder / CERTIFICATES, folder)]:
            with suppress(OSError):
                empty.rmdir()
        self.pop()
        return step_name


def _text(path: Path) -> bytes | None:
    """None for a missing file. Raises FileError, OSError for one that cannot be read."""
    return read_bytes(path) if path.exists() else None


@contextmanager
def _noted(folder: Path, name: str) -> Iterator[None]:
    """Add a file's change within the block to the step."""
    step = _step.get()
    before = _text(folder / name) if step else None
    yield
    if step:
        first, _ = step.texts.get((folder, name), (before, None))
        step.texts[folder, name] = first, _text(folder / name)


def _write_file(folder: Path, name: str, text: bytes | str | None) -> None:
    """Write a file, or delete it if ``text`` is None."""
    with _noted(folder, name):
        if text is None:
            Tree(folder).remove(name)
        else:
            Tree(folder).write(name, text)


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
    _write_file(path, INDEX, text)


def _add(document: TOMLDocument, key: str, values: Values) -> None:
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


def _remove(document: TOMLDocument, key: str, values: Values) -> None:
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
        _write_file(path, file, None)
    for file in names:
        text, level = pack.files.text(file), pack.levels.get(level_of(pack, file))
        _write_file(path, file, whole_certificate(text, level) if level else text)
    describe(path, {"name": name})
    if received:
        _write_file(path, RECEIVED, "")
    return path


def news(old: Pack, pack: Pack) -> str:
    """The differences between a pack and an older version of it."""
    both = old.levels.keys() & pack.levels.keys()
    changed = sum(old.levels[file].level != pack.levels[file].level for file in both)
    counts = {"new": len(pack.levels) - len(both), "changed": changed, "gone": len(old.levels) - len(both)}
    return ", ".join(f"{counted(n, 'level')} {what}" for what, n in counts.items() if n) or "Its levels are the same"


def make_own(path: Path) -> None:
    """Make a received pack the player's own."""
    _write_file(path, RECEIVED, None)


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
    new = path.rename(free_path(folder, path.name, ""))
    if step := _step.get():
        step.moves.append((path, new))
    return new


def same_pack(pack: Pack, other: Pack) -> bool:
    """Whether two packs have the same files, except certificates, which links shorten."""
    one, two = (
        {name: pack.files.text(name) for name in pack.files.own_names if not name.startswith(CERTIFICATES)}
        for pack in (pack, other)
    )
    return one == two


# --- episodes ---


def _change_episodes(path: Path, changes: Mapping[int, Values]) -> None:
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


def place(path: Path, names: Sequence[str], number: int | None, before: str = "") -> None:
    """Put levels into an episode, in this order, before another or at the end; ``number``: None for no episode."""
    pack = Pack(path)
    old = {episode.number: list(episode.files(pack.files.levels)) for episode in pack.index.episodes}
    new = {key: [name for name in files if name not in names] for key, files in old.items()}
    if number is not None:
        at = new[number].index(before) if before in new[number] else len(new[number])
        new[number][at:at] = names
        if len(new[number]) > LEVELS_PER_EPISODE:
            raise PackError(f"episode {number + 1} is full", expected=f"at most {LEVELS_PER_EPISODE} levels")
    _change_episodes(path, {key: {"levels": files} for key, files in new.items() if files != old[key]})


def new_level(path: Path, name: str, author: str) -> str:
    return _write_level(path, Draft(Level(), name, author))


def _write_level(path: Path, draft: Draft) -> str:
    file = free_path(path, file_stem(draft.name, "level"), SUFFIX).name
    _write_file(path, file, ascii_text(draft))
    return file


def rename_level(file: Path, name: str) -> None:
    """Give the level of a readable file another name; the file keeps its own."""
    source = open_source(file)
    with _noted(file.parent, file.name):
        save(source, replace(source.draft, name=name), file)


def duplicate(path: Path, level: NamedLevel) -> str:
    """A copy of a level in the folder, by a name that no level there has; its file's name."""
    names = {other.name for other in Pack(path).levels.values()}
    copies = (f"{level.name} copy{f' {number}' if number > 1 else ''}" for number in count(1))
    return _write_level(path, replace(draft_of(level), name=next(name for name in copies if name not in names)))


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
        _write_file(path, names[name], read_bytes(old.parent / name))
    for name in [] if keep else files:
        _write_file(old.parent, name, None)
    return new


def bring(levels: Sequence[NamedLevel], path: Path, folder: Path) -> list[str]:
    """Move levels into one of the player's folders; their files' names there.

    Those that are not the player's own are copied: from outside ``folder``, or in a received pack. Raises PackError for
    a received pack as goal.
    """
    if (path / RECEIVED).exists():
        raise PackError("that pack was received, and stays as it is")
    names = []
    for level in levels:
        file = Path(level.file)
        foreign = folder not in file.parents or (file.parent / RECEIVED).exists()
        names.append(file.name if file.parent == path else transfer(level, path, keep=foreign))
    return names


Say = Callable[[str, float | None], object]
"""Gets the present work, and the finished share of it, None if unknown."""

Obstacles = dict[tuple[Level, str], Finding]
"""By level and kind of certificate ("exit", "gold"): why the solver found no such run."""

_MISSING = {"no-certificate": "exit", "no-gold-run": "gold"}
"""Codes of findings about missing runs, with the kind of run."""

_SOUGHT = {"exit": "run to the exit", "gold": "run with all gold"}
_GOALS = {"exit": "exit", "gold": "all gold"}

MADE_READY = (*_MISSING, "certificate", "no-pars", "old-pars")
"""Codes of findings that ``make_ready`` removes, unless its search fails."""


@dataclass(frozen=True)
class ReadyPack:
    """A pack to share."""

    pack: Pack
    findings: list[PackFinding]  #: accepted or not
    zipped: bytes  #: bytes of its zip
    link: str  #: "" where it is too large for one
    notes: list[str]  #: what could not be done

    @property
    def problems(self) -> list[PackFinding]:
        """The findings that are not accepted."""
        return [finding for finding in self.findings if not finding.reason]


def make_ready(path: Path, *, seconds: float, jobs: int, say: Say, obstacles: Obstacles | None = None) -> ReadyPack:
    """Certify each level to the exit and with all gold, write the par times, lint; the zip and the link.

    ``seconds``: for each search; ``jobs``: levels at a time; ``say`` may raise to end it. ``obstacles``: of earlier
    searches, which are not repeated; those of new ones are added. Raises NinjaGameError, OSError.
    """
    pack, notes, obstacles = Pack(path), list[str](), {} if obstacles is None else obstacles
    if compiled_available():
        _certify(pack, path, seconds, jobs, say, obstacles)
    else:
        notes.append(f"Certifying needs Numba: {install_hint('fast')}")
    pack, pars = Pack(path), {}
    try:
        for file, pars_of_level in make_pars(pack):
            pars[file] = pars_of_level
            measured = f"Measuring medal times: {len(pars)} of {counted(len(pack.levels), 'level')}"
            say(measured, len(pars) / len(pack.levels))
        Tree(path).write(PARS, write_pars(pars))
    except NinjaGameError as error:
        notes.append(f"No par times: {error}")
    say("Looking for problems", 1.0)
    pack, link = Pack(path), ""
    problems = problems_of(pack, obstacles)
    try:
        link = pack.files.link()
    except LinkError as error:
        notes.append(f"No link: {error}")
    return ReadyPack(pack, problems, pack.files.zipped(), link, notes)


def problems_of(pack: Pack, obstacles: Obstacles) -> list[PackFinding]:
    """The findings about a pack, accepted or not; one about a run that a search did not find says why it did not.

    A level without a run to the exit has no finding about a missing run with all gold.
    """
    problems, no_exit = list[PackFinding](), set[Level]()
    for finding in findings(pack, with_gold=True):
        named_finding, missing = finding, missing_run(pack, finding)
        if missing and (why := obstacles.get(missing)):
            level, kind = missing
            if kind == "gold" and level in no_exit:
                continue
            no_exit |= {level} if kind == "exit" else set()
            named_finding = finding._replace(values={}, odd=why, sought=_SOUGHT[kind])
        problems += [named_finding] if named_finding not in problems else []
    return problems


def missing_run(pack: Pack, finding: PackFinding) -> tuple[Level, str] | None:
    """The level and the kind of the run of which a finding says that it is missing, as ``Obstacles`` have them."""
    file, kind = _missing(pack, finding.file, finding.code)
    return (pack.levels[file].level, kind) if kind and file in pack.levels else None


def _missing(pack: Pack, file: str, code: str) -> tuple[str, str]:
    """The level file and the kind of the run that a finding about a file misses; no kind for other findings."""
    level = level_of(pack, file)
    broken = [kind for kind in RUN_KINDS if code == "certificate" and certificate_name(level, kind) == file]
    return level, next(iter(broken), _MISSING.get(code, ""))


def _certify(pack: Pack, path: Path, seconds: float, jobs: int, say: Say, obstacles: Obstacles) -> None:
    """Certify the levels with missing runs that are not accepted as missing."""
    from ninja_game.search.certify import CertifyOptions, certify_all
    from ninja_game.search.solve import compile_solver
    from ninja_game.search.task import Progress, obstacle

    accepted = {_missing(pack, entry.file, entry.code) for entry in pack.index.accepted}

    def is_open(file: str, kind: str) -> bool:
        level, says = pack.levels[file].level, pack.levels[file].says
        settled = (level, kind) in obstacles or (file, kind) in accepted
        vain = kind == "gold" and has_gold_out_of_reach(level, says)
        return not (settled or vain or is_certified(pack, file, kind))

    in_order = [Path(level.named.file).name for level in episode_set(pack, "").levels]
    levels = {file: pack.levels[file] for file in in_order if any(is_open(file, kind) for kind in RUN_KINDS)}
    options = CertifyOptions({"exit": 0, "gold": -1}, {"seconds": seconds})
    files = [{kind: path / certificate_name(file, kind) for kind in RUN_KINDS} for file in levels]
    goals = {
        file: [_GOALS[kind] for kind in RUN_KINDS[: 1 + (named.level.gold > 0)] if not is_certified(pack, file, kind)]
        for file, named in levels.items()
    }
    planned = {Path(file).stem: seconds * len(sought) for file, sought in goals.items()}
    names = [f"{shown_text(levels[file].name)} ({' and '.join(sought)})" for file, sought in goals.items()]
    begun, done, share = dict[str, float](), 0, 0.0

    def report(name: str, _: Progress) -> None:
        """What is left goes by what the planned seconds took so far, of which the first are taken to go as planned."""
        nonlocal share
        now = monotonic()
        begun.setdefault(name, now)
        rest = [max(0.0, planned[stem] - now + begun.get(stem, now)) for stem in list(planned)[done:]]
        elapsed, worked = now - min(begun.values()), sum(planned.values()) - sum(rest)
        pace = (elapsed + seconds / min(jobs, len(levels))) / (worked + seconds)
        left = max(pace * sum(rest), *rest, 0.0)
        share = max(share, elapsed / max(elapsed + left, 1.0))
        spent = now - begun.get(list(planned)[done], now)
        about = f"about {left:.0f} s left" if left >= 1 else "nearly done"
        say(f"Certifying level {done + 1} of {len(levels)}, {names[done]}: {spent:.0f} s so far, {about}", share)

    if levels:
        say(f"{COMPILING}. You can go on with something else meanwhile", None)
        compile_solver()
        say("Starting the search", None)
    all_found = certify_all(list(levels.values()), files, options, jobs=jobs, report=report)
    for named, by_goal in zip(levels.values(), all_found, strict=True):
        for kind, certified in by_goal.items() if isinstance(by_goal, dict) else ():
            if not certified.run and certified.progress:
                obstacles[named.level, kind] = obstacle(named.level, certified.gold, certified.progress)
        done += 1
        say(f"Certifying: {done} of {counted(len(levels), 'level')} done", share)
