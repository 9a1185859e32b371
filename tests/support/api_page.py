"""The reference of the public API, made from signatures and docstrings: the end of docs/python-api.md."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

import ninja_game
from ninja_game.errors import NinjaGameError

PAGE = Path(__file__).resolve().parents[2] / "docs" / "python-api.md"
HEADING = "## Reference\n"


def reference() -> str:
    """Every public name with its signature and the first line of its docstring; of classes the members too."""
    lines = [HEADING]
    for name in sorted(set(ninja_game.__all__) - {"__version__"}, key=str.lower):
        value = getattr(ninja_game, name)
        plain = inspect.isclass(value) and issubclass(value, (NinjaGameError, int))
        lines.append(f"`{name}{'' if plain else _signature(value)}`: {_first_line(value)}")
        lines += _members(value) if inspect.isclass(value) and not plain else []
        lines.append("")
    return "\n".join(lines)


def _members(cls: Any) -> list[str]:
    """A line for each public method and property of a class; its fields stand in its signature."""
    lines = []
    for name, member in vars(cls).items():
        if name.startswith("_") or not (inspect.isfunction(member) or isinstance(member, property)):
            continue
        lines.append(f"- `{name}{'' if isinstance(member, property) else _signature(member)}`: {_first_line(member)}")
    return lines


def _signature(value: Any) -> str:
    """The parameters of a function or class, without types and without ``self``."""
    parameters = [
        parameter.replace(annotation=parameter.empty, default=_short(parameter.default))
        for parameter in inspect.signature(value).parameters.values()
        if parameter.name != "self"
    ]
    return str(inspect.Signature(parameters))


def _short(default: Any) -> Any:
    """A default as the page shows it: not all 713 tiles of an empty level."""
    return _Long() if isinstance(default, tuple) and len(default) > 9 else default


class _Long:
    """A value that is too long to be shown."""

    def __repr__(self) -> str:
        return "…"


def _first_line(value: Any) -> str:
    return (inspect.getdoc(value) or "").partition("\n")[0].replace("``", "`")


def write_api_page() -> None:
    """Write the reference anew; what stands before it stays."""
    text = PAGE.read_text("utf-8").partition(HEADING)[0]
    PAGE.write_text(text + reference(), "utf-8")
