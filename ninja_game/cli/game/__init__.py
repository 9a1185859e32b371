"""Commands with a window, and films."""
