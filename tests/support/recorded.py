"""Lines that are recorded in golden files: `python3 tools/dev.py accept-pictures` writes them again."""

import os
from collections.abc import Sequence
from difflib import unified_diff
from pathlib import Path

import pytest

ACCEPT = "ACCEPT_PICTURES" in os.environ


def hold_against(golden: Path, now: Sequence[str]) -> None:
    """Fail with what differs from a golden file, or record it."""
    if ACCEPT:
        golden.parent.mkdir(parents=True, exist_ok=True)
        golden.write_text("\n".join([*now, ""]), "utf-8")
    recorded = golden.read_text("utf-8").split("\n")[:-1]
    if list(now) != recorded:
        lines = unified_diff(recorded, list(now), "recorded", "now", lineterm="", n=1)
        pytest.fail("\n".join([f"{golden.stem}: meant? `python3 tools/dev.py accept-pictures`", *lines]))
