"""The machine code of compiled kernels, kept in files from one process to the next.

A kernel's file is named after a digest of all its code and constants (``code_digest``), wherever they are defined:
after an edit of any rule the name is another. Numba's own cache checks only the file of the kernel itself, and falls
back to folders beside the sources; so it is not used. A release's wheel has kernels for any processor of its family
(``SHIPPED``), under the names that they have on this machine; if one of these fits, nothing is compiled.

If two processes need the same kernel, it is compiled once: the second process waits and reads the file.
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

from ninja_game.backend.code_digest import OPTIONS, code_digest
from ninja_game.backend.numba_import import warn_once
from ninja_game.errors import FileError
from ninja_game.files.locking import LOCK_SUFFIX, try_lock
from ninja_game.files.reading import open_regular
from ninja_game.files.user_folder import cache_folder, folder_from_variable
from ninja_game.files.writing import replacing
from ninja_game.runtime import PACKAGE

SHIPPED = PACKAGE / "data" / "kernels"  # machine code of the installation; a checkout has none

GENERIC = ("generic", "")  # the processor of that code, in Numba's words: any of the family, without extra features

MAX_KERNELS = 200  # most kernels in the cache folder, the newest ones: some ten versions of all

LOCK_TIMEOUT = 120  # seconds to wait for a process that compiles the same kernel; then this one compiles it

_KERNEL = re.compile(r"[a-z_]+-[0-9a-f]{32}-[0-9a-f]{16}\.code")

COMPILES_AGAIN = "; it works, but compiles again in the next process"

before_compiling: list[Callable[[], None]] = []
"""Called once, before the first kernel that has to be compiled, since that takes a while."""


@cache
def kernel_name(entry: Callable[..., Any], checked: bool) -> str:
    """The beginning of the names of a kernel's files, without importing Numba."""
    from importlib.metadata import version

    # Kernels contain no code of NumPy, only the layout of its arrays, which patch releases keep.
    versions = version("numba"), *version("numpy").split(".")[:2]
    digest = code_digest(entry, f"{EXTENSION_SUFFIXES[0]} {versions} {OPTIONS} checked={checked}")
    return f"{entry.__name__}-{digest[:32]}"


def are_cached(entries: Iterable[Callable[..., Any]], checked: bool) -> bool:
    """Whether all these kernels have machine code in the cache."""
    files = (path for folder in (SHIPPED, code_folder()) for path in folder.glob("*.code"))
    cached = {path.stem.rpartition("-")[0] for path in files if path.is_file()}
    return cached >= {kernel_name(entry, checked) for entry in entries}


def attach_cache(dispatcher: Any, entry: Callable[..., Any], checked: bool) -> None:
    """Let the machine code of a kernel's twin be read from and written to the cache folder.

    With a Numba without the private parts that this needs, it warns once, and everything works without a cache.
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
    """The folder of machine code: NUMBA_CACHE_DIR, or a folder in the user's cache folder.

    Raises FileError if there is none, and for a relative path: code in the current folder must never be loaded.
    """
    folder = folder_from_variable("NUMBA_CACHE_DIR", lambda: cache_folder() / "compiled")
    if not folder.is_absolute():
        raise FileError("the cache of compiled code has a relative path", found=str(folder), expected="a full path")
    return folder


def evict_old_kernels(folder: Path) -> None:
    """Remove all but the newest kernels of a cache folder, as far as they can be removed."""
    dated = []
    for path in folder.glob("*.code"):
        with suppress(OSError):
            status = path.lstat()
            if _KERNEL.fullmatch(path.name) and stat.S_ISREG(status.st_mode):
                dated.append((status.st_mtime, path))
    for _, path in sorted(dated, reverse=True)[MAX_KERNELS:]:
        with suppress(OSError):
            path.unlink()


class KernelCache:
    """The machine code of one kernel in files, one per signature and processor, with the interface of Numba's caches.

    A file holds the digest of the code, then the code. A file that cannot be read is compiled again; if no file can be
    written, it warns once, and everything works without a cache.
    """

    def __init__(self, folder: Path, name: str) -> None:
        self.folder = folder
        self.name = name
        self.cache_path = str(folder)
        self._held: dict[Path, int] = {}

    def _file(self, signature: Any, processor: tuple[str, ...]) -> str:
        digest = sha256(f"{signature} {processor}".encode()).hexdigest()
        return f"{self.name}-{digest[:16]}.code"

    def load_overload(self, signature: Any, context: Any) -> Any:
        """Load the kernel for these types; None if it is missing or damaged, and no other process is making it."""
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
        """Lock a file that this process makes; if another process makes it, wait until it is done, or has died."""
        end = time.monotonic() + LOCK_TIMEOUT
        with suppress(OSError):
            self.folder.mkdir(parents=True, exist_ok=True)
            while (handle := try_lock(path.with_suffix(LOCK_SUFFIX))) is None and time.monotonic() < end:
                time.sleep(0.05)
            if handle is not None:
                self._held[path] = handle

    def _release(self, path: Path) -> None:
        """Unlock a file, whether it was made or not."""
        if path in self._held:
            os.close(self._held.pop(path))
            with suppress(OSError):
                path.with_suffix(LOCK_SUFFIX).unlink(missing_ok=True)

    def save_overload(self, signature: Any, result: Any) -> None:
        """Write a kernel, completely or not at all."""
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
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            with replacing(path, None, kept=False) as file:
                file.write(sha256(code).digest() + code)
            evict_old_kernels(self.folder)
        except OSError as error:
            warn_once(f"compiled code cannot be kept in {self.folder}: {error.strerror or error}{COMPILES_AGAIN}")


def _read(path: Path, context: Any) -> Any:
    """Load the kernel in a file; None if the file is missing or damaged."""
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
