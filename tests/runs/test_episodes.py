"""Episodes as one recording: the time is carried on, and all else is refused with its reason."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from hypothesis import given, settings

from ninja_game.cli.main import cli
from ninja_game.errors import FormatError, LinkError, ReplayError
from ninja_game.formats.links import write_link
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.recording import parse_replays
from ninja_game.formats.replay.text import lifetimes, parse_episode, parse_replay, write_episode, write_replay
from ninja_game.runs.verify import verify_recording
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from ninja_game.tas.files import open_run
from tests.support.forgeries import GOLD_LATER, WALKING, replay, without_level
from tests.support.own_pack import PACK
from tests.support.samples import WALK, WALK_END
from tests.support.strategies import mutations_of

RUNS = sorted((PACK / "certificates").glob("0*.exit.replay.txt"))
WALKED = replay(), replay(bytes(9) + WALKING + b"\2")
EPISODE = write_episode([parse_replay(each) for each in WALKED])


def run(*words: str | Path) -> Result:
    return CliRunner().invoke(cli, [*map(str, words)])


def verified(text: str, folder: Path, *words: str | Path) -> Result:
    path = folder / "e.episode.txt"
    path.write_text(text)
    return run("verify", path, *words)


@pytest.fixture
def first(tmp_path: Path) -> Path:
    """The first episode of the tests' pack, put together by the command."""
    path = tmp_path / "00.episode.txt"
    result = run("convert", *RUNS[:5], path)
    assert (result.exit_code, result.output) == (0, "")
    return path


def test_five_replays_become_one_recording_with_the_time_carried_on(first: Path, tmp_path: Path) -> None:
    runs = load_replays(first)
    assert [each.level for each in load_levels(first)] == [each.level for each in runs]
    assert [each.record for each in runs] == [0, 1, 2, 3, 4]
    left = LIFETIME
    for each in runs:
        assert each.lifetime == left
        left += GOLD_BONUS * each.replay.gold - each.replay.final_tick
    result = run("verify", first, "--strict", "--level", PACK)
    assert result.exit_code == 0, result.output
    assert f"{left / 40:.3f} s at the exit" in result.output.splitlines()[4]
    assert run("verify", first, "--record", "3", "--json").output.count(f'"lifetime": {runs[3].lifetime}') == 1
    assert run("convert", first, tmp_path / "again", "--to", "replay").exit_code == 0
    again = sorted((tmp_path / "again").iterdir())
    assert [parse_replay(each.read_text()).inputs for each in again] == [each.replay.inputs for each in runs]


def test_an_episode_opens_in_the_tas_editor_level_by_level_and_stays_as_it_is(first: Path) -> None:
    with pytest.raises(ReplayError, match="5 recordings"):
        open_run(first)
    opened = open_run(first, record=2)
    assert opened.track.inputs == load_replays(first)[2].inputs
    assert opened.file.path is None, "one of its levels does not replace all five"


@pytest.mark.parametrize(
    "chosen", [RUNS[:4], [*RUNS[:4], RUNS[5]], [RUNS[1], RUNS[0], *RUNS[2:5]], [RUNS[0]] * 5],
    ids=["four", "of two episodes", "in another order", "one level"],
)  # fmt: skip
def test_levels_that_are_no_episode_do_not_count(chosen: list[Path], tmp_path: Path) -> None:
    path = tmp_path / "e.episode.txt"
    assert run("convert", *chosen, path).exit_code == 0
    assert run("verify", path).exit_code == 0, "each of them does what it says"
    result = run("verify", path, "--strict", "--level", PACK)
    assert (result.exit_code, result.output.count("[other-episode]")) == (1, len(chosen))


def carried(ticks: int) -> str:
    """Two runs; the first, with gold in its first tick, waits until this many ticks are left for the second."""
    waits = bytes(LIFETIME + GOLD_BONUS - WALK_END - ticks)
    return write_episode([parse_replay(replay(waits + WALKING + b"\2")), parse_replay(replay(level=GOLD_LATER))])


def test_the_clock_is_the_one_that_the_level_before_has_left(tmp_path: Path) -> None:
    """Who has as many ticks as it is to the gold gets 80 more in the last one; who has one less is late."""
    taken = next(t for t in range(1, 24) if parse_replay(replay(WALKING[:t], GOLD_LATER)).gold) - 1
    assert taken > 1
    assert verified(carried(taken + 1), tmp_path).exit_code == 0
    late = verified(carried(taken), tmp_path)
    assert late.exit_code == 1
    assert f"the time of the episode runs out: {taken} ticks at the start" in late.output
    alone = load_replays(tmp_path / "e.episode.txt")[1]
    assert verify_recording(parse_replays(write_replay(alone.replay))[0]).in_time


def test_a_command_puts_no_late_runs_together(tmp_path: Path) -> None:
    runs = [tmp_path / "a.replay.txt", tmp_path / "b.replay.txt"]
    for path, each in zip(runs, parse_episode(carried(1)), strict=True):
        path.write_text(write_replay(each))
    result = run("convert", *runs, tmp_path / "e.episode.txt")
    assert result.exit_code == 2
    assert "b.replay.txt" in result.stderr
    assert "the time of the episode runs out: 1 ticks at the start" in result.stderr


FORGED: dict[str, tuple[Callable[[str], str], str]] = {
    "six": (lambda text: text + text.partition("\n")[2], r":1: not the replays of an .*; found 6 replays"),
    "none": (lambda _: "ninja-game episode 1\n", "found 0 replays"),
    "version": (lambda text: text.replace("episode 1", "episode 2"), "not an episode; found 'ninja-game episode 2"),
    "words": (lambda text: text.replace("\n", "\nhello\n", 1), "not an episode"),
    "dead": (lambda text: text.replace("outcome: exit", "outcome: dead", 1), r":2: a level .* not passed; found dead"),
    "no claims": (lambda text: re.sub("(?m)^(rules|outcome|gold|digest): .*\n", "", text), "found no claims"),
    "body": (lambda text: text.replace("body: circle", "body: box", 1), "an episode with two bodies; found circle"),
    "no time": (lambda text: text.replace("final-tick: 23", "final-tick: 3680"), r":2: .*time .* in level 1; found 0"),
    "cut": (lambda text: text[:-5], "the replay is truncated"),
    "cut in the middle": (lambda text: text.replace("\nend\n", "\n", 1), "not a header|truncated"),
    "garbled": (lambda text: text.replace("gold: 1", "gold: one"), r":\d+:\d+: .*gold"),
}


@pytest.mark.parametrize("name", FORGED)
def test_what_is_not_an_episode_is_an_error_with_its_line(name: str, tmp_path: Path) -> None:
    forge, why = FORGED[name]
    text = forge(write_episode([parse_replay(WALKED[0])] * 3) if name == "six" else EPISODE)
    assert text != EPISODE
    with pytest.raises(ReplayError, match=why):
        parse_episode(text, file="e.txt")
    assert verified(text, tmp_path).exit_code == 2


def test_a_claim_that_is_not_so_is_found_in_the_level_that_makes_it(tmp_path: Path) -> None:
    result = verified(EPISODE.replace("gold: 1", "gold: 2", 1), tmp_path)
    assert result.exit_code == 1
    assert "e.episode.txt:0" in next(line for line in result.output.splitlines() if line.startswith("FAIL"))


def test_a_line_of_an_error_is_that_of_the_whole_text() -> None:
    text = EPISODE.replace("ninja-game replay 3\nname: walk", "ninja-game replay 3\nnane: walk")
    line = text.splitlines().index("nane: walk") + 1
    with pytest.raises(ReplayError, match=rf"^e\.txt:{line}:"):
        parse_episode(text, file="e.txt")


def test_an_episode_in_a_link_reads_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "walk.txt").write_text(WALK)
    monkeypatch.chdir(tmp_path)
    assert len(load_replays(write_link("replay", [EPISODE]))) == 2
    with pytest.raises(LinkError, match="a replay without its level"):
        load_replays(write_link("replay", [f"ninja-game episode 1\n{without_level(WALKED[0], 'walk.txt')}"]))


@settings(max_examples=200)
@given(mutations_of((EPISODE,)))
def test_mutated_episodes_are_read_or_refused(text: str) -> None:
    try:
        runs = parse_replays(text)
    except FormatError:
        return
    assert lifetimes([each.replay for each in runs])[:-1] == [each.lifetime for each in runs] or not runs[0].episode
