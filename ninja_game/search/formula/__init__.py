"""Search for keys of a span of ticks that reach a goal, given as a formula."""
