"""Runs under edit, tick by tick: their simulation, history, files and journals, without a window."""
