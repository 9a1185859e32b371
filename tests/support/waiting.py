"""How long tests wait for what is sure to come."""

LONGEST = 1200.0
"""Seconds: a slow, busy machine that compiles the rules for the first time needs minutes. Nothing waits this long in
vain but what hangs."""
