"""Pyodide, the Python of the page: five files of its npm package, of one version, known by their digests."""

from __future__ import annotations

import hashlib
import io
import shutil
import subprocess
import tarfile
import tempfile
from collections.abc import Mapping
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from ninja_game.errors import NinjaGameError
from ninja_game.files.reading import read_bytes
from ninja_game.files.writing import write_atomically

VERSION = "314.0.7"

DIGESTS = {
    "pyodide.mjs": "6f1d60f7bf529beb300f0f47983c921d3982363640ba20af0e38efdddbc66109",
    "pyodide.asm.mjs": "f7cdc8ece80678ceb712f8e65ebe6d3a83203a180c399865f49612a051693635",
    "pyodide.asm.wasm": "cc36e3cab04fdfc9a63ff13eb52eae2b911bf46c025cc7b281f394bd3de1d5e6",
    "pyodide-lock.json": "5dc2fc119108bc148c7457dc86e7675b5c87e1cafd420b9c34c1eaef7b36c010",
    "python_stdlib.zip": "fa1957e5777068fc4f7437f96d860ae2fbe9c19732ba06c84e004ec16dd7dd7a",
}
"""SHA-256 of the files of that version; whatever has others is refused."""

UNUSED = frozenset((
    "_pydatetime", "_pyio", "_pyrepl", "antigravity", "bdb", "cProfile", "cmd", "code", "compileall", "configparser",
    "ctypes", "curses", "dbm", "doctest", "email", "ensurepip", "filecmp", "fileinput", "ftplib", "getpass", "html",
    "http", "idlelib", "imaplib", "lib2to3", "mailbox", "mimetypes", "modulefinder", "multiprocessing", "netrc",
    "nturl2path", "optparse", "pdb", "pickletools", "plistlib", "poplib", "profile", "pstats", "pty", "pyclbr",
    "pydoc", "pydoc_data", "quopri", "rlcompleter", "sched", "shelve", "smtplib", "socketserver", "symtable",
    "tabnanny", "this", "timeit", "tkinter", "trace", "tracemalloc", "tty", "turtle", "turtledemo", "unittest",
    "venv", "wave", "webbrowser", "wsgiref", "xml", "xmlrpc", "zipapp",
))  # fmt: skip
"""Modules of the standard library that a page has no use for."""

ENCODINGS = frozenset((
    "__init__", "aliases", "ascii", "charmap", "cp1252", "cp437", "idna", "latin_1", "punycode", "raw_unicode_escape",
    "undefined", "unicode_escape", "utf_16", "utf_16_be", "utf_16_le", "utf_32", "utf_32_be", "utf_32_le", "utf_8",
    "utf_8_sig",
))  # fmt: skip
"""Encodings that stay; the tables of the others are a ninth of the library."""

_WAIT = 300
"""Seconds for npm."""


def pyodide_files(folder: Path | None, cache: Path) -> dict[str, bytes]:
    """The files by name: those of ``folder``, or of the npm package, which is kept in the folder ``cache``.

    Raises NinjaGameError where they cannot be had or are those of another version.
    """
    if folder is not None:
        return _checked(folder)
    kept = cache / f"pyodide-{VERSION}"
    if not kept.is_dir():
        _fetch(kept)
    try:
        return _checked(kept)
    except NinjaGameError:
        shutil.rmtree(kept, ignore_errors=True)
        _fetch(kept)
        return _checked(kept)


def digest_of(content: bytes) -> str:
    """The SHA-256 of a file's content."""
    return hashlib.sha256(content).hexdigest()


def _checked(folder: Path) -> dict[str, bytes]:
    """The files of a folder. Raises NinjaGameError for a missing or another file."""
    files = {}
    for name, digest in DIGESTS.items():
        try:
            files[name] = read_bytes(folder / name)
        except OSError as error:
            raise NinjaGameError(f"{folder / name}: {error.strerror}; {_how(folder)}") from None
        if digest_of(files[name]) != digest:
            raise NinjaGameError(f"{folder / name}: not the file of Pyodide {VERSION}; {_how(folder)}")
    return files


def _how(folder: Path | None = None) -> str:
    package = f"the npm package pyodide@{VERSION}"
    return f"expected the unpacked files of {package}" if folder else f"unpack {package} and give --pyodide FOLDER"


def _fetch(kept: Path) -> None:
    """Get the package by npm and unpack what is needed of it. Raises NinjaGameError, in words."""
    npm = shutil.which("npm")
    if npm is None:
        raise NinjaGameError(f"npm, which gets Pyodide, is not installed; install Node.js, or {_how()}")
    with tempfile.TemporaryDirectory() as scratch:
        words = [npm, "pack", f"pyodide@{VERSION}", "--silent", "--pack-destination", scratch]
        try:
            done = subprocess.run(words, cwd=scratch, capture_output=True, text=True, check=False, timeout=_WAIT)  # noqa: S603 - our own words
        except (OSError, subprocess.TimeoutExpired) as error:
            raise NinjaGameError(f"npm could not get Pyodide ({error}); {_how()}") from None
        packages = list(Path(scratch).glob("*.tgz"))
        if done.returncode or len(packages) != 1:
            last = (done.stderr.strip().splitlines() or ["no word of it"])[-1]
            raise NinjaGameError(f"npm could not get Pyodide ({last}); {_how()}")
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


def library_of(files: Mapping[str, bytes]) -> bytes:
    """A library of these files; the same bytes for the same files."""
    out = io.BytesIO()
    with ZipFile(out, "w") as packed:
        for name, content in sorted(files.items()):
            packed.writestr(ZipInfo(name), content, ZIP_DEFLATED, 9)
    return out.getvalue()
