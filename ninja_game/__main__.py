"""The program `ninja-game`, which is also `python -m ninja_game`."""

from __future__ import annotations

# `signal` itself imports enough for a signal to come in between.
import _signal  # type: ignore[import-not-found]
import sys


def main() -> None:
    """Let Ctrl-C end the process by itself until modules are loaded that can say so; a traceback says nothing."""
    if sys.platform != "win32":
        if _signal.getsignal(_signal.SIGINT) is _signal.default_int_handler:
            _signal.signal(_signal.SIGINT, _signal.SIG_DFL)
        # tools/dev.py starts the program so that one which comes before this line waits for it.
        _signal.pthread_sigmask(_signal.SIG_UNBLOCK, (_signal.SIGINT,))
    from ninja_game.signals import end_on_signals

    end_on_signals()
    from ninja_game.cli.main import main as run

    run()


if __name__ == "__main__":
    if not sys.flags.safe_path:
        # `-m` puts the current folder first on the path; nothing that lies there may be imported.
        del sys.path[0]
    main()
