"""Test the tests of the rules: break one rule at a time and see whether a test notices.

    python3 tools/dev.py change-rules [NAME …]

The tests run on the plain memory. docs/testing.md says which breaks are left and why. Exit code 1 if more than
``allowed`` go unnoticed.
"""

from __future__ import annotations

import sys

from tools.changes import Suite
from tools.rule_changes import CHANGES

FILES = [
    f"tests/sim/test_{name}.py"
    for name in ("golden", "check_values", "edges", "objects_harmless", "objects_deadly", "properties")
]
SUITE = Suite("ninja_game/sim", CHANGES, (*FILES, "-k", "not compiled and not memories"), allowed=5)

if __name__ == "__main__":
    sys.exit(SUITE.run(sys.argv[1:]))
