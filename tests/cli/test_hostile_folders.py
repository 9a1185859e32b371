"""Commands that write several files, into folders with links in them: nothing outside is made, changed or removed."""

import errno
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from ninja_game.cli.main import cli
from ninja_game.files import writing
from ninja_game.formats.ascii.writer import write_ascii_level
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.web.pages.frame import MARK
from tests.support.forgeries import replay
from tests.support.samples import SPIKED, WALK, write_records

PLACES = (
    "board", "board/levels", "board/pictures", "board/players", "board/style.css", "board/index.html",
    f"board/{MARK}", "replays", "replays/RUN", "board/levels/PAGE",
)  # fmt: skip


@pytest.fixture
def outside(tmp_path: Path) -> Iterator[Path]:
    """A folder that looks like one of ours; it is the same afterwards."""
    folder = tmp_path / "outside"
    folder.mkdir()
    for name in (MARK, "mine.txt", "levels.html"):
        (folder / name).write_text("mine")
    before = {path: path.read_text() for path in folder.iterdir()}
    yield folder
    assert {path: path.read_text() for path in folder.iterdir()} == before
    assert not (tmp_path / "made").exists()


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A folder with a level and a run on it."""
    folder = tmp_path / "source"
    (folder / "runs").mkdir(parents=True)
    (folder / "runs" / "ann.txt").write_text(replay(author="Ann"), "utf-8")
    (folder / "walk.txt").write_text(write_ascii_level(parse_level_string(WALK), name="Walk"), "utf-8")
    return folder


def command(*words: object) -> Result:
    result = CliRunner().invoke(cli, [str(word) for word in words])
    assert result.exit_code in (0, 2), result.output
    return result


def board(source: Path, site: Path) -> Result:
    return command("board", source / "runs", "--levels", source / "walk.txt", "--jobs", "1", "--site", site)


@pytest.mark.parametrize("place", PLACES)
def test_a_board_is_written_through_no_link(place: str, source: Path, tmp_path: Path, outside: Path) -> None:
    site = tmp_path / "site"
    assert board(source, site).exit_code == 0
    place = place.replace("RUN", next((site / "replays").iterdir()).name)
    link = site / place.replace("PAGE", next((site / "board" / "levels").iterdir()).name)
    shutil.rmtree(link) if link.is_dir() else link.unlink()
    for target in (outside, outside / "mine.txt", tmp_path / "made"):
        link.symlink_to(target)
        result = board(source, site)
        assert result.exit_code == 2
        assert f"{link}: " in result.output
        assert "through links here; remove it" in result.output
        assert link.is_symlink()
        link.unlink()


def test_a_disk_that_is_full_leaves_every_earlier_page(
    source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    site = tmp_path / "site"
    board(source, site)
    before = {path: path.read_bytes() for path in site.rglob("*") if path.is_file()}
    (source / "walk.txt").write_text(write_ascii_level(parse_level_string(SPIKED), name="Spiked"), "utf-8")
    replace, left = os.replace, iter(range(6))

    def full(part: str, target: str, **at: int) -> None:
        if next(left, None) is None:
            raise OSError(errno.ENOSPC, "No space left on device", part)
        replace(part, target, **at)

    monkeypatch.setattr(os, "replace", full)
    assert "No space left" in board(source, site).output
    now = {path: path.read_bytes() for path in site.rglob("*") if path.is_file()}
    assert now.keys() >= before.keys()
    assert not [path for path in now if path.suffix == writing.PART_SUFFIX]
    monkeypatch.setattr(os, "replace", replace)
    board(source, site)
    assert len(list((site / "board" / "levels").iterdir())) == 1


@pytest.mark.parametrize("target", ["outside/mine.txt", "made"])
def test_levels_are_converted_through_no_link(target: str, tmp_path: Path, outside: Path) -> None:
    many, folder = write_records(tmp_path / "many.txt", ("Walk", WALK, ""), ("", SPIKED, "")), tmp_path / "levels"
    folder.mkdir()
    (folder / "001.txt").symlink_to(tmp_path / target)
    assert "the file already exists" in command("convert", many, folder).output
    result = command("convert", many, folder, "--force")
    assert (result.exit_code, "only a regular file is written" in result.output) == (2, True)
    assert [path.name for path in folder.iterdir()] == ["001.txt"]


def test_converted_levels_have_names_that_are_files_everywhere(tmp_path: Path) -> None:
    for folder, names, made in (
        ("odd", ("aux.txt", "b.txt"), ["000-aux-con.txt", "001-b-con.txt"]),
        ("same", ("A.txt", "a.txt"), ["000-a-con.txt", "001-a-con.txt"]),
        ("dots", ("a.1.txt", "a.2.txt"), ["000-a.1-con.txt", "001-a.2-con.txt"]),
    ):
        (tmp_path / folder).mkdir()
        for name, level in zip(names, (WALK, SPIKED), strict=True):
            text = write_ascii_level(parse_level_string(level), name="CON")
            (tmp_path / folder / name).write_text(text, "utf-8")
        assert command("convert", tmp_path / folder, tmp_path / f"out-{folder}", "--to", "ascii").exit_code == 0
        there = sorted(path.name for path in (tmp_path / f"out-{folder}").iterdir())
        assert there == made


@pytest.mark.parametrize("target", ["outside/mine.txt", "made"])
def test_certificates_and_pars_are_written_through_no_link(
    target: str, source: Path, tmp_path: Path, outside: Path
) -> None:
    runs = tmp_path / "certificates"
    runs.mkdir()
    (runs / "walk.exit.replay.txt").symlink_to(tmp_path / target)
    result = command("check", source / "walk.txt", "--ticks", "300000", "--jobs", "1", "--replays", runs)
    assert (result.exit_code, "only a regular file is written" in result.output) == (2, True)
    (source / "pack.toml").write_text('name = "a pack"\n')
    (source / "pars.toml").symlink_to(tmp_path / target)
    assert command("levels", "pars", source).exit_code == 2


@pytest.mark.parametrize("target", ["outside/mine.txt", "made"])
def test_the_pictures_of_a_film_are_written_through_no_link(
    target: str, source: Path, tmp_path: Path, outside: Path
) -> None:
    film = tmp_path / "film"
    film.mkdir()
    (film / "00001.png").symlink_to(tmp_path / target)
    result = command("film", source / "runs" / "ann.txt", "-o", film, "--size", "198x150")
    assert (result.exit_code, "only a regular file is written" in result.output) == (2, True)
    (film / "00001.png").unlink()
    assert command("film", source / "runs" / "ann.txt", "-o", film, "--size", "198x150").exit_code == 0
