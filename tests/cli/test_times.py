"""A run has one length and one time, whoever tells it."""

from pathlib import Path

from click.testing import CliRunner

from ninja_game.cli.main import cli
from tests.support.samples import WALK, WALK_END, replay_of_walk, unclaimed_text

SECONDS = "0.575 s"


def output_of(*words: object) -> str:
    result = CliRunner().invoke(cli, [*map(str, words)])
    assert result.exit_code == 0, result.output
    return result.stdout


def test_all_commands_tell_the_same_time_of_a_run(tmp_path: Path) -> None:
    run, other, idea = (tmp_path / name for name in ("run.replay.txt", "other.replay.txt", "idea.inputs.txt"))
    run.write_text(replay_of_walk(author="Ann"), "utf-8")
    idea.write_text(unclaimed_text(WALK, "R*40"), "utf-8")
    assert f"exit in tick {WALK_END} ({SECONDS})" in output_of("record", idea, "-o", other)
    assert f"{WALK_END} ticks ({SECONDS})" in output_of(
        "improve", run, "--ticks", "20000", "--jobs", "1", "-o", tmp_path / "x.txt"
    )
    splits = output_of("splits", run)
    assert f"exit in tick {WALK_END}, {SECONDS}" in splits
    assert f"sum of best: tick {WALK_END}, {SECONDS}" in splits
    assert f"to tick {WALK_END} at most, {SECONDS}" in output_of("info", run)
    # 90 s and two for the piece of gold, less the time
    assert "91.425" in output_of("verify", run)
