"""Write TOML: tables of texts, numbers, truth values and lists of texts, which is all that our files hold."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

Value: TypeAlias = "str | int | float | bool | Sequence[str]"

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")


def write_toml(tables: Mapping[str, Mapping[str, Value]], *, comment: str = "") -> str:
    r"""Tables as TOML text; the table named '' comes first and without a name.

    >>> print(write_toml({"": {"version": 1}, "keys": {"jump": ["shift", "z"]}}), end="")
    version = 1
    <BLANKLINE>
    [keys]
    jump = ["shift", "z"]
    """
    blocks = [f"# {line}" for line in comment.splitlines()]
    parts = ["\n".join(blocks)] if blocks else []
    for name in sorted(tables, key=bool):
        lines = [f"[{_key(name)}]"] if name else []
        lines += [f"{_key(key)} = {_value(value)}" for key, value in tables[name].items()]
        parts.append("\n".join(lines))
    return "\n\n".join(parts) + "\n"


def _key(text: str) -> str:
    return text if _BARE_KEY.fullmatch(text) else _text(text)


def _value(value: Value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    return f"[{', '.join(map(_text, value))}]"


def _text(text: str) -> str:
    """A basic string; half surrogates, which no file can hold, become question marks."""
    whole = text.encode("utf-8", "replace").decode("utf-8")
    return json.dumps(whole, ensure_ascii=False).replace("\x7f", "\\u007f")
