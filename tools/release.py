"""Builds what a release consists of, from a clean clone of the last commit, and tries it: docs/releasing.md.

    python3 tools/dev.py release             # into dist/
    python3 tools/dev.py release --bump 1.0  # the version and the changelog of the next one, to be committed

The same commit gives the same bytes on the same system. Nothing is uploaded.
"""

import argparse
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterable, Sequence
from datetime import UTC, datetime
from pathlib import Path

from ninja_game import __version__
from tools.dev import ROOT, program

WORK = Path(tempfile.gettempdir()) / "ninja-game-release"  # always the same: compiled code holds the names of its files
SITE = f"ninja-game-{__version__}-site"
FROZEN = f"ninja-game-{__version__}-{sys.platform}"

KERNELS = """
from ninja_game.backend.kernel_cache import GENERIC
from ninja_game.backend.numba_import import FIXED
from ninja_game.cli.machine import compile_everything
FIXED.update(zip(("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"), GENERIC))
compile_everything(1, quiet=False)
"""
"""Compiles the kernels of all commands for any processor of the family, into NUMBA_CACHE_DIR."""

NOTES = ("direct_url.json", "uv_cache.json")  # files beside an installed package that are different each time

STARTER = """
import multiprocessing
import sys
if __name__ == "__main__":
    multiprocessing.freeze_support()
    from ninja_game.__main__ import main
    sys.argv[1:] = sys.argv[1:] or ["play"]
    main()
"""
"""What the program without a Python begins with; a double click plays."""


class Release:
    """A release under way: ``source``: a clone of the last commit, ``out``: where its files go."""

    def __init__(self, out: Path) -> None:
        shutil.rmtree(WORK, ignore_errors=True)
        self.source, self.out = WORK / "source", out
        self.epoch = int(self._said("git", "log", "-1", "--format=%ct"))
        self.environment = {
            **os.environ, "SOURCE_DATE_EPOCH": str(self.epoch), "PYTHONHASHSEED": "0", "PYTHONPATH": str(self.source),
            "NINJA_GAME_BACKGROUND_COMPILER": "0", "PYTHONSAFEPATH": "1", "SDL_VIDEODRIVER": "dummy",
            # Bytecode depends on whether other bytecode was there.
            "PYTHONPYCACHEPREFIX": str(WORK / "bytecode"),
        }  # fmt: skip
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        self._said("git", "clone", "-q", "--no-local", str(ROOT), str(self.source))

    def _said(self, *words: str, **more: str) -> str:
        """What a program prints; it and its errors end the release if it fails."""
        environment = getattr(self, "environment", os.environ) | more
        there = self.source if self.source.is_dir() else ROOT
        done = subprocess.run(words, cwd=there, env=environment, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"release: {' '.join(words)} failed:\n{done.stdout}{done.stderr}")
        return done.stdout

    def wheels(self) -> None:
        """The sources, the wheel for any system, and the one of this system and Python, with kernels."""
        self._said(program("uv"), "build", "--quiet", "--sdist", "--wheel", "--out-dir", str(self.out))
        kernels = WORK / "kernels"
        self._said(program("python"), "-c", KERNELS, NUMBA_CACHE_DIR=str(kernels))
        for lock in kernels.glob("*.lock"):
            lock.unlink()
        words = (program("uv"), "build", "--quiet", "--wheel", "--out-dir", str(self.out))
        self._said(*words, NINJA_GAME_KERNELS=str(kernels))

    def wheel(self) -> Path:
        """The wheel with kernels."""
        return next(path for path in self.out.glob("*.whl") if "-none-any" not in path.name)

    def installed(self, name: str, *groups: str) -> Path:
        """The folder of a new environment with that wheel, and what else uv.lock has for it."""
        venv, needs = WORK / name, WORK / f"{name}.txt"
        words = ("export", "--quiet", "--locked", "--no-default-groups", "--no-emit-project", "--extra=fast")
        self._said(program("uv"), *words, *(f"--group={group}" for group in groups), "--output-file", str(needs))
        self._said(program("uv"), "venv", "--quiet", "--clear", "--python", sys.executable, str(venv))
        for what in (("--require-hashes", "-r", str(needs)), ("--no-deps", str(self.wheel()))):
            python = venv / Path(program("python")).relative_to(ROOT / ".venv")
            self._said(program("uv"), "pip", "install", "--quiet", "--python", str(python), *what)
        return python.parent

    def archive(self) -> None:
        """A folder that needs no Python, packed."""
        start = WORK / "ninja-game.py"
        start.write_text(STARTER, "utf-8")
        folder = self.installed("freezing", "release")
        # What an installer notes of its own: from where the wheel came, and when.
        about = next(folder.parent.rglob("ninja_game-*.dist-info"))
        record = about / "RECORD"
        lines = record.read_text("utf-8").splitlines(keepends=True)
        record.write_text("".join(line for line in lines if not any(name in line for name in NOTES)), "utf-8")
        for name in NOTES:
            (about / name).unlink(missing_ok=True)
        metadata = (f"--copy-metadata={name}" for name in ("numba", "numpy", "ninja-game"))
        options = ("--noconfirm", "--log-level=ERROR", f"--name={FROZEN}", "--collect-all=ninja_game", *metadata)
        where = ("--distpath", str(WORK), "--workpath", str(WORK / "work"), "--specpath", str(WORK))
        self._said(str(folder / "pyinstaller"), *options, *where, str(start), PYTHONPATH="")
        self._packed(FROZEN, WORK / FROZEN)

    def site(self) -> None:
        """The page with the game, for any static host."""
        self._said(program("python"), "-m", "ninja_game", "site", str(WORK / SITE))
        self._packed(SITE, WORK / SITE)

    def _packed(self, name: str, folder: Path) -> None:
        """A folder as an archive in which time and owner are always the same."""
        files = sorted(path for path in folder.rglob("*") if path.is_file() or path.is_symlink())
        if sys.platform == "win32" or folder.name == SITE:
            moment = time.gmtime(self.epoch)[:6]
            with zipfile.ZipFile(self.out / f"{name}.zip", "w", zipfile.ZIP_DEFLATED) as packed:
                for path in files:
                    entry = zipfile.ZipInfo(f"{name}/{path.relative_to(folder).as_posix()}", moment)
                    packed.writestr(entry, path.read_bytes(), zipfile.ZIP_DEFLATED)
            return

        def plain(entry: tarfile.TarInfo) -> tarfile.TarInfo:
            entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname = self.epoch, 0, 0, "", ""
            return entry

        with tarfile.open(self.out / f"{name}.tar.xz", "w:xz") as tar:
            for path in files:
                tar.add(path, f"{name}/{path.relative_to(folder).as_posix()}", filter=plain)

    def bill(self) -> None:
        """What is inside (CycloneDX), and the checksums of all files."""
        words = ("export", "--quiet", "--locked", "--no-default-groups", "--format=cyclonedx1.5", "--all-extras")
        bill = json.loads(self._said(program("uv"), *words))
        bill["metadata"]["timestamp"] = datetime.fromtimestamp(self.epoch, UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
        bill.pop("serialNumber", None)
        (self.out / f"ninja-game-{__version__}.cdx.json").write_text(json.dumps(bill, indent=1), "utf-8")
        made = sorted(path for path in self.out.iterdir() if path.name != ".gitignore")
        sums = "".join(f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.name}\n" for path in made)
        (self.out / "SHA256SUMS").write_text(sums, "utf-8")

    def trials(self) -> None:
        """Try the wheel with kernels, with an empty cache, and the folder without a Python, with an empty PATH."""
        run = self.source / "levels" / "certificates" / "00-0-first-steps.exit.replay.txt"
        level = self.source / "levels" / "00-0-first-steps.txt"
        installed = self.installed("trying") / "ninja-game"
        for name, path in (("the wheel", installed), ("without Python", WORK / FROZEN / FROZEN)):
            if path.exists():
                for words in (
                    ("--version",), ("info", str(level)), ("verify", str(run)), ("trace", str(run), "--digests"),
                    ("solve", str(level), "--seconds", "2", "--jobs", "1", "-o", str(WORK / "found.replay.txt")),
                    ("film", str(run), "--to", "20", "-o", str(WORK / "film.gif")),
                    ("verify", "--strict", "--jobs", "2", str(run.parent)),
                ):  # fmt: skip
                    shutil.rmtree(WORK / "cache", ignore_errors=True)
                    for made in ("found.replay.txt", "film.gif"):
                        (WORK / made).unlink(missing_ok=True)
                    began = time.monotonic()
                    own = {"NUMBA_CACHE_DIR": str(WORK / "cache"), "PYTHONPATH": "", "PATH": "", "HOME": str(WORK)}
                    self._said(str(path), *words, **own)
                    compiled = len(list((WORK / "cache").glob("*.code")))
                    print(f"{name}: {words[0]:10} {time.monotonic() - began:5.2f} s, {compiled} kernels compiled")


def bump(version: str) -> None:
    """Give the package another version, and what is unreleased in the changelog its heading."""
    if not re.fullmatch(r"\d+\.\d+(\.\d+)?", version):
        sys.exit(f"release: a version such as 1.0 or 1.0.1 is expected, not {version!r}")
    today = datetime.now(UTC).date()
    for name, old, new in (
        ("ninja_game/__init__.py", f'__version__ = "{__version__}"', f'__version__ = "{version}"'),
        ("CHANGELOG.md", "## [Unreleased]\n", f"## [Unreleased]\n\n## [{version}] - {today}\n"),
    ):
        text = (ROOT / name).read_text("utf-8")
        if text.count(old) != 1:
            sys.exit(f"release: {name} has no line {old.strip()!r}")
        (ROOT / name).write_text(text.replace(old, new), "utf-8")
    print(f"{version}: look at `git diff`, then commit and build")


def main(words: Sequence[str] | None = None) -> None:
    """Build, and try what was built."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="this folder is replaced (./dist)")
    parser.add_argument("--bump", metavar="VERSION", help="set the next version, and build nothing")
    parser.add_argument("--only", choices=["wheels", "archive", "site"], help="this part, without trials")
    options = parser.parse_args(words)
    if options.bump:
        return bump(options.bump)
    release = Release(options.out.resolve())
    parts: Iterable[Callable[[], None]] = (release.wheels, release.archive, release.site, release.bill, release.trials)
    if options.only:
        parts = (release.wheels, release.archive)[: 1 + (options.only == "archive")]
    if options.only == "site":
        parts = (release.site,)
    for part in parts:
        began = time.monotonic()
        part()
        print(f"{part.__name__}: {time.monotonic() - began:.0f} s", flush=True)
    for path in sorted(options.out.iterdir()):
        print(f"{path.stat().st_size:>12,}  {path.name}")
    return None


if __name__ == "__main__":
    main()
