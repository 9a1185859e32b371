"""Scripts for those who work on the project, run by `python3 tools/dev.py tool NAME`; docs/tools.md lists them."""

import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent  # the project's folder

# Before any of them imports pygame: no window, no sound, no greeting.
os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
