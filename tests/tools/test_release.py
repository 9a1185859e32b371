"""Releases: the next version, and archives that do not depend on when and where they are packed."""

import os
from pathlib import Path

import pytest

from ninja_game import __version__
from tools import release


def test_the_next_version_stands_in_the_package_and_in_the_changelog(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(release, "ROOT", tmp_path)
    (tmp_path / "ninja_game").mkdir()
    (tmp_path / "ninja_game" / "__init__.py").write_text(f'__version__ = "{__version__}"\n')
    (tmp_path / "CHANGELOG.md").write_text("# Changelog\n\n## [Unreleased]\n\n- A thing.\n")
    release.bump("1.0")
    assert (tmp_path / "ninja_game" / "__init__.py").read_text() == '__version__ = "1.0"\n'
    assert "## [Unreleased]\n\n## [1.0] - 2" in (tmp_path / "CHANGELOG.md").read_text()
    for wrong in ("one", "1.0"):
        with pytest.raises(SystemExit, match=r"a version such as|has no line"):
            release.bump(wrong)


@pytest.mark.parametrize("name", [release.SITE, release.FROZEN])
def test_an_archive_is_the_same_whenever_and_wherever_it_is_packed(name: str, tmp_path: Path) -> None:
    made = object.__new__(release.Release)
    packed = []
    for moment in (1e9, 1.5e9):
        folder = tmp_path / str(moment) / name
        folder.mkdir(parents=True)
        for file in ("b", "a"):
            (folder / file).write_text(file)
            os.utime(folder / file, (moment, moment))
        made.out, made.epoch = folder.parent, 1_600_000_000
        made._packed(name, folder)
        packed += [path.read_bytes() for path in folder.parent.iterdir() if path.is_file()]
    assert len(packed) == 2
    assert packed[0] == packed[1]
