#!/usr/bin/env python3
"""Everything a developer does, with nothing but Python: `python3 tools/dev.py --help`.

Makes `.venv` beside this folder, installs the project there with what the command needs, and runs the command in it.
Standard library only, since it runs before anything is installed; works from any folder.
"""

import sys

if sys.version_info < (3, 11):  # noqa: UP036 - the one file that an older Python may meet
    sys.exit(f"tools/dev.py: Python 3.11 or newer is needed, this is {sys.version.split()[0]} ({sys.executable}).")

import hashlib
import json
import os
import shutil
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / ".venv"
STAMP = VENV / "ninja-game-install.json"
CACHES = (".pytest_cache", ".mypy_cache", ".ruff_cache", ".import_linter_cache", ".hypothesis", "build", "dist")
SOURCES = ("ninja_game", "tests", "tools", "benchmarks")
DEVELOPMENT = ("cluster", "dev", "fast", "film", "plots")


def fail(message: str) -> int:
    """Exit code 2, after the message on stderr."""
    print(f"tools/dev.py: {message}", file=sys.stderr)
    return 2


# --- the environment ------------------------------------------------------------------------------------------


def venv_script(name: str) -> Path:
    """Path of a program inside the virtual environment, as this system lays it out."""
    return VENV / ("Scripts" if os.name == "nt" else "bin") / (f"{name}.exe" if os.name == "nt" else name)


def make_venv() -> None:
    """A working `.venv`; a half-made one, or one whose Python has gone, is made anew."""
    python = venv_script("python")
    if (
        python.exists()
        and subprocess.run([str(python), "-m", "pip", "--version"], capture_output=True, check=False).returncode == 0
    ):
        return
    try:
        import ensurepip  # noqa: F401
        import venv
    except ImportError as missing:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        raise SystemExit(
            fail(
                f"this Python comes without its module {missing.name!r}, which makes virtual environments.\n"
                f"  Debian, Ubuntu: sudo apt-get install python{version}-venv\n"
                "  or run this script with a Python from python.org, Homebrew, pyenv or uv."
            )
        ) from None
    print(f"Making {VENV} with Python {sys.version.split()[0]} …", flush=True)
    venv.EnvBuilder(with_pip=True, clear=True, symlinks=os.name != "nt").create(VENV)


def installed() -> tuple[str, set[str]]:
    """Digest of the pyproject.toml that was installed last, and the extras that came with it."""
    try:
        stamp = json.loads(STAMP.read_text("utf-8"))
        return str(stamp["pyproject"]), set(stamp["extras"])
    except (OSError, ValueError, KeyError, TypeError):
        return "", set()


def install(needed: Sequence[str]) -> None:
    """The project, editable, with the extras ``needed``; nothing to do while pyproject.toml is the one installed."""
    digest = hashlib.sha256((ROOT / "pyproject.toml").read_bytes()).hexdigest()
    before, extras = installed()
    if before == digest and extras.issuperset(needed):
        return
    make_venv()
    extras |= set(needed)
    print(f"Installing ninja-game{sorted(extras) or ''} into {VENV} …", flush=True)
    if not pip_install(extras):
        # The newest Python may be too new for Numba; everything but speed works without it.
        if "fast" not in extras or not pip_install(extras - {"fast"}):
            raise SystemExit(fail("pip could not install the project; its own message stands above."))
        print("Numba cannot be installed here: going on without the compiled memory.", file=sys.stderr)
    STAMP.write_text(json.dumps({"pyproject": digest, "extras": sorted(extras)}) + "\n", "utf-8")


def pip_install(extras: set[str]) -> bool:
    """Whether pip could install the project with these extras."""
    what = f"{ROOT}[{','.join(sorted(extras))}]" if extras else str(ROOT)
    pip = [str(venv_script("python")), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    return subprocess.run([*pip, "--editable", what], check=False).returncode == 0


def run(*words: str | Path, cwd: Path | None = ROOT) -> int:
    """Exit code of a command; its output goes where ours goes."""
    sys.stdout.flush()
    try:
        return subprocess.run([str(word) for word in words], cwd=cwd, check=False).returncode
    except KeyboardInterrupt:
        return 130


def ninja_game(*words: str) -> int:
    """Exit code of `ninja-game WORDS…`, started in the folder the user is in."""
    return run(venv_script("python"), "-m", "ninja_game", *words, cwd=None)


# --- the commands ---------------------------------------------------------------------------------------------


def play(rest: Sequence[str]) -> int:
    """The game, in a window. Words after `play` go to `ninja-game play`."""
    install(())
    return ninja_game("play", *rest)


def check(rest: Sequence[str] = ()) -> int:
    """Lint, format, types and the import contract; `check --fix` mends what can be mended by a program."""
    install(DEVELOPMENT)
    sources = [name for name in SOURCES if any((ROOT / name).rglob("*.py"))]
    fix = "--fix" in rest
    steps = {
        "lint": ["ruff", "check", *(["--fix"] if fix else []), *sources],
        "format": ["ruff", "format", *([] if fix else ["--check"]), *sources],
        "types": ["mypy"],
        "import contract": ["lint-imports", "--no-cache", "--no-logo"],
    }
    failed = []
    for name, (program, *words) in steps.items():
        print(f"--- {name}", flush=True)
        if run(venv_script(program), *words):
            failed.append(name)
    print(f"check: {', '.join(failed)} failed" if failed else "check: all good", flush=True)
    return 1 if failed else 0


def test(rest: Sequence[str]) -> int:
    """`check`, then the tests on all cores. With words of your own (a file, `-k NAME`) pytest alone, with them."""
    install(DEVELOPMENT)
    if rest:
        return run(venv_script("python"), "-m", "pytest", *rest)
    unchecked = check()
    print("--- tests", flush=True)
    workers = str(min(4, os.cpu_count() or 1))
    code = run(venv_script("python"), "-m", "pytest", "-n", workers, "--dist", "worksteal")
    if unchecked:
        print("tools/dev.py: `check` failed, its messages stand above the tests.", file=sys.stderr)
    return code or unchecked


def bench(rest: Sequence[str]) -> int:
    """How fast the world runs here. Words after `bench` go to `ninja-game bench`."""
    install(DEVELOPMENT)
    return ninja_game("bench", *rest)


def docs(rest: Sequence[str]) -> int:
    """Draw the pictures of docs/ anew: runs tools/draw_*.py."""
    install(DEVELOPMENT)
    scripts = sorted((ROOT / "tools").glob("draw_*.py"))
    return max([run(venv_script("python"), script, *rest) for script in scripts], default=0)


def golden(rest: Sequence[str]) -> int:
    """Write the golden digests of tests/golden anew, after a change that is meant to change the world."""
    install(DEVELOPMENT)
    return run(venv_script("python"), ROOT / "tools" / "golden.py", *rest)


def change_rules(rest: Sequence[str]) -> int:
    """Test the tests: break about seventy rules, one at a time, and tell which breaks no test notices."""
    install(DEVELOPMENT)
    return run(venv_script("python"), ROOT / "tools" / "change_rules.py", *rest)


def run_ninja_game(rest: Sequence[str]) -> int:
    """Any `ninja-game` command: `run info levels/first.txt`."""
    install(())
    return ninja_game(*rest)


def clean(_rest: Sequence[str]) -> int:
    """Remove .venv, caches and build products."""
    folders = [VENV, *(ROOT / name for name in CACHES), *ROOT.glob("*.egg-info")]
    folders += [folder for name in SOURCES for folder in (ROOT / name).rglob("__pycache__")]
    for folder in folders:
        shutil.rmtree(folder, ignore_errors=True)
    return 0


COMMANDS: dict[str, Callable[[Sequence[str]], int]] = {
    "play": play,
    "test": test,
    "check": check,
    "bench": bench,
    "docs": docs,
    "golden": golden,
    "change-rules": change_rules,
    "run": run_ninja_game,
    "clean": clean,
}


def describe(name: str) -> str:
    """What command ``name`` does, wrapped as in its docstring."""
    return "\n".join(line.strip() for line in (COMMANDS[name].__doc__ or "").strip().splitlines())


def main(words: Sequence[str]) -> int:
    """Exit code of the command that ``words`` name; what follows the name is the command's own."""
    name, rest = (words[0], words[1:]) if words else ("", ())
    if name in COMMANDS and rest and rest[0] in ("-h", "--help") and name != "run":
        print(f"usage: tools/dev.py {name} …\n\n{describe(name)}")
        return 0
    if name in COMMANDS:
        return COMMANDS[name](rest)
    table = "\n".join(f"  {name:<13} {describe(name).splitlines()[0]}" for name in COMMANDS)
    overview = f"usage: tools/dev.py COMMAND …\n\n{(__doc__ or '').strip()}\n\n{table}"
    if name in ("", "-h", "--help", "help"):
        print(overview)
        return 0 if name else 2
    print(overview, file=sys.stderr)
    return fail(f"there is no command {name!r}.")


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
