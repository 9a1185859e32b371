"""Whole runs: what came of them, traces, verification, measurements."""
