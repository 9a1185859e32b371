"""Ends a command on Ctrl-C and SIGTERM: by an exception, so that it can clean up; by force if that takes too long.

Before a command begins and after it is done there is nothing to clean up, and an exception would come where nobody
catches it: a signal then ends the process at once. Python handles a signal only between two of its own instructions.
Compiled code, and threads that a leaving process waits for, can hold that up for long; a thread of ours then ends it.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

GRACE = 1.2  # seconds that a command has to end by itself after a signal

last_acts: list[Callable[[], object]] = []
"""Functions called right before the process is ended by force; modules add their own when they are loaded."""

_ENDING = (signal.SIGINT, signal.SIGTERM)

announced = threading.Event()  # the command has said itself that it was stopped; what remains may take its time

received: list[BaseException] = []
"""The exception of the first signal; Python may have lost it, or turned it into another error."""

raising = threading.Event()  # a command is at work: a signal raises an exception in it


class Terminated(BaseException):
    """SIGTERM has come."""


def end_on_signals() -> None:
    """From now on Ctrl-C and SIGTERM end this process and its workers within two seconds, whatever it is doing.

    For the main thread of a program that is ours alone; a second call does nothing.
    """
    if sys.platform == "win32" or signal.getsignal(signal.SIGTERM) is _on_signal:
        return
    # A process of Python's cleans up, silently, what a killed process shared with its workers.
    sys.warnoptions.append("ignore:resource_tracker:UserWarning")
    sys.unraisablehook = _forget_signals
    arrivals, announce = os.pipe()
    os.set_blocking(announce, False)
    for number in _ENDING:
        # Programs that a shell starts in the background ignore Ctrl-C.
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, _on_signal)
    # Written by the handler in C, also while the main thread is in compiled code.
    signal.set_wakeup_fd(announce, warn_on_full_buffer=False)
    threading.Thread(target=_end_by_force, args=(arrivals,), name="ninja-game signals", daemon=True).start()


def leave_signals() -> None:
    """From now on they end the process by themselves: a leaving Python runs nothing of ours any more."""
    for number in _ENDING:
        if signal.getsignal(number) is _on_signal:
            signal.signal(number, signal.SIG_DFL)


def _on_signal(number: int, _: object) -> None:
    """The first signal raises an exception in the command that is at work; the next ones leave it to clean up."""
    if not raising.is_set():
        _end(number)
    if not received:
        received.append(KeyboardInterrupt() if number == signal.SIGINT else Terminated())
        raise received[0]


def _forget_signals(ignored: sys.UnraisableHookArgs) -> None:
    """Say nothing of a signal that came where Python loses exceptions, nor of what fails because of it."""
    if not received:
        sys.__unraisablehook__(ignored)


@contextmanager
def signals_deferred() -> Iterator[None]:
    """Start processes in here: signals wait until it is over, and what is started never hears Ctrl-C.

    So no process is left half started. A terminal sends Ctrl-C to all processes: the one that started the others ends
    them. In another thread than the main one, where Python never deals with signals, it does nothing.
    """
    if sys.platform == "win32" or threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    handlers = {number: signal.signal(number, lambda number, _: came.append(number)) for number in _ENDING}
    # A new process has the mask of the thread that starts it.
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for signum, handler in handlers.items():
            signal.signal(signum, handler)
    for number in came:
        signal.raise_signal(number)


def _end_by_force(arrivals: int) -> None:
    """Wait for a signal that ends the program, give it time to clean up, then end it."""
    number = 0
    while number not in _ENDING:
        number = os.read(arrivals, 1)[0]
    threading.Event().wait(GRACE)
    _end(number)


def _end(number: int) -> None:
    """End this process and its workers at once; unfinished files go."""
    try:
        # A module that is not loaded has started nothing; importing it now might wait for the main thread.
        if processes := sys.modules.get("multiprocessing"):
            for child in processes.active_children():
                child.kill()
        for act in last_acts:
            act()
        if not announced.is_set():
            os.write(2, b"ninja-game: interrupted\n" if number == signal.SIGINT else b"ninja-game: terminated\n")
    finally:
        os._exit(128 + number)
