"""What can be said of a level without playing it."""
