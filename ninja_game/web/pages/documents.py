"""The documents as pages of the site: every Markdown file of the project, and the source files that they lead to.

Markdown stays what it is elsewhere too. A picture ``lab-NAME.png`` becomes the figure of that name, alive at a touch;
a paragraph of links to functions that begins with "Code:" shows their sources; one that begins with **Answer.** opens
at a click. What a link leads to and is not here (a wheel holds fewer documents than a checkout) becomes plain text.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from html import escape
from io import BytesIO
from pathlib import Path
from posixpath import normpath, relpath

from markdown_it import MarkdownIt
from markdown_it.token import Token
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer, TextLexer

from ninja_game.files.user_folder import PACKAGE, data_folder
from ninja_game.play.lab.screen import FIGURES, figure_picture
from ninja_game.play.window import png_of
from ninja_game.web.pages.frame import (
    COMPETE,
    GAME,
    HOME,
    ICON,
    MAKE,
    NAVIGATION,
    SCRIPT,
    SEARCH,
    STYLE,
    Content,
    Markup,
    colours,
    joined,
    page,
    page_icon,
    tag,
)  # fmt: skip

SECTIONS = {MAKE: ("Make", "For level makers"), COMPETE: ("Compete", "For speedrunners")}
"""Pages that are parts of the index of documents, with the headings of those parts there."""

FILM, STILL = "pictures/ninja-game.webp", "pictures/ninja-game.png"
"""The moving picture of the first page, and one for who wants no motion."""

FIGURES_SCRIPT = "app-folder/figures.js"
"""Where the build puts what makes figures move."""

LAB = "lab-"
"""How the name of a figure's picture begins."""

LEFT_OUT = (".", "build/", "dist/")
"""Folders whose Markdown is not the project's, or not meant for readers."""


def slug(heading: str) -> str:
    """The anchor that a heading gets: lower case, no punctuation, blanks as hyphens.

    >>> slug("Nine cells: a `loose` grid")
    'nine-cells-a-loose-grid'
    """
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def markdown_files() -> dict[str, Path]:
    """All documents of the project by their names in it."""
    root = data_folder("docs").parent
    files = {path.relative_to(root).as_posix(): path for path in root.rglob("*.md")}
    return {name: path for name, path in sorted(files.items()) if not name.startswith(LEFT_OUT)}


def page_of(name: str) -> str:
    """The page of a document or of a source file, by its name in the project.

    >>> [page_of(name) for name in ("docs/home.md", "README.md", "docs/learn/README.md", "ninja_game/sim/grid.py")]
    ['index.html', 'docs/about.html', 'learn/index.html', 'code/ninja_game/sim/grid.html']
    """
    if name in ("docs/home.md", "README.md"):
        return HOME if name.startswith("docs") else "docs/about.html"
    path = Path(name)
    if path.suffix != ".md":
        return f"code/{path.with_suffix('').as_posix()}.html" if path.suffix else f"code/{name}/index.html"
    stem = "index" if path.stem == "README" else path.stem
    place = path.parent.as_posix().removeprefix("docs/learn").removeprefix("docs").strip("/.")
    folder = "learn" if name.startswith("docs/learn/") else "docs"
    return normpath(f"{folder}/{place}/{stem}.html")


class Documents:
    """``files``: content by name in the site, once ``build`` was called."""

    def __init__(self) -> None:
        self.markdown = markdown_files()
        self.files: dict[str, bytes] = {}
        self.searched: list[Markup] = []
        self._sources: set[str] = set()
        self._reader = MarkdownIt("commonmark", {"html": False, "highlight": _coloured}).enable("table")
        self._reader.add_render_rule("table_open", lambda *_: '<div class="wide" tabindex="0"><table>')
        self._reader.add_render_rule("table_close", lambda *_: "</table></div>")

    def build(self) -> dict[str, bytes]:
        """All pages, with their pictures, style and search."""
        here = Path(__file__).parent
        for name in self.markdown:
            self._document(name)
        while missing := {name for name in self._sources if page_of(name) not in self.files}:
            for name in missing:
                self._source(name)
        for name, (title, heading) in SECTIONS.items():
            self._part(name, title, heading)
        results = tag("ul", *self.searched, class_="results")
        words = tag("label", "Words ", tag("input", type="search", name="words", autocomplete="off"))
        form = tag("form", words, tag("p", role="status", class_="found"), class_="search", role="search", hidden=True)
        self._write(SEARCH, "Search", [form, results])
        formatter = HtmlFormatter(style="default"), HtmlFormatter(style="github-dark")
        light, dark = (each.get_style_defs(".code") for each in formatter)
        style = [
            colours(),
            (here / STYLE).read_text("utf-8"),
            light,
            f"@media (prefers-color-scheme: dark) {{ {dark} }}",
        ]
        self.files[f"docs/{STYLE}"] = "\n".join(style).encode()
        self.files |= {f"docs/{SCRIPT}": (here / SCRIPT).read_bytes(), f"docs/{ICON}": page_icon()}
        return self.files

    def _write(self, name: str, title: str, contents: Iterable[Content], *, figures: bool = False) -> None:
        """A page in the frame of the site."""
        up = "../" * name.count("/")
        links = [(up + address, text) for address, text in NAVIGATION]
        current = next((address for address, _ in NAVIGATION if address == name), "")
        text = page(
            title,
            *contents,
            up=f"{up}docs/",
            links=links,
            current=up + current,
            figures=up + FIGURES_SCRIPT if figures else "",
        )
        self.files[name] = text.encode()

    # --- documents ---

    def _document(self, name: str) -> None:
        tokens = self._reader.parse(self.markdown[name].read_text("utf-8"))
        page_name = page_of(name)
        title, tokens = _titled(tokens, name)
        headings = list(_anchored(tokens))
        self._note(page_name, title, tokens)
        figures = self._prepare(name, tokens)
        top: list[Content] = []
        if page_name == HOME:
            top = [tag("p", tag("a", "Play now", href=GAME, class_="button"))]
        elif len(headings) > 3 and not page_name.startswith("learn/"):
            entries = [tag("li", tag("a", text, href=f"#{anchor}")) for anchor, text in headings]
            top = [tag("nav", tag("ul", *entries), class_="contents", aria_label="On this page")]
        body = Markup(self._reader.renderer.render(tokens, self._reader.options, {}))
        self._write(page_name, title, [*top, body, *self._neighbours(name)], figures=figures)

    def _neighbours(self, name: str) -> list[Content]:
        """Links to the chapters before and after one."""
        chapters = [each for each in self.markdown if each.startswith("docs/learn/") and not each.endswith("README.md")]
        if name not in chapters:
            return []
        at = chapters.index(name)
        near = (("Before: ", chapters[at - 1] if at else ""), ("Next: ", (*chapters[at + 1 :], "")[0]))
        links = [tag("a", word + self._title(each), href=Path(page_of(each)).name) for word, each in near if each]
        return [tag("nav", *links, class_="near", aria_label="Chapters")]

    def _title(self, name: str) -> str:
        return _titled(self._reader.parse(self.markdown[name].read_text("utf-8")), name)[0]

    def _part(self, name: str, title: str, heading: str) -> None:
        """A page of one part of the index of documents."""
        index = "docs/README.md"
        _, tokens = _titled(self._reader.parse(self.markdown[index].read_text("utf-8")), index)
        starts = [at for at, token in enumerate(tokens) if token.type == "heading_open"]
        start = next(at for at in starts if tokens[at + 1].content == heading)
        tokens = tokens[start + 3 : next((at for at in starts if at > start), len(tokens))]
        self._prepare(index, tokens, name)
        body = Markup(self._reader.renderer.render(tokens, self._reader.options, {}))
        gallery = tag(
            "p", tag("a", "All levels, with their best known runs", href="gallery/index.html", class_="button")
        )
        self._write(name, title, [gallery, body])

    def _note(self, page_name: str, title: str, tokens: list[Token]) -> None:
        """Let a page be found by its words, each of its parts by itself."""
        parts: list[tuple[str, str, list[str]]] = [("", "", [])]
        for at, token in enumerate(tokens):
            if token.type == "heading_open" and token.tag in ("h2", "h3"):
                parts.append((str(token.attrs["id"]), _plain(tokens[at + 1]), []))
            elif token.type in ("inline", "fence"):
                parts[-1][2].append(_plain(token))
        for anchor, heading, texts in parts:
            words = " ".join(" ".join([title, heading, *texts]).split())
            link = tag("a", f"{title}: {heading}" if heading else title, href=page_name + (anchor and f"#{anchor}"))
            start = " ".join(texts)[:160]
            entry = tag("li", link, tag("p", start, class_="faint"), data_place=len(self.searched))
            # All words, past what ``tag`` lets through of a text.
            self.searched.append(Markup(entry.replace("<li", f'<li data-words="{escape(words.casefold())}"', 1)))

    # --- what leads elsewhere ---

    def _prepare(self, name: str, tokens: list[Token], page_name: str = "") -> bool:
        """Turn links and pictures into those of the site, and paragraphs into what they stand for; whether a figure is.

        ``page_name``: the page on which the tokens of the document ``name`` stand.
        """
        page_name = page_name or page_of(name)
        found = False
        for at, token in enumerate(tokens):
            for child in token.children or ():
                if child.type == "link_open":
                    child.attrs["href"] = self._address(str(child.attrs["href"]), name, page_name)
                    if not child.attrs["href"]:
                        child.tag = "span"
                        child.attrs.clear()
                elif child.type == "image":
                    found |= self._picture(child, name, page_name)
            if token.type == "inline" and tokens[at - 1].type == "paragraph_open":
                self._stands_for(tokens, at, page_name)
        _close_spans(tokens)
        return found

    def _stands_for(self, tokens: list[Token], at: int, page_name: str) -> None:
        """Turn a paragraph of sources or an answer into what opens at a click, and one of a picture into the picture."""
        before, token, after = tokens[at - 1 : at + 2]
        children = token.children or []
        links = [str(each.attrs["href"]) for each in children if each.type == "link_open"]
        if len(children) == 1 and children[0].type in ("image", "html_inline"):
            before.hidden = after.hidden = True
        elif token.content.startswith("Code: ") and all("#L-" in link for link in links):
            before.hidden = after.hidden = True
            names = [each.content for each in children if each.type == "code_inline"]
            shown = [self._function(link, each, page_name) for link, each in zip(links, names, strict=True)]
            summary = tag("summary", "Show me the code: ", ", ".join(names))
            token.children = [_html(tag("details", summary, *shown))]
        elif token.content.startswith("**Answer.**"):
            before.type = after.type = "html_block"
            before.content, after.content = "<details><summary>Answer</summary><p>", "</p></details>"
            end = next(place for place, each in enumerate(children) if each.type == "strong_close")
            token.children = children[end + 1 :]

    def _function(self, link: str, name: str, page_name: str) -> Markup:
        """The source of a function, and where it stands in its file."""
        address, _, line = link.partition("#L-")
        target = normpath(f"{Path(page_name).parent.as_posix()}/{address}")
        source = next(each for each in self._sources if page_of(each) == target)
        text = (PACKAGE.parent / source).read_text("utf-8")
        node = _definitions(text)[name]
        lines = text.splitlines()[node.lineno - 1 : node.end_lineno]
        first = tag("p", tag("a", f"{source}, line {line}", href=link), class_="faint")
        return joined(Markup(_coloured("\n".join(lines), "python")), first)

    def _address(self, link: str, name: str, page_name: str) -> str:
        """Where a link of a document leads in the site; "" for what is not here."""
        target, _, anchor = link.partition("#")
        if "://" in link or not target:
            return link
        path = normpath(f"{Path(name).parent.as_posix()}/{target}")
        way = relpath(page_of(path), Path(page_name).parent.as_posix())
        if path in self.markdown:
            return way + (anchor and f"#{anchor}")
        whole = PACKAGE.parent / path if path.startswith(PACKAGE.name) else data_folder("docs").parent / path
        if whole.suffix in (".png", ".gif", ".svg"):
            return self._copied(whole, path, page_name)
        if not whole.exists():
            return ""
        self._sources.add(path)
        if anchor and not anchor.startswith("L-"):
            anchor = f"L-{_definitions(whole.read_text('utf-8'))[anchor].lineno}"
        return way + (anchor and f"#{anchor}")

    def _copied(self, whole: Path, path: str, page_name: str) -> str:
        """The address of a picture, which comes along."""
        if not whole.is_file():
            return ""
        self.files[path] = whole.read_bytes()
        return relpath(path, Path(page_name).parent.as_posix())

    def _picture(self, image: Token, name: str, page_name: str) -> bool:
        """Turn a picture into one of the site; whether it is a figure."""
        path = normpath(f"{Path(name).parent.as_posix()}/{image.attrs['src']}")
        whole, alt = data_folder("docs").parent / path, image.content
        up = "../" * page_name.count("/")
        figure = whole.stem.removeprefix(LAB) if whole.stem.startswith(LAB) else ""
        if figure in FIGURES:
            dark, light = (self._figure(figure, palette) for palette in ("dark", "classic"))
            source = tag("source", srcset=up + dark, media="(prefers-color-scheme: dark)")
            img = tag("img", src=up + light, alt=alt, width=540, height=324, loading="lazy")
            start = tag("button", "Touch to try it", type="button", hidden=True)
            picture = tag("figure", tag("picture", source, img), start, class_="lab", data_figure=figure)
        elif page_name == HOME and path.endswith(".gif"):
            self.files |= {FILM: self._film[0], STILL: self._film[1]}
            source = tag("source", srcset=STILL, media="(prefers-reduced-motion: reduce)")
            picture = tag("picture", source, tag("img", src=FILM, alt=alt, width=528, height=400))
        else:
            picture = tag("img", src=self._copied(whole, path, page_name), alt=alt, loading="lazy")
        image.type, image.content = "html_inline", picture
        return figure in FIGURES

    def _figure(self, figure: str, palette: str) -> str:
        """The name of the still picture of a figure, drawn by the very code that moves it."""
        name = f"lab/{figure}-{palette}.png"
        if name not in self.files:
            self.files[name] = png_of(figure_picture(figure, scale=2.0, palette=palette))
        return name

    @cached_property
    def _film(self) -> tuple[bytes, bytes]:
        """The moving picture of the first page, every second picture of it, as WebP; and its middle as PNG."""
        from PIL import Image, ImageSequence

        film, still = BytesIO(), BytesIO()
        with Image.open(data_folder("docs") / "pictures" / "ninja-game.gif") as gif:
            first, *others = [each.convert("RGB") for each in ImageSequence.Iterator(gif)][::2]
            pace = 2 * gif.info["duration"]
        first.save(film, "webp", save_all=True, append_images=others, duration=pace, loop=0, quality=30, method=4)
        others[len(others) // 2].quantize(64).save(still, "png")
        return film.getvalue(), still.getvalue()

    # --- sources ---

    def _source(self, name: str) -> None:
        """The page of a source file, or of a folder of them."""
        path = (PACKAGE.parent if name.startswith(PACKAGE.name) else data_folder("docs").parent) / name
        if path.is_dir():
            inside = sorted(each for each in path.iterdir() if each.is_dir() or each.suffix == ".py")
            names = [f"{name}/{each.name}" for each in inside if not each.name.startswith(("_", "."))]
            self._sources |= set(names)
            start = Path(page_of(name)).parent.as_posix()
            rows = [tag("li", tag("a", Path(each).name, href=relpath(page_of(each), start))) for each in names]
            self._write(page_of(name), name, [tag("ul", *rows)])
        else:
            text = path.read_text("utf-8")
            self._write(page_of(name), name, [Markup(_coloured(text, f"/{name}"))])


def _titled(tokens: list[Token], name: str) -> tuple[str, list[Token]]:
    """The title of a document, and the tokens without it."""
    if tokens and tokens[0].type == "heading_open" and tokens[0].tag == "h1":
        return _plain(tokens[1]), tokens[3:]
    return Path(name).stem, tokens


def _plain(token: Token) -> str:
    """The text of a token without marks."""
    if token.type == "fence":
        return token.content
    return "".join(" " if each.type == "softbreak" else each.content for each in token.children or ())


def _anchored(tokens: list[Token]) -> Iterator[tuple[str, str]]:
    """Give the headings their anchors; those of the second rank with their texts. Equal ones get numbers."""
    used: dict[str, int] = {}
    for at, token in enumerate(tokens):
        if token.type == "heading_open":
            text = _plain(tokens[at + 1])
            anchor = slug(text)
            used[anchor] = used.get(anchor, -1) + 1
            token.attrs["id"] = anchor + (f"-{used[anchor]}" if used[anchor] else "")
            if token.tag == "h2":
                yield str(token.attrs["id"]), text


def _close_spans(tokens: list[Token]) -> None:
    """End what began as a link and became text."""
    for token in tokens:
        opened = ""
        for child in token.children or ():
            if child.type == "link_open":
                opened = child.tag
            elif child.type == "link_close":
                child.tag = opened


def _html(markup: Markup) -> Token:
    token = Token("html_inline", "", 0)
    token.content = markup
    return token


def _coloured(text: str, lang: str, _: str = "") -> str:
    """A piece of code as HTML, Python in colours; each line has an anchor where ``lang`` is a path."""
    python = lang.split(" ", maxsplit=1)[0].endswith(("python", "py"))
    shape = HtmlFormatter(cssclass="code", lineanchors="L" if "/" in lang else "")
    shown = str(highlight(text, PythonLexer(stripnl=False) if python else TextLexer(stripnl=False), shape)).rstrip()
    return shown.removesuffix("</div>").replace('<div class="code"><pre>', '<pre class="code" tabindex="0">', 1)


def _definitions(text: str) -> Mapping[str, ast.FunctionDef | ast.ClassDef]:
    """The functions and classes of a file; methods as ``Class.method`` and by their name alone."""
    found: dict[str, ast.FunctionDef | ast.ClassDef] = {}
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found.setdefault(node.name, node)
    return found
