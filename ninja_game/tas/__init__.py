"""Runs under edit, tick by tick: their simulation, their history, their files and journals. No window."""
