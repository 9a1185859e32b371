"""Drawings of tiles and objects; the ninja has its own folder, ``view.ninja``."""
