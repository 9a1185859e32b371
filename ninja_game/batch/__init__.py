"""Many worlds stepped at once."""
