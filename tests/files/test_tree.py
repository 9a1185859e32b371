"""Writing below a folder: whatever lies in it, and whatever a name says, nothing outside is made, changed, removed."""

import errno
import os
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from ninja_game.errors import FileError
from ninja_game.files import tree, writing
from ninja_game.files.shown_text import MAX_NAME_BYTES, file_stem, name_key, name_problem
from ninja_game.files.tree import Tree
from ninja_game.files.user_folder import export_path, free_path

DEPTHS = range(6)
BAD_NAMES = (
    "CON", "con.txt", "Prn.tar.gz", "aux", "NUL .txt", "COM1", "lpt9.txt", "com¹.txt", "CONIN$", "conout$.txt",
    "dot.", "blank ", "blank\u3000", "a/b", "a\\b", "c:x", "a:b", "what?", "*", "a\0b", "a\nb", "\x9b2J", "\x7f",
    "\u202egnp.txt", "a\u200bb", "\ufeffa", "\u2028", "\ud800", "ä" * 120, "x" * 201, "", ".", "..",
)  # fmt: skip


@pytest.fixture(autouse=True, params=[True, False], ids=["handles", "paths"])
def systems(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Systems with handles of folders, and those without."""
    monkeypatch.setattr(tree, "FOLDER_HANDLES", request.param)


@pytest.fixture
def outside(tmp_path: Path) -> Iterator[Path]:
    """A folder with a marker, which is the same afterwards."""
    folder = tmp_path / "outside"
    (folder / "1" / "2" / "3" / "4" / "5").mkdir(parents=True)
    marker = folder / "marker.txt"
    marker.write_text("mine")
    before = sorted(folder.rglob("*"))
    yield folder
    assert (sorted(folder.rglob("*")), marker.read_text()) == (before, "mine")


def link_at(root: Path, depth: int, target: str | Path) -> str:
    """A name six folders deep, one part of which is a link; the name."""
    parts = [str(number) for number in range(6)]
    place = root.joinpath(*parts[:depth])
    place.mkdir(parents=True)
    (place / parts[depth]).symlink_to(target)
    return "/".join(parts)


TARGETS: dict[str, Callable[[Path], str | Path]] = {
    "folder": lambda outside: outside, "file": lambda outside: outside / "marker.txt",
    "nothing": lambda outside: outside / "new", "itself": lambda _: "0/../.", "parent": lambda _: "..",
    "relative": lambda _: "../outside",
}  # fmt: skip


@pytest.mark.parametrize("kind", TARGETS)
@pytest.mark.parametrize("depth", DEPTHS)
def test_no_link_is_followed_at_any_depth(kind: str, depth: int, tmp_path: Path, outside: Path) -> None:
    root = tmp_path / "root"
    name = link_at(root, depth, TARGETS[kind](outside))
    link = root.joinpath(*name.split("/")[: depth + 1])
    for use in (Tree(root).write, lambda name, _: Tree(root).check(name)):
        with pytest.raises(FileError, match="through links here; remove it"):
            use(name, "content")
    if depth < 5:
        for remove in (Tree(root).remove, lambda name: Tree(root).remove_others(name, ()), Tree(root).names):
            with pytest.raises(FileError, match="through links here; remove it"):
                remove(name)
    assert link.is_symlink()
    assert [path for path in root.rglob("*") if path.is_file() and not path.is_symlink()] == []


def test_the_root_itself_may_be_a_link_because_the_user_named_it(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    (tmp_path / "root").symlink_to(tmp_path / "real")
    Tree(tmp_path / "root").write("a/b.txt", "content")
    assert (tmp_path / "real" / "a" / "b.txt").read_text() == "content"


def test_only_the_regular_files_of_the_folder_itself_are_removed(tmp_path: Path, outside: Path) -> None:
    root = tmp_path / "root"
    site = Tree(root)
    for name in ("a/old.html", "a/new.html", "a/.hidden", "a/below/deep.html"):
        site.write(name, "x")
    (root / "a" / "link.html").symlink_to(outside / "marker.txt")
    site.remove_others("a", {"new.html"})
    assert site.names("a") == ["below", "link.html", "new.html"]
    site.remove("a/link.html")
    site.remove("a/link.html")
    site.remove("no/such.html")
    site.remove_others("no", ())
    assert (site.names("a"), site.names("no"), site.names()) == (["below", "new.html"], [], ["a"])


@pytest.mark.parametrize("name", ["..", ".", "", "../a", "a/../../b", "/etc/a", "a//b", "a/", "a\0b", "./a"])
def test_a_name_that_leads_out_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(FileError, match="no name of a file in this folder"):
        Tree(tmp_path / "root").write(name, "")
    with pytest.raises(FileError, match="no name of a file in this folder"):
        Tree(tmp_path / "root").remove(name)
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_replaced_whole_or_not_at_all_and_keeps_its_mode(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    site = Tree(tmp_path)
    site.write("a/page.html", "old")
    (tmp_path / "a" / "page.html").chmod(0o640)
    site.write("a/page.html", "new")
    assert (tmp_path / "a" / "page.html").stat().st_mode & 0o777 == 0o640

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left") as caught:
        site.write("a/page.html", "newer")
    assert caught.value.filename == str(tmp_path / "a" / "page.html")
    assert site.names("a") == ["page.html"]
    assert (tmp_path / "a" / "page.html").read_text() == "new"


def test_a_folder_that_is_swapped_for_a_link_meanwhile_leads_nowhere(
    tmp_path: Path, outside: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not vars(tree)["FOLDER_HANDLES"]:
        pytest.skip("this system has no handles of folders")
    root = tmp_path / "root"
    (root / "a").mkdir(parents=True)
    look = tree._replaceable

    def swapped(path: Path, at: int | None) -> os.stat_result | None:
        (root / "a").rename(root / "moved")
        (root / "a").symlink_to(outside)
        return look(path, at)

    monkeypatch.setattr(tree, "_replaceable", swapped)
    Tree(root).write("a/marker.txt", "written")
    assert (root / "moved" / "marker.txt").read_text() == "written"


def test_what_a_killed_writer_left_is_removed_by_the_next_one(tmp_path: Path) -> None:
    left = tmp_path / "a" / f"{writing.PART_PREFIX}0{writing.PART_SUFFIX}"
    left.parent.mkdir()
    left.write_text("half")
    writing.tidied.clear()
    Tree(tmp_path).write("a/b.txt", "x")
    assert Tree(tmp_path).names("a") == ["b.txt"]


# --- names ---


@pytest.mark.parametrize("name", BAD_NAMES, ids=ascii)
def test_a_name_that_some_system_takes_otherwise_is_refused(name: str) -> None:
    assert name_problem(name)


@pytest.mark.parametrize(
    "name", ["a.txt", "Žluťoučký kůň.txt", "レベル　1.txt", "console.txt", "com10", "a b.c", "x" * 200]
)
def test_other_names_are_taken(name: str) -> None:
    assert name_problem(name) == ""


@given(st.text() | st.sampled_from(BAD_NAMES))
def test_what_a_text_names_is_good_on_every_system(text: str) -> None:
    name = f"{file_stem(text, 'replay')}.replay.txt"
    assert name_problem(name) == ""
    assert len(name.encode()) <= MAX_NAME_BYTES + len(".replay.txt")


def test_names_that_are_one_file_somewhere_are_one_here(tmp_path: Path) -> None:
    assert name_key("ÉTÉ.txt") == name_key("e\u0301te\u0301.TXT")
    (tmp_path / "E\u0301te.TXT").touch()
    assert free_path(tmp_path, "éte", ".txt").name == "éte-2.txt"
    (tmp_path / "exports").mkdir()
    (tmp_path / "exports" / "run-1.gif").symlink_to(tmp_path / "nothing")
    assert export_path(tmp_path, "Run", ".gif").name == "run-2.gif"
