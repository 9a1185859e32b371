"""Levels from files and back, with autosaves: no edit is lost, no file of others is replaced."""

from __future__ import annotations

import json
import re
import time
from collections import defaultdict
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from difflib import SequenceMatcher
from pathlib import Path

from ninja_game.document import History, RecoveryFile, check_free, common_length, digest_of_file, recovered_from
from ninja_game.editor.draft import Draft
from ninja_game.errors import DAMAGED, LevelError, NinjaGameError
from ninja_game.files.locking import remove_abandoned
from ninja_game.files.reading import digest_of, read_bytes, read_utf8
from ninja_game.files.user_folder import EDITING
from ninja_game.files.writing import write_atomically
from ninja_game.formats.ascii import writer
from ninja_game.formats.ascii.legend import visible_glyphs
from ninja_game.formats.ascii.object_lines import ListedObject, OddTile, read_object_line
from ninja_game.formats.ascii.picture import Problems
from ninja_game.formats.ascii.reader import parse_ascii_level, sections
from ninja_game.formats.lines import UNCOMMENTED, header_text, numbered_lines
from ninja_game.formats.links import is_link
from ninja_game.formats.load import load_levels, texts_of
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.runtime import NewestJob
from ninja_game.sim.kinds import EXIT, NINJA
from ninja_game.sim.level import COLUMNS, ROWS, Level, ObjectSpec

SUFFIX = ".txt"


@dataclass(frozen=True)
class Source:
    """The file of a draft. ``path``: None if it has none yet. ``text``: the file's.

    ``draft``: the one in the file; ``digest``: of its bytes; ``windows``: whether lines end as on Windows.
    """

    draft: Draft
    path: Path | None = None
    text: str = ""
    digest: str = ""
    windows: bool = False


def new_source(author: str = "", *, room: bool = False) -> Source:
    """A level that has no file: an empty one, or a room with a floor, the ninja and an exit."""
    floor = tuple(int(row == ROWS - 1) for _ in range(COLUMNS) for row in range(ROWS))
    things = ObjectSpec(NINJA, (84.0, 542.0)), ObjectSpec(EXIT, (684.0, 540.0, 396.0, 540.0))
    return Source(Draft(Level(floor, things) if room else Level(), author=author))


def open_source(path: Path, record: int = 0) -> Source:
    """The level number ``record`` of a file or link. ``save`` writes back only to readable files with one level.

    Raises NinjaGameError for a text that cannot be read, OSError.
    """
    linked = is_link(path)
    data = b"" if linked else read_bytes(path)
    texts = list(texts_of(path))
    text = texts[0][1]
    levels = [level for file, content in texts for level in parse_levels(content, file=file)]
    named = next((item for item in levels if item.record == record), None)
    if named is None:
        raise LevelError(f"there is no record {record}", str(path))
    draft = draft_of(named)
    if linked or not named.ascii:
        return Source(draft)
    return Source(draft, path, text, digest_of(data), b"\r\n" in data)


def draft_of(named: NamedLevel) -> Draft:
    return Draft(named.level, **writer.headers_of(named))


def save(source: Source, draft: Draft, path: Path, *, replacing: bool = False) -> Source:
    """Write a draft into a file, keeping the form of the source's file; the new source.

    Raises OccupiedError if that would replace another file, or one that has changed since it was read, unless
    ``replacing``; FileError, OSError if writing fails.
    """
    same_file = source.path is not None and path == source.path
    digest = digest_of_file(path)
    if same_file and draft == source.draft and digest == source.digest:
        return source
    check_free(path, digest, source.digest if same_file else None, replacing=replacing)
    text = updated_text(source.text, source.draft, draft) if same_file and source.text else ascii_text(draft)
    data = (text.replace("\n", "\r\n") if same_file and source.windows else text).encode("utf-8", "replace")
    if digest_of(data) != digest:
        write_atomically(path, data)
    return Source(draft, path, text, digest_of(data), same_file and source.windows)


def draft_of_text(text: str, about: Draft) -> Draft:
    """The first level of a text of any format, or of a link; name and author of ``about`` if the text has none.

    Raises NinjaGameError for a text without a level.
    """
    text = text.strip("\0 \r\n\t")
    named = (load_levels(text) if is_link(text) else parse_levels(text))[0]
    read = draft_of(named)
    return replace(read, name=read.name or about.name, author=read.author or about.author)


AUTOSAVE_SUFFIX = ".json"

_SPACING = 0.4  # least seconds between two autosaves


UNDO = "undo"  # the folder of kept histories, in EDITING
UNDO_BYTES, LEVELS_WITH_UNDO = 2**21, 50
"""The size up to which steps of a level are kept, about, and the most levels whose steps are kept."""


def _undo_file(folder: Path, key: str) -> Path:
    return folder / EDITING / UNDO / f"{digest_of(key.encode())}{AUTOSAVE_SUFFIX}"


def keep_history(folder: Path, key: str, history: History[Draft]) -> None:
    """Keep a level's history. ``key``: the digest of its file, wherever that goes, or the name of an autosave."""
    file = _undo_file(folder, key)
    if key and (history.can_undo or history.can_redo):
        steps = history.steps(max(1, min(100, UNDO_BYTES // (2000 + 50 * len(history.draft.objects)))))
        kept = [[draft.as_json() for draft in drafts] for drafts in ([history.draft], *steps)]
        with suppress(OSError, NinjaGameError):
            file.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(file, json.dumps(kept, separators=(",", ":")))
            files = sorted(file.parent.glob(f"*{AUTOSAVE_SUFFIX}"), key=lambda path: path.stat().st_mtime_ns)
            for old in files[:-LEVELS_WITH_UNDO]:
                old.unlink(missing_ok=True)


def kept_history(folder: Path, key: str, draft: Draft) -> History[Draft]:
    """The history that was kept with this key, with ``draft`` as its present; without a readable one a new history."""
    with suppress(OSError, *DAMAGED):
        kept = json.loads(read_utf8(_undo_file(folder, key)))
        (now,), done, undone = ([Draft.of_json(draft_kept) for draft_kept in drafts] for drafts in kept)
        history = History(now, done, undone)
        # Discarded changes can be undone too.
        history.change(draft)
        return history
    return History(draft)


class Autosave(RecoveryFile):
    """Keeps the newest draft of one document, in a thread of its own."""

    def __init__(self, folder: Path, file: Path | None = None) -> None:
        super().__init__(folder / EDITING, AUTOSAVE_SUFFIX, file)
        self.job: NewestJob[tuple[Source, History[Draft]] | None, None] = NewestJob(self._work)
        self._kept: Draft | None = None
        self._asked_at = 0.0

    def poll(self, history: History[Draft], source: Source) -> None:
        """Save the draft, with its history, if it has changed and it is time; one equal to its file needs none."""
        draft = history.draft
        draft_now = None if draft == source.draft else draft
        if draft_now is not self._kept and time.monotonic() - self._asked_at >= _SPACING and self.job.is_idle:
            self._asked_at = time.monotonic()
            self._kept = draft_now
            self.job.ask((source, history.copy()) if draft_now else None)

    def flush(self, history: History[Draft], source: Source) -> None:
        """Save the draft now, if it has changed, and wait for the disk."""
        self.job.finish()
        self._asked_at = -_SPACING
        self.poll(history, source)
        self.job.finish()

    def _work(self, job: tuple[Source, History[Draft]] | None) -> None:
        if job is None:
            self._forget(self.file)
            return
        with self.reporting():
            self.lock()
            source, history = job
            path = str(source.path.absolute()) if source.path else ""
            kept = {"path": path, "digest": source.digest, "level": ascii_text(history.draft)}
            write_atomically(self.file, json.dumps(kept, indent=1))
            keep_history(self.file.parent.parent, self.file.stem, history)

    def _forget(self, *files: Path) -> None:
        for file in (*files, _undo_file(self.file.parent.parent, self.file.stem)):
            with suppress(OSError):
                file.unlink(missing_ok=True)

    def close(self, *, keep: bool = False) -> None:
        """End. ``keep``: keep the autosave for the next editor."""
        self.job.finish()
        if not keep:
            self._forget()
        super().close(keep=keep)


@dataclass(frozen=True)
class RecoveredDraft:
    """The draft of a crashed editor, its file, and the autosave's file."""

    draft: Draft
    source: Source
    file: Path

    def forget(self) -> bool:
        """Delete it; False if another program has recovered it."""
        return remove_abandoned(self.file)


def lost_drafts(folder: Path) -> Iterator[RecoveredDraft]:
    """The drafts of editors that crashed, the newest first; those of running editors are left out."""
    return recovered_from(folder / EDITING, AUTOSAVE_SUFFIX, _read)


def _read(file: Path) -> RecoveredDraft:
    """The content of an autosave; its path counts only if that file still exists. Raises as ``lost_drafts``."""
    kept = json.loads(read_utf8(file))
    draft = draft_of(parse_levels(kept["level"])[0])
    source = new_source()
    if kept["path"]:
        with suppress(OSError, NinjaGameError):
            # If another program has changed the file since, saving asks.
            source = replace(open_source(Path(kept["path"])), digest=str(kept["digest"]))
    return RecoveredDraft(draft, source, file)


_ROW = re.compile(r"(\s*+\d*+\s*+\|).*(\|.*)")
_RULER = re.compile(r";[\s\d]*")


def ascii_text(draft: Draft) -> str:
    return writer.write_ascii_level(draft.level, **writer.headers_of(draft))


def updated_text(text: str, opened: Draft, draft: Draft) -> str:
    """The text of ``opened``, changed so that it reads as ``draft``.

    Lines that are still true stay as they are. A text that cannot be changed line by line is written again, with its
    comments at the end.
    """
    if draft == opened:
        return text
    changed = "\n".join(_Lines(text, opened, draft).changed())
    if reads_as(changed, draft, named=draft.name != opened.name):
        return changed
    comments = [line for line in text.split("\n") if line.startswith(";") and not _RULER.fullmatch(line)]
    return ascii_text(draft) + "".join(f"\n{line}" for line in comments) + ("\n" if comments else "")


def reads_as(text: str, draft: Draft, *, named: bool = True) -> bool:
    """Whether a text reads as just this draft. ``named``: its name too, which a file may get from its path."""
    try:
        read = parse_ascii_level(text)
    except LevelError:
        return False
    headers = writer.headers_of(read) | ({} if named else {"name": draft.name})
    objects = read.level.objects
    return (
        headers == writer.headers_of(draft)
        and read.level.tiles == draft.level.tiles
        and len(objects) == len(draft.objects)
        and all(map(writer.same_spec, objects, draft.objects))
    )


class _Lines:
    """The lines of a level file, changed from one draft to another; comments, order and unchanged lines stay."""

    def __init__(self, text: str, opened: Draft, draft: Draft) -> None:
        self.lines = text.split("\n")
        self.opened, self.draft = opened, draft
        lines = list(numbered_lines(text, UNCOMMENTED))
        self.first = lines[0][0]
        self.header, self.rows, self.listed = sections(lines[1:], Problems(""))
        self.replaced: dict[int, list[str]] = {}
        self.after: dict[int, list[str]] = defaultdict(list)

    def changed(self) -> Iterator[str]:
        self._change_header()
        self._change_picture()
        self._change_list()
        for number, line in enumerate(self.lines, 1):
            yield from self.replaced.get(number, [line])
            yield from self.after[number]

    def _change_header(self) -> None:
        places = {line.partition(":")[0].strip(): number for number, line in self.header}
        last = max([self.first, *places.values()])
        for key, value in writer.headers_of(self.draft).items():
            before = getattr(self.opened, key)
            if value != before:
                line = f"{key}: {header_text(value)}".rstrip()
                if key in places:
                    self.replaced[places[key]] = [line]
                else:
                    self.after[last].append(line)

    def _change_picture(self) -> None:
        parts = [visible_glyphs(spec) for spec in self.draft.objects]
        for (number, line), chars in zip(self.rows, writer.picture_rows(self.draft.level, parts), strict=True):
            match = _ROW.fullmatch(line)
            # A space is an empty cell, as a dot is: spaces typed by a person are kept.
            old = line[match.end(1) : match.start(2)] if match else ""
            kept = "".join(" " if a == "." and b == " " else a for a, b in zip(chars, old, strict=True))
            self.replaced[number] = [f"{match[1]}{kept}{match[2]}"] if match else [line]

    def _change_list(self) -> None:
        """Keep the lines of objects that remain, in order, and insert new objects between them."""
        read = {number: read_object_line(line) for number, line in self.listed}
        tiles = [number for number, entries in read.items() if entries and isinstance(entries[0], OddTile)]
        end = self.rows[-1][0]
        while end < len(self.lines) and _RULER.fullmatch(self.lines[end]):
            end += 1
        if writer.tile_lines(self.opened.level) != writer.tile_lines(self.draft.level):
            self.replaced |= {number: [] for number in tiles}
            self.after[end] += writer.tile_lines(self.draft.level)
        owners: list[tuple[int, ObjectSpec]] = [
            (number, entry.spec)
            for number, entries in read.items()
            for entry in entries
            if isinstance(entry, ListedObject)
        ]
        specs = self.draft.objects[self._count_drawn(len(owners)) :]
        keys = [repr(spec) for _, spec in owners]
        matcher = SequenceMatcher(None, keys, [repr(spec) for spec in specs], autojunk=False)
        content: dict[int, list[ObjectSpec]] = {number: [] for number, _ in owners}
        touched: set[int] = set()
        for tag, i1, i2, j1, j2 in matcher.get_opcodes():
            if tag == "equal":
                for (number, _), spec in zip(owners[i1:i2], specs[j1:j2], strict=True):
                    content[number].append(spec)
                continue
            touched |= {owners[i][0] for i in range(i1, i2)}
            within = i1 > 0 and i1 < len(owners) and owners[i1 - 1][0] == owners[i1][0]
            if within and j2 > j1:
                # New objects between two of one line: this line and all behind it are written again.
                self.replaced |= {number: [] for number in content}
                self.replaced[owners[0][0]] = writer.write_object_lines(specs)
                return
            if j2 > j1:
                self.after[owners[i1 - 1][0] if i1 else end] += writer.write_object_lines(specs[j1:j2])
        for number in touched:
            self.replaced[number] = self._rewritten(number, content[number])

    def _rewritten(self, number: int, records: Sequence[ObjectSpec]) -> list[str]:
        """A line for its remaining objects, with its comment."""
        lines = writer.write_object_lines(records)
        _, mark, comment = self.lines[number - 1].partition(";")
        if mark and lines:
            lines[-1] += f"  ;{comment}"
        return lines

    def _count_drawn(self, listed: int) -> int:
        """How many of the first objects only the picture makes: as many as before, if possible."""
        objects = self.draft.objects
        most = writer.drawn_only(self.draft.level, [visible_glyphs(spec) for spec in objects])
        old = self.opened.objects
        before = len(old) - listed
        if not listed or old == objects:
            return most
        at = common_length(old, objects)
        end = common_length(old[at:][::-1], objects[at:][::-1])
        if at >= before:
            return min(most, before)
        if len(old) - end <= before:
            return min(most, len(objects) - listed)
        return min(most, at)
