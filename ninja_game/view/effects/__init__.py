"""Particles for events."""
