"""Builds and serves the folder of the site: the page, Pyodide, the game as one archive, icons, licences."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path, PurePath
from typing import Any

from ninja_game import __version__
from ninja_game.errors import DAMAGED, FileError, NinjaGameError
from ninja_game.files.bundled import data_folder
from ninja_game.files.reading import digest_of, read_utf8
from ninja_game.files.tree import Tree, leads_below
from ninja_game.levels.published import published_levels
from ninja_game.runtime import PACKAGE
from ninja_game.web.pages.documents import Documents
from ninja_game.web.pages.frame import GAME_PAGE, MARK as PAGES_MARK, REPLAYS
from ninja_game.web.pages.gallery import page_name, picture_name
from ninja_game.web.site import game_archive as archive

SITE_MARK = "ninja-game-site.json"  # marks a folder that the build wrote, with the names of the files in it

ICONS = {"icons/64.png": (64, 1 / 6), "icons/192.png": (192, 1 / 6), "icons/512.png": (512, 1 / 6)}
MASKABLE = "icons/maskable-512.png"  # an icon that systems crop to their own shape: its corners are empty

_LARGE = ("pyodide/pyodide.asm.wasm", "pyodide/python_stdlib.zip", "game.tar.gz")
"""Files that the page fetches with progress and caches itself; the service worker caches the rest."""

TEMPLATES = (GAME_PAGE, "sw.js")  # files of the page that name the version; they lie above the versioned folder

_FOLDER = "app-folder"  # the name of the version's folder in templates and documents

_PAGES_FILES = ("style.css", "search.js", "icon.png")
PAGES = (
    "index.html",
    *(f"{folder}/{name}" for folder in ("docs", "gallery") for name in _PAGES_FILES),
    "gallery/index.html",
)
"""Pages cached for visits without a network, beside the game, *Learn* and the gallery; others once they are visited."""


def build_site(out: Path, pyodide: Path | None, cache: Path, address: str = "") -> dict[str, bytes]:
    """Write the site into the folder ``out``, new, empty, or an earlier site; its files by name.

    ``pyodide``: a folder with the files of its npm package; None fetches it by npm into the folder ``cache``.
    ``address``: of the site, if it is known: previews of links name their pictures by it. Raises FileError for a folder
    with other files, NinjaGameError if Pyodide is not available; OSError.
    """
    before = _own_files(out)
    python = archive.pyodide_files(pyodide, cache)
    about = json.loads(python["pyodide-lock.json"])["info"]
    library, game = archive.bytecode_files(
        archive.library_files(python["python_stdlib.zip"]), dict(archive.game_files()), python
    )
    python["python_stdlib.zip"] = archive.library_zip(library)
    app = {f"pyodide/{name}": content for name, content in python.items() if not name.endswith(".json")}
    app |= {"game.tar.gz": archive.game_tar(game)} | _page()
    files = _stamped(app, _icons(), about, Documents(address).build(), address) | _licences() | _music()
    site = Tree(out)
    for name, content in files.items():
        site.write(name, content)
    site.write(SITE_MARK, json.dumps({"version": __version__, "files": sorted(files)}, indent=1) + "\n")
    gone = before - set(files)
    for name in gone:
        site.remove(name)
    for folder in sorted({folder for name in gone for folder in PurePath(name).parents}, reverse=True):
        with suppress(OSError):
            (out / folder).rmdir()  # of an earlier version, if nothing else is in it
    return files


def _own_files(out: Path) -> set[str]:
    """The files of an earlier build. Raises FileError for a folder that is not ours."""
    if not out.exists() or (out.is_dir() and all(map(_is_of_pages, out.iterdir()))):
        return set()
    hint = "name a new folder, or remove that one yourself"
    try:
        names = json.loads(read_utf8(out / SITE_MARK))["files"]
    except (OSError, *DAMAGED):
        raise FileError(
            "this is not a site of ninja-game", str(out), expected="a new or empty folder", hint=hint
        ) from None
    return {name for name in names if isinstance(name, str) and leads_below(name)}


def _is_of_pages(path: Path) -> bool:
    """Whether a file belongs to a board or a gallery, or the replays beside one."""
    return (path / PAGES_MARK).is_file() or (path.name == REPLAYS and any(path.parent.glob(f"*/{PAGES_MARK}")))


def _page() -> dict[str, bytes]:
    folder = PACKAGE / "web" / "page"
    return {
        path.name: path.read_bytes() for path in sorted(folder.iterdir()) if path.suffix in {".html", ".css", ".js"}
    }


def _icons() -> dict[str, bytes]:
    from ninja_game.ui.canvas import png_of
    from ninja_game.view.ninja.figure import icon

    sizes = ICONS | {MASKABLE: (512, 0.0)}
    return {name: png_of(icon(size, corner=corner)) for name, (size, corner) in sizes.items()}


def _licences() -> dict[str, bytes]:
    own = {path.name: path.read_bytes() for path in (PACKAGE / "web" / "licences").glob("*.txt")}
    packages = {f"{name}.txt": archive.licence_of(name).encode() for name in ("ninja-game", "tomlkit")}
    return {f"licences/{name}": content for name, content in (own | packages).items()}


def _music() -> dict[str, bytes]:
    """The layers of the music, which the page fetches before they are played."""
    folder = data_folder("assets") / "sounds" / "music"
    return {f"music/{path.name}": path.read_bytes() for path in sorted(folder.glob("*.ogg"))}


def _stamped(
    app: dict[str, bytes], icons: dict[str, bytes], about: dict[str, str], documents: dict[str, bytes], address: str
) -> dict[str, bytes]:
    """The page's files: ``app`` in a folder with a digest in its name, so that two versions never mix.

    Above it icons, the manifest, and the files that name the version. ``about``: Pyodide's.
    """
    above = icons | {"manifest.webmanifest": json.dumps(_manifest(), indent=1).encode()}
    parts = [f"{name} {len(content)}\n".encode() + content for name, content in sorted((app | above).items())]
    stamp = digest_of(b"".join(parts))[:16]
    folder = f"app-{stamp}"
    build = {"version": __version__, "id": stamp, "pyodide": about, "sizes": {name: len(app[name]) for name in _LARGE}}
    templates = {name: app.pop(name) for name in TEMPLATES} | documents
    app["build.js"] = f"export const build = {json.dumps(build)};\n".encode()
    files = {f"{folder}/{name}": content for name, content in app.items()} | above
    small = sorted(name for name in files if not name.endswith(_LARGE))
    # Without pyodide.asm.mjs: if that is loaded first, Chromium's start hangs.
    modules = [name for name in files if name.endswith((".js", "/pyodide.mjs")) and "figures" not in name]
    taught = sorted(name for name in documents if name.startswith(("learn/", "lab/")))
    large = sorted({*files} - {*small})
    levels = published_levels(data_folder("levels")).entries
    gallery = [f"gallery/{name(digest)}" for digest in levels for name in (page_name, picture_name)]
    cached = {"id": stamp, "small": [GAME_PAGE, *small], "pages": [*PAGES, *taught, *gallery], "large": large}
    stamps = {
        _FOLDER: folder,
        "{{kept}}": json.dumps(cached),
        "{{address}}": address,
        "{{preloads}}": "\n".join(f'<link rel="modulepreload" href="{name}">' for name in modules),
    }
    for key, text in stamps.items():
        templates |= {name: content.replace(key.encode(), text.encode()) for name, content in templates.items()}
    return files | templates


def _manifest() -> dict[str, object]:
    icons = [
        {"src": name, "sizes": f"{size}x{size}", "type": "image/png", "purpose": "any"}
        for name, (size, _) in ICONS.items()
    ]
    return {
        "name": "ninja-game",
        "short_name": "ninja-game",
        "description": "A platform game in the style of N: run, jump, collect gold, reach the exit.",
        "start_url": GAME_PAGE,
        "scope": "./",
        "display": "standalone",
        "orientation": "any",
        "background_color": "#cacad0",
        "theme_color": "#cacad0",
        "categories": ["games"],
        "icons": [*icons, {"src": MASKABLE, "sizes": "512x512", "type": "image/png", "purpose": "maskable"}],
    }


_TYPES = {
    ".wasm": "application/wasm",
    ".mjs": "text/javascript",
    ".js": "text/javascript",
    ".webmanifest": "application/manifest+json",
    ".gz": "application/gzip",
    ".ogg": "audio/ogg",
}
"""Types that browsers demand, whatever this system's table says."""


class _Handler(SimpleHTTPRequestHandler):
    """Serves files, no lists of folders; a browser asks each time whether it has the newest."""

    protocol_version = "HTTP/1.1"
    extensions_map = SimpleHTTPRequestHandler.extensions_map | _TYPES

    def end_headers(self) -> None:
        """Add the headers of all answers."""
        self.send_header("Cache-Control", "no-cache")
        self.send_header("X-Content-Type-Options", "nosniff")
        super().end_headers()

    def send_head(self) -> Any:
        """The requested file; 404 for one behind a link out of the folder, and for an impossible name."""
        with suppress(ValueError, OSError):
            if Path(self.translate_path(self.path)).resolve().is_relative_to(Path(self.directory).resolve()):
                return super().send_head()
        self.send_error(404)
        return None

    def list_directory(self, path: Any) -> None:  # noqa: ARG002 - the base class names it
        """Answer 404: no lists of folders."""
        self.send_error(404)

    def log_message(self, *_: Any) -> None:
        """Log nothing."""


def site_server(folder: Path, port: int) -> ThreadingHTTPServer:
    """A server of a folder, for this machine only; ``port`` 0 takes a free one. Raises NinjaGameError."""
    handler: Callable[..., _Handler] = partial(_Handler, directory=str(folder))
    try:
        return ThreadingHTTPServer(("127.0.0.1", port), handler)
    except OSError as error:
        raise NinjaGameError(f"port {port} cannot be used: {error.strerror}; choose another with --port") from None
