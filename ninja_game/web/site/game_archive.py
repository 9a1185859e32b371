"""The page's code: the game as one archive, compiled if there is Node, and Pyodide, the Python of the page.

Pyodide is five files of its npm package, of one version, identified by their digests.
"""

from __future__ import annotations

import gzip
import io
import shutil
import subprocess
import tarfile
import tempfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

import tomlkit

from ninja_game.errors import NinjaGameError
from ninja_game.files.bundled import data_folder
from ninja_game.files.reading import digest_of, read_bytes
from ninja_game.files.writing import write_atomically
from ninja_game.runtime import PACKAGE

PYODIDE_VERSION = "314.0.7"

DIGESTS = {
    "pyodide.mjs": "6f1d60f7bf529beb300f0f47983c921d3982363640ba20af0e38efdddbc66109",
    "pyodide.asm.mjs": "f7cdc8ece80678ceb712f8e65ebe6d3a83203a180c399865f49612a051693635",
    "pyodide.asm.wasm": "cc36e3cab04fdfc9a63ff13eb52eae2b911bf46c025cc7b281f394bd3de1d5e6",
    "pyodide-lock.json": "5dc2fc119108bc148c7457dc86e7675b5c87e1cafd420b9c34c1eaef7b36c010",
    "python_stdlib.zip": "fa1957e5777068fc4f7437f96d860ae2fbe9c19732ba06c84e004ec16dd7dd7a",
}
"""SHA-256 of the files of that version; others are refused."""

UNUSED = frozenset((
    "_pydatetime", "_pyio", "_pyrepl", "antigravity", "bdb", "cProfile", "cmd", "code", "compileall", "configparser",
    "ctypes", "curses", "dbm", "doctest", "email", "ensurepip", "filecmp", "fileinput", "ftplib", "getpass", "html",
    "http", "idlelib", "imaplib", "lib2to3", "mailbox", "mimetypes", "modulefinder", "multiprocessing", "netrc",
    "nturl2path", "optparse", "pdb", "pickletools", "plistlib", "poplib", "profile", "pstats", "pty", "pyclbr",
    "pydoc", "pydoc_data", "quopri", "rlcompleter", "sched", "shelve", "smtplib", "socketserver", "symtable",
    "tabnanny", "this", "timeit", "tkinter", "trace", "tracemalloc", "tty", "turtle", "turtledemo", "unittest",
    "venv", "wave", "webbrowser", "wsgiref", "xml", "xmlrpc", "zipapp",
))  # fmt: skip
"""Modules of the standard library that a page does not need."""

ENCODINGS = frozenset((
    "__init__", "aliases", "ascii", "charmap", "cp1252", "cp437", "idna", "latin_1", "punycode", "raw_unicode_escape",
    "undefined", "unicode_escape", "utf_16", "utf_16_be", "utf_16_le", "utf_32", "utf_32_be", "utf_32_le", "utf_8",
    "utf_8_sig",
))  # fmt: skip
"""Encodings that stay; the tables of the others are a ninth of the library."""

_NPM_WAIT = 300  # seconds for npm


def pyodide_files(folder: Path | None, cache: Path) -> dict[str, bytes]:
    """The files by name: those of ``folder``, or of the npm package, which is cached in the folder ``cache``.

    Raises NinjaGameError if they are not available or of another version.
    """
    if folder is not None:
        return _checked(folder)
    kept = cache / f"pyodide-{PYODIDE_VERSION}"
    if not kept.is_dir():
        _fetch(kept)
    try:
        return _checked(kept)
    except NinjaGameError:
        shutil.rmtree(kept, ignore_errors=True)
        _fetch(kept)
        return _checked(kept)


def _checked(folder: Path) -> dict[str, bytes]:
    """The files of a folder. Raises NinjaGameError for a missing or another file."""
    files = {}
    for name, digest in DIGESTS.items():
        try:
            files[name] = read_bytes(folder / name)
        except OSError as error:
            raise NinjaGameError(f"{folder / name}: {error.strerror}; {_hint(folder)}") from None
        if digest_of(files[name]) != digest:
            raise NinjaGameError(f"{folder / name}: not the file of Pyodide {PYODIDE_VERSION}; {_hint(folder)}")
    return files


def _hint(folder: Path | None = None) -> str:
    package = f"the npm package pyodide@{PYODIDE_VERSION}"
    return f"expected the unpacked files of {package}" if folder else f"unpack {package} and give --pyodide FOLDER"


def _fetch(kept: Path) -> None:
    """Fetch the package by npm and unpack the needed files. Raises NinjaGameError."""
    npm = shutil.which("npm")
    if npm is None:
        raise NinjaGameError(f"npm, which gets Pyodide, is not installed; install Node.js, or {_hint()}")
    with tempfile.TemporaryDirectory() as scratch:
        words = [npm, "pack", f"pyodide@{PYODIDE_VERSION}", "--silent", "--pack-destination", scratch]
        try:
            process = subprocess.run(words, cwd=scratch, capture_output=True, text=True, check=False, timeout=_NPM_WAIT)  # noqa: S603 - our own words
        except (OSError, subprocess.TimeoutExpired) as error:
            raise NinjaGameError(f"npm could not get Pyodide ({error}); {_hint()}") from None
        packages = list(Path(scratch).glob("*.tgz"))
        if process.returncode or len(packages) != 1:
            last = (process.stderr.strip().splitlines() or ["no word of it"])[-1]
            raise NinjaGameError(f"npm could not get Pyodide ({last}); {_hint()}")
        kept.mkdir(parents=True, exist_ok=True)
        with tarfile.open(packages[0]) as package:
            for name in DIGESTS:
                file = package.extractfile(f"package/{name}")
                if file is not None:
                    write_atomically(kept / name, file.read())


def library_files(library: bytes) -> dict[str, bytes]:
    """The files of the standard library, a zip, without ``UNUSED`` and rare encodings."""
    files = {}
    with ZipFile(io.BytesIO(library)) as old:
        for name in old.namelist():
            top, _, rest = name.partition("/")
            rare = top == "encodings" and rest.removesuffix(".py") not in ENCODINGS
            if not name.endswith("/") and top.removesuffix(".py") not in UNUSED and not rare:
                files[name] = old.read(name)
    return files


def library_zip(files: Mapping[str, bytes]) -> bytes:
    """A library of these files; the same bytes for the same files."""
    out = io.BytesIO()
    with ZipFile(out, "w") as packed:
        for name, content in sorted(files.items()):
            packed.writestr(ZipInfo(name), content, ZIP_DEFLATED, 9)
    return out.getvalue()


NOT_IN_PAGE = {
    "package": ("batch/", "board/", "cli/", "learn/", "search/", "tas", "web/board/", "web/page", "web/site/"),
    "levels": (),
    "assets": ("bench.", "desktop/", "generated.tsv.xz", "sounds/music/"),
}
"""Files of the package and its data that a page does not need: how their names begin."""


def game_tar(files: Mapping[str, bytes]) -> bytes:
    """A compressed tar of files; the same bytes for the same files."""
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name, content in sorted(files.items()):
            entry = tarfile.TarInfo(name)
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    return gzip.compress(packed.getvalue(), 9, mtime=0)


def game_files() -> Iterator[tuple[str, bytes]]:
    """Name and content of every file of the package, its data, and the library for TOML."""
    for path in PACKAGE.rglob("*.py"):
        name = path.relative_to(PACKAGE).as_posix()
        if not name.startswith(NOT_IN_PAGE["package"]):
            yield f"ninja_game/{name}", path.read_bytes()
    yield "boot.py", (PACKAGE / "web" / "page" / "boot.py").read_bytes()
    for folder in ("levels", "assets"):
        root = data_folder(folder)
        for path in root.rglob("*"):
            name = path.relative_to(root).as_posix()
            if path.is_file() and path.suffix != ".md" and not name.startswith(NOT_IN_PAGE[folder]):
                yield f"ninja_game/data/{folder}/{name}", path.read_bytes()
    root = Path(tomlkit.__file__).parent
    for path in root.rglob("*.py"):
        yield f"tomlkit/{path.relative_to(root).as_posix()}", path.read_bytes()


def licence_of(name: str) -> str:
    """The text of an installed package's licence, "" if it has none."""
    for path in distribution(name).files or ():
        if path.name.upper().startswith("LICEN"):
            return path.read_text("utf-8")
    return ""


_WAIT = 600  # seconds for node

Files = dict[str, bytes]  # content by name


def bytecode_files(library: Files, game: Files, pyodide: Mapping[str, bytes]) -> tuple[Files, Files]:
    """The standard library's and the game's files with bytecode instead of Python text.

    ``pyodide``: the files of its package. Without Node.js the files are unchanged, and the first visit takes longer.
    Raises NinjaGameError if node fails.
    """
    node = shutil.which("node")
    if node is None:
        return library, game
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch)
        _write(place / "pyodide", pyodide)
        _write(place / "work" / "library", _texts(library))
        _write(place / "work" / "game", _texts(game))
        _write(place / "work", {"compiling.py": Path(__file__).with_name("compiling.py").read_bytes()})
        words = [node, str(Path(__file__).with_name("bytecode.mjs")), str(place / "pyodide"), str(place / "work")]
        try:
            subprocess.run(words, capture_output=True, text=True, check=True, timeout=_WAIT)  # noqa: S603 - our own words
        except (OSError, subprocess.SubprocessError) as error:
            last_line = str(getattr(error, "stderr", "") or error).strip().splitlines()[-1:]
            raise NinjaGameError(f"node could not compile the game for the page: {''.join(last_line)}") from None
        return _replaced(library, place / "work" / "library"), _replaced(game, place / "work" / "game")


def _texts(files: Files) -> Files:
    return {name: content for name, content in files.items() if name.endswith(".py")}


def _replaced(files: Files, folder: Path) -> Files:
    """The files, with the bytecode in ``folder`` instead of their texts."""
    bytecode = {f"{name}c": (folder / f"{name}c").read_bytes() for name in _texts(files)}
    return {name: content for name, content in files.items() if not name.endswith(".py")} | bytecode


def _write(folder: Path, files: Mapping[str, bytes]) -> None:
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
