"""Packs: levels in episodes, in a folder or a zip (docs/making-levels.md)."""
