"""Sounds and music: what they are made of, and how."""
