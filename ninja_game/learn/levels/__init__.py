"""Levels to learn in: where they come from, and which of them an episode is played in."""
