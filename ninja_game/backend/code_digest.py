"""The digest of a kernel's sources, which names its machine code. Needs neither Numba nor NumPy."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from hashlib import sha256
from types import CodeType, FunctionType, ModuleType
from typing import Any

from ninja_game.sim.schema.declare import REGISTERED

OPTIONS = {"nogil": True, "error_model": "python", "_nrt": False}
"""Options of Numba for every function. ``_nrt``: no reference counts, since no kernel makes an array."""


def code_digest(entry: Callable[..., Any], compiler: str) -> str:
    """Hash everything that determines the machine code of a kernel.

    That is ``compiler`` (the compiler with its options), the code of the function and of all registered functions that
    it reaches, the fields of the named tuples that they take, and the values of the constants that they name.
    """
    digest = sha256(compiler.encode())
    waiting: list[Any] = [entry]
    known = {entry}
    while waiting:
        rule = waiting.pop()
        digest.update(f"{rule.__module__}.{rule.__qualname__} {rule.__defaults__}\n".encode())
        names: set[str] = set()
        for code in _codes(rule.__code__):
            constants = [value for value in code.co_consts if not isinstance(value, CodeType)]
            digest.update(code.co_code + f"{code.co_names} {constants}\n".encode())
            names.update(code.co_names)
        for annotation in rule.__annotations__.values():
            if fields := getattr(rule.__globals__.get(annotation), "_fields", ()):
                digest.update(f"{annotation}: {fields}\n".encode())
        for name in sorted(names & rule.__globals__.keys()):
            value = rule.__globals__[name]
            if _is_plain(value):
                digest.update(f"{name} = {value!r}\n".encode())
            elif isinstance(value, ModuleType):
                there = {key: vars(value)[key] for key in sorted(names & vars(value).keys())}
                digest.update(f"{name}: {[(key, there[key]) for key in there if _is_plain(there[key])]}\n".encode())
            elif isinstance(value, FunctionType) and value in REGISTERED and value not in known:
                known.add(value)
                waiting.append(value)
    return digest.hexdigest()


def _is_plain(value: Any) -> bool:
    """Whether a global is a constant that a rule may name."""
    return isinstance(value, (bool, int, float, str, tuple, list))


def _codes(code: CodeType) -> Iterator[CodeType]:
    """A function's code and the code of the functions inside it."""
    yield code
    for value in code.co_consts:
        if isinstance(value, CodeType):
            yield from _codes(value)
