"""Write golden digests, our replays, the list of promises: `python3 tools/dev.py golden` (tests/golden/README.md)."""

from tests.support.golden_generated import write_generated
from tests.support.golden_runs import GOLDEN, write_golden_files
from tests.support.promises import write_promises

if __name__ == "__main__":
    write_golden_files()
    write_generated()
    write_promises()
    tables = ", ".join(sorted(path.name for path in GOLDEN.glob("*.tsv")))
    print(f"wrote the replays of tests/pack and levels, {tables}, promises.txt")
