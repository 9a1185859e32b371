"""The known run: what computes another one judges nothing."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from ninja_game.backend import memories, self_test
from ninja_game.backend.memories import CHECKED, Plan, compiled_available, open_worlds, proven_memory
from ninja_game.backend.self_test import DIGEST, SelfTestError, known_level, self_test_digest
from ninja_game.cli.main import cli
from ninja_game.errors import FileError
from ninja_game.runs import verify
from ninja_game.sim.kinds import VALUE_COUNTS
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.ninja import tick
from ninja_game.sim.schema.world_fields import CAPACITY
from tests.support.memories import BOTH
from tests.support.samples import WALK, WALK_END, running, write_records


@pytest.fixture
def as_at_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    """A process that has not judged anything yet."""
    monkeypatch.setattr(memories.PROCESS, "kernels", {})
    memories._prove_plain.cache_clear()


@pytest.mark.parametrize("memory", [*BOTH, pytest.param(CHECKED, marks=BOTH[1].marks)])
def test_the_known_run_has_its_digest_on_every_memory(memory: str | Plan) -> None:
    """After a change of a rule that is meant, `python3 tools/dev.py golden` writes the digest again."""
    assert self_test_digest(lambda level, box: open_worlds(memory, level, box=box)) == DIGEST


def test_the_known_run_has_every_kind_of_object() -> None:
    assert {spec.kind for spec in known_level().objects} == set(range(len(VALUE_COUNTS)))


@pytest.mark.usefixtures("as_at_the_start")
def test_a_broken_rule_is_noticed_before_anything_is_judged(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tick, "WALL_PROBE", 0.2)
    with pytest.raises(SelfTestError, match="the plain memory does not compute the world of N here"):
        proven_memory("plain")


@pytest.mark.usefixtures("as_at_the_start")
@pytest.mark.parametrize("memory", BOTH)
@pytest.mark.parametrize("word", ["verify", "trace"])
def test_a_command_that_cannot_be_sure_says_so_and_ends(
    word: str, memory: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if (word, memory) == ("trace", "plain"):
        pytest.skip("nothing is proved for a trace by plain Python")
    monkeypatch.setattr(self_test, "DIGEST", "0" * 64)
    path = write_records(tmp_path / "walk.txt", *[("Walk", WALK, running(WALK_END))] * 3)
    result = CliRunner().invoke(cli, [word, str(path), "--memory", memory])
    assert result.exit_code == 2
    assert f"the {memory} memory does not compute the world of N here" in result.stderr
    assert "exit" not in result.stdout


def test_what_is_wrong_here_is_no_result_of_a_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path, log = write_records(tmp_path / "walk.txt", ("Walk", WALK, running(WALK_END))), tmp_path / "log"
    words = ["verify", str(path), "--memory", "plain", "--jobs", "1", "--resume", str(log)]

    def unusable(memory: str, work: int) -> str:
        raise FileError("the cache of compiled code has a relative path", found="rel")

    with monkeypatch.context() as here:
        here.setattr(verify, "proven_memory", unusable)
        result = CliRunner().invoke(cli, words)
    assert result.exit_code == 2
    assert "the cache of compiled code has a relative path" in result.stderr
    assert "results" not in log.read_text()
    assert CliRunner().invoke(cli, words).exit_code == 0


@pytest.mark.skipif(not compiled_available(), reason="Numba is not installed")
@pytest.mark.usefixtures("as_at_the_start")
def test_the_checked_and_the_quick_kernels_live_side_by_side() -> None:
    level = Level(objects=(ObjectSpec(5, (100.0, 100.0)),))
    quick, checked, plain = (open_worlds(memory, level, box=False) for memory in ("compiled", CHECKED, "plain"))
    keys = bytes([2] * 50)
    runs = [[bytes(memoryview(part)) for part in memory.run(keys)] for memory in (quick, checked, plain)]
    assert runs[0] == runs[1] == runs[2]
    with pytest.raises(IndexError):
        checked.observe(CAPACITY)
