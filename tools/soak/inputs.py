"""Feed odd inputs to every entry point, which reads untrusted data: only our own errors may come out, in bounded work.

    python3 tools/dev.py tool soak.inputs --texts 1000000
    python3 tools/dev.py tool soak.inputs --coverage --minutes 480 --findings found --corpus kept
    python3 tools/dev.py tool soak.inputs --entry "pack zip" --read found/pack-zip-1f2e3d4c

The entry points are in `input_table.py`. With ``--coverage`` inputs that reach new code are mutated further, and kept
in the folder ``--corpus``. Exit code 0: nothing found; 1: something was; each finding is a file of ``--findings``,
printed with its traceback and what repeats it.
"""

import argparse
import faulthandler
import os
import random
import shutil
import signal
import sys
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterator
from functools import partial
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NoReturn

from coverage import Coverage

from tools import ROOT
from tools.soak.input_table import ENTRY_POINTS, errors_of
from tools.soak.mutators import mutated

SLOW_S, HANGS_S = 2.0, 20.0
"""Processor time of an input that is a finding, and after which its reading is ended; a busy machine does not count."""
WATCHED = 5  # how much longer code takes that tells where it is
MEMORY = 4 * 2**30  # of the whole process, address space

OWN = {
    "levels/*.txt": {"ascii level", "any levels", "archive"},
    "levels/certificates/*.txt": {"replay", "any recordings", "replay in a link", "run with includes"},
    "levels/*.toml": {"pack index", "pars"},
}
"""Files of the game, and the entry points that read them."""

PACKAGE = str(ROOT / "ninja_game")


class HangError(BaseException):
    """An input that took all of its processor time."""


def _end_hang(*_: object) -> NoReturn:
    raise HangError


class Trial:
    """Tries inputs on entry points. ``findings``: where what is wrong is kept; ``wrong``: how often each was seen."""

    def __init__(self, place: Path, findings: Path, slow: float) -> None:
        self.outcomes: Counter[str] = Counter()
        self.wrong: Counter[str] = Counter()
        self.slowest = 0.0, ""
        self._place, self._findings, self._slow = place / "entry", findings, slow
        self._place.mkdir()
        self.started = self._reported = time.monotonic()

    def read(self, name: str, data: bytes) -> None:
        """Let an entry point read an input."""
        outcome, problem, where = "read", "", ""
        began = time.process_time()
        signal.setitimer(signal.ITIMER_PROF, HANGS_S)
        try:
            ENTRY_POINTS[name].read(data, self._place)
        except errors_of(name) as error:
            outcome = "refused"
            str(error)
        except (Exception, HangError) as error:  # noqa: BLE001 - foreign errors are what is searched
            problem, where = traceback.format_exc(limit=-12), f"{type(error).__name__} {_line_of(error)}"
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0)
        taken = time.process_time() - began
        self.slowest = max(self.slowest, (taken, name))
        if not problem and taken > self._slow:
            problem, where = f"{taken:.1f} s of processor time", "slow"
        self.outcomes[f"{name}: {outcome if not problem else 'wrong'}"] += 1
        if problem:
            self._tell(name, data, problem, f"{name}: {where}")
        if next(os.scandir(self._place), None):
            shutil.rmtree(self._place)
            self._place.mkdir()

    def _tell(self, name: str, data: bytes, problem: str, kind: str) -> None:
        self.wrong[kind] += 1
        if self.wrong[kind] > 1:
            return
        file = self._findings / f"{name.replace(' ', '-')}-{sha256(data).hexdigest()[:8]}"
        self._findings.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data)
        print(
            f"{problem}\n{kind}\nagain: python3 tools/dev.py tool soak.inputs --entry '{name}' --read {file}\n",
            flush=True,
        )

    def tell_progress(self, seconds: float = 60) -> None:
        """Print now and then how many inputs were read."""
        if time.monotonic() - self._reported > seconds:
            self._reported = time.monotonic()
            print(f"{self.outcomes.total()} inputs, {len(self.wrong)} findings", flush=True)

    def summary(self) -> int:
        """Print what was seen; the exit code."""
        import resource  # not on Windows

        for outcome, times in sorted(self.outcomes.items()):
            print(f"{times:9d}  {outcome}")
        for kind, times in self.wrong.items():
            print(f"{times:9d}  WRONG: {kind}")
        used = resource.getrusage(resource.RUSAGE_SELF)
        print(f"slowest: {self.slowest[0]:.2f} s ({self.slowest[1]}), peak memory {used.ru_maxrss >> 10} MiB")
        seconds = used.ru_utime + used.ru_stime
        print(f"{self.outcomes.total()} inputs in {seconds:.0f} s of processor time, {len(self.wrong)} findings")
        sys.stdout.flush()
        return 1 if self.wrong else 0


def _line_of(error: BaseException) -> str:
    """The last line of ours in a traceback: findings of the same line are one."""
    ours = [each for each in traceback.extract_tb(error.__traceback__) if each.filename.startswith(PACKAGE)]
    return f"{ours[-1].filename.removeprefix(PACKAGE)}:{ours[-1].lineno}" if ours else ""


_COVERAGE = Coverage(data_file=None, include=[f"{PACKAGE}/*"], omit=[f"{PACKAGE}/sim/*"], config_file=False)


def lines_of(read: Callable[[], None]) -> set[tuple[str, int]]:
    """Which lines of the package something executes."""
    _COVERAGE.erase()
    with _COVERAGE.collect():
        read()
    seen = _COVERAGE.get_data()
    return {(file, line) for file in seen.measured_files() for line in seen.lines(file) or ()}


Pool = dict[str, list[bytes]]


def loop(trial: Trial, pool: Pool, rng: random.Random, *, grow: bool, kept: Path | None) -> Iterator[None]:
    """Read the pool, then one odd input after another.

    Where the pool grows, those that reach lines that nothing in it does join it, and are ``kept``.
    """

    def reached(name: str, data: bytes) -> set[Any]:
        if grow:
            return lines_of(partial(trial.read, name, data))
        trial.read(name, data)
        return set()

    names = [name for name in pool for _ in range(ENTRY_POINTS[name].share)]
    known = {name: set[Any]().union(*(reached(name, data) for data in inputs)) for name, inputs in pool.items()}
    while True:
        name = rng.choice(names)
        other = rng.choice(pool[name if rng.random() < 0.8 else rng.choice(names)])
        data = mutated(rng.choice(pool[name]), other, rng)
        if not (lines := reached(name, data)) <= known[name]:
            known[name] |= lines
            pool[name].append(data)
            if kept:
                (kept / sha256(name.encode() + data).hexdigest()).write_bytes(name.encode() + b"\n" + data)
        yield


def sound_inputs(names: list[str], kept: Path | None) -> Pool:
    """Inputs to mutate: tests/corpus, a folder for each entry point, our levels and runs, and those kept earlier."""
    found: Pool = {name: [] for name in names}
    for file in sorted((ROOT / "tests" / "corpus").glob("*/*")):
        found.get(file.parent.name.replace("-", " "), []).append(file.read_bytes())
    for file in sorted(kept.iterdir()) if kept and kept.is_dir() else []:
        head, _, inside = file.read_bytes().partition(b"\n")
        found.get(head.decode("latin-1"), []).append(inside)
    for place, readers in OWN.items():
        texts = [file.read_bytes() for file in sorted(ROOT.glob(place))[::9]]
        for name in found.keys() & readers:
            found[name] += texts
    return found


def options_of() -> argparse.Namespace:
    """The options of the command line."""
    parser = argparse.ArgumentParser(
        description="Feed odd inputs to the entry points; only our own errors may come out."
    )
    parser.add_argument("--texts", type=int, default=0, help="how many inputs (default: without end, or 100000)")
    parser.add_argument("--minutes", type=float, default=0, help="how long")
    parser.add_argument("--seed", type=int, default=1, help="of chance (default 1)")
    parser.add_argument("--entry", action="append", help="only this entry point; may be given again")
    parser.add_argument("--coverage", action="store_true", help="keep and mutate what reaches new code")
    parser.add_argument("--corpus", type=Path, help="folder of inputs to begin with; --coverage keeps its own there")
    parser.add_argument("--findings", type=Path, default=Path("findings"), help="folder of what is wrong (./findings)")
    parser.add_argument("--read", type=Path, help="read this one file, through the --entry")
    return parser.parse_args()


def main() -> int:
    """Fuzz, print what was found and a summary."""
    options = options_of()
    import resource  # not on Windows

    faulthandler.enable()
    warnings.simplefilter("ignore")  # two files of one name in a zip are meant
    # A hang in compiled code shows where it is; one in ours is ended.
    signal.signal(signal.SIGPROF, _end_hang)
    faulthandler.register(signal.SIGPROF, chain=True)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))
    ram = Path("/dev/shm")
    with TemporaryDirectory(dir=ram if ram.is_dir() else None) as place:
        trial = Trial(Path(place), options.findings, SLOW_S * (WATCHED if options.coverage else 1))
        if options.read:
            trial.read(options.entry[0], options.read.read_bytes())
            return trial.summary()
        wanted = [name for name in ENTRY_POINTS if name in (options.entry or ENTRY_POINTS)]
        pool = sound_inputs(wanted, options.corpus)
        texts = options.texts or (10**12 if options.minutes else 100_000)

        def over() -> bool:
            late = options.minutes and time.monotonic() - trial.started > options.minutes * 60
            return bool(late) or trial.outcomes.total() >= texts

        if options.coverage and options.corpus:
            options.corpus.mkdir(exist_ok=True)
        for _ in loop(trial, pool, random.Random(options.seed), grow=options.coverage, kept=options.corpus):
            trial.tell_progress()
            if over():
                break
        return trial.summary()


if __name__ == "__main__":
    sys.exit(main())
