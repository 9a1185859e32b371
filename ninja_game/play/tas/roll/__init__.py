"""The piano roll of the bench: a row a tick, the keys of each, and what the world says after it."""
