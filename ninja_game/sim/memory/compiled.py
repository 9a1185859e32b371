"""The compiled twins of all rules: the same functions over NumPy records, made by Numba.

A twin has the code of its rule and a namespace of its own, in which rules are compiled functions and module-level lists
are constant arrays. So the plain rules stay ordinary Python and both memories run side by side in one process.

Only entry points get the wrappers that Python needs and a place in the cache; that saves a quarter of the compile time
and most of the cache.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from types import FunctionType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ninja_game.sim.level import Level
from ninja_game.sim.loader import grid_tiles, record_table
from ninja_game.sim.memory import kernels as _entry_points  # noqa: F401 - registers the entry points of the simulation
from ninja_game.sim.memory.declare import ENTRY_POINTS, REGISTERED
from ninja_game.sim.memory.layout import TILE_MAP, Records, new_worlds

Kernels = dict[str, Callable[..., Any]]
"""Compiled entry points by name."""


class Compiler:
    """Makes compiled twins of what is registered, and of what is registered later when it is asked again.

    Nothing is compiled before it is called for the first time. ``boundscheck``: raise IndexError for an index out of
    range (otherwise it is silent), for the tests; it does not use the cache.
    """

    def __init__(self, *, boundscheck: bool = False) -> None:
        import numba

        jit: Any = numba.njit
        options: dict[str, Any] = {"nogil": True, "error_model": "python", "boundscheck": boundscheck}
        self._inner = jit(no_cpython_wrapper=True, no_cfunc_wrapper=True, **options)
        self._outer = jit(cache=not boundscheck, **options)
        self._twins: dict[Callable[..., Any], Any] = {}
        self._namespaces: dict[str, dict[str, Any]] = {}

    def kernels(self) -> Kernels:
        """All entry points registered so far."""
        new = [rule for rule in REGISTERED if rule not in self._twins]
        for rule in new:
            namespace = self._namespaces.setdefault(rule.__module__, {"__builtins__": __builtins__})
            twin = FunctionType(rule.__code__, namespace, rule.__name__, rule.__defaults__)
            twin.__module__ = rule.__module__
            twin.__qualname__ = rule.__qualname__
            self._twins[rule] = (self._outer if rule in ENTRY_POINTS else self._inner)(twin)
        for name in {rule.__module__ for rule in new}:
            _fill(self._namespaces[name], vars(sys.modules[name]), self._twins)
        return {entry.__name__: self._twins[entry] for entry in ENTRY_POINTS}


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
    """Tell whether this is a module-level sequence of numbers, which a rule may index."""
    kinds = {type(value) for value in values}
    return bool(kinds) and kinds <= {int, float}


def load_compiled(kernels: Kernels, data: Level, box: bool) -> tuple[NDArray[np.void], Records]:
    """A level and a new world in it, each as an array of one record. Raises LevelError as ``record_table`` does."""
    table = record_table(data)
    levels = np.zeros(1, TILE_MAP)
    levels[0]["tiles"] = grid_tiles(data)
    worlds = new_worlds(1, table.slots)
    values = np.array(table.values, dtype=np.float64).reshape(-1, 9)
    kinds = np.array(table.kinds, dtype=np.int64)
    counts = np.array(table.counts, dtype=np.int64)
    kernels["load_world"](levels, worlds, 0, kinds, counts, values, int(box))
    return levels, worlds
