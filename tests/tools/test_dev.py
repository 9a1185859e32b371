"""The door for a bare Python, and the other doors: what a command installs, and that no folder is imported from."""

import os
import re
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

from ninja_game.cli.commands import COMMANDS
from tools import ROOT, dev

MODULES = ("click", "json", "numba", "numpy", "pathlib", "rich", "socket", "tomllib")
LEVEL = str(ROOT / "levels" / "00-0-first-steps.txt")


@pytest.fixture
def poisoned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, in which files have the names of modules; each leaves a trace when it is run."""
    for name in MODULES:
        (tmp_path / f"{name}.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'a').write({name!r})\n", "utf-8")
    monkeypatch.delenv("PYTHONSAFEPATH", raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, ...]]:
    """What `dev.install` was asked for; nothing is installed, and this very Python is the environment's."""
    asked: list[tuple[str, ...]] = []
    monkeypatch.setattr(dev, "install", asked.append)
    monkeypatch.setattr(dev, "program", lambda name: sys.executable if name == "python" else name)
    # Otherwise the tests' own process would become the command.
    monkeypatch.setattr(dev, "become", lambda *words: subprocess.run([sys.executable, *words], check=False).returncode)
    return asked


def test_dev_runs_nothing_from_the_current_folder(
    poisoned: Path, installed: list[tuple[str, ...]], capfd: pytest.CaptureFixture[str]
) -> None:
    assert dev.main(["run", "info", LEVEL]) == 0
    assert dev.main(["tool", "doors", "--help"]) != 0  # tools are found, in their folders
    assert dev.main(["tool", "soak.inputs", "--help"]) == 0
    assert dev.main(["benchmark", "board_size", "--help"]) == 0
    assert re.findall("usage: (.*?) ", capfd.readouterr().out) == ["inputs.py", "board_size.py"]
    assert dev.main(["tool", "golden", "--help"]) == 0  # has no options, and would write files
    assert capfd.readouterr().out.startswith("Write golden digests")
    assert not (poisoned / "ran").exists()


def test_dev_itself_imports_nothing_from_the_current_folder(poisoned: Path) -> None:
    subprocess.run([sys.executable, ROOT / "tools" / "dev.py", "--help"], check=True, capture_output=True)
    assert not (poisoned / "ran").exists()


@pytest.mark.parametrize("door", ["module", "script"])
def test_the_command_runs_nothing_from_the_current_folder(poisoned: Path, door: str) -> None:
    script = Path(sysconfig.get_path("scripts")) / "ninja-game"
    if door == "script" and not script.exists():
        pytest.skip("the script ninja-game is not installed beside this Python")
    words = [sys.executable, "-m", "ninja_game"] if door == "module" else [str(script)]
    subprocess.run([*words, "info", LEVEL], check=True, capture_output=True)
    assert not (poisoned / "ran").exists()


@pytest.mark.parametrize("command", ["check", "solve", "improve", "verify", "tas"])
def test_run_installs_numba_for_whatever_may_need_it(installed: list[tuple[str, ...]], command: str) -> None:
    dev.main(["run", command, "--help"])
    assert all("fast" in names for names in installed)
    assert installed


def test_what_is_installed_is_installed_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[list[str]] = []

    def sync(names: list[str]) -> bool:
        calls.append(names)
        return True

    monkeypatch.setattr(dev, "STAMP", tmp_path / "stamp")
    monkeypatch.setattr(dev, "run", lambda *_: 0)
    monkeypatch.setattr(dev, "uv_sync", sync)
    dev.install(["cluster"])
    dev.install(["cluster"])
    dev.install(["cluster", "fast"])
    dev.install(["cluster"])
    assert calls == [["cluster"], ["cluster", "fast"]]


def test_play_and_run_install_what_their_command_uses(installed: list[tuple[str, ...]]) -> None:
    dev.main(["play", "--help"])
    dev.main(["run", "demonstrations", "--help"])
    assert installed == [(), ("fast", "learn", "minari")]
    assert all("fast" in command.extras for command in COMMANDS.values() if command.compiles)
    assert {extra for command in COMMANDS.values() for extra in command.extras} <= set(dev.DEVELOPMENT)


def test_pip_installs_the_locked_versions_where_uv_cannot_be_had(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []

    def run(*words: str) -> int:
        if words[-1] == "--version":
            return 0
        path = Path(words[words.index("-c") + 1])
        asked.extend([*words[words.index("--editable") + 1 :], *path.read_text("utf-8").split()])
        return 0

    monkeypatch.setattr(dev, "STAMP", tmp_path / "stamp")
    monkeypatch.setattr(dev, "uv_sync", lambda _names: False)
    monkeypatch.setattr(dev, "run", run)
    dev.install(())
    assert asked[0] == str(dev.ROOT)
    asked.clear()
    dev.install(dev.DEVELOPMENT)
    assert asked[0] == f"{dev.ROOT}[cluster,fast,film,learn,minari,plots,train]"
    lock = (ROOT / "uv.lock").read_text("utf-8")
    for name in ("ruff", "pillow", "pygame-ce"):
        version = lock.partition(f'name = "{name}"\nversion = "')[2].partition('"')[0]
        assert f"{name}=={version}" in asked


def test_lint_fails_with_the_names_of_what_failed(
    installed: list[tuple[str, ...]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = {"mypy", "lint-imports"}
    monkeypatch.setattr(dev, "run", lambda *words: int(words[0] in broken))
    assert dev.main(["lint"]) == 1
    assert capsys.readouterr().out == "lint: mypy, lint-imports failed\n"
    broken.clear()
    assert dev.main(["lint"]) == 0
    assert capsys.readouterr().out == "lint: all good\n"
    assert len(installed) == 2


def test_an_unknown_command_is_refused_with_the_list(capsys: pytest.CaptureFixture[str]) -> None:
    assert dev.main(["chekc"]) == 2
    captured = capsys.readouterr()
    assert "no command 'chekc'" in captured.err
    assert "change-rules" in captured.err
    assert dev.main(["--help"]) == 0
    assert "change-rules" in capsys.readouterr().out


def test_the_readme_lists_the_same_commands() -> None:
    table = (ROOT / "README.md").read_text("utf-8").partition("## Maintainers")[2]
    listed = re.findall(r"^\| `python3 tools/dev\.py (\S+?)[ `]", table, re.MULTILINE)
    assert sorted(listed) == sorted(re.findall(r"^  (\S+)  ", dev.__doc__ or "", re.MULTILINE))


def test_old_pythons_are_shown_what_is_needed() -> None:
    source = (ROOT / "tools" / "dev.py").read_text("utf-8")
    # The check stands before anything that a Python of those days could trip over when it runs.
    assert source.index("sys.version_info < (3, 11)") < source.index("\nimport hashlib")


@pytest.mark.skipif(sys.platform == "win32", reason="no process takes another's place there")
def test_signals_and_exit_codes_are_those_of_the_command() -> None:
    program = "import sys; from tools import dev; dev.program = lambda _: sys.executable; dev.become('-c', CODE)"
    for code, expected in (("import sys; sys.exit(3)", 3), ("import os; os.kill(os.getpid(), 15)", -15)):
        done = subprocess.run([sys.executable, "-c", program.replace("CODE", repr(code))], cwd=ROOT, check=False)
        assert done.returncode == expected


def test_a_test_whose_worker_crashed_has_failed_and_is_run_again_alone(tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text("from tests.conftest import pytest_handlecrashitem\n", "utf-8")
    (tmp_path / "pytest.ini").write_text("[pytest]\n", "utf-8")
    (tmp_path / "test_crash.py").write_text(
        "import os\n"
        "def test_dies_beside_others(): 'PYTEST_XDIST_WORKER' in os.environ and os._exit(9)\n"
        "def test_dies(): os._exit(8)\n"
        "def test_fails(): assert False\n",
        "utf-8",
    )
    words = [sys.executable, "-m", "pytest", "-n", "1", "-p", "no:cacheprovider"]
    alone = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    alone["PYTHONPATH"] = str(ROOT)
    ended = subprocess.run(words, cwd=tmp_path, env=alone, capture_output=True, text=True, check=False)
    assert ended.returncode == 1
    trace = "; Python's trace of it stands above). Alone it"
    assert f"::test_dies_beside_others' (exit code 9{trace} passed" in ended.stdout
    assert f"::test_dies' (exit code 8{trace} did NOT pass" in ended.stdout
    assert "3 failed in" in ended.stdout


def test_the_end_of_the_tests_says_which_were_skipped_and_why(tmp_path: Path) -> None:
    (tmp_path / "conftest.py").write_text("from tests.conftest import pytest_terminal_summary\n", "utf-8")
    (tmp_path / "pytest.ini").write_text("[pytest]\n", "utf-8")
    skips = "import pytest\n@pytest.mark.parametrize('n', [1, 2])\ndef test_page(n): pytest.skip('no Chromium')\n"
    (tmp_path / "test_a.py").write_text(skips, "utf-8")
    (tmp_path / "test_b.py").write_text("import pytest\npytest.skip('no Node', allow_module_level=True)\n", "utf-8")
    words = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-ra"]
    alone = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    alone["PYTHONPATH"] = str(ROOT)
    ended = subprocess.run(words, cwd=tmp_path, env=alone, capture_output=True, text=True, check=False)
    assert ended.returncode == 0
    *_, heading, node, chromium, _ = ended.stdout.splitlines()
    assert "! NOT RUN HERE: 3 tests or files of tests !" in heading
    assert [node, chromium] == ["1 skipped, 'no Node': test_b.py", "2 skipped, 'no Chromium': test_a.py"]
