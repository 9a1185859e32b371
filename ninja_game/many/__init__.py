"""Many worlds at once: batches, verification at scale, search."""
