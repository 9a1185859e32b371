"""The game's episodes are made of its levels; what the player drops into a folder is there too."""

import os
import shutil
from pathlib import Path

from ninja_game.files.bundled import bundled_levels
from ninja_game.formats.n14.level_string import write_level_string
from ninja_game.formats.pack.pack import certificate_name
from ninja_game.player.catalogue import Catalogue
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.player_data import PlayerData
from ninja_game.player.progress import LOCKED, UNLOCKED
from tests.support.own_pack import PACK
from tests.support.players import played, short_level
from tests.support.special_files import needs_special_files


def test_bundled_episodes_can_be_read_and_name_each_level_once() -> None:
    catalogue = Catalogue()
    assert catalogue.episodes
    assert not catalogue.problems
    listed = [entry.named.file for episode in catalogue.episodes.values() for entry in episode.levels]
    assert len(listed) == len(set(listed))
    assert {entry.named.file for entry in catalogue.single_levels()} == {str(path) for path in bundled_levels()}


def test_files_in_the_players_folder_are_offered_as_they_come(tmp_path: Path) -> None:
    catalogue = Catalogue(tmp_path)
    assert catalogue.own() == []
    (tmp_path / "mine.txt").write_text(write_level_string(short_level()))
    assert [(entry.title, entry.source) for entry in catalogue.own()] == [("mine", "yours")]


def test_broken_file_is_named_and_the_others_stay(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(write_level_string(short_level()))
    (tmp_path / "b.txt").write_text("ninja-game level 1\nnonsense")
    catalogue = Catalogue(tmp_path)
    assert len(catalogue.own()) == 1
    assert "b.txt" in catalogue.problems[0]


@needs_special_files
def test_odd_things_in_the_players_folder_are_named_and_stop_nothing(tmp_path: Path) -> None:
    (tmp_path / "mine.txt").write_text(write_level_string(short_level()))
    os.mkfifo(tmp_path / "pipe.txt")
    (tmp_path / "loop").symlink_to(tmp_path)
    (tmp_path / "gone.txt").symlink_to(tmp_path / "nowhere")
    (tmp_path / "folder.txt").mkdir()
    catalogue = Catalogue(tmp_path)
    assert [entry.title for entry in catalogue.own()] == ["mine"]
    assert len(catalogue.problems) == 3
    assert "a pipe, not a file" in catalogue.problems[-1]
    assert Catalogue(tmp_path / "missing").own() == []


def test_unchanged_file_is_read_once_and_a_changed_one_again(tmp_path: Path) -> None:
    file = tmp_path / "mine.txt"
    file.write_text(write_level_string(short_level()))
    (tmp_path / "broken.txt").write_text("ninja-game level 1\nnonsense")
    catalogue = Catalogue(tmp_path)
    first = catalogue.own()
    assert catalogue.own()[0] is first[0]
    assert len(catalogue.problems) == 2
    file.write_text(write_level_string(short_level(1, gold=1)))
    assert catalogue.own()[0].digest != first[0].digest


def pack_of(folder: Path, name: str, numbers: tuple[int, ...] = (0, 1)) -> Path:
    """A pack with an episode of one level for each number, and a level in none."""
    folder.mkdir()
    episodes = "".join(f"[[episode]]\nnumber = {number}\n" for number in numbers)
    (folder / "pack.toml").write_text(f'name = "{name}"\ncolumns = ["First"]\n{episodes}')
    for number in numbers:
        (folder / f"{number:02d}-0-level.txt").write_text(write_level_string(short_level(number)))
    (folder / "alone.txt").write_text(write_level_string(short_level(99)))
    return folder


def test_pack_in_the_players_folder_is_offered_beside_ours(tmp_path: Path) -> None:
    pack_of(tmp_path / "mine", "My pack")
    (tmp_path / "single.txt").write_text(write_level_string(short_level(5)))
    catalogue = Catalogue(tmp_path)
    ours, mine = catalogue.packs()
    assert (ours.key, mine.key, mine.columns) == ("", "My pack", ("First",))
    assert [episode.pack for episode in mine.episodes.values()] == ["My pack"] * 2
    assert [(each.source, each.episode) for each in mine.levels] == [
        ("My pack", "00-0"), ("My pack", "01-0"), ("My pack", ""),
    ]  # fmt: skip
    assert [entry.title for entry in catalogue.own()] == ["single"]
    assert catalogue.problems == []


def test_zipped_pack_is_what_its_folder_is(tmp_path: Path) -> None:
    pack_of(tmp_path / "mine", "My pack")
    shutil.make_archive(str(tmp_path / "mine"), "zip", tmp_path / "mine")
    folder = Catalogue(tmp_path).packs()[1]
    shutil.rmtree(tmp_path / "mine")
    zipped = Catalogue(tmp_path).packs()[1]
    assert [entry.digest for entry in zipped.levels] == [entry.digest for entry in folder.levels]


def test_packs_are_read_again_when_their_files_change(tmp_path: Path) -> None:
    folder = pack_of(tmp_path / "mine", "My pack")
    catalogue = Catalogue(tmp_path)
    first = catalogue.packs()[1]
    assert catalogue.packs()[1] is first
    (folder / "00-1-more.txt").write_text(write_level_string(short_level(7)))
    assert len(catalogue.packs()[1].episodes[0].levels) == 2
    shutil.rmtree(folder)
    assert len(catalogue.packs()) == 1


def test_odd_packs_are_named_and_stop_nothing(tmp_path: Path) -> None:
    (tmp_path / "c.zip").write_text("no zip")
    (pack_of(tmp_path / "d", "Torn") / "pack.toml").write_text("name = [,")
    catalogue = Catalogue(tmp_path)
    assert [pack.key for pack in catalogue.packs()] == [""]
    no_zip, torn = catalogue.problems
    assert "c.zip: neither a folder nor a zip" in no_zip
    assert "pack.toml:1:" in torn


def test_packs_of_one_name_stand_side_by_side_with_what_tells_them_apart(tmp_path: Path) -> None:
    for file, more in (("a", 'author = "Ann"'), ("b", 'author = "Ann"\nversion = "2"'), ("c", 'author = "Ann"')):
        index = pack_of(tmp_path / file, "Same") / "pack.toml"
        index.write_text(f"{more}\n{index.read_text('utf-8')}", "utf-8")
    pack_of(tmp_path / "d", "Other")
    catalogue = Catalogue(tmp_path)
    _, *packs = catalogue.packs()
    assert [(pack.key, pack.name) for pack in packs] == [
        ("Same", "Same (a)"), ("Same (b)", "Same, 2"), ("Same (c)", "Same (c)"),
        ("Other", "Other"),
    ]  # fmt: skip
    assert {entry.source for entry in packs[1].levels} == {"Same (b)"}
    catalogue.more.append(tmp_path / "a")
    assert len(catalogue.packs()) == 5, "a pack of the folder that the command line names is there once"
    assert catalogue.problems == []
    for file, author in (("b", "Ida"), ("c", "Zoe")):
        index = tmp_path / file / "pack.toml"
        index.write_text(index.read_text("utf-8").replace("Ann", author), "utf-8")
    assert [pack.name for pack in catalogue.packs()[1:4]] == ["Same by Ann", "Same by Ida, 2", "Same by Zoe"]


def test_next_episode_is_the_next_one_that_there_is(tmp_path: Path) -> None:
    pack_of(tmp_path / "mine", "My pack", (0, 3, 4, 10))
    catalogue = Catalogue(tmp_path)
    episodes = catalogue.packs()[1].episodes
    following = {number: catalogue.following(episode) for number, episode in episodes.items()}
    assert {number: each.number if each else None for number, each in following.items()} == {
        0: 3, 3: 4, 4: None, 10: None,
    }  # fmt: skip
    assert [catalogue.preceding(episodes[number]) for number in (0, 3, 10)] == [None, episodes[0], None]


def test_first_episode_that_there_is_in_a_column_is_open(tmp_path: Path) -> None:
    data = PlayerData(tmp_path)
    pack_of(tmp_path / "levels" / "mine", "My pack", (2, 5, 17))
    newcomer = data.newcomer()
    episodes = data.catalogue.packs()[1].episodes
    assert {data.episode_state(episode) for episode in episodes.values()} == {UNLOCKED}, "all of one's own"
    assert not data.lock_of(episodes[5].levels[0])
    assert [newcomer.episode_state(episode) for episode in episodes.values()] == [UNLOCKED, LOCKED, UNLOCKED]
    (tmp_path / "levels" / "mine" / "received").touch()
    episodes = data.catalogue.packs()[1].episodes
    assert [data.episode_state(episode) for episode in episodes.values()] == [UNLOCKED, LOCKED, UNLOCKED]
    run = EpisodePlaythrough(data, episodes[2])
    assert run.legitimate
    run.passed(played(run.level))
    assert data.episode_state(episodes[5]) == UNLOCKED
    data.close()


def test_progress_of_packs_is_kept_apart_and_passes_over_gaps(tmp_path: Path) -> None:
    data = PlayerData(tmp_path)
    pack_of(tmp_path / "levels" / "mine", "My pack", (0, 3))
    episodes = data.catalogue.packs()[1].episodes
    run = EpisodePlaythrough(data, episodes[0])
    run.passed(played(run.level))
    assert data.progress_in("My pack").state(3) == UNLOCKED
    assert data.progress_in("My pack").is_beaten(0)
    assert data.progress.state(3) == LOCKED
    data.close()
    again = PlayerData(tmp_path)
    assert again.progress_in("My pack").state(3) == UNLOCKED
    again.close()


def test_a_pack_that_is_called_as_a_source_is_none(tmp_path: Path) -> None:
    for name in ("game", "yours"):
        pack_of(tmp_path / name, name)
    catalogue = Catalogue(tmp_path)
    packs = catalogue.packs()[1:]
    assert [(pack.key, pack.name) for pack in packs] == [("game (game)", "game"), ("yours (yours)", "yours")]
    assert [entry.source for pack in packs for entry in pack.levels[:1]] == ["game (game)", "yours (yours)"]
    for pack in packs:
        assert catalogue.episode_of(pack.levels[0]) is pack.episodes[min(pack.episodes)]


def test_a_certificate_is_read_again_only_when_it_has_changed(tmp_path: Path) -> None:
    shutil.copytree(PACK, tmp_path / "laundry")
    catalogue = Catalogue(tmp_path)
    entry = catalogue.packs()[1].levels[0]
    run = catalogue.author_run(entry)
    assert run
    assert catalogue.author_run(entry) is run
    file = tmp_path / "laundry" / certificate_name(Path(entry.named.file).name, "exit")
    file.rename(file.with_suffix(".bak"))
    assert catalogue.author_run(entry) is None
