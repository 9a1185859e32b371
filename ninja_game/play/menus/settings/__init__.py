"""The settings: pages of widgets, and the change of keys and buttons."""
