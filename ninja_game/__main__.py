"""`python -m ninja_game` is `ninja-game`."""

from __future__ import annotations

from ninja_game.cli.main import main

if __name__ == "__main__":
    main()
