"""Whole runs: results, traces, verification, measurements."""
