"""ninja-game: a playable N-style platformer whose world is that of N v1.4, bit for bit."""

__version__ = "0.1.0"
