"""The readable text format of levels (docs/level-format.md)."""
