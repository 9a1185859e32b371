"""docs/learning.md: its commands are run here, its Python by pytest itself; its tables tell what there is."""

import re
import shlex
from dataclasses import fields
from pathlib import Path

import pytest
from click.testing import CliRunner

from examples import bench_report, evaluate, measure, ppo
from examples.agents import LEARNED
from ninja_game.cli.main import cli
from ninja_game.files.bundled import data_folder
from ninja_game.learn import ENVIRONMENTS
from ninja_game.learn.observations.observation import PARTS
from ninja_game.learn.rewards import REWARD_TERMS

DOC = (Path(__file__).resolve().parents[2] / "docs" / "learning.md").read_text("utf-8")
UNWRAPPED = " ".join(DOC.split())
COMMANDS = [
    line
    for block in re.findall(r"^```sh\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL)
    for line in block.splitlines()
    if line.startswith(("ninja-game ", "python3 -m examples."))
]
SHORTER = {
    "levels/certificates": "levels/certificates/00-0-first-steps.exit.replay.txt",
    "test": "00-2-the-chimney",
    "50": "3",
    "100": "3",
    "1000000": "1",
    "agent.npz": str(LEARNED),
}
"""What a command of the page is run with instead, so that a test takes seconds."""


TRIED = [pytest.param(line, marks=[pytest.mark.slow] * ("examples.ppo" in line)) for line in COMMANDS]


@pytest.mark.parametrize("line", TRIED)
def test_a_command_of_the_page_does_what_it_says(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "levels").symlink_to(data_folder("levels"))
    monkeypatch.setattr(measure, "TASKS", {"bench:test:0-2": 1})
    program, *words = [SHORTER.get(word, word) for word in shlex.split(line.removeprefix("python3 -m "))]
    command = {"ninja-game": cli, "examples.ppo": ppo.main, "examples.evaluate": evaluate.main}
    command["examples.measure"] = measure.main
    result = CliRunner().invoke(command[program], words)
    assert result.exit_code == 0, result.output
    assert result.stdout


def test_the_first_agent_is_one_that_was_measured() -> None:
    """The table of ten minutes has the results of all seeds that were tried."""
    runs = bench_report.load_results(Path(__file__).resolve().parents[2] / "benchmarks" / "results" / "ninjabench")
    first, random = runs["sight", "ppo-1M"], runs["sight", "random"]
    learned = {run["training"]["level"] for run in first}
    assert learned == {option.default for option in ppo.main.params if option.name == "level"}
    passed = [100 * run["scores"]["bench:test"]["easy"]["passed"] for run in first]
    chance = bench_report.rates(random, "bench:test", "passed")[:, 0].mean() * 100
    seeds = ", ".join(f"{share:.1f}" for share in passed)
    assert (
        f"seeds 0 to {len(first) - 1} passed {seeds} % of the easy levels of the test, chance {chance:.1f} %"
        in UNWRAPPED
    )
    assert min(passed) > 1.5 * chance


def test_the_commands_of_the_protocol_are_ones_that_can_be_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results").mkdir()
    page = (Path(__file__).resolve().parents[2] / "docs" / "ninjabench.md").read_text("utf-8")
    lines = re.findall(r"^python3 -m examples\.(\w+) (.*)$", page, re.MULTILINE)
    assert {name for name, _ in lines} == {"ppo", "measure", "bench_report"}
    for name, words in lines:
        command = {"ppo": ppo.main, "measure": measure.main, "bench_report": bench_report.main}[name]
        command.make_context(name, shlex.split(words))


def test_the_page_tells_every_part_of_an_observation_with_its_arguments_and_shape() -> None:
    section = DOC.partition("## Observations")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| `\"(\w+)\"` \| `(\w+)\((.*?)\)` \| \((.*?)\) (\w+) \|", section, re.MULTILINE)
    assert {row[0] for row in rows} == set(PARTS)
    for name, kind, arguments, shape, dtype in rows:
        part = PARTS[name]()
        own = {field.name: field.default for field in fields(part) if field.name != "normalised"}
        settings = [f"{key}={'…' if isinstance(value, tuple) else repr(value)}" for key, value in own.items()]
        assert (kind, arguments) == (type(part).__name__, ", ".join(settings))
        assert (shape.strip(","), dtype) == (", ".join(map(str, part.box.shape)), str(part.box.dtype))


def test_the_page_tells_every_reward() -> None:
    section = DOC.partition("## Rewards")[2].partition("\n## ")[0]
    rows = re.findall(r"^\| `\"(\w+)\"` \| `(\w+)\(", section, re.MULTILINE)
    assert rows == [(name, term.__name__) for name, term in REWARD_TERMS.items()]


def test_the_page_tells_every_id() -> None:
    section = DOC.partition("## Ids and versions")[2].partition("\n## ")[0]
    assert set(re.findall(r"`(Ninja[\w-]*-v\d+)`", section)) == set(ENVIRONMENTS)
