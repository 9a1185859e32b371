"""What a player does and owns: attempts, records, progress, settings."""
