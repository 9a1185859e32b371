"""Test the tests of events: make one reported event wrong at a time and see whether a test notices.

    python3 tools/dev.py change-events [NAME …]

The list comes from the sources (``event_changes``). Exit code 1 if more than ``allowed`` go unnoticed.
"""

from __future__ import annotations

import sys

from tools.changes import Suite
from tools.event_changes import event_changes

CHANGES = event_changes()
TESTS = ("tests/sim/test_golden.py", "-k", "every_golden_run and plain")
SUITE = Suite("ninja_game/sim", CHANGES, TESTS, allowed=len(CHANGES) // 20)

if __name__ == "__main__":
    sys.exit(SUITE.run(sys.argv[1:]))
