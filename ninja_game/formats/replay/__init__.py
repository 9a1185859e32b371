"""Replays as text, and notations of inputs."""
