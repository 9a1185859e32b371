"""Generated levels: the same for the same seed, certified, lintless, about as hard as they were asked to be."""

from pathlib import Path
from statistics import mean
from threading import Event

import pytest
from click.testing import CliRunner, Result

from ninja_game.backend.memories import compiled_available
from ninja_game.cli.main import cli

if not compiled_available():
    pytest.skip("Numba is not installed", allow_module_level=True)

from ninja_game.batch.difficulty import difficulty
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.generator.generate import Effort, Generated, generate
from ninja_game.levels.lint import level_warnings
from ninja_game.runs.run import run_level
from tests.support.golden_generated import SEEDS, SMALL, generated_digest, read_generated
from tests.support.slow import the_rest_is_slow


def made(seed: int, wanted: int) -> Generated:
    """The level of a seed with a small budget."""
    level = generate(seed, wanted, effort=SMALL)
    assert level is not None
    return level


@pytest.mark.parametrize("asked", the_rest_is_slow(SEEDS, 1))
def test_a_seed_always_makes_the_same_level(asked: tuple[int, int]) -> None:
    # After a change of generator or solver that is meant, `python3 tools/dev.py golden` writes the table again.
    assert generated_digest(*asked) == read_generated()["{} {}".format(*asked)]


@pytest.mark.parametrize("asked", the_rest_is_slow([(11, 1), (12, 4), (13, 8)], 1))
def test_the_certificate_passes_the_level_and_gives_its_difficulty(asked: tuple[int, int]) -> None:
    level = made(*asked)
    run = run_level(level.named.level, level.run.inputs, memory="plain")
    assert (run.outcome, run.end_tick) == ("exit", level.run.end_tick)
    assert level.difficulty == round(difficulty(level.named.level, level.run.inputs, tries=SMALL.tries), 2)
    assert level_warnings(level.named.level) == []


@pytest.mark.slow
def test_what_is_asked_for_changes_how_hard_it_is() -> None:
    easy = mean(made(seed, 1).difficulty for seed in range(3))
    hard = mean(made(seed, 8).difficulty for seed in range(3))
    assert easy < 3 < hard


def test_a_search_that_is_stopped_gives_nothing() -> None:
    stop = Event()
    stop.set()
    assert generate(1, 5, stop=stop) is None


def command(*words: str | Path) -> Result:
    """`ninja-game generate WORDS…`."""
    return CliRunner().invoke(cli, ["generate", *map(str, words)])


@pytest.fixture(autouse=True)
def small_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.generator.generate.DEFAULT", SMALL)


def test_the_command_writes_level_and_certificate(tmp_path: Path) -> None:
    level, replay = tmp_path / "level.txt", tmp_path / "level.replay.txt"
    result = command("--seed", "4", "--difficulty", "2", "-o", level, "--replay", replay)
    assert result.exit_code == 0, result.output
    (named,) = load_levels(level)
    assert named.name in result.stdout
    assert named.author == "ninja-game generate"
    (recording,) = load_replays(replay, level=named.level)
    assert run_level(named.level, recording.inputs).outcome == "exit"


@pytest.mark.slow
def test_without_a_name_nothing_is_overwritten(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for _ in range(2):
        assert command("--seed", "4", "--difficulty", "2").exit_code == 0
    first, second = sorted(tmp_path.iterdir(), key=lambda path: len(path.name))
    assert second.name == f"{first.stem}-2.txt"
    assert first.read_text("utf-8") == second.read_text("utf-8")


@pytest.mark.parametrize(
    "words, problem",
    [
        (["--difficulty", "11"], "difficulty"),
        (["--seed", "-1"], "seed"),
        (["-o", "nowhere/level.txt"], "nowhere"),
        (["-o", "one.txt", "--replay", "one.txt"], "one file"),
    ],
)
def test_bad_input_is_reported(words: list[str], problem: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("ninja_game.generator.generate.compose", pytest.fail)  # before any work is done
    result = command(*words)
    assert result.exit_code == 2
    assert problem in result.stderr


def test_a_seed_without_a_level_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.generator.generate.DEFAULT", Effort(attempts=0))
    result = command("--seed", "4")
    assert result.exit_code == 1
    assert "try another" in result.stdout
