"""Whole runs: the result, traces, verification, measurements."""
