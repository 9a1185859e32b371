"""The piano roll of the TAS editor: a row per tick with its keys and the values after it."""
