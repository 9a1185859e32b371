"""The program `ninja-game`, which is also `python -m ninja_game`."""

from __future__ import annotations

import sys


def main() -> None:
    """Listen to signals before anything else: one that comes while modules are loaded would be lost."""
    from ninja_game.signals import end_on_signals

    end_on_signals()
    from ninja_game.cli.main import main as run

    run()


if __name__ == "__main__":
    if not sys.flags.safe_path:
        # `-m` puts the current folder first on the path; nothing that lies there may be imported.
        del sys.path[0]
    main()
