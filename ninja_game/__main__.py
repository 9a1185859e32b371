"""`python -m ninja_game` is `ninja-game`."""

from __future__ import annotations

import sys

if __name__ == "__main__":
    if not sys.flags.safe_path:
        # `-m` puts the current folder first on the path; nothing that lies there may be imported.
        del sys.path[0]
    from ninja_game.cli.main import main

    main()
