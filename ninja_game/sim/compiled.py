"""The compiled twins of all rules: the same functions over NumPy records, made by Numba.

A twin has the code of its rule and a namespace of its own, in which rules are compiled functions and module-level lists
are constant arrays. So the plain rules stay ordinary Python and both memories run side by side in one process.

Only what is called from outside (``ENTRY_POINTS``) gets the wrappers that Python needs and a place in the cache; that
saves a quarter of the compile time and most of the cache. Numba's cache notices a change only in the file of the entry
point itself, so the cache folder is named after a digest of all sources of ``sim``; Numba reads the folder's name when
it is first imported, and never again.
"""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Callable, Iterable
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from . import batch
from .memory import REGISTERED

ENTRY_POINTS: tuple[Callable[..., Any], ...] = batch.ENTRY_POINTS


def available() -> bool:
    """Is Numba installed?"""
    from importlib.util import find_spec

    return find_spec("numba") is not None


def source_digest() -> str:
    """A digest of every source file of the simulation and of the versions that compile it."""
    digest = hashlib.sha256(f"{sys.version} {np.__version__}".encode())
    folder = Path(__file__).parent
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def use_cache(folder: Path) -> None:
    """Keep compiled code in a folder of this name for these sources. Call before anything imports Numba."""
    if "numba" not in sys.modules:
        os.environ.setdefault("NUMBA_CACHE_DIR", str(folder / source_digest()))


def compile_rules(boundscheck: bool = False) -> dict[str, Callable[..., Any]]:
    """Compiled entry points by name. Nothing is compiled before it is called for the first time.

    ``boundscheck``: raise IndexError for an index out of range (otherwise it is silent), for the tests.
    """
    import numba

    options = {"nogil": True, "error_model": "python", "boundscheck": boundscheck}
    inner = numba.njit(no_cpython_wrapper=True, no_cfunc_wrapper=True, **options)
    outer = numba.njit(cache=not boundscheck, **options)
    twins: dict[Callable[..., Any], Any] = {}
    namespaces: dict[str, dict[str, Any]] = {}
    for rule in REGISTERED:
        namespace = namespaces.setdefault(rule.__module__, {"__builtins__": __builtins__})
        code = FunctionType(rule.__code__, namespace, rule.__name__, rule.__defaults__)
        code.__module__ = rule.__module__
        code.__qualname__ = rule.__qualname__
        twins[rule] = (outer if rule in ENTRY_POINTS else inner)(code)
    for name, namespace in namespaces.items():
        _fill(namespace, vars(sys.modules[name]), twins)
    return {entry.__name__: twins[entry] for entry in ENTRY_POINTS}


def _fill(namespace: dict[str, Any], source: dict[str, Any], twins: dict[Callable[..., Any], Any]) -> None:
    """Give a twin's namespace what its rule's module has: twins for rules, arrays for lists, the rest as it is."""
    for name, value in source.items():
        if isinstance(value, FunctionType) and value in twins:
            namespace[name] = twins[value]
        elif isinstance(value, (list, tuple)) and _is_table(value):
            namespace[name] = np.array(value)
        elif not name.startswith("__"):
            namespace[name] = value


def _is_table(values: Iterable[Any]) -> bool:
    """A module-level sequence of numbers, which a rule may index."""
    kinds = {type(value) for value in values}
    return bool(kinds) and kinds <= {int, float}
