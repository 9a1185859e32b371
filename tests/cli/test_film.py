"""`ninja-game film`: films of recordings, at the size and speed that were asked for."""

from dataclasses import replace
from io import BytesIO
from pathlib import Path
from unittest.mock import Mock

import pytest
from click.testing import CliRunner, Result
from PIL import Image, ImageSequence

from ninja_game.cli.film import film as command
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.demo import write_demo
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import Replay, parse_replay, write_episode
from ninja_game.play.replay import film
from ninja_game.play.replay.film import Film, section_of
from ninja_game.play.replay.playback import Playback, names_of
from ninja_game.runs.run import record_replay
from ninja_game.runs.splits import RunSplits, run_splits
from ninja_game.sim.inputs import Demo
from ninja_game.view.hud import Hud
from tests.support.samples import SPIKED, WALK, WALK_END, replay_of_walk, running, write_records


def film_of(*words: object) -> Result:
    return CliRunner().invoke(command, [str(word) for word in words])


def shown_ms(film: Path) -> int:
    """How long a film of 264 x 200 px lasts."""
    with Image.open(film) as image:
        assert image.size == (264, 200)
        return sum(frame.info["duration"] for frame in ImageSequence.Iterator(image))


@pytest.fixture(name="replay")
def replay_file(tmp_path: Path) -> Path:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk())
    return path


def test_film_has_the_size_and_the_speed_that_were_asked_for(replay: Path, tmp_path: Path) -> None:
    ms = {}
    for speed in (0.5, 1, 4):
        film = tmp_path / f"{speed}.gif"
        assert film_of(replay, "-o", film, "--size", "264x200", "--speed", speed).exit_code == 0
        ms[speed] = shown_ms(film)
    ticks = WALK_END + 1 + 40
    assert ms[1] == pytest.approx(25 * ticks, abs=30)
    assert ms[0.5] == pytest.approx(50 * ticks, abs=60)
    assert ms[4] == pytest.approx(25 / 4 * ticks, abs=60)
    with Image.open(tmp_path / "0.5.gif") as slow:
        assert getattr(slow, "n_frames", 0) > ticks / 2 + 9, "every tick is shown"


def test_record_of_a_file_becomes_a_folder_of_pictures(tmp_path: Path) -> None:
    file = write_records(tmp_path / "two.txt", ("one", WALK, running(3)), ("two", WALK, running(5)))
    assert film_of(file, "--record", 1, "-o", tmp_path / "film", "--size", "132x100").exit_code == 0
    assert len(list((tmp_path / "film").glob("*.png"))) == 5 + 1 + 1 + 40
    found = film_of(file, "--record", 2)
    assert "no record 2" in found.output


def test_film_of_a_run_without_an_end_wants_its_last_tick_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(film, "MAX_PICTURES", 30)
    file = write_records(tmp_path / "long.txt", ("long", "0" * 713 + "|5^100,566", running(1000)))
    steps: list[int] = []
    step = Playback.step

    def noted(playback: Playback) -> None:
        steps.append(playback.tick)
        step(playback)

    monkeypatch.setattr(Playback, "step", noted)
    assert "more than 30 pictures; name its last tick: --to" in str(film_of(file).exception)
    assert len(steps) <= 32, "no more of the run is simulated than a film would show"
    assert film_of(file, "--to", 40, "-o", tmp_path / "film", "--size", "132x100").exit_code == 0
    assert len(list((tmp_path / "film").glob("*.png"))) == 41


def test_film_never_replaces_its_replay_and_needs_a_known_form(replay: Path, tmp_path: Path) -> None:
    text = replay.read_text()
    assert film_of(replay, "-o", replay).exit_code == 2
    assert replay.read_text() == text
    assert ".gif" in str(film_of(replay, "-o", tmp_path / "film.avi").exception)
    assert not (tmp_path / "film.avi").exists()


def test_each_ghost_has_a_colour_and_a_name(replay: Path, tmp_path: Path) -> None:
    demo = write_demo(Demo(bytes(4) + bytes([2] * 9), 13.0))
    folders = []
    for number, authors in enumerate((("Ann",), ("Bea",), ("Ann", "Bea"))):
        records = [f"$Late#{author}##{WALK}#{demo}#" for author in authors]
        ghosts = tmp_path / f"{number}.txt"
        ghosts.write_text("\n".join(records))
        folders.append(tmp_path / str(number))
        assert film_of(replay, "-o", folders[-1], "--to", 3, "--size", "792x600", "--ghost", ghosts).exit_code == 0
    pictures = [(folder / "00003.png").read_bytes() for folder in folders]
    assert len(set(pictures)) == 3, "two names, and two colours over each other"


def test_a_section_of_an_episode_simulates_each_run_once(monkeypatch: pytest.MonkeyPatch) -> None:
    recording = Recording(parse_level_string(WALK), Replay.of_inputs(bytes([2] * 9), parse_level_string(WALK)))
    looked = Mock(return_value=9)
    monkeypatch.setattr(Playback, "find_end", looked)
    parts = section_of([Film(recording), Film(recording)], 3, 60)
    assert [each.moments for each in parts] == [range(3, 50), range(11)]
    assert looked.call_count == 2


def test_section_ghosts_and_keys(replay: Path, tmp_path: Path) -> None:
    folder = tmp_path / "plain"
    assert film_of(replay, "-o", folder, "--from", 5, "--to", 9, "--size", "264x200").exit_code == 0
    plain = [(folder / f"{number:05d}.png").read_bytes() for number in range(5)]
    assert len(list(folder.iterdir())) == 5
    late = write_records(tmp_path / "late.txt", ("Late", WALK, write_demo(Demo(bytes(4) + bytes([2] * 9), 13.0))))
    words: tuple[object, ...]
    for name, words in {"keys": ("--keys",), "ghost": ("--ghost", late)}.items():
        other = tmp_path / name
        assert film_of(replay, "-o", other, "--from", 5, "--to", 9, "--size", "264x200", *words).exit_code == 0
        assert all((other / f"{number:05d}.png").read_bytes() != plain[number] for number in range(5)), name
    assert "no pictures" in str(film_of(replay, "-o", tmp_path / "none", "--from", 9000).exception)
    spiked = write_records(tmp_path / "other.txt", ("Mine", SPIKED, running(9)))
    assert "another level" in film_of(replay, "-o", tmp_path / "none", "--ghost", spiked).stderr


@pytest.mark.parametrize("count, size", [(2, (264, 100)), (3, (264, 200)), (4, (264, 200))])
def test_runs_stand_beside_each_other_with_their_splits(
    replay: Path, tmp_path: Path, count: int, size: tuple[int, int]
) -> None:
    late = write_demo(Demo(bytes(4) + bytes([2] * 24), 28.0))
    others = write_records(tmp_path / "late.txt", *[("Late", WALK, late)] * (count - 1))
    words = replay, "--beside", others, "--size", "132x100"
    assert film_of(*words, "-o", tmp_path / "all").exit_code == 0
    files = sorted((tmp_path / "all").iterdir())
    assert len(files) == WALK_END + 4 + 1 + 40, "to the end of the last of them"
    with Image.open(files[-1]) as last:
        assert last.size == size
        parts = [last.crop((x, 0, x + 132, 100)).tobytes() for x in (0, 132)]
        assert parts[0] != parts[1]
    assert film_of(*words, "--splits", "--from", 30, "--to", 30, "-o", tmp_path / "told").exit_code == 0
    assert (tmp_path / "told" / "00000.png").read_bytes() != files[30].read_bytes()


@pytest.mark.parametrize("words, gold", [((), False), (("--gold",), True)])
def test_the_last_three_splits_are_shown_and_gold_where_it_is_asked_for(
    words: tuple[str, ...], gold: bool, replay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    events, shown = list[str](), list[str]()

    def texts(own: RunSplits, _: object) -> list[tuple[int, str]]:
        events.extend(each.event for each in own.splits)
        return [(tick, str(tick)) for tick in range(5)]

    def foot(_hud: object, _surface: object, text: str, *_: object) -> list[object]:
        shown.append(text)
        return []

    monkeypatch.setattr(film, "split_texts", texts)
    monkeypatch.setattr(Hud, "foot", foot)
    assert film_of(replay, "--splits", *words, "--to", 9, "-o", tmp_path / "told").exit_code == 0
    assert ("gold-taken" in events, shown[-1]) == (gold, "0.225 s; 2; 3; 4")


def test_splits_end_before_the_keys_and_the_newest_is_not_cut(
    replay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = list[str]()
    monkeypatch.setattr(film, "split_texts", lambda *_: [(tick, f"{tick} {'x' * 28}") for tick in range(5)])

    def foot(_hud: Hud, _surface: object, text: str, *_: object) -> list[object]:
        shown.append(text)
        return []

    monkeypatch.setattr(Hud, "foot", foot)
    assert film_of(replay, "--splits", "--keys", "--to", 9, "-o", tmp_path / "told").exit_code == 0
    assert shown[-1].startswith("0.225 s; 3 x")
    assert shown[-1].endswith(f"; 4 {'x' * 28}")


def test_a_large_gif_is_reported(replay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hint = "as .mp4 it would be smaller"
    assert hint not in film_of(replay, "--to", 3, "-o", tmp_path / "a.gif").output
    monkeypatch.setattr("ninja_game.cli.terminal._LARGE", 9)
    assert hint in film_of(replay, "--to", 3, "-o", tmp_path / "b.gif").output


def test_names_of_runs_are_not_cut_within_a_word(tmp_path: Path) -> None:
    level = parse_level_string(WALK)
    names = ("04-2.tas.speedrun", "x" * 40)
    runs = [Recording(level, Replay.of_inputs(b"\0", level), file=f"{name}.txt") for name in names]
    assert names_of(runs) == ["04-2.tas.speedrun.txt", f"{'x' * 25}..."]


def test_splits_say_by_how_much_others_are_later(tmp_path: Path) -> None:
    late = write_demo(Demo(bytes(4) + bytes([2] * 24), 28.0))
    file = write_records(tmp_path / "two.txt", ("First", WALK, running(24)), ("Late", WALK, late))
    first, second = (run_splits(replace(each, file="", record=0)) for each in load_replays(file))
    texts = [text for _, text in film.split_texts(first, [second])]
    assert texts[-1] == "exit, Late +4"
    assert [text for _, text in film.split_texts(second, [first])][-1] == "exit, First -4"
    first, second = map(run_splits, load_replays(file))
    assert [text for _, text in film.split_texts(first, [second])][-1] == "exit, two.txt 1 +4", "no player's name"


def test_runs_with_one_title_have_their_files_above_them(tmp_path: Path) -> None:
    """Those of nobody too: the name in a record of N is its level's maker's."""
    file = write_records(tmp_path / "two.txt", *[("Walk", WALK, running(24))] * 2, ("Other", WALK, running(24)))
    first, *others = load_replays(file)
    assert [each.title for each in (first, *others)] == ["Walk - two.txt", "Walk - two.txt 1", "Other - two.txt 2"]
    assert names_of([first, *others]) == ["two.txt", "two.txt 1", "two.txt 2"]
    first, *others = (
        replace(each, replay=replace(each.replay, made=Provenance(played=True))) for each in (first, *others)
    )
    shown = film.Film(first, beside=tuple(others))
    titles = [film._Panel(shown, each, []).title for each in (first, *others)]
    assert titles == ["Walk - me, two.txt", "Walk - me, two.txt 1", "Other - me"]


def test_films_that_are_too_much_are_refused(replay: Path, tmp_path: Path) -> None:
    many = write_records(tmp_path / "four.txt", *[("Late", WALK, running(24))] * 4)
    assert "4 runs; at most 3" in film_of(replay, "--beside", many, "-o", tmp_path / "a").output
    spiked = write_records(tmp_path / "other.txt", ("Mine", SPIKED, running(9)))
    assert "another level" in film_of(replay, "--beside", spiked, "-o", tmp_path / "a").output
    assert "would replace" in film_of(replay, "--beside", many, "-o", many).output


def test_a_film_of_an_episode_shows_all_its_levels_and_the_time_that_is_left(replay: Path, tmp_path: Path) -> None:
    episode = tmp_path / "two.episode.txt"
    run = parse_replay(replay.read_text())
    episode.write_text(write_episode([run, run]))
    assert film_of(episode, "-o", tmp_path / "all", "--size", "264x200").exit_code == 0
    files = [each.read_bytes() for each in sorted((tmp_path / "all").iterdir())]
    length = WALK_END + 1 + 40
    assert len(files) == 2 * length
    assert files[0] != files[length], "the second level begins with another time"
    assert film_of(episode, "--record", 1, "-o", tmp_path / "one", "--size", "264x200").exit_code == 0
    assert [each.read_bytes() for each in sorted((tmp_path / "one").iterdir())] == files[length:]
    words = ["--from", length - 2, "--to", length + 1, "--size", "264x200"]
    assert film_of(episode, *words, "-o", tmp_path / "part").exit_code == 0
    assert [each.read_bytes() for each in sorted((tmp_path / "part").iterdir())] == files[length - 2 : length + 2]
    assert film_of(episode, *words, "--ghost", replay, "-o", tmp_path / "with").exit_code == 0
    assert len(list((tmp_path / "with").iterdir())) == 4
    assert f"there are {2 * length}" in str(film_of(episode, "--from", 999, "-o", tmp_path / "no").exception)


def test_runs_beside_an_episode_are_those_of_each_level(replay: Path, tmp_path: Path) -> None:
    run, episode = parse_replay(replay.read_text()), tmp_path / "two.episode.txt"
    other = parse_level_string(WALK.replace("0^115,566", "0^117,566"))
    second = record_replay(other, run.playback(WALK_END + 1))
    episode.write_text(write_episode([run, second]))
    words = ["--from", WALK_END, "--to", WALK_END + 60, "--size", "264x200", "-o"]
    assert film_of(episode, "--beside", episode, *words, tmp_path / "both").exit_code == 0
    sizes = {Image.open(BytesIO(each.read_bytes())).size for each in (tmp_path / "both").iterdir()}
    assert sizes == {(528, 200)}
    found = film_of(episode, "--beside", replay, *words, tmp_path / "no")
    assert "as many runs for each level of the episode" in found.output


def test_a_video_without_its_encoder_says_what_helps(
    replay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    av = pytest.importorskip("av")
    monkeypatch.setattr(av, "codecs_available", frozenset({"gif"}))
    found = film_of(replay, "-o", tmp_path / "film.mp4")
    assert "no encoder libx264; write a .gif" in str(found.exception)
    assert not (tmp_path / "film.mp4").exists()


@pytest.mark.parametrize("suffix", [".webm", ".mp4"])
def test_a_video_has_the_size_and_the_speed_that_were_asked_for(suffix: str, replay: Path, tmp_path: Path) -> None:
    av = pytest.importorskip("av")
    film = tmp_path / f"fast{suffix}"
    assert film_of(replay, "-o", film, "--size", "264x200", "--speed", 2).exit_code == 0
    with av.open(str(film)) as container:
        pictures = list(container.decode(video=0))
    assert (pictures[0].width, pictures[0].height) == (264, 200)
    # 80 ticks a second are more than are shown: every second one is.
    assert len(pictures) == (WALK_END + 1 + 40) // 2
    assert "even px" in str(film_of(replay, "-o", film, "--size", "265x200").exception)


def test_film_that_cannot_be_written_names_its_place(replay: Path, tmp_path: Path) -> None:
    found = film_of(replay, "-o", tmp_path / "nowhere" / "film.gif", "--size", "132x100")
    assert "film.gif: the film cannot be written" in str(found.exception)


def test_failed_film_leaves_nothing(replay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from ninja_game.play.replay.film import Film, write_film

    run = load_replays(replay)[0]
    assert not write_film([Film(run)], tmp_path / "film.gif", lambda made, count: made < 20 < count)
    assert not (tmp_path / "film.gif").exists()


def test_a_film_without_a_name_of_its_own_replaces_nothing(
    replay: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    victim = tmp_path / "victim"
    victim.write_text("kept")
    (tmp_path / "walk.gif").symlink_to(victim)
    assert film_of(replay, "--to", "2", "--size", "132x100").exit_code == 0
    assert victim.read_text() == "kept"
    assert (tmp_path / "walk-2.gif").read_bytes().startswith(b"GIF89a")


def test_a_file_of_several_wants_its_record_named(tmp_path: Path) -> None:
    file = write_records(tmp_path / "two.txt", ("one", WALK, running(3)), ("two", WALK, running(5)))
    found = film_of(file, "-o", tmp_path / "film.gif")
    assert found.exit_code == 2
    assert "holds 2 recordings; choose one with --record" in found.output
