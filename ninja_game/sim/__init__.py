"""The deterministic world: no pygame, no clock, no I/O, no randomness."""
