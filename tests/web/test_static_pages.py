"""Gallery and board in Chromium: no text runs, everything can be read without scripts, by keyboard and on a phone."""

import json
import re
import shutil
import subprocess
import tarfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from hashlib import sha256
from itertools import chain, pairwise
from pathlib import Path
from re import fullmatch
from typing import Any

import pytest

from ninja_game.board.judge import judge
from ninja_game.board.ranking import Ranking
from ninja_game.files.writing import write_atomically
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.levels.published import published_levels
from ninja_game.web.board.pages import BoardPages
from ninja_game.web.pages.documents import Documents
from ninja_game.web.pages.gallery import SORT_ORDERS, write_gallery
from tests.support.forgeries import WALKING, replay
from tests.support.own_pack import PACK
from tests.support.samples import WALK
from tests.support.visitor import LOADING, eventually
from tests.support.web_page import CACHE, served
from tests.web.conftest import made_by_one

HOSTILE = (
    "<script>document.title='owned'</script>", "<img src=x onerror=\"document.title='owned'\">",
    "\"><svg onload=document.title='owned'>", "javascript:document.title='owned'", "'-alert(1)-'", "{{7*7}}${7*7}",
    "</title><script>document.title='owned'</script>", "\u202egnp.exe", "\x00\x1b[2J", "W" * 300, "&lt;b&gt;",
)  # fmt: skip
PUBLIC = "https://example.org/game/"  # where the site says that it will be
PHONE, NARROWEST = {"width": 390, "height": 844}, {"width": 320, "height": 640}


def board_of_hostile_names(folder: Path) -> Path:
    """A board on which every name of a level, player, run, file and episode is one of HOSTILE."""
    levels, runs = folder / "levels", folder / "runs"
    levels.mkdir()
    runs.mkdir()
    index = [f"name = {json.dumps(HOSTILE[0])}", f"comment = {json.dumps(HOSTILE[1])}"]
    for number, name in enumerate(HOSTILE):
        level = WALK.replace("0^115,566", f"0^{115 + number},566")
        text = write_ascii_level(parse_level_string(level), name=name, author=name, comment=name)
        (levels / f"{number:02d}-0-level.txt").write_text(text, "utf-8")
        index.append(f"[[episode]]\nnumber = {number}\nname = {json.dumps(name)}")
        (runs / f"{number}.txt").write_text(replay(WALKING + b"\2", level, author=name, name=name), "utf-8")
        (runs / f"{number}-b.txt").write_text(replay(bytes(3) + WALKING + b"\2", level, author="Ann"), "utf-8")
        bad = name.replace("/", "").replace("\0", "")[:60]
        (runs / f"{bad}.txt").write_text(f"{name}\n{name}", "utf-8")
    (levels / "pack.toml").write_text("\n".join(index), "utf-8")
    shown = published_levels(levels)
    ranking = Ranking(judge(runs, shown, jobs=1), shown)
    assert len(ranking.judged.runs) == 2 * len(HOSTILE)
    BoardPages(folder / "site", ranking, address=PUBLIC).write()
    return folder / "site"


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the hostile board and a gallery of a few levels."""
    return made_by_one(tmp_path_factory, "pages", write_site) / "site"


def write_site(base: Path) -> None:
    base.mkdir()
    folder = board_of_hostile_names(base)
    write_gallery(folder, published_levels(PACK), address=PUBLIC)
    # Nobody touches a figure here.
    for name, content in (Documents(PUBLIC).build() | {"app-folder/figures.js": b""}).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    (folder / "play.html").write_text("<!doctype html><title>the game</title>", "utf-8")


@pytest.fixture(scope="module")
def address(site: Path) -> Iterator[str]:
    with served(site) as where:
        yield where


@pytest.fixture
def open_page(chromium: Any, address: str) -> Iterator[Callable[..., Any]]:
    """Opens a page of the site in a fresh profile; what goes wrong in it fails the test."""
    problems: list[str] = []

    with ExitStack() as stack:

        def open_page(name: str, **about: Any) -> Any:
            context = chromium.new_context(**about)
            stack.callback(context.close)
            context.set_default_timeout(LOADING)
            page = context.new_page()
            page.on("console", lambda message: problems.append(message.text))
            page.on("pageerror", lambda error: problems.append(str(error)))
            page.on("dialog", lambda dialog: problems.append(dialog.message))
            page.goto(address + name)
            return page

        yield open_page
    assert problems == []


def all_pages(site: Path) -> list[str]:
    """The board's pages, and those of its runs."""
    found = [*site.glob("board/**/*.html"), *site.glob("replays/*.html")]
    names = [path.relative_to(site).as_posix() for path in sorted(found)]
    return [name for name in names if "board/style.css" in (site / name).read_text("utf-8") or name.startswith("board")]


def test_a_chat_shows_every_level_and_run_with_its_own_title_words_and_picture(site: Path) -> None:
    pages = [path for name in ("gallery/levels", "board/levels", "replays") for path in site.glob(f"{name}/*.html")]
    pages = [path for path in pages if not path.stem.endswith("-runs")]
    levels, runs = len(published_levels(PACK).entries), len([*site.glob("replays/*.txt")])
    assert len(pages) == levels + len(HOSTILE) + runs > 30
    shown = set()
    for path in [*pages, site / "index.html"]:
        about = dict(re.findall(r'<meta (?:property|name)="([a-z:]+)" content="([^"]*)">', path.read_text("utf-8")))
        assert about["twitter:card"] == "summary_large_image"
        assert about["og:image"].startswith(PUBLIC)
        assert (site / about["og:image"].removeprefix(PUBLIC)).read_bytes().startswith(b"\x89PNG")
        shown.add((about["og:title"], about["og:description"], about["og:image"]))
    assert len(shown) == len(pages) + 1
    assert sum("Time: " in words for _, words, _ in shown) == runs


def test_a_runs_page_leads_to_the_game_the_level_and_the_file(site: Path, open_page: Callable[..., Any]) -> None:
    page = open_page("gallery/index.html", viewport=PHONE)
    page.get_by_role("link", name="Run and Hop").click()
    page.get_by_role("link", name="To the exit").click()
    page.get_by_role("heading", name="Run and Hop to the exit").wait_for()
    stem = Path(page.url).stem
    for name, leads in (("Watch this run", f"../play.html#watch={stem}"), ("The replay as a file", f"{stem}.txt")):
        assert page.get_by_role("link", name=name).get_attribute("href") == leads
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert (site / "replays" / f"{stem}.txt").is_file()
    page.get_by_role("link", name="The level", exact=True).click()
    page.get_by_role("heading", name="Run and Hop").wait_for()


@pytest.mark.slow
def test_no_script_of_a_name_runs(site: Path, address: str, open_page: Callable[..., Any]) -> None:
    page = open_page("board/index.html")
    names = all_pages(site)
    # All players have a page of records, but the one whose record was beaten in its own moment: it has one of gains.
    assert len(names) == 5 + 4 * len(HOSTILE) + 2 * (len(HOSTILE) + 1)
    for name in names:
        page.goto(address + name)
        assert "owned" not in page.title().replace("document.title='owned'", "")
        assert page.evaluate("document.scripts.length") == 1
        foreign = "main img:not([alt]), main svg:not([role=img], [aria-hidden]), iframe, object"
        assert page.evaluate(f"document.querySelectorAll('{foreign}').length") == 0
        for link in page.evaluate("Array.from(document.links, (link) => link.protocol)"):
            assert link == "http:"


@pytest.mark.slow
def test_the_policy_lets_nothing_else_run(open_page: Callable[..., Any], chromium: Any, address: str) -> None:
    context = chromium.new_context()
    page = context.new_page()
    refused: list[str] = []
    page.on("console", lambda message: refused.append(message.text))
    page.goto(address + "board/index.html")
    add = "(tag) => document.body.append(Object.assign(document.createElement(tag[0]), tag[1]))"
    page.evaluate(add, ["script", {"textContent": "document.title = 'owned'"}])
    page.evaluate(add, ["style", {"textContent": "main { display: none }"}])
    page.evaluate(add, ["iframe", {"src": "/index.html"}])
    page.evaluate("fetch('/index.html').catch(() => console.log('fetch was refused'))")
    eventually(page, lambda: sum("Content Security Policy" in text for text in refused) >= 4, "not all is refused")
    eventually(page, lambda: "fetch was refused" in refused, "the fetch is not refused")
    assert page.title() == "Board: <script>document.title='owned'</script> - ninja-game", "no script has set it"
    assert page.locator("main").is_visible()
    context.close()


@pytest.mark.parametrize("size", [PHONE, NARROWEST, {"width": 1280, "height": 900}], ids=["phone", "narrow", "desk"])
def test_no_page_is_wider_than_the_window(
    site: Path, address: str, size: dict[str, int], open_page: Callable[..., Any]
) -> None:
    page = open_page("gallery/index.html", viewport=size)
    level = next(site.glob("gallery/levels/*.html")).name
    found = [path for folder in ("learn", "docs") for path in sorted(site.rglob(f"{folder}/*.html"))]
    # What is too wide is so in the narrowest window first: in others a sample is looked at.
    documents = [path.relative_to(site).as_posix() for path in found[:: 1 if size is NARROWEST else 10]]
    for name in ("gallery/index.html", f"gallery/levels/{level}", *all_pages(site)[:10], "index.html", *documents):
        page.goto(address + name)
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), name


@pytest.mark.slow
def test_gallery_is_searched_and_sorted_by_keyboard(open_page: Callable[..., Any]) -> None:
    page = open_page("gallery/index.html", viewport=PHONE)
    levels = page.locator(".card:visible")
    count = levels.count()
    assert count == len(published_levels(PACK).entries)
    page.keyboard.press("Tab")
    assert page.locator(":focus").inner_text() == "To the content"
    page.keyboard.press("Enter")
    page.locator("#content:focus").wait_for()
    page.keyboard.press("Tab")
    page.keyboard.type("RUN  and hop")
    assert levels.count() == 1
    assert page.get_by_role("status").inner_text() == f"1 of {count} shown"
    for _ in range(20):
        page.keyboard.press("Backspace")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    for _ in range([by for by, _ in SORT_ORDERS].index("difficulty")):
        page.keyboard.press("ArrowDown")
    hard = page.evaluate(
        "Array.from(document.querySelectorAll('.card'), (each) => Number(each.dataset.difficulty ?? 99))"
    )
    assert hard == sorted(hard)
    assert len(set(hard)) > count / 2
    shown = page.evaluate("Array.from(document.querySelectorAll('.card'), (each) => each.innerText)")
    assert all(f"difficulty {value:.1f}" in text for value, text in zip(hard, shown, strict=True) if value < 99)
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    page.wait_for_url("**/levels/*.html")
    assert page.get_by_role("link", name="Play this level").get_attribute("href").startswith("../../play.html#level=1.")


def test_everything_is_read_without_a_script(open_page: Callable[..., Any]) -> None:
    page = open_page("gallery/index.html", java_script_enabled=False)
    assert page.locator(".card:visible").count() == len(published_levels(PACK).entries)
    assert page.locator("form.search").is_hidden()
    page.locator(".card a").first.click()
    page.get_by_role("heading", name="Par times").wait_for()
    board = open_page("board/index.html", java_script_enabled=False)
    assert board.get_by_role("table").count() == 3
    assert board.locator(".card:visible").count() > 0


@contextmanager
def _named(what: str) -> Iterator[None]:
    try:
        yield
    except AssertionError as error:
        raise AssertionError(f"{what}: {error}") from None


def test_everything_has_a_name_and_headings_go_down_by_one(site: Path, open_page: Callable[..., Any]) -> None:
    page = open_page("gallery/index.html")
    level = next(site.glob("gallery/levels/*.html")).name
    for name in ("gallery/index.html", f"gallery/levels/{level}", "board/index.html", "board/episodes.html"):
        page.goto(page.url.split("/gallery/")[0].split("/board/")[0] + "/" + name)
        with _named(name):
            assert page.evaluate("document.documentElement.lang") == "en"
            sizes = page.evaluate("Array.from(document.querySelectorAll('h1, h2, h3'), (h) => Number(h.localName[1]))")
            assert sizes.count(1) == 1
            assert all(lower - upper <= 1 for upper, lower in pairwise(sizes))
            assert page.evaluate(
                "Array.from(document.images).every((image) => image.alt && image.naturalWidth || image.loading)"
            )
            fields = (
                "Array.from(document.querySelectorAll('input, select')).every((field) => field.labels.length === 1)"
            )
            assert page.evaluate(fields)
            assert page.evaluate("Array.from(document.links).every((link) => link.textContent.trim() !== '')")
            assert page.evaluate(
                "Array.from(document.querySelectorAll('table')).every((table) => table.caption !== null)"
            )
            assert page.evaluate("Array.from(document.querySelectorAll('th')).every((head) => head.textContent)")


CONTRAST = """
() => {
  const numbers = (text) => text.match(/[\\d.]+/g).map(Number);
  const part = (value) => (value / 255 <= 0.04045 ? value / 255 / 12.92 : ((value / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = ([r, g, b]) => 0.2126 * part(r) + 0.7152 * part(g) + 0.0722 * part(b);
  const ground = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const colour = numbers(getComputedStyle(at).backgroundColor);
      if (colour.length < 4 || colour[3] > 0) return colour;
    }
  };
  const found = [];
  for (const element of document.querySelectorAll("body *")) {
    const own = Array.from(element.childNodes).some((node) => node.nodeType === 3 && node.textContent.trim());
    if (!own || element.closest(".hidden, .skip, svg, option") || !element.checkVisibility()) continue;
    const both = [numbers(getComputedStyle(element).color), ground(element)].map(luminance).sort((a, b) => b - a);
    found.push([(both[0] + 0.05) / (both[1] + 0.05), `${element.localName}.${element.className}`]);
  }
  return found.sort((a, b) => a[0] - b[0])[0];
}
"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_letter_stands_out(site: Path, scheme: str, open_page: Callable[..., Any]) -> None:
    page = open_page("gallery/index.html", color_scheme=scheme)
    level = next(site.glob("gallery/levels/*.html")).name
    for name in ("gallery/index.html", f"gallery/levels/{level}", "board/index.html", "board/players.html"):
        page.goto(page.url.split("/gallery/")[0].split("/board/")[0] + "/" + name)
        ratio, where = page.evaluate(CONTRAST)
        assert ratio >= 4.5, (name, where)


AXE, AXE_DIGEST = "axe-core@4.14.1", "29348999450cdf2849a8e70b7912fc2da85a849da39c0d0d5394f51d4a9ed95c"
"""The npm package of rules about access, and the sha256 of its script."""


@pytest.fixture(scope="module")
def axe(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The script of axe-core; skips where npm cannot get it."""
    kept = CACHE / f"{AXE}.js"
    if not kept.exists():
        npm, scratch = shutil.which("npm"), tmp_path_factory.mktemp("axe")
        if npm is None:
            pytest.skip("npm is not here")
        words = [npm, "pack", AXE, "--silent", "--pack-destination", str(scratch)]
        if subprocess.run(words, check=False, capture_output=True, timeout=120, cwd=scratch).returncode:
            pytest.skip(f"npm cannot get {AXE}")
        with tarfile.open(next(scratch.glob("*.tgz"))) as package:
            script = package.extractfile("package/axe.min.js")
            assert script is not None
            write_atomically(kept, script.read())
    data = kept.read_bytes()
    assert sha256(data).hexdigest() == AXE_DIGEST
    return data.decode("utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_has_no_serious_finding(site: Path, scheme: str, axe: str, open_page: Callable[..., Any]) -> None:
    page = open_page("board/index.html", bypass_csp=True, color_scheme=scheme, viewport=PHONE)
    address = page.url.split("/board/")[0]
    kinds = ("board/levels/[^-]*", "board/levels/.*-runs.*", "board/players/[^-]*", "board/players/.*-records.*")
    found = [[name for name in all_pages(site) if fullmatch(kind, name)][:3] for kind in kinds]
    assert all(found)
    names = list(chain(*found))
    names += ["gallery/index.html", *(f"gallery/levels/{path.name}" for path in [*site.glob("gallery/levels/*")][:2])]
    names += ["index.html", "search.html", "docs/learning.html", "code/ninja_game/sim/grid.html"]
    names += [f"learn/{path.name}" for path in sorted(site.glob("learn/*.html"))]
    names += ["board/index.html", *(f"board/{each}.html" for each in ("players", "levels", "episodes", "rejected"))]
    for name in names:
        page.goto(f"{address}/{name}")
        page.evaluate(axe)
        found = page.evaluate("axe.run().then((run) => run.violations.map((each) => [each.impact, each.id]))")
        assert not [each for each in found if each[0] in ("serious", "critical")], name
