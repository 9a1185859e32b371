"""Observations: parts with their own spaces, combined in a Dict or in one row of numbers."""
