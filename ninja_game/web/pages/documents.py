"""The documents as pages of the site: every Markdown file of the project, and the source files that they link to.

The Markdown is the same as elsewhere. A picture ``lab-NAME.png`` becomes the figure of that name, live at a touch; a
paragraph of links to functions that begins with "Code:" shows their sources; one that begins with **Answer.** opens at
a click; Python marked "try" can be changed and run. Links to missing files (a wheel holds fewer documents than a
checkout) become plain text.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Mapping
from html import escape
from io import BytesIO
from pathlib import Path
from posixpath import normpath, relpath

from markdown_it import MarkdownIt
from markdown_it.token import Token
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonConsoleLexer, PythonLexer, TextLexer

from ninja_game.files.bundled import data_folder
from ninja_game.play.lab.figure import figure_texts
from ninja_game.play.lab.screen import FIGURES, figure_picture
from ninja_game.runtime import PACKAGE
from ninja_game.ui.canvas import png_of
from ninja_game.web.pages import frame
from ninja_game.web.pages.frame import GAME_PAGE, HOME_PAGE, NAVIGATION, SEARCH_PAGE, Content, Markup, joined, tag

FILM = "pictures/ninja-game.webp"  # the film of the first page
_STILL = "pictures/ninja-game.png"  # its picture, for readers who want no motion

FIGURES_SCRIPT = "app-folder/figures.js"  # the script that animates figures

LAB = "lab-"  # the beginning of the name of a figure's picture

_LEFT_OUT = (".", "build/", "dist/")  # folders whose Markdown is not the project's, or not meant for readers


def slug(heading: str) -> str:
    """The anchor of a heading: lower case, no punctuation, spaces as hyphens.

    >>> slug("Nine cells: a `loose` grid")
    'nine-cells-a-loose-grid'
    """
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def markdown_files() -> dict[str, Path]:
    root = data_folder("docs").parent
    files = {path.relative_to(root).as_posix(): path for path in root.rglob("*.md")}
    return {name: path for name, path in sorted(files.items()) if not name.startswith(_LEFT_OUT)}


def page_of(name: str) -> str:
    """The page of a document or of a source file, by its name in the project.

    >>> [page_of(name) for name in ("docs/home.md", "README.md", "docs/learn/README.md", "ninja_game/sim/grid.py")]
    ['index.html', 'docs/about.html', 'learn/index.html', 'code/ninja_game/sim/grid.html']
    """
    if name in ("docs/home.md", "README.md"):
        return HOME_PAGE if name.startswith("docs") else "docs/about.html"
    path = Path(name)
    if path.suffix != ".md":
        return f"code/{path.with_suffix('').as_posix()}.html" if path.suffix else f"code/{name}/index.html"
    stem = "index" if path.stem == "README" else path.stem
    place = path.parent.as_posix().removeprefix("docs/learn").removeprefix("docs").strip("/.")
    folder = "learn" if name.startswith("docs/learn/") else "docs"
    return normpath(f"{folder}/{place}/{stem}.html")


class Documents:
    """The documents as pages. ``files``: content by name in the site, once ``build`` was called.

    ``address``: the site's, if it is known.
    """

    def __init__(self, address: str = "") -> None:
        self._address_of_site = address
        self._reader = MarkdownIt("commonmark", {"html": False, "highlight": _highlighted}).enable("table")
        self._reader.add_render_rule("table_open", lambda *_: '<div class="wide words" tabindex="0"><table>')
        self._reader.add_render_rule("table_close", lambda *_: "</table></div>")
        self.markdown = {
            name: _split_title(self._reader.parse(path.read_text("utf-8")), name)
            for name, path in markdown_files().items()
        }
        self.files: dict[str, bytes] = {}
        self.searched: list[Markup] = []
        self._sources: set[str] = set()

    def build(self) -> dict[str, bytes]:
        folder = Path(__file__).parent
        for name in self.markdown:
            self._document(name)
        while missing := {name for name in self._sources if page_of(name) not in self.files}:
            for name in missing:
                self._source(name)
        results = tag("ul", *self.searched, class_="results")
        words = tag("label", "Words ", tag("input", type="search", name="words", autocomplete="off"))
        form = tag("form", words, tag("p", role="status", class_="found"), class_="search", role="search", hidden=True)
        self._write(SEARCH_PAGE, "Search", [form, results])
        light, dark = (HtmlFormatter(style=name).get_style_defs(".code") for name in ("default", "github-dark"))
        dark = f"@media (prefers-color-scheme: dark) {{ {dark} }}"
        style = [frame.colours(), (folder / frame.STYLE).read_text("utf-8"), light, dark]
        self.files[f"docs/{frame.STYLE}"] = "\n".join(style).encode()
        self.files |= {
            f"docs/{frame.SCRIPT}": (folder / frame.SCRIPT).read_bytes(),
            f"docs/{frame.ICON}": frame.page_icon(),
        }
        return self.files

    def _write(self, name: str, title: str, contents: Iterable[Content], *, figures: bool = False) -> None:
        """A page in the frame of the site."""
        up = "../" * name.count("/")
        links = [(up + address, text) for address, text in NAVIGATION]
        script = up + FIGURES_SCRIPT if figures else ""
        picture = self._address_of_site + _STILL if name == HOME_PAGE else ""
        self.files[name] = frame.page(
            title, *contents, up=f"{up}docs/", links=links, current=up + name, figures=script, picture=picture
        ).encode()

    def _document(self, name: str) -> None:
        title, tokens = self.markdown[name]
        page_name = page_of(name)
        headings = list(_add_anchors(tokens))
        self._index_words(page_name, title, tokens)
        figures = self._rewrite_links(name, tokens)
        top: list[Content] = []
        if page_name == HOME_PAGE:
            top = [tag("p", tag("a", "Play now", href=GAME_PAGE, class_="button"))]
        elif len(headings) > 3 and not page_name.startswith("learn/"):
            entries = [tag("li", tag("a", text, href=f"#{anchor}")) for anchor, text in headings]
            top = [tag("nav", tag("ul", *entries), class_="contents", aria_label="On this page")]
        body = Markup(self._reader.renderer.render(tokens, self._reader.options, {}))
        self._write(page_name, title, [*top, body, *self._neighbours(name)], figures=figures)

    def _neighbours(self, name: str) -> list[Content]:
        chapters = [path for path in self.markdown if path.startswith("docs/learn/") and not path.endswith("README.md")]
        if name not in chapters:
            return []
        at = chapters.index(name)
        near = (("Before: ", chapters[at - 1] if at else ""), ("Next: ", (*chapters[at + 1 :], "")[0]))
        links = [tag("a", word + self.markdown[page][0], href=Path(page_of(page)).name) for word, page in near if page]
        return [tag("nav", *links, class_="near", aria_label="Chapters")]

    def _index_words(self, page_name: str, title: str, tokens: list[Token]) -> None:
        """Add the words of a page to the search, each of its parts by itself."""
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
            # Not by ``tag``, which would truncate the text.
            self.searched.append(Markup(entry.replace("<li", f'<li data-words="{escape(words.casefold())}"', 1)))

    def _rewrite_links(self, name: str, tokens: list[Token]) -> bool:
        """Rewrite links, pictures and paragraphs for the site; whether a figure is among them."""
        has_pictures = False
        for at, token in enumerate(tokens):
            opened = ""
            sources = []
            for child in token.children or ():
                if child.type == "link_open":
                    link = str(child.attrs["href"])
                    child.attrs["href"] = address = self._address(link, name)
                    opened = child.tag = "a" if address else "span"
                    sources.append((link, address))
                elif child.type == "link_close":
                    child.tag = opened
                elif child.type == "image":
                    has_pictures |= self._picture(child, name)
            if token.type == "inline" and tokens[at - 1].type == "paragraph_open":
                _replace_paragraph(tokens[at - 1], token, tokens[at + 1], sources, Path(name).parent)
        return has_pictures

    def _address(self, link: str, name: str) -> str:
        """The target of a document's link in the site; "" for a file that is not in it."""
        target, _, anchor = link.partition("#")
        if "://" in link or not target:
            return link
        path = normpath(f"{Path(name).parent.as_posix()}/{target}")
        page = relpath(page_of(path), Path(page_of(name)).parent.as_posix())
        if path in self.markdown:
            return page + (anchor and f"#{anchor}")
        whole = PACKAGE.parent / path if path.startswith(PACKAGE.name) else data_folder("docs").parent / path
        if whole.suffix in (".png", ".gif", ".svg"):
            return self._copy_picture(whole, path, name)
        if not whole.exists():
            return ""
        self._sources.add(path)
        if anchor:
            anchor = f"L-{_definitions(whole.read_text('utf-8'))[anchor].lineno}"
        return page + (anchor and f"#{anchor}")

    def _copy_picture(self, whole: Path, path: str, name: str) -> str:
        """The address of a picture, which is copied into the site."""
        if not whole.is_file():
            return ""
        self.files[path] = whole.read_bytes()
        return relpath(path, Path(page_of(name)).parent.as_posix())

    def _picture(self, image: Token, name: str) -> bool:
        """Rewrite a picture for the site; whether it is a figure."""
        path = normpath(f"{Path(name).parent.as_posix()}/{image.attrs['src']}")
        whole, alt = data_folder("docs").parent / path, image.content
        up = "../" * page_of(name).count("/")
        figure = whole.stem.removeprefix(LAB) if whole.stem.startswith(LAB) else ""
        if figure in FIGURES:
            dark, light = (self._figure(figure, palette) for palette in ("dark", "classic"))
            source = tag("source", srcset=up + dark, media="(prefers-color-scheme: dark)")
            img = tag("img", src=up + light, alt=alt, width=540, height=324, loading="lazy")
            start = tag("button", "Touch to try it", type="button", hidden=True)
            meanings = figure_texts()[figure]["legend"].items()
            legend = [tag("span", tag("i", class_=role), words) for role, words in meanings]
            parts = tag("picture", source, img), tag("p", *legend, class_="legend"), start
            picture = tag("figure", *parts, class_="lab", data_figure=figure)
        elif page_of(name) == HOME_PAGE and path.endswith(".gif"):
            self.files |= _film(whole)
            source = tag("source", srcset=_STILL, media="(prefers-reduced-motion: reduce)")
            picture = tag("picture", source, tag("img", src=FILM, alt=alt, width=528, height=400))
        else:
            address = self._copy_picture(whole, path, name)
            picture = tag("img", src=address, alt=alt, loading="lazy") if address else joined(alt)
        image.type, image.content = "html_inline", picture
        return figure in FIGURES

    def _figure(self, figure: str, palette: str) -> str:
        """The name of the still picture of a figure, drawn by the code that animates it."""
        name = f"lab/{figure}-{palette}.png"
        if name not in self.files:
            self.files[name] = png_of(figure_picture(figure, scale=2.0, palette=palette))
        return name

    def _source(self, name: str) -> None:
        path = (PACKAGE.parent if name.startswith(PACKAGE.name) else data_folder("docs").parent) / name
        if path.is_dir():
            inside = sorted(file for file in path.iterdir() if file.is_dir() or file.suffix == ".py")
            names = [f"{name}/{file.name}" for file in inside if not file.name.startswith(("_", "."))]
            self._sources |= set(names)
            start = Path(page_of(name)).parent.as_posix()
            rows = [tag("li", tag("a", Path(other).name, href=relpath(page_of(other), start))) for other in names]
            self._write(page_of(name), name, [tag("ul", *rows)])
        else:
            text = path.read_text("utf-8")
            self._write(page_of(name), name, [Markup(_highlighted(text, f"/{name}"))])


def _split_title(tokens: list[Token], name: str) -> tuple[str, list[Token]]:
    """The title of a document, by default its file's name, and what follows it."""
    if tokens and tokens[0].type == "heading_open" and tokens[0].tag == "h1":
        return _plain(tokens[1]), tokens[3:]
    return Path(name).stem, tokens


def _plain(token: Token) -> str:
    """The text of a token without markup."""
    if token.type == "fence":
        return token.content
    return "".join(" " if part.type == "softbreak" else part.content for part in token.children or ())


def _add_anchors(tokens: list[Token]) -> Iterator[tuple[str, str]]:
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


def _film(path: Path) -> dict[str, bytes]:
    """Every second picture of the first page's film as WebP, and its middle picture as PNG."""
    from PIL import Image, ImageSequence

    film, still = BytesIO(), BytesIO()
    with Image.open(path) as gif:
        first, *others = [image.convert("RGB") for image in ImageSequence.Iterator(gif)][::2]
        pace = 2 * gif.info["duration"]
    first.save(film, "webp", save_all=True, append_images=others, duration=pace, loop=0, quality=30, method=4)
    others[len(others) // 2].quantize(64).save(still, "png")
    return {FILM: film.getvalue(), _STILL: still.getvalue()}


def _replace_paragraph(
    before: Token, token: Token, after: Token, links: Iterable[tuple[str, str]], folder: Path
) -> None:
    """Turn a paragraph of sources or an answer into a part that opens at a click, and one of a picture into a picture.

    ``links``: those in it, as written, relative to ``folder``, and their targets in the site.
    """
    children = token.children or []
    if len(children) == 1 and children[0].type == "html_inline":
        before.hidden = after.hidden = True
    elif token.content.startswith("Code: "):
        before.hidden = after.hidden = True
        names = ", ".join(link.partition("#")[2] for link, _ in links)
        functions = [_function(folder, link, address) for link, address in links]
        children[0].type, children[0].content = (
            "html_inline",
            tag("details", tag("summary", "Show me the code: ", names), *functions),
        )
        del children[1:]
    elif token.content.startswith("**Answer.**"):
        before.type = after.type = "html_block"
        before.content, after.content = "<details><summary>Answer</summary><p>", "</p></details>"
        del children[: next(place for place, item in enumerate(children) if item.type == "strong_close") + 1]


def _function(folder: Path, link: str, address: str) -> Markup:
    """The source of a function, and its place in the file."""
    path, _, name = link.partition("#")
    source = normpath((folder / path).as_posix())
    text = (PACKAGE.parent / source).read_text("utf-8")
    node = _definitions(text)[name]
    lines = text.splitlines()[node.lineno - 1 : node.end_lineno]
    first = tag("p", tag("a", f"{source}, line {node.lineno}", href=address), class_="faint")
    return joined(Markup(_highlighted("\n".join(lines), "python")), first)


def _highlighted(text: str, lang: str, about: str = "") -> str:
    """A piece of code as HTML, Python in colours; each line has an anchor if ``lang`` is a path.

    ``about``: the rest of a fence's first line; "try" adds an element that figures.js makes a runnable program.
    """
    python = lang.split(" ", maxsplit=1)[0].endswith(("python", "py"))
    lexer = PythonConsoleLexer if text.startswith(">>>") else PythonLexer if python else TextLexer
    shape = HtmlFormatter(cssclass="code", lineanchors="L" if "/" in lang else "")
    markup = str(highlight(text, lexer(stripnl=lexer is PythonConsoleLexer), shape)).rstrip()
    markup = re.sub(r'<a (id="L-\d+")[^>]*></a>', r"<span \1></span>", markup)
    buttons = [tag("button", words, type="button", hidden=True) for words in ("Run", "Edit")]
    after = tag("p", *buttons, class_="try") if about == "try" else ""
    markup = markup.removesuffix("</div>").replace('<div class="code"><pre>', '<pre class="code" tabindex="0">', 1)
    return markup + after


def _definitions(text: str) -> Mapping[str, ast.FunctionDef | ast.ClassDef]:
    """The functions and classes of a file; methods too, by their names."""
    definitions: dict[str, ast.FunctionDef | ast.ClassDef] = {}
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            definitions.setdefault(node.name, node)
    return definitions
