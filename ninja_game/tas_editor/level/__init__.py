"""The level in the TAS editor: the world after any tick, paths and ghosts of runs, playback and play by hand."""
