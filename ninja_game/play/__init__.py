"""The front end: a window that shows the world, plays its sounds and reads the player's inputs.

What it keeps of a player is ``player``, which needs no window. Its files and folders lie above one another in the order
of the contract ``play`` in pyproject.toml: the main menu, the editor, the menus, the level, the panels over it, ...
"""
