"""Menus that lead to a level: episodes, packs, the browser, the level of the day."""
