"""Whole runs: results, traces, verification, measurements.

Of any recording, whoever made it and wherever it lies; what is kept of a player's own runs is ``player``.
"""
