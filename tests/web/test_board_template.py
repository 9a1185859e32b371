"""The template of a board from end to end, in two clones: submit, gate, check, merge, publish, contest, withdraw."""

import json
import os
import re
import shutil
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from ninja_game.backend.kernel_cache import code_folder
from ninja_game.files.bundled import bundled_replays

TEMPLATE = Path("docs/board-template")
FIRST_LEVEL = "00-0"


def shell_of(step: str) -> str:
    """The shell of a step of the workflow, by its name or by how its command begins."""
    text = (TEMPLATE / ".github" / "workflows" / "board.yml").read_text("utf-8")
    if command := re.search(rf"- run: ({re.escape(step)}.*)", text):
        return command[1]
    found = text.partition(f"- name: {step}\n")[2].partition("      - ")[0].partition("run: |\n")[2]
    assert found, step
    return textwrap.dedent(found)


class Clone:
    """A clone of the board's repository, in which the steps of the workflow run."""

    def __init__(self, folder: Path, origin: Path) -> None:
        self.folder = folder
        self.temp = folder.with_name(f"{folder.name}-temp")
        self.temp.mkdir()
        tool = self.temp / "ninja-game"
        tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m ninja_game "$@"\n', "utf-8")
        tool.chmod(0o755)
        self.environment = os.environ | {
            "GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull, "BASE": "origin/main",
            "RUNNER_TEMP": str(self.temp), "GITHUB_STEP_SUMMARY": str(self.temp / "summary.md"),
            "PATH": f"{self.temp}{os.pathsep}{os.environ['PATH']}", "XDG_CACHE_HOME": str(self.temp / "cache"),
            "NUMBA_CACHE_DIR": str(code_folder()), "PYTHONPATH": str(Path.cwd()), "LC_ALL": "C",
        }  # fmt: skip
        subprocess.run(["git", "clone", "-q", str(origin), str(folder)], check=True, env=self.environment)
        self.git("config", "user.name", folder.name)
        self.git("config", "user.email", f"{folder.name}@example.org")

    def git(self, *words: str) -> str:
        command = ["git", "-C", str(self.folder), *words]
        return subprocess.run(command, check=True, env=self.environment, capture_output=True, text=True).stdout

    def run(self, step: str) -> tuple[bool, str]:
        """Whether a step of the workflow goes well, and what it says."""
        words = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", shell_of(step)]
        done = subprocess.run(
            words, cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False, timeout=300
        )
        return done.returncode == 0, done.stdout + done.stderr

    def submits(self, name: str, text: str) -> tuple[bool, str]:
        """A branch with a file, as it comes from a fork: whether the checks of a pull request pass, and the report."""
        self.git("fetch", "-q")
        self.git("checkout", "-q", "-B", "change", "origin/main")
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "a run")
        self.git("push", "-q", "-f", "origin", "change")
        passed, output = self.run("Only runs are changed")
        return self.run("What this does to the board") if passed else (False, output)

    def publishes(self, *before: tuple[str, ...]) -> dict[str, dict[str, object]]:
        """What the keeper does, then the steps that a push to main runs; the ledger's runs after it, by file."""
        self.git("checkout", "-q", "main")
        self.git("pull", "-q", "--no-edit", "origin", "main")
        self.git("fetch", "-q")
        for words in before:
            self.git(*words)
        self.git("push", "-q", "origin", "main")
        for step in ("ninja-game board", "Keep the board as data, for the next check"):
            passed, output = self.run(step)
            assert passed, output
        return {row["file"]: row for row in json.loads(self.git("show", "origin/main:board.json"))["runs"]}

    def page(self, name: str) -> str:
        return (self.folder / "public" / "board" / name).read_text("utf-8")


@pytest.fixture
def clones(tmp_path: Path) -> tuple[Clone, Clone]:
    """The keeper's clone and a player's."""
    origin = tmp_path / "origin"
    shutil.copytree(TEMPLATE, tmp_path / "first")
    for words in (["init", "-q", "-b", "main"], ["add", "-A"], ["commit", "-q", "-m", "The template"]):
        person = ["-c", "user.name=me", "-c", "user.email=me@example.org"]
        subprocess.run(["git", "-C", str(tmp_path / "first"), *person, *words], check=True)
    subprocess.run(["git", "clone", "-q", "--bare", str(tmp_path / "first"), str(origin)], check=True)
    return Clone(tmp_path / "keeper", origin), Clone(tmp_path / "player", origin)


def certificate(kind: str, author: str) -> str:
    """A run of the first level by somebody."""
    (path,) = (each for each in bundled_replays() if each.name.startswith(FIRST_LEVEL) and f".{kind}." in each.name)
    lines = [line for line in path.read_text("utf-8").splitlines() if not line.startswith(("author:", "made:"))]
    return "\n".join([lines[0], f"author: {author}", "made: played", *lines[1:]]) + "\n"


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("git") or not shutil.which("bash"), reason="git and bash are not here")
def test_a_board_lives_in_a_repository(clones: tuple[Clone, Clone]) -> None:
    keeper, player = clones
    merge = ("merge", "-q", "--no-edit", "origin/change")
    passed, report = player.submits("replays/ann/one.txt", certificate("gold", "Ann"))
    assert passed, report
    assert report.count("new: ann/one.txt: Ann passes") == 1
    assert list(keeper.publishes(merge)) == ["ann/one.txt"]
    assert ">Ann</a>" in keeper.page("index.html")

    passed, report = player.submits("replays/eve/one.txt", certificate("gold", "Eve"))
    assert (passed, "copy: eve/one.txt: a copy of the run by Ann in ann/one.txt" in report) == (False, True), report
    passed, report = player.submits("replays/eve/two.txt", certificate("exit", "Eve").replace("gold: ", "gold: 9"))
    assert (passed, "refused: eve/two.txt" in report) == (False, True), report
    for name in ("board.toml", "board.json", ".cache/ninja-game/board/runs-0.json", "replays/eve/runs-0.json"):
        assert not player.submits(name, "{}")[0], name

    passed, report = player.submits("replays/bob/one.txt", certificate("exit", "Bob"))
    assert (passed, "Any %: place 1 of 2" in report) == (True, True), report
    ledger = keeper.publishes(merge)
    assert list(ledger) == ["ann/one.txt", "bob/one.txt"]
    level = next(path.name for path in (keeper.folder / "public/board/levels").glob("*-runs.html")).replace("-runs", "")
    fell = keeper.page(f"levels/{level}").partition("How the record fell")[2].partition("</table>")[0]
    assert (fell.count("<tr>"), ">Bob</a>" in fell, ">Ann</a>" in fell) == (3, True, True), "the record is contested"
    assert keeper.page("feed.xml").count("<entry>") == 2

    after = keeper.publishes(("rm", "-q", "replays/bob/one.txt"), ("commit", "-q", "-m", "Bob withdraws a run"))
    assert after == {"ann/one.txt": ledger["ann/one.txt"]}, "the others keep their dates"
    passed, report = player.submits("replays/eve/three.txt", certificate("exit", "Eve"))
    assert (passed, "a copy of an earlier run by Bob" in report) == (False, True), report
    assert ">Bob</a>" not in keeper.page("index.html") + keeper.page(f"levels/{level}")
    assert len(list((keeper.folder / "public" / "replays").glob("*.txt"))) == 1, "the run itself is gone from the pages"
