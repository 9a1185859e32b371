"""The level editor in the window; what it does to a level is in ``ninja_game.editor``."""
