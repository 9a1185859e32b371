"""HTML from values: every text and attribute is escaped here, and nothing else makes markup."""

from __future__ import annotations

import re
from html import escape
from typing import TypeAlias

from ninja_game.files.shown_text import shown_text

LONGEST = 400
"""Characters of a text that are shown."""

_EMPTY = frozenset({"img", "input", "link", "meta", "path"})
"""Elements without an end tag."""

_ADDRESS = re.compile(r"(?:https?://[\w.:-]+/)?(?!//)[\w./#=&,-]*")
"""Where a page may lead: a file of its site, a page with the game, a fragment; no scheme that runs anything."""


class Markup(str):
    """HTML that is whole and escaped. Only ``tag`` and ``joined`` make it."""

    __slots__ = ()


Content: TypeAlias = Markup | str | int | None


def joined(*contents: Content) -> Markup:
    """Contents one after the other; plain texts become data, None nothing.

    >>> joined("a < b", None, 7)
    'a &lt; b7'
    """
    return Markup("".join(_escaped(each) for each in contents if each is not None))


def _escaped(content: Content) -> str:
    return content if isinstance(content, Markup) else escape(shown_text(str(content), LONGEST))


def tag(name: str, /, *contents: Content, **attributes: str | int | bool | None) -> Markup:
    """An element. ``attributes``: names with _ for - and without one at their end; True: without value; None: left out.

    Raises ValueError for an address that is none of ours.

    >>> tag("a", "<b>", href="levels/1.html", class_="x", data_name='"', hidden=True)
    '<a href="levels/1.html" class="x" data-name="&quot;" hidden>&lt;b&gt;</a>'
    """
    parts = [name]
    for key, value in attributes.items():
        attribute = key.rstrip("_").replace("_", "-")
        if attribute in {"href", "src"} and not _ADDRESS.fullmatch(str(value)):
            raise ValueError(f"not an address of a page: {value!r}"[:100])
        if value is True:
            parts.append(attribute)
        elif value is not None and value is not False:
            text = str(value)
            shown = text if attribute in {"href", "src", "d", "content"} else shown_text(text, LONGEST)
            parts.append(f'{attribute}="{escape(shown)}"')
    start = f"<{' '.join(parts)}>"
    return Markup(start if name in _EMPTY else f"{start}{joined(*contents)}</{name}>")
