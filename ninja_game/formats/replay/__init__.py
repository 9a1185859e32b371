"""Replays as text."""
