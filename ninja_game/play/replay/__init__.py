"""The replay viewer, and its export."""
