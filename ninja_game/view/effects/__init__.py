"""Particles that events set off."""
