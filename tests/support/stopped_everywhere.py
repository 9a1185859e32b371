"""Run a command and stop a copy of its process at every this many function calls, from its first line to its last.

    python -m tests.support.stopped_everywhere SIGTERM EVERY WORD ...

Prints a line for each copy: how it ended, in words where that is wrong, and where it was. Nothing depends on the
clock: a copy gets the signal in the middle of its start, of an import, of its work, of its end. The command must not
write files.
"""

import mmap
import os
import re
import signal
import sys
import tempfile
from functools import partial
from typing import Any

LONGEST = 60  # seconds that a copy has, on any machine


def stop_copies(number: signal.Signals, every: int, report: int) -> None:
    """From now on stop a copy of this process at each ``every``-th call."""
    calls = 0
    this = os.getpid()

    def count(frame: Any, event: str, called: Any) -> None:
        nonlocal calls
        if event not in {"call", "c_call"} or os.getpid() != this:
            return
        calls += 1
        if calls % every == 0:
            end = _end_of_a_copy(number)
            if os.getpid() == this:
                place = f"{frame.f_code.co_filename}:{frame.f_lineno}, call {calls}"
                os.write(report, f"{end} {place}\n".encode())

    sys.setprofile(count)


def _end_of_a_copy(number: signal.Signals) -> str:
    with tempfile.TemporaryFile() as errors:
        copy = os.fork()
        if not copy:
            sys.setprofile(None)
            signal.set_wakeup_fd(-1)  # its other end is the first process's
            signal.alarm(LONGEST)
            os.dup2(errors.fileno(), 2)
            signal.raise_signal(number)
            return ""
        code = os.waitstatus_to_exitcode(os.waitpid(copy, 0)[1])
        errors.seek(0)
        text = re.sub(r"ninja-game: [\d,]+ s: .*\n", "", errors.read().decode())
    right = code in (128 + number, -number) and text.count("\n") <= 1 and "Traceback" not in text
    return "right" if right else f"code {code} {text!r}"


def main() -> None:
    """Run the command that the arguments name."""
    number, every = signal.Signals[sys.argv[1]], int(sys.argv[2])
    sys.argv = ["ninja-game", *sys.argv[3:]]
    from ninja_game.__main__ import main as run

    # The world of a copy is its own.
    mmap.mmap = partial(mmap.mmap, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)  # type: ignore[assignment, misc]
    report = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    stop_copies(number, every, report)
    run()


if __name__ == "__main__":
    main()
