"""Programs that start in no time: forks of a process that has loaded the game, and Numba where it is installed."""

import json
import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent.parent

SERVER = """
import gc, json, os, sys
from ninja_game import simulation
from ninja_game.backend import kernel_cache, memories, numba_import
from ninja_game.cli import main
from ninja_game.runs import recording_reader, verify
if memories.compiled_available():
    numba_import.import_numba()
    from numba.core.registry import cpu_target
    cpu_target.typing_context.refresh()
    cpu_target.target_context.refresh()
gc.freeze()
for line in sys.stdin:
    folder, environment, sys.argv[1:], streams, code = json.loads(line)
    if (child := os.fork()) == 0:
        break
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
else:
    sys.exit()
os.setsid()
os.chdir(folder)
os.environ.update(environment)
for number, (name, stream) in enumerate(zip(streams, ("stdin", "stdout", "stderr"), strict=True)):
    os.dup2(os.open(name, os.O_RDWR | os.O_CREAT), number)
    new = open(number, "w" if number else "r", encoding="utf-8", closefd=False)
    setattr(sys, stream, new), setattr(sys, f"__{stream}__", new)
exec(code)
"""


class Ended(NamedTuple):
    """Exit code of a program, and what it wrote."""

    code: int
    out: str
    errors: str


class WarmStart:
    """Starts programs one at a time; ``folder``: for files of its own."""

    def __init__(self, folder: Path) -> None:
        self._streams = os.devnull, str(folder / "out"), str(folder / "errors")
        pipe = subprocess.PIPE
        # A process with threads cannot be forked.
        environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
        self._server = subprocess.Popen(
            [sys.executable, "-c", SERVER], stdin=pipe, stdout=pipe, text=True, env=environment
        )

    def run(
        self,
        code: str,
        words: Sequence[str] = (),
        folder: Path = ROOT,
        environment: Mapping[str, str] = MappingProxyType({}),
        terminal: str = "",
    ) -> Ended:
        """Let a program run in a folder until it ends. ``terminal``: the name of one that is all its streams."""
        for name in self._streams[1:]:
            Path(name).write_bytes(b"")
        about = [str(folder), dict(environment), words, [terminal] * 3 if terminal else self._streams, code]
        assert self._server.stdin
        assert self._server.stdout
        print(json.dumps(about), file=self._server.stdin, flush=True)
        ended = int(self._server.stdout.readline())
        return Ended(ended, *(Path(name).read_text("utf-8") for name in self._streams[1:]))

    def close(self) -> None:
        self._server.communicate()
