"""The state of a world, described once, and how rules are marked for the compiler; ``backend`` holds worlds."""
