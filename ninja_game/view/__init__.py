"""The picture of a level in play: it reads the world and never changes it. ``level_view`` draws all of it."""
