"""The replay viewer, and its export as films and pictures."""
