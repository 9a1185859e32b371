"""The folder of the page: what is in it, that it is the same each time, and that nothing else is ever overwritten."""

import gzip
import io
import json
import re
import subprocess
import sys
import tarfile
import threading
import urllib.error
import urllib.request
from contextlib import nullcontext
from functools import cache
from http.server import ThreadingHTTPServer
from pathlib import Path
from unittest.mock import Mock
from zipfile import ZipFile

import pytest
from click.testing import CliRunner

from ninja_game.cli.main import cli
from ninja_game.errors import FileError, NinjaGameError
from ninja_game.files.bundled import bundled_replays, data_folder
from ninja_game.files.reading import digest_of
from ninja_game.runtime import PACKAGE
from ninja_game.web.pages.documents import Documents
from ninja_game.web.site import build, compiling, game_archive
from ninja_game.web.site.build import site_server
from ninja_game.web.site.game_archive import NOT_IN_PAGE
from tests.support.slow import the_rest_is_slow

DOCUMENTS = cache(lambda address: Documents(address).build())
COMPRESS = gzip.compress


@pytest.fixture
def pyodide(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with stand-ins for Pyodide's files, small ones, that count as the right version; no Node.js.

    What takes long is made once for all sites, and compressed little.
    """
    monkeypatch.setattr(build, "Documents", lambda address: Mock(build=lambda: dict(DOCUMENTS(address))))
    quick = "ninja_game.web.site.game_archive.gzip.compress"
    monkeypatch.setattr(quick, lambda data, _, mtime=0: COMPRESS(data, 1, mtime=mtime))
    monkeypatch.setattr("ninja_game.web.site.game_archive.shutil.which", lambda _: None)
    folder = tmp_path / "pyodide"
    folder.mkdir()
    library = io.BytesIO()
    with ZipFile(library, "w") as packed:
        for name in ("json/__init__.py", "tkinter/__init__.py", "encodings/utf_8.py", "encodings/big5.py", "this.py"):
            packed.writestr(name, "pass\n")
    files = {name: name.encode() for name in game_archive.DIGESTS}
    files |= {"python_stdlib.zip": library.getvalue(), "pyodide-lock.json": b'{"info": {"abi_version": "1<"}}'}
    for name, content in files.items():
        (folder / name).write_bytes(content)
        monkeypatch.setitem(game_archive.DIGESTS, name, digest_of(content))
    return folder


def names_in(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_the_same_files_give_the_same_site_and_old_ones_go(pyodide: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    first = build.build_site(out, pyodide, tmp_path)
    names = names_in(out)
    assert {*first, build.SITE_MARK} == names
    assert {"index.html", "play.html", "sw.js", "manifest.webmanifest", "licences/MPL-2.0.txt"} <= names
    (app,) = {name.split("/")[0] for name in names if name.startswith("app-")}
    assert {f"{app}/start.js", f"{app}/game.tar.gz", f"{app}/pyodide/pyodide.mjs"} <= names
    before = {name: (out / name).read_bytes() for name in names}
    (out / "mine.txt").write_text("not of the site")
    mark = json.loads((out / build.SITE_MARK).read_text())
    mark["files"] += ["old.js", "../outside.txt", "a/../../outside.txt", "/outside.txt", "\0", "", "pyodide/.."]
    (out / build.SITE_MARK).write_text(json.dumps(mark))
    (out / "old.js").write_text("of an earlier version")
    (tmp_path / "outside.txt").write_text("not in the folder")
    DOCUMENTS.cache_clear()
    build.build_site(out, pyodide, tmp_path)
    assert {name: (out / name).read_bytes() for name in names} == before
    assert names_in(out) == names | {"mine.txt"}
    assert (tmp_path / "outside.txt").exists()


@pytest.mark.parametrize("place", the_rest_is_slow(["index.html", "licences/MPL-2.0.txt", "learn", build.SITE_MARK], 1))
def test_nothing_is_written_or_removed_through_a_link(place: str, pyodide: Path, tmp_path: Path) -> None:
    out, outside = tmp_path / "out", tmp_path / "outside"
    build.build_site(out, pyodide, tmp_path)
    (out / place).rename(outside)
    (out / place).symlink_to(outside)
    before = {path: path.read_bytes() for path in (outside, *outside.rglob("*")) if path.is_file()}
    with pytest.raises(FileError, match="through links here; remove it"):
        build.build_site(out, pyodide, tmp_path)
    assert {path: path.read_bytes() for path in (outside, *outside.rglob("*")) if path.is_file()} == before


def test_a_mark_that_is_nested_too_deep_is_no_mark(pyodide: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / build.SITE_MARK).write_text("[" * 100_000)
    with pytest.raises(FileError, match="not a site of ninja-game"):
        build.build_site(tmp_path / "out", pyodide, tmp_path)


def app_folder(site: Path) -> Path:
    (app,) = site.glob("app-*")
    return app


def test_the_page_knows_its_version_and_sizes(pyodide: Path, tmp_path: Path) -> None:
    build.build_site(tmp_path / "out", pyodide, tmp_path)
    app = app_folder(tmp_path / "out")
    about = json.loads((app / "build.js").read_text().removeprefix("export const build = ").removesuffix(";\n"))
    assert about["pyodide"] == {"abi_version": "1<"}
    assert app.name == f"app-{about['id']}"
    assert about["sizes"] == {name: (app / name).stat().st_size for name in build._LARGE}
    page, worker = ((tmp_path / "out" / name).read_text() for name in ("play.html", "sw.js"))
    kept = json.loads(worker.split("const kept = ")[1].split(";\n")[0])
    assert {"play.html", f"{app.name}/start.js", "icons/192.png", "manifest.webmanifest"} <= set(kept["small"])
    assert all((tmp_path / "out" / name).is_file() for name in kept["small"] + kept["large"])
    texts = [path.read_text() for path in (tmp_path / "out").rglob("*") if path.suffix in {".html", ".js"}]
    assert "{{" not in page + worker
    assert "user-scalable" not in page  # its dialogs are texts, which people enlarge
    assert not [text for text in texts if build._FOLDER in text]
    for icon in json.loads((tmp_path / "out" / "manifest.webmanifest").read_text())["icons"]:
        assert (tmp_path / "out" / icon["src"]).read_bytes().startswith(b"\x89PNG")


def test_all_files_of_the_game_have_another_address_when_one_of_them_is_another_one(
    pyodide: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    build.build_site(tmp_path / "out", pyodide, tmp_path)
    before = app_folder(tmp_path / "out")
    icons = build._icons()
    monkeypatch.setattr(build, "_icons", lambda: icons | {"icons/64.png": b"\x89PNG"})
    build.build_site(tmp_path / "out", pyodide, tmp_path)
    after = app_folder(tmp_path / "out")
    assert after.name != before.name
    assert {path.name for path in after.glob("*.js")} >= {"start.js", "host.js", "painter.js"}


def test_the_archive_holds_the_game_and_nothing_that_the_page_cannot_use(pyodide: Path, tmp_path: Path) -> None:
    build.build_site(tmp_path / "out", pyodide, tmp_path)
    app = app_folder(tmp_path / "out")
    packed = gzip.decompress((app / "game.tar.gz").read_bytes())
    with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
        names = set(archive.getnames())
    wanted = {"boot.py", "ninja_game/play/main.py", "ninja_game/web/shim/pygame/__init__.py", "tomlkit/__init__.py"}
    assert wanted | {"ninja_game/data/levels/00-0-first-steps.txt", "ninja_game/data/assets/sounds/jump-1.ogg"} <= names
    assert not [name for name in names if "/cli/" in name or "/learn/" in name or name.endswith((".pyc", ".md"))]
    with ZipFile(app / "pyodide" / "python_stdlib.zip") as library:
        assert library.namelist() == ["encodings/utf_8.py", "json/__init__.py"]


@pytest.mark.parametrize("folder, beginning", [(name, each) for name in NOT_IN_PAGE for each in NOT_IN_PAGE[name]])
def test_all_that_the_page_leaves_out_is_there(folder: str, beginning: str) -> None:
    root = PACKAGE if folder == "package" else data_folder(folder)
    assert any(path.relative_to(root).as_posix().startswith(beginning) for path in root.rglob("*.*"))


def test_a_folder_with_other_things_is_left_alone(pyodide: Path, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "index.html").write_text("mine")
    with pytest.raises(FileError, match=r"not a site of ninja-game.*new or empty folder"):
        build.build_site(tmp_path / "mine", pyodide, tmp_path)
    assert names_in(tmp_path / "mine") == {"index.html"}


def test_a_folder_that_board_has_made_becomes_a_site(pyodide: Path, tmp_path: Path) -> None:
    """As it says itself; not with anything else beside its pages."""
    out, runs = tmp_path / "out", tmp_path / "runs"
    runs.mkdir()
    (runs / "a.txt").write_text(bundled_replays()[0].read_text("utf-8"), "utf-8")
    printed = CliRunner().invoke(cli, ["board", str(runs), "--site", str(out), "--jobs", "1"])
    assert f"ninja-game site {out}" in printed.stderr
    pages = names_in(out)
    assert {path.name for path in out.iterdir()} == {"board", "replays"}
    (out / "mine.txt").write_text("mine")
    with pytest.raises(FileError, match="not a site of ninja-game"):
        build.build_site(out, pyodide, tmp_path)
    (out / "mine.txt").unlink()
    build.build_site(out, pyodide, tmp_path)
    assert pages | {"play.html", build.SITE_MARK} <= names_in(out)


def test_other_files_than_those_of_the_version_are_refused(pyodide: Path, tmp_path: Path) -> None:
    (pyodide / "pyodide.mjs").write_bytes(b"other")
    with pytest.raises(NinjaGameError, match=r"pyodide\.mjs: not the file of Pyodide"):
        build.build_site(tmp_path / "out", pyodide, tmp_path)
    assert not (tmp_path / "out").exists()


def test_without_npm_the_command_says_what_to_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.web.site.game_archive.shutil.which", lambda _: None)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    result = CliRunner().invoke(cli, ["site", str(tmp_path / "out")])
    assert (result.exit_code, result.stdout) == (2, "")
    assert "npm, which gets Pyodide, is not installed" in result.stderr
    assert "--pyodide FOLDER" in result.stderr
    assert CliRunner().invoke(cli, ["site"]).exit_code == 2


def test_bytecode_runs_without_its_source_and_is_made_for_both_folders(tmp_path: Path) -> None:
    for name in ("library", "game"):
        (tmp_path / name).mkdir()
        (tmp_path / name / f"{name}_of_page.py").write_text("")
    subprocess.run([sys.executable, compiling.__file__], cwd=tmp_path, check=True)
    for source in tmp_path.glob("*/*.py"):
        source.unlink()
    program = "import sys; sys.path[:0] = ['library', 'game']; import library_of_page, game_of_page"
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True)


def test_what_npm_gives_is_kept(pyodide: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def npm(*_: object, cwd: str, **__: object) -> Mock:
        with tarfile.open(Path(cwd) / "pyodide.tgz", "w:gz") as package:
            package.add(pyodide, "package")
        return Mock(returncode=0)

    monkeypatch.setattr("ninja_game.web.site.game_archive.shutil.which", lambda _: "npm")
    monkeypatch.setattr("ninja_game.web.site.game_archive.subprocess.run", run := Mock(side_effect=npm))
    files = [game_archive.pyodide_files(folder, tmp_path / "cache") for folder in (None, None, pyodide)]
    assert files[0] == files[1] == files[2]
    run.assert_called_once()


@pytest.fixture
def server(tmp_path: Path) -> ThreadingHTTPServer:
    (tmp_path / "a.wasm").write_bytes(b"\0asm")
    (tmp_path / "manifest.webmanifest").write_text("{}")
    (tmp_path / "empty").mkdir()
    (tmp_path / "link.txt").symlink_to(Path(__file__))
    server = site_server(tmp_path, 0)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def test_the_local_server_names_the_kinds_of_files_and_lists_nothing(server: ThreadingHTTPServer) -> None:
    address = f"http://127.0.0.1:{server.server_port}"
    try:
        for name, kind in (("a.wasm", "application/wasm"), ("manifest.webmanifest", "application/manifest+json")):
            with urllib.request.urlopen(f"{address}/{name}") as answer:
                assert (answer.headers["Content-Type"], answer.headers["Cache-Control"]) == (kind, "no-cache")
        for name in ("empty/", "%00", "link.txt"):
            with pytest.raises(urllib.error.HTTPError, match="404") as refused:
                urllib.request.urlopen(f"{address}/{name}")
            refused.value.close()
        with pytest.raises(NinjaGameError, match="--port"):
            site_server(Path(), server.server_port)
    finally:
        server.shutdown()
        server.server_close()


@pytest.mark.slow
def test_the_commands_of_the_document_run(pyodide: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (Path(__file__).parents[2] / "docs" / "browser.md").read_text("utf-8")
    lines = re.findall(r"^    ninja-game ((?:site|player) .*?)\s+#", page, re.MULTILINE)
    assert lines == ["site public", "site --serve", "player export my-data.zip"]
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("NINJA_GAME_HOME", str(tmp_path / "home"))
    served = Mock(side_effect=lambda folder, _: nullcontext(Mock(page=(folder / "index.html").read_bytes())))
    monkeypatch.setattr(build, "site_server", served)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr("ninja_game.web.pages.gallery.write_gallery", lambda folder, _, address: folder)
    for line in lines:
        words = [*line.split(), *(["--pyodide", str(pyodide)] if line.startswith("site") else [])]
        result = CliRunner().invoke(cli, words)
        assert result.exit_code == 0, result.output
    assert "compressed by gzip" in CliRunner().invoke(cli, ["site", "public", "--pyodide", str(pyodide)]).output
    assert (tmp_path / "public" / "index.html").is_file()
    assert served.call_count == 1
    assert (tmp_path / "my-data.zip").is_file()
