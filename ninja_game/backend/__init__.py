"""Worlds, in two memories: plain Python objects or NumPy records; what compiles for them, and which one to use."""
