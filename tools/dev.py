#!/usr/bin/env python3
"""Begins with a bare Python: installs what a command needs into `.venv` and runs it there.

usage: python3 tools/dev.py COMMAND ...

  play             the game, in a window; words after it go to `ninja-game play`
  run              any `ninja-game` command: `run info levels/00-0-first-steps.txt`
  test             `lint`, then the tests; `test --all`: those too that are slow and rarely fail; with words of your own
                   (a file, `-k NAME`) pytest alone, with them
  lint             style, format, types, import contract, names; `lint --fix` mends what a program can mend
  benchmark        measure how fast the world is on this machine; `benchmark --help` lists options; `benchmark page`:
                   another script of benchmarks/
  golden           write the golden files of the tests again, after a change of the rules that is meant
  change-rules     test the tests: break the rules one at a time and tell which breaks no test notices
  accept-pictures  record the screens, pictures and messages of the tests again, after a change that is meant
  release          build and try what a release has, into dist/: docs/releasing.md; `release --help` lists options
  docs             draw the pictures of docs/ again
  tool             any script of tools/, listed in docs/tools.md: `tool soak.kills --kills 10`
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
import runpy
import shutil
import subprocess
import tomllib
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
STAMP = VENV / "ninja-game-installed.txt"
MADE = (".pytest_cache", ".mypy_cache", ".ruff_cache", ".import_linter_cache", ".hypothesis", "build", "dist")
DEVELOPMENT = ("cluster", "dev", "fast", "film", "learn", "minari", "plots", "train")
COMMANDS = runpy.run_path(str(ROOT / "ninja_game" / "cli" / "commands.py"))["COMMANDS"]
PROGRAMS = {
    "benchmark": ("benchmarks",),
    "golden": ("tools.golden",),
    "release": ("tools.release",),
    "change-rules": ("tools.breaks", "--rules"),
}
DRAWINGS = ("draw.how_it_works", "draw.screens")
LINT = (("ruff", "check"), ("ruff", "format", "--check"), ("mypy",), ("lint-imports",), ("python", "-m", "tools.lint"))
FIX = (("ruff", "check", "--fix"), ("ruff", "format"), *LINT[2:])
CORES = str(min(4, 1 + (os.cpu_count() or 1)))


def program(name: str) -> str:
    """Path of a program in the virtual environment, as this system lays it out."""
    return str(VENV / ("Scripts" if os.name == "nt" else "bin") / (f"{name}.exe" if os.name == "nt" else name))


def run(*words: str) -> int:
    """Exit code of a program of the environment. An interrupt reaches it too, and it ends as it does."""
    # The report of a crashed worker stands beside its test.
    errors = subprocess.STDOUT if "pytest" in words else None
    process = subprocess.Popen([program(words[0]), *words[1:]], cwd=ROOT, stderr=errors)
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


def install(names: Sequence[str]) -> None:
    """The project, editable, with these extras and groups; nothing to do while those of this lock are there."""
    digest = hashlib.sha256((ROOT / "pyproject.toml").read_bytes() + (ROOT / "uv.lock").read_bytes()).hexdigest()
    before = STAMP.read_text("utf-8").split() if STAMP.is_file() else []
    if before[:1] == [digest] and set(names) <= set(before):
        return
    here = Path(program("python")).exists() and run("python", "-m", "pip", "--version") == 0
    # None is there, or a half-made one, or one whose Python has gone.
    if not here and subprocess.run([sys.executable, "-m", "venv", "--clear", VENV], check=False).returncode:
        sys.exit("tools/dev.py: there is no environment without Python's modules venv and ensurepip; see above.")
    wanted = sorted({*names, *before[1:]})
    print(f"Installing ninja-game ({', '.join(wanted) or 'no extras'}) into {VENV} ...", flush=True)
    if not (uv_sync(wanted) or pip_install(wanted)):
        # The newest Python may be too new for Numba; everything but speed works without it.
        if "fast" not in wanted or not pip_install([name for name in wanted if name != "fast"]):
            sys.exit("tools/dev.py: the project could not be installed; the installer's own message stands above.")
        print("Numba cannot be installed here: going on without the compiled memory.", file=sys.stderr)
    STAMP.write_text("\n".join([digest, *wanted]) + "\n", "utf-8")


def uv_sync(names: Sequence[str]) -> bool:
    """Whether uv could install exactly the versions and files of uv.lock."""
    if not Path(program("uv")).exists() and run("python", "-m", "pip", "install", "--quiet", "uv"):
        return False
    os.environ["UV_PROJECT_ENVIRONMENT"] = str(VENV)
    words = ["uv", "sync", "--quiet", "--locked", "--inexact", "--python", program("python"), "--no-default-groups"]
    return run(*words, *(f"--{'group' if name == 'dev' else 'extra'}={name}" for name in names)) == 0


def pip_install(names: Sequence[str]) -> bool:
    """Whether pip could install the versions of uv.lock; a package with several of them is left to pip."""
    packages = tomllib.loads((ROOT / "uv.lock").read_text("utf-8"))["package"]
    several = [package["name"] for package in packages]
    exact = [
        f"{p['name']}=={p['version']}" for p in packages if "registry" in p["source"] and several.count(p["name"]) == 1
    ]
    constraints = VENV / "constraints.txt"
    constraints.write_text("\n".join(exact) + "\n", "utf-8")
    group = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["dependency-groups"]["dev"]
    tools = [name for name in group if not name.startswith("ninja-game")] if "dev" in names else []
    extras = ",".join(name for name in names if name != "dev")
    project = f"{ROOT}[{extras}]" if extras else str(ROOT)
    return run("python", "-m", "pip", "install", "--quiet", "-c", str(constraints), "--editable", project, *tools) == 0


def lint(steps: Sequence[Sequence[str]]) -> list[str]:
    """Run the checks of style, format, types and the import contract; the commands that failed."""
    return [" ".join(words) for words in steps if run(*words)]


def tool(folder: str, name: str, *rest: str) -> int:
    """A script of tools/ or benchmarks/. One without options would not read --help: its purpose is printed here."""
    script = ROOT / folder / f"{name.replace('.', '/')}.py"
    text = script.read_text("utf-8") if script.is_file() else "argparse"
    if {"-h", "--help"} & {*rest} and "argparse" not in text:
        print(ast.get_docstring(ast.parse(text)))
        return 0
    return become("-m", f"{folder}.{name}", *rest)


def main(words: Sequence[str]) -> int:
    """Exit code of the command that ``words`` name; what follows the name is the command's own."""
    # Nothing in the folder that the user is in may be imported, by what starts here or by what that starts.
    os.environ["PYTHONSAFEPATH"] = "1"
    if os.environ.pop("PYTHONDONTWRITEBYTECODE", ""):
        # Tests start Python hundreds of times; without any bytecode each imports everything from its source.
        os.environ["PYTHONPYCACHEPREFIX"] = str(VENV / "bytecode")
    name, *rest = words or ["--help"]
    if name == "play" or (name == "run" and rest):
        command = [name, *rest] if name == "play" else rest
        install(COMMANDS[command[0]].extras if command[0] in COMMANDS else ())
        return become("-m", "ninja_game", *command)
    if name == "clean":
        caches = [path for path in ROOT.rglob("__pycache__") if VENV not in path.parents]
        for folder in [VENV, *(ROOT / made for made in MADE), *ROOT.glob("*.egg-info"), *caches]:
            shutil.rmtree(folder, ignore_errors=True)
        return 0
    if name in {"test", "lint", "accept-pictures", "docs", *PROGRAMS} or (name == "tool" and rest):
        install(DEVELOPMENT)
    match name, *rest:
        case ("test",) | ("test", "--all") | ("lint",) | ("lint", "--fix"):
            chosen = [] if rest else ["-m", "not slow"]
            # While the linter runs, bytecode is made once: every process of the tests would compile everything.
            words = [program("python"), "-m", "pytest", "--collect-only", "-q"]
            quiet = subprocess.DEVNULL
            with subprocess.Popen(words, cwd=ROOT, stdout=quiet, stderr=quiet) if name == "test" else nullcontext():
                faults = lint(FIX if "--fix" in rest else LINT)
            failed = name == "test" and run("python", "-m", "pytest", "-n", CORES, "--dist", "worksteal", *chosen)
            print(f"lint: {', '.join(faults)} failed" if faults else "lint: all good", flush=True)
            return int(failed or bool(faults))
        case "test", *rest:
            return run("python", "-m", "pytest", *rest)
        case "accept-pictures", *_:
            os.environ["ACCEPT_PICTURES"] = "1"
            tests = [
                path for path in (ROOT / "tests").rglob("test_*.py") if "support.recorded" in path.read_text("utf-8")
            ]
            return run("python", "-m", "pytest", "-q", *map(str, sorted(tests)))
        case "docs", *_:
            return max(run("python", "-m", f"tools.{drawing}") for drawing in DRAWINGS)
        case "tool" | "benchmark", script, *rest if name == "tool" or (ROOT / f"benchmarks/{script}.py").is_file():
            return tool(f"{name}s", script, *rest)
        case _ if name in PROGRAMS:
            return become("-m", *PROGRAMS[name], *rest)
    asked = {name, *rest} & {"-h", "--help", "help"}
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
