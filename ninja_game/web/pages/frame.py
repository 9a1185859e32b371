"""The parts of all static pages: escaped HTML, the frame, headings in the game's own letters, their folder."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable
from functools import lru_cache
from html import escape
from itertools import compress, repeat
from pathlib import Path
from typing import TypeAlias

from pygame import Color

from ninja_game.board.memo import Memo, program, values_digest
from ninja_game.errors import FileError
from ninja_game.files.reading import file_stamp
from ninja_game.files.shown_text import shown_text
from ninja_game.files.tree import Tree, leads_below
from ninja_game.ui.canvas import png_of
from ninja_game.ui.lettering import CAP, LETTER_SPACING, WEIGHTS, glyph_of
from ninja_game.ui.theme import PALETTES, Palette, mixed
from ninja_game.view.ninja.figure import icon

_MAX_TEXT = 400  # characters of a text that are shown

_EMPTY = frozenset({"img", "input", "link", "meta", "source"})  # elements without an end tag

_ADDRESS = re.compile(r"(?:https?://[\w.:-]+/)?(?!//)[\w./#=&,-]*")
"""The allowed targets of links: a file of the site, a page with the game, a fragment; no scheme that runs anything."""


class Markup(str):
    """HTML that is complete and escaped. Only ``tag`` and ``joined`` make it."""

    __slots__ = ()


Content: TypeAlias = Markup | str | int | None


def joined(*contents: Content) -> Markup:
    """Contents one after the other; plain texts are escaped, None is left out.

    >>> joined("a < b", None, 7)
    'a &lt; b7'
    """
    present = [content for content in contents if content is not None]
    return Markup("".join([c if isinstance(c, Markup) else escape(shown_text(str(c), _MAX_TEXT)) for c in present]))


def tag(name: str, /, *contents: Content, **attributes: str | int | bool | None) -> Markup:
    """An element. ``attributes``: names with _ for -, without one at their end; True writes no value, None nothing.

    Raises ValueError for an address outside of the site.

    >>> tag("a", "<b>", href="levels/1.html", class_="x", data_name='"', hidden=True)
    '<a href="levels/1.html" class="x" data-name="&quot;" hidden>&lt;b&gt;</a>'
    """
    parts = [name]
    for key, value in attributes.items():
        if value is None or value is False:
            continue
        attribute = key.rstrip("_").replace("_", "-")
        if attribute in {"href", "src"} and not _ADDRESS.fullmatch(str(value)):
            raise ValueError(f"not an address of a page: {value!r}"[:100])
        if value is True:
            parts.append(attribute)
        else:
            text = str(value)
            written = text if attribute in {"href", "src", "d", "content"} else shown_text(text, _MAX_TEXT)
            parts.append(f'{attribute}="{escape(written)}"')
    start = f"<{' '.join(parts)}>"
    return Markup(start if name in _EMPTY else f"{start}{joined(*contents)}</{name}>")


POLICY = "default-src 'none'; img-src 'self'; style-src 'self'; script-src 'self'; base-uri 'none'; form-action 'none'"
"""The content security policy of every page: nothing from elsewhere, no script or style within the page."""

FIGURES_POLICY = POLICY.replace("script-src 'self'", "connect-src 'self'; script-src 'self' 'wasm-unsafe-eval'")
"""The policy of pages with figures, which run Python."""

HOME_PAGE = "index.html"
GAME_PAGE = "play.html"
SEARCH_PAGE = "search.html"
NAVIGATION = (
    (HOME_PAGE, "Home"), ("learn/index.html", "Learn"), (GAME_PAGE, "Play"), ("docs/making-levels.html", "Make"),
    ("gallery/index.html", "Compete"), ("docs/index.html", "Reference"), (SEARCH_PAGE, "Search"),
)  # fmt: skip
"""Pages in the folder of a site, and the names of their links."""

STYLE = "style.css"
SCRIPT = "search.js"
ICON = "icon.png"
REPLAYS = "replays"  # the folder of a site with the replays that pages lead to
MARK = ".ninja-game-pages"  # a file in a folder of pages: it marks them as replaceable

_INK_ROLES = (
    "background", "tile", "text", "on_tile", "panel", "panel_edge", "accent", "good", "bad", "gold", "gold_light",
    "ninja", "switch",
)  # fmt: skip
_FAINT = 0.35  # share between the palette's ink and its faint one for small text: enough contrast
_FRAME = 0.4  # how much darker than a tile the frame of a page is, on which letters stand
_ICON_SIZE = 64
_MAX_HEADING = 30
LONG_CELL = 24  # most characters of a cell in one line
_MAX_HEAD = 14  # letters in the first row
_NUMBER = re.compile(r"(?:<[^>]*>)*[-+]?\d[\d.,]*(?: of \d+| s)?(?:<[^>]*>)*")
"""A cell with a number, which is aligned to the right for comparison."""


class Pages:
    """The folder ``name`` of a site, with pages. Raises FileError if it holds files that were not made here.

    ``memo``: of the same site; pages in it that are unchanged on the disk are not made again.
    """

    def __init__(self, site: Path, name: str, memo: Memo | None = None) -> None:
        self.folder = site / name
        self._memo = memo or Memo()
        self._site = Tree(site, kept=False)  # they can always be made again
        self._written: set[str] = set()
        present = self._site.names(name)
        if present and MARK not in present:
            raise FileError("not a folder of pages made here", str(self.folder), hint="empty it, or choose another one")
        sources = Path(__file__).parent
        self.write(MARK, "made by ninja-game\n")
        self.write(STYLE, "\n".join((colours(), (sources / STYLE).read_text("utf-8"))))
        self.write(SCRIPT, (sources / SCRIPT).read_text("utf-8"))
        self.write(ICON, page_icon())

    def write(self, name: str, content: str | bytes, *, replay: bool = False) -> None:
        """Write a file in the folder, or below it, over an earlier one: pages can always be made again.

        ``replay``: in the site's folder of replays instead.
        """
        self._site.write(self._place(name, replay=replay), content)

    def make(self, name: str, data: object, content: Callable[[], str | bytes], *, replay: bool = False) -> None:
        """As ``write``, unless the file is there already, made from the same plain values."""
        digest = f"{program()} {data}" if isinstance(data, str) else values_digest([program(), data])
        place = self._place(name, replay=replay)
        file = f"{self._site.root}/{place}"
        if self._memo.recall(place) != [digest, *file_stamp(file)]:
            self._site.write(place, content())
            self._memo.note(place, [digest, *file_stamp(file)])

    def _place(self, name: str, *, replay: bool) -> str:
        if replay:
            return f"{REPLAYS}/{name}"
        self._written.add(name)
        return f"{self.folder.name}/{name}"

    def finish(self) -> None:
        """Remove files that this memo's earlier pages had and these have not, and save the memo."""
        for name in self._memo.forgotten:
            if leads_below(name) and name.startswith((f"{self.folder.name}/", f"{REPLAYS}/")):
                self._site.remove(name)
        self._memo.save()

    def clear(self, below: str) -> None:
        """Remove all earlier pages from one of its folders, except those written now."""
        now = {name.removeprefix(f"{below}/") for name in self._written if name.startswith(f"{below}/")}
        self._site.remove_others(f"{self.folder.name}/{below}", now)


DESCRIPTION = "A platform game in the style of N, in a page: play it, see how it works, make levels, compare runs."


def page(
    title: str,
    *contents: Content,
    up: str = "",
    links: Iterable[tuple[str, str]] = (),
    current: str = "",
    figures: str = "",
    picture: str = "",
    description: str = "",
) -> str:
    """A whole page. ``up``: the path to the folder of the pages; ``links``: addresses and names at its top.

    ``current``: the address of the page's own link; ``figures``: of the script for figures; ``picture``: of the preview
    where somebody shares a link, complete if the site's own is known; ``description``: the text beside it.
    """
    description = shown_text(description, _MAX_TEXT) or DESCRIPTION
    graph = {"og:title": shown_text(title), "og:description": description, "og:type": "website", "og:image": picture}
    head = tag(
        "head",
        tag("meta", charset="utf-8"),
        tag("meta", http_equiv="Content-Security-Policy", content=FIGURES_POLICY if figures else POLICY),
        tag("meta", name="viewport", content="width=device-width, initial-scale=1"),
        tag("meta", name="referrer", content="no-referrer"),
        tag("meta", name="description", content=description),
        *(tag("meta", property=name, content=content) for name, content in graph.items() if content),
        tag("meta", name="twitter:card", content="summary_large_image") if picture else None,
        tag("title", f"{title} - ninja-game"),
        tag("link", rel="stylesheet", href=f"{up}{STYLE}"),
        tag("link", rel="icon", href=f"{up}{ICON}"),
        tag("script", src=f"{up}{SCRIPT}", defer=True),
        tag("script", src=figures, type="module") if figures else None,
    )
    links = tuple(links)
    navigation = _navigation(links, current if current in dict(links) else "")
    body = tag(
        "body",
        tag("a", "To the content", href="#content", class_="skip"),
        tag("header", navigation, heading(title)),
        tag("main", *contents, id="content", tabindex="-1"),
    )
    return f"<!doctype html>\n{tag('html', head, body, lang='en')}\n"


@lru_cache(64)
def _navigation(links: tuple[tuple[str, str], ...], current: str) -> Markup:
    """The links at the top of many pages."""
    entries = [
        tag("li", tag("a", name, href=href, aria_current="page" if href == current else None)) for href, name in links
    ]
    return tag("nav", tag("ul", *entries), aria_label="Pages")


@lru_cache(64)  # the pages of a player, one after the other, share it
def heading(text: str) -> Markup:
    """The heading of a page in the game's own letters, or plain if letters are missing."""
    letters = shown_text(text)
    glyphs = [glyph_of(character) for character in letters]
    if not 0 < len(letters) <= _MAX_HEADING or None in glyphs:
        return tag("h1", text)
    x, moves = 1.0, []
    for letter in glyphs:
        for line in letter.lines if letter else ():
            points = [f"{x + left:.2f} {top + 3:.2f}" for left, top in line]
            moves.append("M" + "L".join(points if len(points) > 1 else points * 2))
        x += (letter.width if letter else 0.0) + LETTER_SPACING + WEIGHTS[1]
    ink = {"fill": "none", "stroke": "currentColor", "stroke_width": str(WEIGHTS[1])}
    strokes = tag("path", d="".join(moves), **ink, stroke_linecap="round", stroke_linejoin="round")
    box = f"0 0 {x:.1f} {CAP + 7:.1f}"
    picture = tag("svg", strokes, viewBox=box, aria_hidden="true", height=str(round(30 * (CAP + 7) / CAP)))
    return tag("h1", picture, tag("span", letters, class_="hidden"))


def page_icon() -> bytes:
    return png_of(icon(_ICON_SIZE))


def colours() -> str:
    """The palettes as custom properties: the classic one, and the dark one for readers who prefer it."""
    dark = f"@media (prefers-color-scheme: dark) {{ {_root(PALETTES['dark'])} }}"
    return f"{_root(PALETTES['classic'])}\n{dark}"


def _root(palette: Palette) -> str:
    inks = {role.replace("_", "-"): getattr(palette, role) for role in _INK_ROLES}
    inks["faint"] = mixed(palette.text, palette.faint, _FAINT)
    inks["link"] = mixed(palette.accent, palette.text, 0.25)
    inks["frame"] = mixed(palette.tile, palette.outline, _FRAME)
    candidates = palette.background, palette.text, palette.on_tile
    inks["on-accent"] = max(candidates, key=lambda ink: abs(sum(ink[:3]) - sum(palette.accent[:3])))
    variables = " ".join(f"--{role}: {css_colour(ink)};" for role, ink in inks.items())
    return f":root {{ {variables} }}"


def css_colour(ink: Color) -> str:
    return f"#{ink.r:02x}{ink.g:02x}{ink.b:02x}"


def definitions(pairs: Iterable[tuple[str, Content]]) -> Markup:
    """A list of names and values."""
    return tag("dl", *(tag("div", tag("dt", name), tag("dd", value)) for name, value in pairs))


def table(
    caption: str, heads: Iterable[str], rows: Iterable[Iterable[Content]], optional: Collection[str] = ()
) -> Markup:
    """A table with its caption, without empty columns; it scrolls by itself if it is too wide.

    ``optional``: heads of columns that a narrow page leaves out.
    """
    cells = [list(row) for row in rows]
    filled = [any(cell not in ("", None) for cell in column) for column in zip(*cells, strict=True)] or repeat(True)
    columns = [*compress(heads, filled)]
    lines = [[*compress(row, filled)] for row in cells]
    numbers = [all(_NUMBER.fullmatch(str(cell)) for cell in column if cell) for column in zip(*lines, strict=True)]
    kinds = [f"n{at}" for at, number in enumerate(numbers, 1) if number]
    kinds += [f"l{at}" for at, name in enumerate(columns, 1) if name in optional]
    head = tag("tr", *(tag("th", _wrapping(name, _MAX_HEAD), scope="col") for name in columns))
    body = tag("tbody", *(tag("tr", *(tag("td", _wrapping(cell)) for cell in line)) for line in lines))
    whole = tag("table", tag("caption", caption), tag("thead", head), body, class_=" ".join(kinds) or None)
    return tag("div", whole, class_="wide", tabindex="0", role="region", aria_label=caption)


def _wrapping(cell: Content, longest: int = LONG_CELL) -> Content:
    """A cell that breaks its lines if it is long."""
    long = isinstance(cell, str) and not isinstance(cell, Markup) and len(cell) > longest
    return tag("span", cell, class_="text") if long else cell


def section(title: str, *contents: Content, anchor: str | None = None) -> Markup:
    return tag("section", tag("h2", title), joined(*contents), id=anchor)


def on_this_page(leads: Iterable[tuple[str, str]]) -> Markup:
    """Links to parts of a page, by their anchors."""
    links = [tag("li", tag("a", text, href=f"#{anchor}")) for anchor, text in leads]
    return tag("nav", tag("ul", *links), class_="contents", aria_label="On this page")
