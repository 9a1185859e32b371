"""One annotated schema, and the two memories made of it.

The state of the world is described once, by annotated classes (``world_fields.py``). This module turns such a class
into the *plain* memory: a Python class with slots, every field zero at first. ``layout.py`` of the backend turns the
same class into the *compiled* memory: a NumPy record. The rules are ordinary functions that never know which of the
two they hold.

``@fast`` only registers a rule; the backend's ``compiler.py`` makes compiled twins of what is registered. Plain play
imports neither Numba nor NumPy.
"""

from __future__ import annotations

from collections.abc import Callable
from inspect import get_annotations
from operator import attrgetter
from typing import Annotated, Any, NamedTuple, TypeVar, get_args, get_origin, get_type_hints

f8 = Annotated[float, "f8"]
f4 = Annotated[float, "f4"]
i8 = Annotated[int, "i8"]
i4 = Annotated[int, "i4"]
i2 = Annotated[int, "i2"]
u1 = Annotated[int, "u1"]

C = TypeVar("C")
F = TypeVar("F", bound=Callable[..., Any])

REGISTERED: set[Any] = set()  # every function marked ``@fast``

KERNELS: dict[Any, str] = {}
"""The registered functions that Python calls, with their names: only they get wrappers and a place in the cache."""


def fast(function: F) -> F:
    """Register a rule for compilation and give it back unchanged."""
    REGISTERED.add(function)
    return function


def kernel(function: F) -> F:
    """Register a function that Python calls; its arguments are arrays and numbers, never single records.

    Raises TypeError if another kernel has the same name.
    """
    if function.__name__ in KERNELS.values():
        raise TypeError(f"there is another kernel of the name {function.__name__}; rename one")
    KERNELS[function] = function.__name__
    return fast(function)


class Field(NamedTuple):
    """One field of a struct: a scalar code (``"f8"``) or a struct class, and its length (0: not an array)."""

    name: str
    type: str | type
    length: int


def fields_of(cls: type) -> list[Field]:
    """List the fields that a struct declares or inherits, bases first, in the order of declaration."""
    if "FIELDS" in cls.__dict__:
        return list(cls.__dict__["FIELDS"])
    fields: dict[str, Field] = {}
    for base in reversed(cls.__mro__[:-1]):
        hints = get_type_hints(base, include_extras=True)
        for name in get_annotations(base):
            fields.setdefault(name, _field(name, hints[name]))
    return list(fields.values())


def scalars_of(cls: type) -> list[Field]:
    """List the fields of a struct that hold one number: no arrays, no structs."""
    return [field for field in fields_of(cls) if field.length == 0 and isinstance(field.type, str)]


def _field(name: str, hint: Any) -> Field:
    """Read one annotation: ``f8``, ``Struct`` or ``Annotated[list[element], length]``."""
    length = 0
    if get_origin(hint) is Annotated and get_origin(get_args(hint)[0]) is list:
        array, length = get_args(hint)
        hint = get_args(array)[0]
    if get_origin(hint) is Annotated:
        return Field(name, get_args(hint)[1], length)
    return Field(name, hint, length)


def getter_of(fields: list[Field]) -> Callable[[Any], tuple[Any, ...]]:
    """Make a function that reads these fields of an object as a tuple."""
    return attrgetter(*(field.name for field in fields))


def setter_of(fields: list[Field]) -> Callable[[Any, tuple[Any, ...]], None]:
    """Make a function that writes a tuple back into these fields of an object."""
    targets = ", ".join(f"o.{field.name}" for field in fields)
    names: dict[str, Any] = {}
    exec(f"def restore(o, values):\n    {targets}, = values", names)  # noqa: S102 - made from the schema, not from input
    setter: Callable[[Any, tuple[Any, ...]], None] = names["restore"]
    return setter


def struct_base(cls: type[C]) -> type[C]:
    """Declare fields for structs to inherit. The class has no instances, hence empty slots."""
    body = {name: value for name, value in cls.__dict__.items() if name not in ("__dict__", "__weakref__")}
    remade: type[C] = type(cls.__name__, cls.__bases__, body | {"__slots__": ()})
    return remade


def struct(cls: type[C]) -> type[C]:
    """Give an annotated class slots and a constructor without arguments that makes everything zero.

    If a struct ends with an array of structs, the array starts with one element, the unused index 0; the loader appends
    the objects of a level.
    """
    fields = fields_of(cls)
    lines = ["def __init__(self):"]
    names: dict[str, Any] = {}
    for name, kind, length in fields:
        if isinstance(kind, type):
            names[kind.__name__] = kind
            count = 1 if name == fields[-1].name else length
            value = f"[{kind.__name__}() for _ in range({count})]" if length else f"{kind.__name__}()"
        else:
            value = "0.0" if kind.startswith("f") else "0"
            value = f"[{value}] * {length}" if length else value
        lines.append(f"    self.{name} = {value}")
    exec("\n".join(lines), names)  # noqa: S102 - generated from the schema above, not from input
    body = {
        "__slots__": tuple(field.name for field in fields),
        "__init__": names["__init__"],
        "__module__": cls.__module__,
        "__doc__": cls.__doc__,
        "__qualname__": cls.__qualname__,
        "FIELDS": fields,
    }
    remade: type[C] = type(cls.__name__, cls.__bases__, body)
    return remade
