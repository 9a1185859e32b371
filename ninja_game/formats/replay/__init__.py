"""Replays as text, and notations of inputs (docs/replay-format.md)."""
