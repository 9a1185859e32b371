"""The machine code of compiled kernels, kept in files from one process to the next.

A kernel's file is named after a digest of all the code and constants that went into it (``code_digest``), wherever it
lies: an edit of any rule is another file. Numba's own cache looks at the file of the kernel alone, and falls back
to folders beside the sources, so it is not used. A release's wheel has kernels for any processor of its family
(``SHIPPED``), under the names that they have on this machine; where one of these fits, nothing is compiled.

Two processes that need the same kernel at the same time compile it once: the second one waits and reads the file.
"""

from __future__ import annotations

import os
import pickle
import re
import stat
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from functools import cache
from hashlib import sha256
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from typing import Any
from uuid import uuid4

from ninja_game.backend.code_digest import OPTIONS, code_digest
from ninja_game.backend.numba_import import warn_once
from ninja_game.errors import FileError
from ninja_game.files.locking import LOCK_SUFFIX, try_lock
from ninja_game.files.reading import open_regular
from ninja_game.files.user_folder import PACKAGE, cache_folder, folder_from_variable

SHIPPED = PACKAGE / "data" / "kernels"  # machine code that came with the installation; a checkout has none

GENERIC = ("generic", "")
"""The processor that it is made for, as Numba names one: any of the family, with no features beyond."""

MAX_KERNELS = 200  # how many compiled kernels stay in the cache folder: the newest, some ten versions of all

LOCK_TIMEOUT = 120  # seconds to wait for a process that compiles the same kernel; then this one compiles it too

_KERNEL = re.compile(r"[a-z_]+-[0-9a-f]{32}-[0-9a-f]{16}\.code")

COMPILES_AGAIN = "; it works, but compiles again in the next process"

before_compiling: list[Callable[[], None]] = []
"""What is called once, before the first kernel that has to be compiled: it takes a while."""


@cache
def kernel_name(entry: Callable[..., Any], checked: bool) -> str:
    """How the names of a kernel's files begin; Numba is not imported for it."""
    from importlib.metadata import version

    # Kernels contain no code of NumPy, only the layout of its arrays, which patch releases keep.
    versions = version("numba"), *version("numpy").split(".")[:2]
    digest = code_digest(entry, f"{EXTENSION_SUFFIXES[0]} {versions} {OPTIONS} checked={checked}")
    return f"{entry.__name__}-{digest[:32]}"


def are_cached(entries: Iterable[Callable[..., Any]], checked: bool) -> bool:
    """Whether there is machine code of all these kernels."""
    kept = {
        path.stem.rpartition("-")[0]
        for folder in (SHIPPED, code_folder())
        for path in folder.glob("*.code")
        if path.is_file()
    }
    return kept >= {kernel_name(entry, checked) for entry in entries}


def attach_cache(dispatcher: Any, entry: Callable[..., Any], checked: bool) -> None:
    """Let the machine code of a kernel's twin be read from the cache folder, and written there.

    A Numba without the private parts that this needs works without a cache, which is said once.
    """
    from numba.core import codegen, compiler, serialize

    needed: tuple[tuple[Any, str], ...] = (
        (dispatcher, "_cache"), (compiler.CompileResult, "_rebuild"), (compiler.CompileResult, "_reduce"),
        (serialize, "dumps"), (codegen, "JITCPUCodegen"), (getattr(codegen, "JITCPUCodegen", None), "magic_tuple"),
    )  # fmt: skip
    if missing := [name for owner, name in needed if not hasattr(owner, name)]:
        warn_once(f"compiled code cannot be kept, since this Numba has no {missing[0]}{COMPILES_AGAIN}")
        return
    dispatcher._cache = KernelCache(code_folder(), kernel_name(entry, checked))  # noqa: SLF001


@cache
def code_folder() -> Path:
    """Where machine code is kept: in NUMBA_CACHE_DIR, or else in the user's cache folder.

    Raises FileError where there is none, and for a relative path: what lies in the current folder is never loaded.
    """
    folder = folder_from_variable("NUMBA_CACHE_DIR", lambda: cache_folder() / "compiled")
    if not folder.is_absolute():
        raise FileError("the cache of compiled code has a relative path", found=str(folder), expected="a full path")
    return folder


def evict_old_kernels(folder: Path) -> None:
    """Remove all but the newest kernels of a cache folder; what cannot be removed stays."""
    dated = []
    for path in folder.glob("*.code"):
        with suppress(OSError):
            about = path.lstat()
            if _KERNEL.fullmatch(path.name) and stat.S_ISREG(about.st_mode):
                dated.append((about.st_mtime, path))
    for _, path in sorted(dated, reverse=True)[MAX_KERNELS:]:
        with suppress(OSError):
            path.unlink()


class KernelCache:
    """The machine code of one kernel in files, one for each signature and processor; what Numba asks of a cache.

    A file holds the digest of what follows, then the code. What cannot be read is compiled; where nothing can be
    written, that is said once and everything works without a cache.
    """

    def __init__(self, folder: Path, name: str) -> None:
        self.folder = folder
        self.name = name
        self.cache_path = str(folder)
        self._held: dict[Path, int] = {}

    def _file(self, signature: Any, processor: tuple[str, ...]) -> str:
        about = sha256(f"{signature} {processor}".encode()).hexdigest()
        return f"{self.name}-{about[:16]}.code"

    def load_overload(self, signature: Any, context: Any) -> Any:
        """The kernel for these types; None if it is not there or damaged, and no other process is making it."""
        context.refresh()
        system, *processor = context.codegen().magic_tuple()
        path = self.folder / self._file(signature, (system, *processor))
        code = _read(path, context) or _read(SHIPPED / self._file(signature, (system, *GENERIC)), context)
        if code is None:
            while before_compiling:
                before_compiling.pop()()
            self._wait(path)
            code = _read(path, context)
            if code is not None:
                self._release(path)
        return code

    def _wait(self, path: Path) -> None:
        """Keep other processes from making a file; where one is making it, wait until it has, or has died."""
        end = time.monotonic() + LOCK_TIMEOUT
        with suppress(OSError):
            self.folder.mkdir(parents=True, exist_ok=True)
            while (handle := try_lock(path.with_suffix(LOCK_SUFFIX))) is None and time.monotonic() < end:
                time.sleep(0.05)
            if handle is not None:
                self._held[path] = handle

    def _release(self, path: Path) -> None:
        """Let others have a file, whether it was made or not."""
        if path in self._held:
            os.close(self._held.pop(path))
            with suppress(OSError):
                path.with_suffix(LOCK_SUFFIX).unlink(missing_ok=True)

    def save_overload(self, signature: Any, result: Any) -> None:
        """Write a kernel, whole or not at all."""
        path = self.folder / self._file(signature, result.codegen.magic_tuple())
        try:
            self._write(path, result)
        finally:
            self._release(path)

    def _write(self, path: Path, result: Any) -> None:
        from numba.core.serialize import dumps

        pack: Any = dumps
        try:
            # The only text in it lists the types of all lines, with memory addresses of this process.
            parts = result._reduce()  # noqa: SLF001 - as Numba's own caches do
            code = pack(tuple("" if isinstance(part, str) else part for part in parts))
        except Exception as error:  # noqa: BLE001 - whatever another version of Numba does here: it works without
            warn_once(f"compiled code cannot be kept ({type(error).__name__}: {error}){COMPILES_AGAIN}")
            return
        part = path.with_suffix(f".{uuid4().hex[:16]}")
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            part.write_bytes(sha256(code).digest() + code)
            part.replace(path)
            evict_old_kernels(self.folder)
        except OSError as error:
            warn_once(f"compiled code cannot be kept in {self.folder}: {error.strerror or error}{COMPILES_AGAIN}")
            with suppress(OSError):
                part.unlink(missing_ok=True)


def _read(path: Path, context: Any) -> Any:
    """The kernel in a file; None where there is none, or a damaged one."""
    from numba.core.compiler import CompileResult

    rebuild: Any = CompileResult._rebuild  # noqa: SLF001 - as Numba's own caches do
    try:
        with open_regular(path) as file:
            data = file.read()
        if sha256(data[32:]).digest() == data[:32]:
            return rebuild(context, *pickle.loads(data[32:]))  # noqa: S301 - our own file
    except Exception:  # noqa: BLE001 - whatever a damaged file leads to: it is compiled and written again
        return None
    return None
