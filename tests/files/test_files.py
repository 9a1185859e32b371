"""Files are written whole or not at all, and the bundled ones are found."""

from __future__ import annotations

from pathlib import Path
from typing import IO

import pytest

from ninja_game.files.resources import data_folder
from ninja_game.files.writing import write_atomically


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


def test_new_files_have_the_usual_rights(tmp_path: Path) -> None:
    (tmp_path / "usual").write_bytes(b"")
    write_atomically(tmp_path / "ours", b"")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "usual").stat().st_mode


def test_data_folder_of_a_checkout(root: Path) -> None:
    assert data_folder("levels") == root / "levels"
