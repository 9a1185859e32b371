"""The piano roll of the TAS editor: one row per tick, the keys of each, and what the world says after it."""
