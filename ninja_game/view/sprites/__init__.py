"""Drawings of tiles and objects."""
