"""A pack: its files in a folder, a zip or a link, and their content: index, levels, episodes, certificates.

A zip or link stays in memory, never on the disk.
"""

from __future__ import annotations

import re
from collections import Counter
from functools import cached_property
from io import BytesIO
from pathlib import Path, PurePosixPath
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from ninja_game.errors import FileError, NinjaGameError, PackError
from ninja_game.files.reading import LINK, MAX_BYTES, decoded, files_in, read_bytes
from ninja_game.files.shown_text import name_key
from ninja_game.files.untrusted import open_zip, unpacked
from ninja_game.files.user_folder import REPLAY_SUFFIX
from ninja_game.formats.links import is_link, link_kind, pack_link, pack_texts
from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.named_level import NamedLevel, parse_levels
from ninja_game.formats.pack.index import LEVELS_PER_EPISODE, EpisodeIndex, parse_index
from ninja_game.formats.pack.pars import Pars, parse_pars
from ninja_game.formats.replay.text import episode_key

INDEX = "pack.toml"
PARS = "pars.toml"  # the table of par times
CERTIFICATES = "certificates"  # the folder of replays
RECEIVED = "received"  # marks a pack as received by a link; copies of the pack do not contain this file

MAX_FILES = 4096  # most files in a zip; all of them together may have MAX_BYTES

MAX_FILE_BYTES = 4 * 2**20  # the largest size of one file

LEVEL_FILES = re.compile(r"[^/\\:]+\.txt", re.IGNORECASE)


def certificate_name(file: str, kind: str) -> str:
    """The path, in its pack, of a level file's certificate, "exit" or "gold".

    >>> certificate_name("a.txt", "exit")
    'certificates/a.exit.replay.txt'
    """
    return f"{CERTIFICATES}/{file.rpartition('.')[0]}.{kind}{REPLAY_SUFFIX}"


class PackFiles:
    """The files of a pack: ``names``, such as "pack.toml" or "certificates/a.exit.replay.txt", sorted.

    ``problems``: files of a zip that hide others.

    Raises FileError for an invalid zip, or one beyond the limits, LinkError for a broken link; OSError.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._root = ""
        self._zip: ZipFile | None = None
        self._entries: dict[str, ZipInfo] = {}
        self._texts: dict[str, str] = {}
        self.problems: list[str] = []
        if is_link(path):
            self.path = Path(LINK)
            self._texts = pack_texts(path)
            self.names = tuple(sorted(self._texts))
        elif path.is_dir():
            # A symbolic link in a foreign pack may point to a private file.
            below = [] if (path / CERTIFICATES).is_symlink() else files_in(path / CERTIFICATES, follow_links=False)
            names = [*files_in(path, follow_links=False), *(f"{CERTIFICATES}/{name}" for name in below)]
            self.names = tuple(sorted(names))
        else:
            self._open_zip(read_bytes(path))
            self.names = tuple(sorted(self._entries))

    def _open_zip(self, data: bytes) -> None:
        try:
            self._zip = open_zip(BytesIO(data), most_files=MAX_FILES, most_bytes=MAX_BYTES)
        except ValueError as error:
            what, found = "neither a folder nor a zip that can be a pack", str(error)
            raise FileError(what, str(self.path), found=found, expected=f"a pack, with {INDEX}") from None
        entries = [entry for entry in self._zip.infolist() if not entry.filename.endswith("/")]
        # Many zips contain the folder instead of its files.
        indexes = [name for entry in entries if PurePosixPath(name := entry.filename).name == INDEX]
        root = min(indexes, key=lambda name: name.count("/"), default=INDEX).removesuffix(INDEX)
        self._root = PurePosixPath(root).name
        if others := [name for name in sorted(set(indexes)) if name != root + INDEX]:
            self.problems.append(f"{self.place(others[0])}: a second index; {root + INDEX} is the one that is read")
        keys = Counter(name_key(entry.filename) for entry in entries)
        duplicates = sorted({entry.filename for entry in entries if keys[name_key(entry.filename)] > 1})
        self.problems += [f"{self.place(name)}: more than one file has this name on some system" for name in duplicates]
        for entry in entries:
            name = entry.filename.removeprefix(root)
            parts = PurePosixPath(name).parts
            is_plain = "\\" not in name and ".." not in parts and not name.startswith("/")
            if entry.filename.startswith(root) and is_plain and (len(parts) == 1 or parts[:-1] == (CERTIFICATES,)):
                self._entries[name] = entry

    @property
    def levels(self) -> list[str]:
        return [name for name in self.names if LEVEL_FILES.fullmatch(name)]

    @property
    def folder(self) -> str:
        """The name of the folder, in a zip of the one that was packed."""
        return self._root or self.path.resolve().name.removesuffix(".zip")

    @property
    def own_names(self) -> list[str]:
        """The names of a pack's own files: index, par times, levels, certificates."""
        replays = [name for name in self.names if name.startswith(f"{CERTIFICATES}/") and name.endswith(REPLAY_SUFFIX)]
        return [name for name in (INDEX, PARS) if name in self.names] + self.levels + replays

    def zipped(self) -> bytes:
        """The pack as a zip, the same bytes for the same files."""
        data, folder = BytesIO(), self.folder
        with ZipFile(data, "w", ZIP_DEFLATED) as file:
            for name in self.own_names:
                entry = ZipInfo(f"{folder}/{name}")
                entry.compress_type = ZIP_DEFLATED
                file.writestr(entry, self.text(name))
        return data.getvalue()

    def place(self, name: str) -> str:
        """The path of a file for error messages; in a folder that of the file itself."""
        return str(self.path / name)

    def text(self, name: str) -> str:
        """A file's text with plain line ends. Raises FileError, OSError."""
        if name in self._texts:
            return self._texts[name]
        return decoded(self._bytes(name), self.place(name))

    def link(self) -> str:
        """The pack as a link. Raises LinkError for one that is too large."""
        return pack_link({name: self.text(name) for name in self.own_names})

    def _bytes(self, name: str) -> bytes:
        if self._zip is None and not self._texts:
            return read_bytes(self.path / name, MAX_FILE_BYTES)
        if self._zip is None or name not in self._entries:
            raise FileError("not in the pack", self.place(name))
        if self._entries[name].file_size > MAX_FILE_BYTES:
            raise FileError("the file is too large", self.place(name), expected=f"at most {MAX_FILE_BYTES >> 20} MiB")
        try:
            return unpacked(self._zip, self._entries[name])
        except ValueError as error:
            raise FileError("cannot be read from the zip", self.place(name), found=str(error)) from None


def is_pack(path: Path) -> bool:
    """Whether a path looks like a pack: a folder with an index, a file named like a zip, a link of a pack."""
    if kind := link_kind(path):
        return kind == "pack"
    try:
        return (path / INDEX).is_file() if path.is_dir() else path.suffix.lower() == ".zip"
    except OSError:
        return False


class Pack:
    """A folder, zip or link with ``pack.toml``. Unreadable level files become ``problems``; the others are loaded.

    Raises PackError for a missing or invalid index, FileError for anything but a pack; OSError.
    """

    def __init__(self, path: Path) -> None:
        self.files = PackFiles(path)
        self.problems = list(self.files.problems)
        if INDEX not in self.files.names:
            raise PackError("a pack without its index", str(path), expected=f"a file {INDEX} in it")
        self.index = parse_index(self.files.text(INDEX), file=self.files.place(INDEX))

    @property
    def name(self) -> str:
        return self.index.name

    @cached_property
    def levels(self) -> dict[str, NamedLevel]:
        """The level of each file; the first one if a file has several."""
        named_levels = {}
        for name in self.files.levels:
            try:
                named_levels[name] = parse_levels(self.files.text(name), file=self.files.place(name))[0]
            except NinjaGameError as error:
                self.problems.append(str(error))
            except OSError as error:
                self.problems.append(f"{self.files.place(name)}: {error.strerror}")
        return named_levels

    @cached_property
    def episodes(self) -> dict[EpisodeIndex, tuple[NamedLevel, ...]]:
        """The levels of each episode that has any, at most five, by the number of the episode."""
        members = {}
        for episode in self.index.episodes:
            files = episode.files(self.files.levels)
            self.problems += [f"{self.files.place(file)}: not there" for file in files if file not in self.files.names]
            levels = tuple(self.levels[file] for file in files if file in self.levels)
            if len(levels) > LEVELS_PER_EPISODE:
                self.problems.append(f"{self.files.place(files[LEVELS_PER_EPISODE])}: the sixth level of its episode")
            if levels:
                members[episode] = levels[:LEVELS_PER_EPISODE]
        return members

    def read_pars(self) -> dict[str, Pars]:
        """Read the table of pars, by level file. Raises PackError, FileError, OSError."""
        if PARS not in self.files.names:
            return {}
        return parse_pars(self.files.text(PARS), file=self.files.place(PARS))

    @cached_property
    def pars(self) -> dict[str, Pars]:
        """The pars of levels, by level file, without those of levels that have changed since."""
        try:
            all_pars = self.read_pars()
        except (NinjaGameError, OSError) as error:
            self.problems.append(str(error))
            return {}
        digests = {file: level_digest(named.level) for file, named in self.levels.items() if file in all_pars}
        return {file: pars for file, pars in all_pars.items() if digests.get(file, "").startswith(pars.level or "?")}

    def certificate(self, file: str, kind: str) -> str | None:
        """The name of a level file's certificate, "exit" or "gold"; None without one."""
        name = certificate_name(file, kind)
        return name if name in self.files.names else None


def episodes_of(path: Path) -> set[str]:
    """The keys of a pack's episodes; none of anything else. Raises as ``Pack`` does."""
    episodes = Pack(path).episodes.values() if is_pack(path) else ()
    return {episode_key(level.level for level in levels) for levels in episodes}
