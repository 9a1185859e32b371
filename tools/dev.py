#!/usr/bin/env python3
"""The door for a bare Python: installs what a command needs into `.venv` and runs it there.

usage: python3 tools/dev.py COMMAND ...

  play             the game, in a window; words after it go to `ninja-game play`
  run              any `ninja-game` command: `run info levels/00-0-first-steps.txt`
  test             `lint`, then all tests; with words of your own (a file, `-k NAME`) pytest alone, with them
  lint             style, format, types, import contract; `lint --fix` mends what a program can mend
  benchmark        measure how fast the world is on this machine; `benchmark --help` lists options
  golden           write the golden files of the tests again, after a change of the rules that is meant
  change-rules     test the tests: break the rules one at a time and tell which breaks no test notices
  accept-pictures  record the screens and pictures of the tests again, after a change of the looks that is meant
  docs             draw the pictures of docs/ again
  tool             any script of tools/, listed in docs/tools.md: `tool soak.attract_mode --minutes 1`
  clean            remove .venv, caches and build products

Versions are those of uv.lock: uv installs them, or pip where uv cannot be had. Standard library only.
"""

import sys

if sys.version_info < (3, 11):  # noqa: UP036 - the one file that an older Python may meet
    sys.exit(f"tools/dev.py: Python 3.11 or newer is needed, this is {sys.version.split()[0]} ({sys.executable}).")

import signal

if __name__ == "__main__":
    # Ctrl-C while the rest is loaded: no traceback.
    signal.signal(signal.SIGINT, signal.SIG_DFL)

import ast
import hashlib
import os
import shutil
import subprocess
import tempfile
import tomllib
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
STAMP = VENV / "ninja-game-installed.txt"
CACHES = (".pytest_cache", ".mypy_cache", ".ruff_cache", ".import_linter_cache", ".hypothesis", "build", "dist")
SOURCES = ("ninja_game", "tests", "tools", "benchmarks", "examples")
EXTRAS = ("cluster", "fast", "film", "learn", "minari", "plots", "train")
DEVELOPMENT = (*EXTRAS, "dev")
USES = {
    "play": (), "edit": ("fast",), "info": (), "convert": (), "record": (), "link": (), "player": (),
    "lab": (), "site": (), "film": ("film",), "verify": ("cluster", "fast"),
    "demonstrations": ("fast", "learn", "minari"),
}  # fmt: skip
"""The extras that commands of the game use; those that are not here use Numba."""
DRAWINGS = ("draw.how_it_works", "draw.screens")
PICTURE_TESTS = ("tests/play/test_recorded_screens.py", "tests/play/test_pictures.py", "tests/play/test_sound.py")


def program(name: str) -> str:
    """Path of a program in the virtual environment, as this system lays it out."""
    return str(VENV / ("Scripts" if os.name == "nt" else "bin") / (f"{name}.exe" if os.name == "nt" else name))


def run(*words: str) -> int:
    """Exit code of a command in the project's folder. An interrupt reaches the command too, and it ends as it does."""
    process = subprocess.Popen(words, cwd=ROOT)
    while True:
        try:
            code = process.wait()
        except KeyboardInterrupt:
            continue
        return code if code >= 0 else 128 - code


def become(*words: str) -> int:
    """Run the environment's Python in the place of this process, so that signals and exit codes are its own."""
    sys.stdout.flush()
    if os.name != "nt":
        if words[:2] == ("-m", "ninja_game"):
            # It waits until the program has begun, which lets it come; Python's own start would show a traceback.
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        os.execv(program("python"), [program("python"), *words])
    return subprocess.run([program("python"), *words], check=False).returncode


def make_environment() -> None:
    """A `.venv` with pip; a half-made one, or one whose Python has gone, is made again."""
    works = [program("python"), "-m", "pip", "--version"]
    if Path(works[0]).exists() and subprocess.run(works, capture_output=True, check=False).returncode == 0:
        return
    print(f"Making {VENV} with Python {sys.version.split()[0]} ...", flush=True)
    if run(sys.executable, "-m", "venv", "--clear", str(VENV)):
        sys.exit("tools/dev.py: there is no environment without Python's modules venv and ensurepip; see above.")


def install(names: Sequence[str]) -> None:
    """The project, editable, with these extras and groups; nothing to do while those of this lock are there."""
    digest = hashlib.sha256((ROOT / "pyproject.toml").read_bytes() + (ROOT / "uv.lock").read_bytes()).hexdigest()
    before = STAMP.read_text("utf-8").split() if STAMP.is_file() else []
    if before[:1] == [digest] and set(names) <= set(before):
        return
    make_environment()
    wanted = sorted({*names, *before[1:]})
    extras = f" with {', '.join(wanted)}" if wanted else ""
    print(f"Installing ninja-game{extras} into {VENV}; this can take a minute ...", flush=True)
    if not (uv_sync(wanted) or pip_install(wanted)):
        # The newest Python may be too new for Numba; everything but speed works without it.
        if "fast" not in wanted or not pip_install([name for name in wanted if name != "fast"]):
            sys.exit("tools/dev.py: the project could not be installed; the installer's own message stands above.")
        print("Numba cannot be installed here: going on without the compiled memory.", file=sys.stderr)
    STAMP.write_text("\n".join([digest, *wanted]) + "\n", "utf-8")


def uv_sync(names: Sequence[str]) -> bool:
    """Whether uv could install exactly the versions and files of uv.lock."""
    uv = program("uv")
    if not Path(uv).exists() and run(
        program("python"), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "uv"
    ):
        return False
    os.environ["UV_PROJECT_ENVIRONMENT"] = str(VENV)
    words = [uv, "sync", "--quiet", "--locked", "--inexact", "--python", program("python"), "--no-default-groups"]
    return run(*words, *(f"--group={name}" if name == "dev" else f"--extra={name}" for name in names)) == 0


def pip_install(names: Sequence[str]) -> bool:
    """Whether pip could install the versions of uv.lock; a package with several of them is left to pip."""
    packages = tomllib.loads((ROOT / "uv.lock").read_text("utf-8"))["package"]
    count = Counter(package["name"] for package in packages)
    exact = [f"{p['name']}=={p['version']}" for p in packages if "registry" in p["source"] and count[p["name"]] == 1]
    extras = ",".join(name for name in names if name != "dev")
    project = f"{ROOT}[{extras}]" if extras else str(ROOT)
    group = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["dependency-groups"]["dev"]
    tools = [name for name in group if not name.startswith("ninja-game")] if "dev" in names else []
    with tempfile.TemporaryDirectory() as folder:
        constraints = Path(folder) / "constraints.txt"
        constraints.write_text("\n".join(exact) + "\n", "utf-8")
        words = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--constraint", str(constraints)]
        return run(program("python"), *words, "--editable", project, *tools) == 0


def extras_of(words: Sequence[str]) -> list[str]:
    """The extras that a command of the game uses."""
    return [*USES.get(words[0] if words else "play", ("fast",))]


def lint(*fix: str) -> int:
    """Style, format, types and the import contract."""
    install(DEVELOPMENT)
    steps = [["ruff", "check", *fix], ["ruff", "format", *(() if fix else ("--check",))], ["mypy"], ["lint-imports"]]
    failed = [" ".join(words) for words in steps if run(program(words[0]), *words[1:])]
    print(f"lint: {', '.join(failed)} failed" if failed else "lint: all good", flush=True)
    return 1 if failed else 0


def test(rest: Sequence[str]) -> int:
    """`lint`, then the tests on up to four cores; or pytest alone, with ``rest``."""
    install(DEVELOPMENT)
    if rest:
        return run(program("python"), "-m", "pytest", *rest)
    unclean = lint()
    jobs = str(min(4, os.cpu_count() or 1))
    failed = run(program("python"), "-m", "pytest", "-n", jobs, "--dist", "worksteal")
    if unclean:
        print("tools/dev.py: `lint` failed, its messages stand above the tests.", file=sys.stderr)
    return failed or unclean


def tool(name: str, *rest: str) -> int:
    """A script of tools/. One without options would not read --help: what it is for is said here."""
    script = ROOT / "tools" / f"{name.replace('.', '/')}.py"
    text = script.read_text("utf-8") if script.is_file() else "argparse"
    if {"-h", "--help"} & {*rest} and "argparse" not in text:
        print(ast.get_docstring(ast.parse(text)))
        return 0
    install(DEVELOPMENT)
    return become("-m", f"tools.{name}", *rest)


def clean() -> int:
    """Remove what can be made again."""
    folders = [VENV, *(ROOT / name for name in CACHES), *ROOT.glob("*.egg-info")]
    for folder in [*folders, *(folder for name in SOURCES for folder in (ROOT / name).rglob("__pycache__"))]:
        shutil.rmtree(folder, ignore_errors=True)
    return 0


def main(words: Sequence[str]) -> int:
    """Exit code of the command that ``words`` name; what follows the name is the command's own."""
    # Nothing in the folder that the user is in may be imported, by what starts here or by what that starts.
    os.environ["PYTHONSAFEPATH"] = "1"
    match list(words):
        case ["play", *rest]:
            install(())
            return become("-m", "ninja_game", "play", *rest)
        case ["run", *rest]:
            install(extras_of(rest))
            return become("-m", "ninja_game", *rest)
        case ["test", *rest]:
            return test(rest)
        case ["lint"] | ["lint", "--fix"]:
            return lint(*words[1:])
        case [("golden" | "change-rules") as name, *rest]:
            return tool(name.replace("-", "_"), *rest)
        case ["accept-pictures"]:
            os.environ["ACCEPT_PICTURES"] = "1"
            return test(["-q", *PICTURE_TESTS])
        case ["docs"]:
            install(DEVELOPMENT)
            return max(run(program("python"), "-m", f"tools.{name}") for name in DRAWINGS)
        case ["benchmark", *rest]:
            install(DEVELOPMENT)
            return become("-m", "benchmarks", *rest)
        case ["tool", name, *rest]:
            return tool(name, *rest)
        case ["clean"]:
            return clean()
    asked = not words or "help" in words[-1] or "-h" in words
    print(__doc__, file=sys.stdout if asked else sys.stderr, end="")
    if not asked:
        print(f"tools/dev.py: there is no command {' '.join(words)!r}.", file=sys.stderr)
    return 0 if asked else 2


if __name__ == "__main__":
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
