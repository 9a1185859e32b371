"""Makes compiled twins of rules: the same functions over NumPy records, compiled by Numba.

A twin has the code of its rule and its own namespace, in which rules are compiled functions and module-level lists
constant arrays. So the plain rules stay ordinary Python, and both memories run side by side in one process.

Only kernels get wrappers for Python and a place in the cache: that saves a quarter of the compile time.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from types import FunctionType
from typing import Any, TypeVar

import numpy as np

from ninja_game.backend.code_digest import OPTIONS
from ninja_game.sim.schema.declare import KERNELS, REGISTERED

R = TypeVar("R")

AttachCache = Callable[[Any, Callable[..., Any], bool], None]
"""Gives a kernel's compiled twin, before its first call, a place in a cache; the flag: indices are checked."""


class Compiler:
    """``compiler(kernel)`` gives the compiled twin of a kernel; it takes the same arguments.

    A twin is compiled at its first call. ``checked``: an index out of range raises IndexError, else it goes unnoticed.
    ``attach_cache``: see ``AttachCache``. ``pipeline``: the passes, ``numba``: the module, both of ``numba_import``.
    """

    def __init__(
        self,
        numba: Any,
        *,
        checked: bool = False,
        attach_cache: AttachCache | None = None,
        pipeline: type | None = None,
    ) -> None:
        jit: Any = numba.njit
        self._checked = checked
        options: dict[str, Any] = {**OPTIONS, "boundscheck": checked}
        if pipeline is not None:
            options["pipeline_class"] = pipeline
        self._inner = jit(no_cpython_wrapper=True, no_cfunc_wrapper=True, **options)
        self._outer = jit(**options)
        self._types: Any = numba.types
        self._attach_cache = attach_cache
        self._twins: dict[Callable[..., Any], Any] = {}
        self._namespaces: dict[str, dict[str, Any]] = {}

    def __call__(self, entry: Callable[..., R]) -> Callable[..., R]:
        """The compiled twin of a kernel. Raises TypeError for any other function."""
        if entry not in KERNELS:
            raise TypeError(f"{entry.__module__}.{entry.__qualname__} is not a kernel")
        twin: Callable[..., R] = self._twin(entry)
        return twin

    def _twin(self, rule: Callable[..., Any]) -> Any:
        """Make the twin of a registered function, and the twins of all rules in its module's namespace."""
        if rule not in self._twins:
            namespace = self._namespaces.setdefault(rule.__module__, {"__builtins__": __builtins__})
            twin = FunctionType(rule.__code__, namespace, rule.__name__, rule.__defaults__)
            twin.__module__ = rule.__module__
            twin.__qualname__ = rule.__qualname__
            entry = rule in KERNELS
            self._twins[rule] = compiled = self._outer(twin) if entry else self._one_for_all_integers(self._inner(twin))
            if entry and self._attach_cache:
                self._attach_cache(compiled, rule, self._checked)
            if len(namespace) == 1:
                self._fill(namespace, vars(sys.modules[rule.__module__]))
        return self._twins[rule]

    def _one_for_all_integers(self, compiled: Any) -> Any:
        """Make a function take any integer as int64: Numba would compile it again for each type and each constant."""
        template = getattr(compiled, "get_call_template", None)
        types = self._types
        if template is None:  # private in Numba: without it everything works, but compiles longer
            return compiled

        def widened(args: Iterable[Any], names: dict[str, Any]) -> Any:
            kinds = [types.unliteral(kind) for kind in args]
            small = [isinstance(kind, types.Integer) and kind.bitwidth < types.int64.bitwidth for kind in kinds]
            return template(
                [types.int64 if is_small else kind for is_small, kind in zip(small, kinds, strict=True)], names
            )

        compiled.get_call_template = widened
        return compiled

    def _fill(self, namespace: dict[str, Any], source: dict[str, Any]) -> None:
        """Fill a namespace from its module: twins for rules, arrays for lists of numbers, the rest unchanged."""
        for name, value in source.items():
            if isinstance(value, FunctionType) and value in REGISTERED:
                namespace[name] = self._twin(value)
            elif isinstance(value, (list, tuple)) and value and {*map(type, value)} <= {int, float}:
                # A table of numbers, which rules index.
                namespace[name] = np.array(value)
            elif not name.startswith("__"):
                namespace[name] = value
