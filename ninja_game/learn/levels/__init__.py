"""Levels for learning: their sources, and the choice of the level of an episode."""
