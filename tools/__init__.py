"""Scripts for those who work on the project, run by `python3 tools/dev.py tool NAME`; docs/tools.md lists them."""

from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
"""The project's folder."""
