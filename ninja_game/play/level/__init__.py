"""The screen for playing a level."""
