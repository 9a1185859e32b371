"""The piano roll of the TAS editor: a row a tick, the keys of each, and what the world says after it."""
