"""The program `ninja-game`, which is also `python -m ninja_game`."""

from __future__ import annotations

# Importing `signal` takes long enough for a signal to arrive meanwhile.
import _signal  # type: ignore[import-not-found]
import os
import sys
from contextlib import suppress


def open_missing_streams() -> None:
    """Give standard input, output and errors that were closed before the program began something to lead to.

    Else the next file that is opened would take their place, and whatever is printed be an error.
    """
    while (handle := os.open(os.devnull, os.O_RDWR)) <= 2:
        name, mode = (("stdin", "r"), ("stdout", "w"), ("stderr", "w"))[handle]
        os.set_inheritable(handle, True)
        setattr(sys, name, open(handle, mode, encoding="utf-8", closefd=False))  # noqa: SIM115
    os.close(handle)


def main() -> None:
    """Let Ctrl-C end the process without a traceback until the modules are loaded that report it in one line."""
    if sys.platform != "win32":
        if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
            _signal.signal(_signal.SIGINT, _signal.SIG_DFL)
        # tools/dev.py blocks signals before it starts the program: one that arrived early is delivered here.
        _signal.pthread_sigmask(_signal.SIG_UNBLOCK, (_signal.SIGINT,))
    open_missing_streams()
    # Child processes must not import modules from the current folder either.
    os.environ["PYTHONSAFEPATH"] = "1"
    from ninja_game.signals import end_on_signals

    end_on_signals()
    if sys.argv[1:] == ["play"]:
        # Show the first picture before the command line is loaded. An error here occurs there again, and is reported.
        with suppress(Exception):
            from ninja_game.play.window import open_at_once

            open_at_once(None)
    from ninja_game.cli.main import main as run

    run()


if __name__ == "__main__":
    if not sys.flags.safe_path:
        # `-m` puts the current folder first on the path; modules in it must not be imported.
        del sys.path[0]
    main()
