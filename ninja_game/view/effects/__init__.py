"""Particles for the events of a tick."""
