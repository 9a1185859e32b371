"""The reference of the public API, made from signatures and docstrings: the ends of the pages ``PAGES``."""

from __future__ import annotations

import inspect
import textwrap
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

import ninja_game
import ninja_game.learn
from ninja_game.errors import NinjaGameError
from ninja_game.learn.observations.part import Part

DOCS = Path(__file__).resolve().parents[2] / "docs"
PAGES = {DOCS / "python-api.md": ninja_game, DOCS / "learning.md": ninja_game.learn}
HEADING = "## Reference\n"


def reference(module: ModuleType) -> str:
    """Every public name of a module with its signature and its docstring's first line; of classes the members too."""
    lines = [HEADING]
    for name in sorted(set(module.__all__) - {"__version__"}, key=lambda name: (name.lower(), name)):
        value = getattr(module, name)
        plain = inspect.isclass(value) and issubclass(value, (NinjaGameError, int))
        lines += _wrapped(f"`{name}{'' if plain else _signature(value)}`: {_first_line(value)}")
        lines += _members(value) if inspect.isclass(value) and not plain and not issubclass(value, Part) else []
        lines.append("")
    return "\n".join(lines)


def _members(cls: Any) -> list[str]:
    """A line for each public method and property of a class; its fields stand in its signature."""
    lines = []
    for name, member in vars(cls).items():
        is_property = isinstance(member, (property, cached_property))
        if name.startswith("_") or not (inspect.isfunction(member) or is_property):
            continue
        signature = "" if is_property else _signature(member)
        lines += _wrapped(f"- `{name}{signature}`: {_first_line(member)}")
    return lines


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, 120, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)


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


def write_api_pages() -> None:
    """Write the references again; what stands before them stays."""
    for page, module in PAGES.items():
        text = page.read_text("utf-8").partition(HEADING)[0]
        page.write_text(text + reference(module), "utf-8")
