"""Test the tests of what is seen: break one drawing at a time and see whether a test notices.

    python3 tools/dev.py change-pictures [NAME …]

Exit code 1 if more than ``allowed`` go unnoticed.
"""

from __future__ import annotations

import sys

from tools.changes import Suite
from tools.picture_changes import CHANGES

SEEN = ("recorded_screens", "pictures", "backdrop", "palette", "lettering", "text_fields")
FILES = [f"tests/play/test_{name}.py" for name in SEEN]
SUITE = Suite("ninja_game/play", CHANGES, FILES, allowed=5)

if __name__ == "__main__":
    sys.exit(SUITE.run(sys.argv[1:]))
