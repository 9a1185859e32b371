"""Demonstrations: recordings become what an agent would have seen, done and earned."""

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from ninja_game import Recording, load_replays
from ninja_game.cli.main import cli
from ninja_game.errors import ArgumentError
from ninja_game.files.bundled import bundled_replays
from ninja_game.formats.n14.level_file import LevelRecord
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.recording import demo_recording, demo_replay
from ninja_game.learn.demonstrations import (
    Demonstration,
    UnplayableRecordingError,
    arrays,
    demonstration,
    write_minari,
    write_npz,
)
from ninja_game.learn.single import NinjaEnv
from ninja_game.sim.inputs import Demo, with_press_bits
from tests.support.reference import recordings, require_reference
from tests.support.samples import running, write_records

FLAT = parse_level_string("0" * 713 + "|5^100,566!0^130,566!11^260,564,230,564")


def recorded(keys: list[int]) -> Recording:
    return Recording(FLAT, demo_replay(Demo(bytes(keys), len(keys)), FLAT, "run"), file="runs.txt")


@pytest.mark.parametrize("path", bundled_replays()[::10], ids=lambda path: path.name)
def test_certificates_are_demonstrations_of_their_own_run(path: Path) -> None:
    recording = load_replays(path)[0]
    made = demonstration(recording)
    replay = recording.replay
    assert replay is not None
    assert (made.outcome, made.gold, len(made.rewards)) == (replay.outcome, replay.gold, replay.final_tick + 1)
    assert made.rewards.tolist() == [0.0] * replay.final_tick + [1.0]
    assert made.terminations.tolist() == [False] * replay.final_tick + [True]
    assert not made.truncations.any()


@pytest.mark.parametrize("actions", ["discrete", "buttons"])
def test_the_actions_played_again_show_and_pay_the_same(actions: str) -> None:
    recording = load_replays(bundled_replays()[0])[0]
    made = demonstration(recording, actions=actions, memory="plain")
    env = NinjaEnv(recording.level, actions=actions, frame_skip=1, memory="plain")
    seen = [env.reset()[0]]
    for action, reward in zip(made.actions, made.rewards, strict=True):
        observation, paid, *_ = env.step(action)
        seen.append(observation)
        assert paid == reward
    assert np.array_equal(np.stack(seen), np.asarray(made.observations))


def test_what_ends_before_the_exit_is_truncated_and_both_keys_are_none() -> None:
    made = demonstration(recorded([2, 3, 15, 1, 0]), memory="plain")
    assert made.actions.tolist() == [2, 1, 4, 0, 1, 1]  # a demo of N runs one tick more than it is long
    assert made.outcome == "running"
    assert made.truncations.tolist() == [False] * 5 + [True]
    assert not made.terminations.any()


def test_recordings_that_press_jump_again_while_it_is_held_are_refused() -> None:
    held = [4 + 8] + [4] * 200
    assert demonstration(recorded([0] * 3 + held), memory="plain").outcome == "running"
    with pytest.raises(UnplayableRecordingError, match=r"runs.txt: run: it presses jump again"):
        demonstration(recorded([0] * 3 + held + [4 + 8] * 3), memory="plain")
    # A press in the air, far from any wall, makes no other run.
    assert demonstration(recorded([0] * 3 + [4 + 8, 4, 4 + 8, 4]), memory="plain").outcome == "running"


def three() -> list[Demonstration]:
    return [demonstration(recorded([2] * length), memory="plain", observation="state") for length in (3, 1, 5)]


def test_arrays_have_the_steps_of_all_episodes() -> None:
    episodes = three()
    found = arrays(episodes)
    assert found["observations"].shape == found["next_observations"].shape == (12, 30)
    assert np.array_equal(found["observations"][1:4], found["next_observations"][:3])
    assert found["episode_ids"].tolist() == [0] * 4 + [1] * 2 + [2] * 6
    assert found["truncations"].nonzero()[0].tolist() == [3, 5, 11]
    assert found["names"].tolist() == ["run"] * 3
    with pytest.raises(ArgumentError, match="no demonstrations"):
        arrays([])


def test_an_npz_file_holds_the_arrays(tmp_path: Path) -> None:
    write_npz(tmp_path / "demos.npz", three())
    with np.load(tmp_path / "demos.npz") as stored:
        for name, array in arrays(three()).items():
            assert np.array_equal(stored[name], array)


def test_minari_reads_what_was_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    minari = pytest.importorskip("minari")
    episodes = three()
    write_minari("ninja/three-v0", episodes, observation="state")
    dataset = minari.load_dataset("ninja/three-v0")
    assert (dataset.total_episodes, dataset.total_steps) == (3, 12)
    for written, read in zip(episodes, dataset.iterate_episodes(), strict=True):
        for name in ("observations", "actions", "rewards", "terminations", "truncations"):
            assert np.array_equal(getattr(written, name), getattr(read, name))
    assert isinstance(dataset.recover_environment().unwrapped, NinjaEnv)
    for name in ("ninja/three-v0", "no name"):
        with pytest.raises(ArgumentError, match=name):
            write_minari(name, episodes)


def test_minaris_environment_plays_every_episode_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of several levels, by the command."""
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    minari = pytest.importorskip("minari")
    paths = [str(path) for path in bundled_replays()[:6:2]]
    words = [
        "demonstrations",
        *paths,
        "--minari",
        "ninja/several-v0",
        "--observation",
        "state",
        "--observation",
        "time",
    ]
    result = CliRunner().invoke(cli, [*words, "--memory", "plain"])
    assert result.exit_code == 0, result.output
    dataset = minari.load_dataset("ninja/several-v0")
    env = dataset.recover_environment(memory="plain")
    metadata = list(dataset.storage.get_episode_metadata(range(3)))
    assert [each["frame_skip"] for each in metadata] == [1] * 3
    assert [each["options"]["level"] for each in metadata] == [0, 1, 2]
    for each, path, described in zip(dataset.iterate_episodes(), paths, metadata, strict=True):
        assert described["level_digest"] == level_digest(load_replays(path)[0].level)
        seen = [env.reset(options=described["options"])[0]]
        for action, reward, terminated in zip(each.actions, each.rewards, each.terminations, strict=True):
            observation, *paid = env.step(action)
            assert paid[:2] == [reward, terminated]
            seen.append(observation)
        for name, array in each.observations.items():
            assert np.array_equal(array, np.stack([row[name] for row in seen]))


def test_several_parts_are_written_under_their_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MINARI_DATASETS_PATH", str(tmp_path))
    episodes = [
        demonstration(recorded([2] * length), memory="plain", observation=["state", "rays"]) for length in (3, 2)
    ]
    found = arrays(episodes)
    assert found["observations/state"].shape == (7, 30)
    assert found["next_observations/rays"].shape == (7, 16)
    minari = pytest.importorskip("minari")
    write_minari("ninja/parts-v0", episodes, observation=["state", "rays"])
    read = minari.load_dataset("ninja/parts-v0")[1].observations
    assert isinstance(episodes[1].observations, dict)
    for name, array in episodes[1].observations.items():
        assert np.array_equal(read[name], array)


def test_the_command_writes_demonstrations_and_names_what_it_leaves_out(tmp_path: Path) -> None:
    out = tmp_path / "demos.npz"
    words = ["demonstrations", str(bundled_replays()[0]), "-o", str(out), "--memory", "plain", "--actions", "buttons"]
    result = CliRunner().invoke(cli, words)
    assert result.exit_code == 0, result.output
    ticks = len(load_replays(bundled_replays()[0])[0].inputs)
    assert f"1 demonstrations, {ticks} steps, 1 to the exit" in result.stdout
    with np.load(out) as stored:
        assert stored["actions"].shape == (ticks, 3)
    for wrong in (words[:2], [*words[:3], str(tmp_path / "demos.txt")], [*words, "--observation", "smell"]):
        result = CliRunner().invoke(cli, wrong)
        assert result.exit_code == 2
        assert result.stdout == ""


def test_reference_recordings_are_demonstrations_unless_they_press_jump_again() -> None:
    require_reference()
    unplayable = []
    for row in recordings()[::40]:
        recording = demo_recording(LevelRecord(row.label, "", "", row.data, row.demo), "", parse_level_string(row.data))
        try:
            made = demonstration(recording)
        except UnplayableRecordingError:
            keys = recording.replay.playback(row.ticks)
            unplayable.append(row.row)
            assert with_press_bits(keys) != keys
        else:
            assert (made.outcome, made.gold, len(made.rewards)) == (row.outcome, row.gold, row.ticks)
    # Of all 1,108 recordings 10 are.
    assert unplayable == [760, 1000]


def test_observations_beyond_the_limit_are_refused_and_the_option_is_named(tmp_path: Path) -> None:
    path = write_records(tmp_path / "long.txt", ("Long", "0" * 713 + "|5^100,566", running(9_000)))
    words = ["demonstrations", str(path), "-o", str(tmp_path / "x.npz"), "--megabytes"]
    refused = CliRunner().invoke(cli, [*words, "1"])
    assert refused.exit_code == 2
    assert "too many observations; found 9,001 ticks of 120 bytes each; --megabytes raises the limit" in refused.stderr
    assert CliRunner().invoke(cli, [*words, "2"]).exit_code == 0


def test_without_minari_it_is_said_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ninja_game.learn.demonstrations.find_spec", lambda _: None)
    result = CliRunner().invoke(cli, ["demonstrations", str(bundled_replays()[0]), "--minari", "ninja/one-v0"])
    assert (result.exit_code, result.stdout) == (2, "")
    assert "data sets of Minari need it" in result.stderr
