"""Levels as text that people write."""
