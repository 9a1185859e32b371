"""Facts about a level that need no play: episodes, findings, pictures."""
