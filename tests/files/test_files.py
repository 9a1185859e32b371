"""Files are written whole or not at all, never where that would destroy something, and are read safely."""

import os
import signal
import subprocess
import sys
import threading
import time
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import IO
from unittest.mock import Mock

import pytest

from ninja_game import runtime
from ninja_game.errors import FileError
from ninja_game.files import writing
from ninja_game.files.bundled import data_folder
from ninja_game.files.locking import locked, read_abandoned, remove_abandoned, try_lock
from ninja_game.files.reading import Skipped, files_below, read_bytes, read_text, read_utf8, text_files
from ninja_game.files.user_folder import user_folder
from ninja_game.files.writing import open_atomically, remove_leftovers, write_atomically
from tests.support.special_files import needs_special_files


def test_file_is_replaced_by_the_whole_new_one(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")
    write_atomically(path, "neu: ä")
    assert path.read_bytes() == "neu: ä".encode()
    assert list(tmp_path.iterdir()) == [path]


def test_failed_write_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")

    def fill(file: IO[bytes]) -> None:
        file.write(b"half")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_atomically(path, fill)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_new_files_have_the_usual_rights_and_old_ones_keep_theirs(tmp_path: Path) -> None:
    (tmp_path / "usual").write_bytes(b"")
    write_atomically(tmp_path / "ours", b"")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "usual").stat().st_mode
    (tmp_path / "ours").chmod(0o600)
    write_atomically(tmp_path / "ours", b"new")
    assert (tmp_path / "ours").stat().st_mode & 0o777 == 0o600


def test_content_is_on_the_disk_before_its_name_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[str] = []
    monkeypatch.setattr(os, "fsync", lambda _: calls.append("sync"))
    monkeypatch.setattr(os, "replace", lambda *_, **__: calls.append("replace"))
    write_atomically(tmp_path / "a", b"content")
    assert calls == ["sync", "replace", "sync"]


def test_link_stays_and_its_target_is_written(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    target, link = tmp_path / "folder" / "target", tmp_path / "link"
    target.write_text("old")
    link.symlink_to(target)
    write_atomically(link, "new")
    assert link.is_symlink()
    assert target.read_text() == "new"


@needs_special_files
@pytest.mark.parametrize("kind", ["device", "pipe", "folder", "link to a device"])
def test_only_regular_files_are_written(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "out"
    if kind == "device":
        path = Path("/dev/null")
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    else:
        path.symlink_to("/dev/null")
    before = path.lstat()
    with pytest.raises(FileError, match="only a regular file is written"):
        write_atomically(path, b"x")
    assert (path.lstat().st_mode, path.lstat().st_ino) == (before.st_mode, before.st_ino)


def test_what_is_read_is_never_replaced(tmp_path: Path) -> None:
    source = tmp_path / "a.txt"
    source.write_text("mine")
    (tmp_path / "link").symlink_to(source)
    for path, keep in ((source, source), (tmp_path / "link", source), (source, tmp_path)):
        with pytest.raises(FileError, match="read by the same command"):
            write_atomically(path, b"x", keep=[keep])
    assert source.read_text() == "mine"
    write_atomically(tmp_path / "b.txt", b"x", keep=[source, tmp_path])


def test_errors_name_the_file_that_was_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "missing" / "a.png"
    with pytest.raises(OSError, match="No such file") as caught:
        write_atomically(path, b"x")
    assert caught.value.filename == str(path)
    for name in ("n" * 300, "nul\0"):
        with pytest.raises((OSError, FileError)) as odd:
            write_atomically(tmp_path / name, b"x")
        assert writing.PART_PREFIX not in str(odd.value)


def test_full_disk_is_an_error_and_leaves_nothing(tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    path = tmp_path / "a.png"
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, limits[1]))
    try:
        with pytest.raises(OSError, match="too large") as caught:
            write_atomically(path, b"x" * 10_000)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, before)
    assert caught.value.filename == str(path)
    assert list(tmp_path.iterdir()) == []


def test_other_errors_within_the_block_keep_their_names(tmp_path: Path) -> None:
    with pytest.raises(BrokenPipeError) as caught, open_atomically(tmp_path / "a"):
        raise BrokenPipeError(32, "Broken pipe")
    assert caught.value.filename is None
    with pytest.raises(FileNotFoundError) as missing, open_atomically(tmp_path / "a"):
        (tmp_path / "other").read_bytes()
    assert missing.value.filename == str(tmp_path / "other")


def test_a_process_that_is_ended_by_force_leaves_no_unfinished_file(tmp_path: Path) -> None:
    program = (
        "import pathlib, sys\nfrom ninja_game import signals\nfrom ninja_game.files.writing import open_atomically\n"
        "with open_atomically(pathlib.Path(sys.argv[1])) as file:\n"
        "    file.write(b'half')\n    signals._end(15)\n"
    )
    ended = subprocess.run([sys.executable, "-c", program, str(tmp_path / "a")], check=False, capture_output=True)
    assert (ended.returncode, ended.stderr) == (143, b"ninja-game: terminated\n")
    assert not list(tmp_path.iterdir())


def test_leftovers_of_killed_writers_are_removed_and_live_ones_stay(tmp_path: Path) -> None:
    program = (
        "import os, pathlib, signal, sys\nfrom ninja_game.files.writing import open_atomically\n"
        "with open_atomically(pathlib.Path(sys.argv[1])) as file:\n"
        "    file.write(b'half')\n    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    subprocess.run([sys.executable, "-c", program, str(tmp_path / "a")], check=False)
    assert len(list(tmp_path.iterdir())) == 1
    with open_atomically(tmp_path / "b") as file:
        assert len(list(tmp_path.iterdir())) == 1
        link = tmp_path / f"{writing.PART_PREFIX}link{writing.PART_SUFFIX}"
        link.symlink_to(sys.executable)  # nobody's leftover, and nothing is opened through it
        writing.tidied.clear()
        remove_leftovers(tmp_path)
        file.write(b"whole")
    assert {each.name for each in tmp_path.iterdir()} == {"b", link.name}


# --- reading ---


@needs_special_files
def test_only_regular_files_are_read(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path, tmp_path / "pipe", Path("/dev/zero")):
        with pytest.raises(FileError, match="only a regular file is read"):
            read_bytes(path)
    with pytest.raises(FileError, match="no file has this name"):
        read_bytes(tmp_path / "nul\0")
    (tmp_path / "big").write_bytes(b"x" * 11)
    with pytest.raises(FileError, match="too large"):
        read_bytes(tmp_path / "big", 10)
    assert read_bytes(tmp_path / "big", 11) == b"x" * 11


def test_what_is_not_text_is_an_error_with_its_place(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(b"one\ntw\xff")
    with pytest.raises(FileError, match=r"a\.txt:2:3: not a text in UTF-8; found the byte 0xff"):
        read_utf8(path)
    path.write_bytes(b"one\r\ntw\0")
    with pytest.raises(FileError, match=r"a\.txt:2: not a text file; found a zero byte"):
        read_text(path)


@needs_special_files
def test_walk_survives_loops_pipes_and_links_and_names_what_it_left_out(tmp_path: Path) -> None:
    for name in ("a.txt", "sub/b.txt", "sub.txt", ".hidden/c.txt"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("x")
    os.mkfifo(tmp_path / "pipe.txt")
    (tmp_path / "sub" / "loop").symlink_to(tmp_path)
    (tmp_path / "self.txt").symlink_to(tmp_path / "self.txt")
    (tmp_path / "gone.txt").symlink_to(tmp_path / "nowhere")
    found = list(files_below(tmp_path))
    assert [str(each.relative_to(tmp_path)) for each in found if isinstance(each, Path)] == [
        "a.txt", "sub/b.txt", "sub.txt",
    ]  # fmt: skip
    left_out = {each.path.name: each.why for each in found if isinstance(each, Skipped)}
    assert left_out.keys() == {"pipe.txt", "loop", "self.txt", "gone.txt"}
    assert left_out["pipe.txt"] == "a pipe, not a file"
    assert text_files(tmp_path) == [each for each in found if isinstance(each, Path)]


def test_fan_of_links_is_walked_once(tmp_path: Path) -> None:
    for depth in range(40):
        (tmp_path / f"d{depth}").mkdir()
        for name in ("left", "right"):
            (tmp_path / f"d{depth}" / name).symlink_to(tmp_path / f"d{depth + 1}")
    (tmp_path / "d0" / "a.txt").write_text("x")
    assert len(text_files(tmp_path)) == 1


def test_unreadable_corner_is_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "secret").mkdir()
    (tmp_path / "z.txt").write_text("x")
    scandir = os.scandir

    def guarded(path: Path) -> object:
        if path.name == "secret":
            raise PermissionError(13, "Permission denied", str(path))
        return scandir(path)

    # A root user may read everything, so that modes would not do.
    monkeypatch.setattr(os, "scandir", guarded)
    secret, file = files_below(tmp_path)
    assert str(secret) == f"{tmp_path / 'secret'}: Permission denied"
    assert file == tmp_path / "z.txt"


# --- locks ---


def test_lock_is_for_one_and_a_missing_one_stops_nobody(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    order = []

    def second() -> None:
        with locked(tmp_path / "file", 600):
            order.append("second")

    other = threading.Thread(target=second)
    with locked(tmp_path / "file", 1):
        other.start()
        start = time.monotonic()
        with locked(tmp_path / "file", 0.1):
            assert time.monotonic() - start >= 0.1
        order.append("first")
    other.join()
    assert order == ["first", "second"]
    with locked(tmp_path / "no such folder" / "file", 1):
        pass
    monkeypatch.setattr("fcntl.flock", Mock(side_effect=OSError(37, "No locks available")))
    start = time.monotonic()
    with locked(tmp_path / "file", 600):
        assert time.monotonic() - start < 300
    handle = try_lock(tmp_path / "held")
    assert handle is not None, "what is edited is kept on such a disk too"
    os.close(handle)


def test_what_dead_programs_left_is_found_newest_first_whatever_lies_beside_it(tmp_path: Path) -> None:
    for number, name in enumerate("cab"):
        (tmp_path / f"{name}.json").write_text(name)
        os.utime(tmp_path / f"{name}.json", (number, number))
    (tmp_path / "dangling.json").symlink_to("nowhere")
    (tmp_path / "folder.json").mkdir()

    def found() -> list[str]:
        return list(read_abandoned(tmp_path, "*.json", Path.read_text, ()))

    assert found() == ["b", "a", "c"]
    handle = try_lock(tmp_path / "a.lock")
    assert handle is not None
    assert found() == ["b", "c"]
    assert not remove_abandoned(tmp_path / "a.json"), "another program goes on with it"
    os.close(handle)
    assert found() == ["b", "a", "c"]
    assert remove_abandoned(tmp_path / "a.json")
    assert found() == ["b", "c"]
    assert not (tmp_path / "a.lock").exists()


# --- places ---


def test_data_folder_of_a_checkout(root: Path) -> None:
    assert data_folder("levels") == root / "levels"


def test_home_of_an_unknown_user_is_one_of_our_errors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NINJA_GAME_HOME", "~nobody-of-that-name/x")
    with pytest.raises(FileError, match="NINJA_GAME_HOME names no folder"):
        user_folder()


def test_what_is_missing_is_installed_as_the_place_has_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "tools/dev.py run" in runtime.install_hint("fast")
    monkeypatch.setattr(runtime, "PACKAGE", tmp_path / "site-packages" / "ninja_game")
    install = f"install it: {sys.executable} -m pip install "
    assert runtime.install_hint("learn").startswith(f"{install}'gymnasium>=")
    for extra in ("fast", "cluster", "plots", "film", "learn", "minari", "train"):
        hint = runtime.install_hint(extra).removeprefix(install)
        assert hint
        assert "ninja-game" not in hint, "it may be missing there"

    def refuse(name: str) -> None:
        raise PackageNotFoundError(name)

    monkeypatch.setattr("importlib.metadata.requires", refuse)
    assert runtime.install_hint("fast").startswith("this copy of the program cannot be added to")
