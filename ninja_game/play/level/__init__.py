"""The screen for playing a level; the picture of the level is in ``ninja_game.view``."""
