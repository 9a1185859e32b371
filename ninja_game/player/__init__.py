"""A player's data: attempts, records, progress, settings."""
