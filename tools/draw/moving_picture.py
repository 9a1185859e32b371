"""Make the moving picture at the top of the README: `python3 tools/dev.py tool draw.moving_picture`.

It is a bundled replay, exported as the game's replay viewer exports it.
"""

from __future__ import annotations

import os

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")

from ninja_game.formats.load import load_replays
from ninja_game.play.replay.film import Film, write_film
from tools import ROOT

REPLAY = ROOT / "levels" / "certificates" / "43-4-the-skull.exit.replay.txt"
PICTURE = ROOT / "docs" / "pictures" / "ninja-game.gif"

if __name__ == "__main__":
    write_film(Film(load_replays(REPLAY)[0]), PICTURE)
    print(f"{PICTURE.relative_to(ROOT)}: {PICTURE.stat().st_size / 1000:.0f} kB")
