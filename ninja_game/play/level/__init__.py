"""The screen on which a level is played."""
