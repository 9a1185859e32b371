"""The documents as pages: all of them, every link between pages, rules and sources, and what becomes of a paragraph."""

import re
from html.parser import HTMLParser
from pathlib import Path
from posixpath import normpath
from urllib.parse import unquote

import pytest
from markdown_it import MarkdownIt

from ninja_game.play.lab.screen import FIGURES
from ninja_game.web.pages.documents import LAB, Documents, _add_anchors, markdown_files, page_of
from ninja_game.web.pages.frame import GAME_PAGE
from tests.test_docs import anchors

ROOT = Path(__file__).resolve().parents[2]
ELSEWHERE = (GAME_PAGE, "gallery/index.html", "app-folder/figures.js")
"""What other parts of the build put beside the documents."""


class Tags(HTMLParser):
    """Reads a page. ``ids``: the anchors of a page; ``links``: all that it leads to or shows."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:  # noqa: ARG002 - its interface
        values = dict(attrs)
        self.ids |= {values["id"] or ""} if "id" in values else set()
        self.links += [value for name, value in attrs if value and name in {"href", "src", "srcset"}]


@pytest.fixture(scope="module")
def files() -> dict[str, bytes]:
    return Documents().build()


@pytest.fixture(scope="module")
def pages(files: dict[str, bytes]) -> dict[str, Tags]:
    return {name: Tags(content.decode()) for name, content in files.items() if name.endswith(".html")}


def test_every_document_is_a_page_with_all_its_headings(pages: dict[str, Tags]) -> None:
    ours = {
        path.relative_to(ROOT).as_posix()
        for path in ROOT.rglob("*.md")
        if not path.relative_to(ROOT).parts[0].startswith((".", "build", "dist"))
    }
    assert set(markdown_files()) == ours
    assert len({page_of(name) for name in ours}) == len(ours) > 50
    for name in ours:
        # The title is the heading of the frame.
        assert len(anchors(ROOT / name) - pages[page_of(name)].ids) <= 1, name


def test_every_link_leads_to_a_page_and_an_anchor_of_it(files: dict[str, bytes], pages: dict[str, Tags]) -> None:
    dead, outside = [], set()
    for name, page in pages.items():
        for link in page.links:
            target, _, anchor = link.partition("#")
            if "://" in link:
                outside.add(target)
                continue
            target = normpath((Path(name).parent / target).as_posix()) if target else name
            if (target not in files and target not in ELSEWHERE) or (
                anchor and target in pages and unquote(anchor) not in pages[target].ids
            ):
                dead.append(f"{name}: {link}")
    assert not dead
    assert all(link.startswith("https://") for link in outside)
    assert len(outside) < 10


def test_no_link_of_a_document_became_plain_text(files: dict[str, bytes]) -> None:
    """In a checkout all is there; a wheel holds less."""
    for name in markdown_files():
        text = re.sub(r"^```.*?^```", "", (ROOT / name).read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)
        written = set(re.findall(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "x", text)))
        shown = set(re.findall(r'href="([^"]+)"', files[page_of(name)].decode().split("<main", 1)[1]))
        assert len(shown) >= len(written) - 1, name


def test_pages_without_figures_run_and_fetch_nothing_of_their_own(files: dict[str, bytes]) -> None:
    for name, content in files.items():
        if name.endswith(".html"):
            text = content.decode()
            scripts = re.findall(r"<script[^>]*>", text)
            assert ("data-figure=" in text) == ("app-folder/figures.js" in text), name
            assert ("data-figure=" in text) == ("'wasm-unsafe-eval'" in text.split("<title>")[0].replace("&#x27;", "'"))
            assert all("src=" in script for script in scripts), name
            assert "style=" not in re.sub(r"<pre.*?</pre>", "", text, flags=re.DOTALL), name


def test_a_chapter_shows_its_figure_its_answer_and_the_very_source(files: dict[str, bytes]) -> None:
    page = files["learn/01-grid-and-cells.html"].decode()
    assert '<figure class="lab" data-figure="grid">' in page
    assert "<details><summary>Answer</summary>" in page
    assert "Show me the code: cell_at, cell_index" in page
    source = (ROOT / "ninja_game" / "sim" / "grid.py").read_text("utf-8")
    line = source.splitlines().index("def cell_at(x: float, y: float) -> int:") + 1
    assert f'href="../code/ninja_game/sim/grid.html#L-{line}"' in page
    plain = re.sub(r"<[^>]+>", "", page).replace("&lt;", "<")
    assert "return int(y / CELL) * STRIDE + int(x / CELL) + (STRIDE + 1)" in plain


def test_an_example_with_its_results_looks_like_a_session_of_python(files: dict[str, bytes]) -> None:
    page = files["docs/verification.html"].decode()
    assert '<span class="gp">&gt;&gt;&gt; </span>' in page
    assert '<span class="go">(0, 0, True)</span>\n</pre>' in page
    assert "<blockquote>" not in page


def test_every_figure_of_a_document_is_one_of_the_lab_and_has_a_still_picture(files: dict[str, bytes]) -> None:
    shown = {name for content in files.values() for name in re.findall(rb'data-figure="([\w-]+)"', content)}
    assert {name.decode() for name in shown} <= set(FIGURES)
    for name in shown:
        for palette in ("classic", "dark"):
            assert files[f"lab/{name.decode()}-{palette}.png"].startswith(b"\x89PNG")
    live = {path.stem.removeprefix(LAB) for path in (ROOT / "docs" / "pictures").glob(f"{LAB}*")}
    assert {name.decode() for name in shown} == live & set(FIGURES)
    assert not [name for name, content in files.items() if re.search(rb"<p>\s*<picture", content)]


def test_search_finds_parts_of_pages_by_their_words(files: dict[str, bytes]) -> None:
    text = files["search.html"].decode()
    assert 'href="docs/rules/world.html#3-edge-states"' in text
    words = re.search(r'<li data-words="([^"]*)"[^>]*><a href="docs/rules/world.html#3-edge-states"', text)
    assert words
    assert "interesting" in words[1]


def test_the_contents_of_a_page_are_its_headings_of_the_second_rank() -> None:
    tokens = MarkdownIt().parse("# A page\n\n## One\n\n### Deeper\n\n## One\n")
    assert [*_add_anchors(tokens)] == [("one", "One"), ("one-1", "One")]
