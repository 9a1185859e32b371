"""Observations: parts, each with a space of its own, put together as a Dict or as one row of numbers."""
