"""The site as it is built, Chromium and Node: for tests and measurements of what runs in a page."""

import shutil
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ninja_game.files.user_folder import cache_folder
from ninja_game.web.site.build import build_site, site_server
from ninja_game.web.site.game_archive import PYODIDE_VERSION

ROOT = Path(__file__).resolve().parent.parent.parent
BUSY = ROOT / "benchmarks" / "busy.py"
DIGESTS, SCENES = (ROOT / "tests" / "support" / f"page_{name}.py" for name in ("digests", "scenes"))
"""Files that Python runs here and in a page alike."""

CACHE = cache_folder()
PYODIDE = CACHE / f"pyodide-{PYODIDE_VERSION}"  # where Pyodide's files are once a site was built

SIZE = (1584, 1200)

EMPTY_PAGE = "licences/NOTICE.txt"
"""A file of the site without scripts of its own and without rules about those of others."""

START = """
async ([width, height]) => {
  document.body.innerHTML = "<canvas></canvas>";
  document.head.append(Object.assign(document.createElement("base"), { href: "/" }));
  document.body.style.margin = 0;
  const canvas = document.querySelector("canvas");
  Object.assign(canvas.style, { width: `${width}px`, height: `${height}px`, display: "block" });
  const [folder] = (await (await fetch("/play.html")).text()).match(/app-[0-9a-f]{16}/);
  const { build } = await import(`/${folder}/build.js`);
  const { loadPyodide } = await import(`/${folder}/pyodide/pyodide.mjs`);
  const { createHost } = await import(`/${folder}/host.js`);
  const indexURL = new URL(`/${folder}/pyodide/`, location.href).href;
  const python = await loadPyodide({ indexURL, lockFileContents: { info: build.pyodide, packages: {} } });
  const archive = await (await fetch(`/${folder}/game.tar.gz`)).arrayBuffer();
  python.unpackArchive(archive, "gztar", { extractDir: "/game" });
  python.runPython("import sys; sys.path[:0] = ['/game/ninja_game/web/shim', '/game']");
  const host = createHost(canvas);
  host.attach(python);
  Object.assign(window, { python, host, canvas, app: `/${folder}/` });
}
"""


def run_in(page: Any, *sources: Path) -> None:
    """Run files in a page's Python, one after the other, as one program."""
    text = "\n".join(source.read_text("utf-8") for source in sources)
    page.evaluate("text => { python.runPython(text); }", text.replace("from __future__ import annotations", ""))


def missing() -> str:
    """What keeps a page from being tried here, in words; "" if nothing does."""
    try:
        import playwright  # noqa: F401
    except ImportError:
        return "playwright is not installed"
    if chromium_path() is None:
        return "Chromium is not installed"
    return ""


def chromium_path() -> str | None:
    """The system's Chromium."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


def built_site(folder: Path) -> Path:
    """The site, built in a folder. Raises NinjaGameError where Pyodide cannot be had."""
    build_site(folder, None, CACHE)
    return folder


@contextmanager
def served(folder: Path) -> Iterator[str]:
    """The address of a folder on this machine."""
    server = site_server(folder, 0)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_address[1]}/"
    finally:
        server.shutdown()
        server.server_close()


@contextmanager
def browser() -> Iterator[Any]:
    """Chromium without a window."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=chromium_path(), args=["--no-sandbox"])
        try:
            yield chromium
        finally:
            chromium.close()


@contextmanager
def python_page(chromium: Any, address: str, size: tuple[int, int] = SIZE) -> Iterator[Any]:
    """An empty page with the site's Python, the game importable, and a host: `python`, `host`, `canvas`, `app`."""
    page = chromium.new_page(viewport={"width": size[0], "height": size[1]})
    try:
        page.goto(address + EMPTY_PAGE)
        page.evaluate(START, list(size))
        yield page
    finally:
        page.close()
