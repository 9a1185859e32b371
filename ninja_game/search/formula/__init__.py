"""Search for the keys of a span of ticks that reach a goal which a person states."""
