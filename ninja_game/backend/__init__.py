"""The two memories of worlds, plain Python objects and NumPy records; the compiler; the choice between the memories."""
