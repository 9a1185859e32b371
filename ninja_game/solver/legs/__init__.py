"""Runs that are put together from legs: from switch to switch, from gold to gold, to the exit."""
