"""The level on the bench: the world after any tick, ways and ghosts of runs, playing and taking over."""
