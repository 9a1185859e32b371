"""The state of a world, described once and held in two memories: plain Python objects, or NumPy records."""
