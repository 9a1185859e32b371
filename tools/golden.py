"""Write the golden digests and our replays again: `python3 tools/dev.py golden` (see tests/golden/README.md)."""

from __future__ import annotations

from tests.support.golden_generated import write_generated
from tests.support.golden_runs import GOLDEN, write_golden_files

if __name__ == "__main__":
    write_golden_files()
    write_generated()
    tables = ", ".join(sorted(path.name for path in GOLDEN.glob("*.tsv")))
    print(f"wrote the replays of tests/pack and levels, {tables}")
