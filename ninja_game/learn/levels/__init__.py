"""Levels to learn in: where they come from, and which of them an episode is played in."""

from __future__ import annotations

from ninja_game.learn.levels.origins import DEFAULT_LEVEL, Origin, generated_levels, level_source
from ninja_game.learn.levels.source import LevelChoice, LevelSource

__all__ = ["DEFAULT_LEVEL", "LevelChoice", "LevelSource", "Origin", "generated_levels", "level_source"]
