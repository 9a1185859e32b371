"""The piano roll of the bench: one row per tick, the keys of each, and what the world says after it."""
