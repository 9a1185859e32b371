"""Finds, shortens and certifies runs by search."""
