"""`ninja-game record`, and `convert` to the forms that hold inputs only."""

import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from ninja_game import parse_replay, verify_recording
from ninja_game.cli.main import cli
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import parse_level_string
from tests.support.samples import WALK, WALK_END, running, unclaimed_text, write_records

LOOSE = unclaimed_text(WALK, "#go (R*5)*2   ; ten ticks", "R*50", headers="name: Idea\nauthor: A. Player\n")


def called(*words: str | Path) -> Result:
    return CliRunner().invoke(cli, list(map(str, words)))


@pytest.fixture
def idea(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "idea.inputs.txt"
    path.write_text(LOOSE)
    return path


def test_record_fills_in_what_comes_of_the_inputs(idea: Path) -> None:
    result = called("record", idea)
    assert result.exit_code == 0, result.output
    assert result.stdout == f"idea.replay.txt: exit in tick {WALK_END} ({WALK_END / 40:.3f} s), 1 gold\n"
    (recording,) = load_replays("idea.replay.txt")
    assert verify_recording(recording).good
    assert recording.replay is not None
    assert (recording.name, recording.author) == ("Idea", "A. Player")
    assert [marker.name for marker in recording.replay.markers] == ["go"]
    assert called("verify", "idea.replay.txt", "--strict", "--level", "idea.replay.txt").exit_code == 0


def test_record_never_replaces_what_a_person_wrote(idea: Path) -> None:
    assert called("record", idea, "-o", idea).exit_code == 2
    assert idea.read_text() == LOOSE
    assert called("record", idea).exit_code == 0
    assert called("record", idea).stdout.startswith("idea-2.replay.txt"), "the name is taken"
    assert called("record", idea, "-o", "idea.replay.txt").exit_code == 2
    assert called("record", idea, "-o", "idea.replay.txt", "--force").exit_code == 0


@pytest.mark.parametrize("header", ["rules", "body"])
def test_a_replay_that_lost_a_claim_is_recorded_again_without_the_others(idea: Path, header: str) -> None:
    called("record", idea, "-o", "run.replay.txt")
    idea.write_text(re.sub(f"^{header}:.*\n", "", Path("run.replay.txt").read_text(), flags=re.MULTILINE))
    result = called("record", idea)
    assert (result.exit_code, "take rules, outcome, gold, digest, waypoints out too" in result.stderr) == (2, True)
    lost = r"^(rules|body|outcome|gold|digest):.*\n|^waypoints:\n(  .*\n)+"
    idea.write_text(re.sub(lost, "", idea.read_text(), flags=re.MULTILINE))
    assert called("record", idea, "-o", "again.replay.txt").exit_code == 0
    assert Path("again.replay.txt").read_text() == Path("run.replay.txt").read_text()


def test_a_replay_without_a_name_gets_that_of_the_level_inside(idea: Path) -> None:
    called("record", idea, "-o", "run.replay.txt")
    text = re.sub("^name:.*\n", "", Path("run.replay.txt").read_text(), flags=re.MULTILINE)
    idea.write_text(re.sub(r"(?<=level-data:\n)(.*\n)(?:  name.*\n)?", r"\1  name: Under the Hill\n", text))
    assert called("record", idea, "-o", "named.replay.txt").output.startswith("named")
    (recording,) = load_replays("named.replay.txt")
    assert (recording.replay.name, recording.replay.level_name) == ("Under the Hill", "Under the Hill")


def test_a_replay_with_wrong_claims_is_recorded_again(idea: Path) -> None:
    called("record", idea, "-o", "run.replay.txt")
    edited = (
        Path("run.replay.txt").read_text().replace("R*24", "R*10 .*3 R*60").replace("final-tick: 23", "final-tick: 99")
    )
    Path("edited.replay.txt").write_text(edited)
    assert called("verify", "edited.replay.txt").exit_code == 1
    assert called("record", "edited.replay.txt", "-o", "new.replay.txt").exit_code == 0
    assert called("verify", "new.replay.txt").exit_code == 0
    assert parse_replay(Path("new.replay.txt").read_text()).final_tick > WALK_END


def test_a_replay_is_recorded_again_on_a_changed_level(idea: Path) -> None:
    called("record", idea, "-o", "run.replay.txt")
    changed = idea.parent / "changed.txt"
    changed.write_text(WALK.replace("115,566", "115,500"))
    result = called("record", "run.replay.txt", "--level", changed, "-o", "new.replay.txt")
    assert result.exit_code == 0, result.output
    assert result.stdout.endswith("0 gold\n")
    (recording,) = load_replays("new.replay.txt")
    assert (recording.author, recording.level) == ("A. Player", parse_level_string(changed.read_text()))
    assert verify_recording(recording).good


def test_a_loose_replay_is_verified_as_any_recording(idea: Path) -> None:
    assert called("verify", idea).exit_code == 0
    idea.write_text(LOOSE.replace("R*50", "L*50"))
    short = called("verify", idea)
    assert short.exit_code == 1
    assert "does not reach the exit" in short.stdout
    assert called("info", idea).exit_code == 0


@pytest.mark.parametrize("form, suffix", [("inputs", ".inputs.txt"), ("celeste", ".tas"), ("libtas", ".libtas.txt")])
def test_demos_go_to_inputs_of_tools_and_back(form: str, suffix: str, tmp_path: Path) -> None:
    demos = write_records(tmp_path / "demos.txt", ("Walk", WALK, running(WALK_END)))
    level = tmp_path / "level.nlevel"
    level.write_text(WALK + "\n")
    out = tmp_path / f"out{suffix}"
    result = called("convert", demos, out)
    assert result.exit_code == 0, result.output
    assert ("levels, names" in result.stderr) == (form != "inputs")
    words = ("--level", level) if form != "inputs" else ()
    back = called("convert", out, "-", "--to", "file", *words)
    assert back.exit_code == 0, back.output
    assert back.stdout.strip().split("#")[4] == running(WALK_END)
    for command in ("verify", "splits", "trace"):
        assert called(command, out, "--level", level).exit_code == 0, command


def test_an_included_file_is_sent_along_to_other_machines(idea: Path) -> None:
    from ninja_game.runs.chunks import VerifyOptions, chunks_in, self_contained, verify_chunk

    (idea.parent / "part.txt").write_text("R*50\n")
    idea.write_text(LOOSE.replace("R*50", "include part.txt"))
    (chunk,) = map(self_contained, chunks_in([idea]))
    (idea.parent / "part.txt").unlink()
    (verdict,) = verify_chunk(chunk, VerifyOptions())
    assert getattr(verdict, "outcome", verdict) == "exit"
