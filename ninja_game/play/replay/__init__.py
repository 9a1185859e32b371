"""The screen on which a replay is watched, and its export."""
