"""The gate of the board's template, its own shell in a real repository: only new runs come in."""

import os
import subprocess
import textwrap
from collections.abc import Callable
from pathlib import Path

import pytest

WORKFLOW = Path("docs/board-template/.github/workflows/board.yml")
RUN = "replays/ann/run.txt"


def gate() -> str:
    """The shell of the step as the workflow has it."""
    step = WORKFLOW.read_text("utf-8").partition("name: Only runs are changed")[2].partition("      - name:")[0]
    assert "shell: bash" in step
    return textwrap.dedent(step.partition("run: |\n")[2])


class Repository:
    """A repository with a board, and a branch of somebody else."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        folder.mkdir()
        self.git("init", "-q", "-b", "main")
        self.put(RUN, "a run")
        self.put(".github/workflows/board.yml", "the workflow\n" * 20)
        self.commit()
        self.git("checkout", "-q", "-b", "change")

    def git(self, *words: str) -> None:
        person = ("-c", "user.name=me", "-c", "user.email=me@example.org", "-c", "protocol.file.allow=always")
        env = os.environ | {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
        subprocess.run(["git", *person, "-C", str(self.folder), *words], check=True, capture_output=True, env=env)

    def put(self, name: str, text: str = "a new run") -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def commit(self) -> None:
        self.git("add", "-A", "-f")
        self.git("commit", "-q", "--allow-empty", "-m", "change")

    def passes(self, base: str = "main") -> bool:
        words = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", gate()]
        env = os.environ | {"BASE": base, "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull}
        return subprocess.run(words, cwd=self.folder, capture_output=True, env=env, check=False).returncode == 0


@pytest.fixture
def repository(tmp_path: Path) -> Repository:
    return Repository(tmp_path / "board")


@pytest.mark.parametrize("names", [[], ["replays/eve/a.txt"], ["replays/eve/a_b-1.2.txt", "replays/top.txt"]])
def test_new_runs_come_in(repository: Repository, names: list[str]) -> None:
    for name in names:
        repository.put(name)
    repository.commit()
    assert repository.passes()


def rename(repository: Repository, name: str) -> None:
    repository.put("replays/eve/keep.txt")
    repository.git("mv", name, "replays/eve/run.txt")


def link(repository: Repository, name: str) -> None:
    (repository.folder / name).unlink(missing_ok=True)
    (repository.folder / name).symlink_to("../../board.json")


def executable(repository: Repository) -> None:
    repository.put("replays/eve/run.txt").chmod(0o755)


def submodule(repository: Repository) -> None:
    commit = "1234567890" * 4
    repository.git("update-index", "--add", "--cacheinfo", f"160000,{commit},replays/eve/run.txt")
    repository.git("commit", "-q", "-m", "a submodule")
    repository.git("checkout", "-q", "-B", "change")


def bare(repository: Repository) -> None:
    for name in ("HEAD", "config", "objects/aa/b", "refs/heads/main"):
        repository.put(f"replays/{name}")


TRICKS: dict[str, Callable[[Repository], object]] = {
    "the workflow is renamed into a run": lambda made: rename(made, ".github/workflows/board.yml"),
    "somebody else's run is renamed": lambda made: rename(made, RUN),
    "a run is removed": lambda made: made.git("rm", "-q", RUN),
    "a run is changed": lambda made: made.put(RUN, "another"),
    "a run becomes executable": lambda made: (made.folder / RUN).chmod(0o755),
    "a new run is executable": executable,
    "a run becomes a link": lambda made: link(made, RUN),
    "a new link": lambda made: link(made, "replays/eve/run.txt"),
    "a submodule": submodule,
    "a bare repository": bare,
    "attributes": lambda made: made.put("replays/.gitattributes", "* filter=x"),
    "a hidden folder": lambda made: made.put("replays/.git2/run.txt"),
    "a device of Windows": lambda made: made.put("replays/aux/run.txt"),
    "a device's file": lambda made: made.put("replays/eve/Con.txt"),
    "a folder that ends in a dot": lambda made: made.put("replays/eve./run.txt"),
    "only capitals are other": lambda made: made.put("replays/Ann/Run.txt"),
    "a folder with other capitals": lambda made: made.put("replays/ANN/new.txt"),
    "deep folders": lambda made: made.put("replays/eve/b/run.txt"),
    "a long name": lambda made: made.put(f"replays/{'a' * 100}.txt"),
    "a hidden file": lambda made: made.put("replays/eve/.txt"),
    "a line end in a name": lambda made: made.put("replays/eve/a\nreplays/b.txt"),
    "a line end that ends like a run": lambda made: made.put("x\nreplays/b.txt"),
    "a command in a name": lambda made: made.put("replays/eve/$(touch x).txt"),
    "a wrong ending": lambda made: made.put("replays/eve/run.tas"),
    "the workflow is changed": lambda made: made.put(".github/workflows/board.yml", "nothing"),
    "a file beside the runs": lambda made: made.put("replays.txt"),
    "modules that are to be overlooked": lambda made: made.put(".gitmodules", '[submodule "x"]\n\tignore = all\n'),
}


@pytest.mark.parametrize("trick", TRICKS)
def test_nothing_else_comes_in(repository: Repository, trick: str) -> None:
    repository.put("replays/eve/good.txt")
    repository.commit()
    TRICKS[trick](repository)
    if trick != "a submodule":
        repository.commit()
    assert not repository.passes()


def test_what_cannot_be_compared_does_not_come_in(repository: Repository) -> None:
    repository.commit()
    assert not repository.passes("no-such-branch")
