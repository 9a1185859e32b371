"""Runs under edit, tick by tick: what they lead to, what was changed, what is kept of it on the disk. No window."""
