"""Packs, folders and zips: index, episodes, certificates; what is wrong is named with its line."""

import zipfile
from pathlib import Path

import pytest

from ninja_game.errors import FileError, PackError
from ninja_game.formats.load import load_levels
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.pack import pack as pack_files
from ninja_game.formats.pack.index import parse_index
from ninja_game.formats.pack.pack import Pack
from tests.support.players import short_level

INDEX = 'name = "Two"\nauthor = "me"\ncolumns = ["First"]\n\n[[episode]]\nnumber = 0\nname = "One"\n'
LEVEL = write_level_string(short_level())


def folder_pack(folder: Path, index: str = INDEX) -> Path:
    """A pack with two levels in episode 0 and one in none."""
    (folder / "certificates").mkdir(parents=True)
    (folder / "pack.toml").write_text(index)
    for number, name in enumerate(("00-1-b.txt", "00-0-a.txt", "other.txt")):
        (folder / name).write_text(write_level_string(short_level(number)))
    (folder / "certificates" / "00-0-a.exit.replay.txt").write_text("any")
    return folder


def zip_pack(path: Path, entries: dict[str, str]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for name, text in entries.items():
            file.writestr(name, text)
    return path


def test_files_belong_to_the_episode_whose_number_they_begin_with(tmp_path: Path) -> None:
    pack = Pack(folder_pack(tmp_path / "two"))
    ((episode, levels),) = pack.episodes.items()
    assert (pack.name, pack.index.author, episode.number, episode.name) == ("Two", "me", 0, "One")
    assert [Path(level.file).name for level in levels] == ["00-0-a.txt", "00-1-b.txt"]
    assert sorted(pack.levels) == ["00-0-a.txt", "00-1-b.txt", "other.txt"]
    assert pack.certificate("00-0-a.txt", "exit") == "certificates/00-0-a.exit.replay.txt"
    assert pack.certificate("00-0-a.txt", "gold") is None
    assert pack.problems == []


def test_listed_files_come_in_the_order_of_the_list(tmp_path: Path) -> None:
    listed = INDEX + 'levels = ["other.txt", "00-0-a.txt", "gone.txt"]\n'
    pack = Pack(folder_pack(tmp_path / "two", listed))
    (levels,) = pack.episodes.values()
    assert [Path(level.file).name for level in levels] == ["other.txt", "00-0-a.txt"]
    assert pack.problems == [f"{tmp_path / 'two' / 'gone.txt'}: not there"]


def test_episode_without_levels_is_left_out_and_a_broken_level_named(tmp_path: Path) -> None:
    path = folder_pack(tmp_path / "two", INDEX + "\n[[episode]]\nnumber = 7\n")
    (path / "00-2-c.txt").write_text("ninja-game level 1\nnonsense")
    pack = Pack(path)
    assert [episode.number for episode in pack.episodes] == [0]
    assert "00-2-c.txt:2" in pack.problems[0]


def test_sixth_level_is_named_and_left_out(tmp_path: Path) -> None:
    path = folder_pack(tmp_path / "two")
    for number in range(2, 6):
        (path / f"00-{number}-x.txt").write_text(write_level_string(short_level(number)))
    pack = Pack(path)
    assert [len(levels) for levels in pack.episodes.values()] == [5]
    assert pack.problems == [f"{path / '00-5-x.txt'}: the sixth level of its episode"]


@pytest.mark.parametrize("top", ["", "two/"])
def test_zip_is_what_its_folder_is(tmp_path: Path, top: str) -> None:
    path = folder_pack(tmp_path / "two")
    entries = {f"{top}{file.relative_to(path)}": file.read_text() for file in path.rglob("*") if file.is_file()}
    zipped, folder = Pack(zip_pack(tmp_path / "two.zip", entries)), Pack(path)
    assert zipped.files.names == folder.files.names
    assert [level.level for level in zipped.levels.values()] == [level.level for level in folder.levels.values()]
    assert zipped.index == folder.index
    assert [level.level for level in load_levels(tmp_path / "two.zip")] == [level.level for level in load_levels(path)]


def test_names_in_a_zip_that_lead_elsewhere_are_skipped(tmp_path: Path) -> None:
    odd = ["../a.txt", "/b.txt", "x/../c.txt", "deep/er/d.txt", "certificates/../e.txt", "..\\f.txt"]
    pack = Pack(zip_pack(tmp_path / "odd.zip", {"pack.toml": INDEX, "good.txt": LEVEL, **dict.fromkeys(odd, LEVEL)}))
    assert pack.files.names == ("good.txt", "pack.toml")


def test_what_a_zip_hides_is_reported(tmp_path: Path) -> None:
    entries = {"a/pack.toml": INDEX, "a/x.txt": LEVEL, "a/X.txt": LEVEL, "b/pack.toml": INDEX}
    problems = Pack(zip_pack(tmp_path / "odd.zip", entries)).problems
    assert [problem.removeprefix(f"{tmp_path}/odd.zip/") for problem in problems] == [
        "b/pack.toml: a second index; a/pack.toml is the one that is read",
        "a/X.txt: more than one file has this name on some system",
        "a/x.txt: more than one file has this name on some system",
    ]


def test_file_without_a_name_in_a_zip_is_skipped(tmp_path: Path) -> None:
    path = zip_pack(tmp_path / "odd.zip", {"pack.toml": INDEX, "good.txt": LEVEL, "x": LEVEL})
    data = bytearray(path.read_bytes())
    data[data.rindex(b"PK\1\2") + 46] = 0  # the library cuts names at a zero byte: the last one is empty now
    data[data.rindex(b"PK\3\4") + 30] = 0
    path.write_bytes(data)
    assert Pack(path).files.names == ("good.txt", "pack.toml")


def test_zip_that_is_none_broken_or_too_large_is_one_of_our_errors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "no.zip").write_text("no zip")
    with pytest.raises(FileError, match=r"no\.zip: neither a folder nor a zip"):
        Pack(tmp_path / "no.zip")
    path = zip_pack(tmp_path / "two.zip", {"pack.toml": INDEX, "a.txt": LEVEL, "bomb.txt": "0" * 10**6})
    monkeypatch.setattr(pack_files, "MAX_FILE_BYTES", 10**5)
    pack = Pack(path)
    assert list(pack.levels) == ["a.txt"]
    assert "bomb.txt: the file is too large" in pack.problems[0]
    monkeypatch.setattr(pack_files, "MAX_FILES", 2)
    with pytest.raises(FileError, match="found more than 2 files in a zip"):
        Pack(path)
    data = bytearray(path.read_bytes())
    data[40:60] = bytes(20)
    (tmp_path / "torn.zip").write_bytes(data)
    with pytest.raises(FileError, match=r"torn\.zip"):
        Pack(tmp_path / "torn.zip")


def test_pack_without_index_says_so(tmp_path: Path) -> None:
    with pytest.raises(PackError, match=r"without its index; expected a file pack\.toml"):
        Pack(tmp_path)


@pytest.mark.parametrize(
    "text, message",
    [
        ("name = 'x'\nnot [ toml", r"p\.toml:2:\d+: no TOML"),
        ("name = My pack", r"p\.toml:1:8: no TOML: Invalid value; found 'name = My pack'; a text stands in double"),
        ("a = " + "[" * 5000, "p.toml: no TOML"),
        ("name = 'x'\na" + ".a" * 5000 + " = 1", "p.toml:2:1: no TOML: A key of more than 50 parts"),
        ("name = 0x" + "f" * 5000, "p.toml: no TOML: A whole number of more than 64 bits"),
        ("", "without a name"),
        ("name = 5", "name is not text; found 5"),
        ("name = 'x'\nepisodes = []", r"p\.toml:2: an unknown entry; found 'episodes'; .*did you mean 'episode'\?"),
        ("name = 'x'\n[[episode]]\nnumber = 0\n\nlevel = ['a']", r"p\.toml:5: .* 'level'; .*did you mean 'levels'\?"),
        ("version = '2'\n[[episode]]\nnumber = 0\nname = 'x'", r"p\.toml: a pack without a name"),
        ("name = 'x'\n[[accept]]\nfile = 'a.txt'\ncode = 'same-name'", r"p\.toml:2: accept without its reason"),
        ("name = 'x'\ncolumns = 'y'", "columns is not a list of texts"),
        ("name = 'x'\nepisode = 5", r"p\.toml:2: not a list of tables: episode"),
        ("name = 'x'\nepisode = [5]", r"p\.toml:2: not a list of tables: episode"),
        ("name = 'x'\n\n[[episode]]\nnumber = 100", r"p\.toml:4: an episode's number; found 100"),
        ("name = 'x'\n[[episode]]\nlevels = ['a.txt']", r"p\.toml:2: an episode's number; found None"),
        ("name = 'x'\n[[episode]]\nnumber = true", r"p\.toml:3: an episode's number; found True"),
        ("name = 'x'\n[[episode]]\nnumber = 3\n[[episode]]\nnumber = 3", r"p\.toml:4: episode 3 is there twice"),
        ("name = 'x'\n[[episode]]\nnumber = 0\nlevels = [[]]", r"p\.toml:4: levels is not a list of texts"),
        ("name = 'x'\n[[episode]]\nnumber = 0\nlevels = ['a','a','a','a','a','a']", r"toml:4: the levels of episode"),
        ("name = 'x'\n[[episode]]\nnumber = 0\ntitle = 'y'", r"p\.toml:4: an unknown entry; found 'title'"),
    ],
)
def test_wrong_index_is_an_error_with_its_line(text: str, message: str) -> None:
    with pytest.raises(PackError, match=message):
        parse_index(text, file="p.toml")
