"""Other ways through a span of a run that is known, searched from save-states and joined to the rest of it."""
