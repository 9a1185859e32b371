"""Runs that collect gold: in which order, and how to get from one piece to the next."""
